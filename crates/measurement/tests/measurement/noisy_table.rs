//! A raw table as tests of its judgement draw it, of the library and of this program.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use rand::RngExt;

/// A Gaussian in this many rows, each off by up to `noise`, the last one 0.
pub(crate) fn table(rows: u32, noise: f64, seed: u64) -> (Vec<f64>, Vec<f64>) {
    let x: Vec<f64> = (0..rows).map(|i| 8.0 * f64::from(i) / f64::from(rows - 1)).collect();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut more = || noise * random.random_range(-1.0..=1.0);
    let mut f: Vec<f64> = x.iter().map(|x| (-0.5 * x * x).exp() + more()).collect();
    f[rows as usize - 1] = 0.0;
    (x, f)
}
