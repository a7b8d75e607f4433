//! Random footprints.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha20Rng;
use stickslip_tip::{Gaussian, TipFunction};

#[allow(dead_code, reason = "printed")]
/// How one was made.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kind {
    /// This many pairs of lobes beside a Gaussian of width 1.
    Lobes(usize),
    /// A table of so many rows of a smooth shape.
    Table(usize),
}

/// So many tips that are accepted, always the same.
pub(crate) fn tips(count: usize) -> Vec<(Kind, TipFunction)> {
    let mut rng = ChaCha20Rng::seed_from_u64(12);
    let mut tips = vec![];
    while tips.len() < count {
        let (kind, tip) = if tips.len() % 2 == 0 { lobed(&mut rng) } else { table(&mut rng) };
        tips.extend(tip.map(|tip| (kind, tip)));
    }
    tips
}

fn lobed(rng: &mut ChaCha20Rng) -> (Kind, Option<TipFunction>) {
    let pairs = rng.random_range(1..=3);
    let mut terms = vec![Gaussian { amplitude: 1.0, center: 0.0, width: 1.0 }];
    for _ in 0..pairs {
        let amplitude = rng.random_range(-0.6..0.8);
        let (center, width) = (rng.random_range(0.3..5.0), 60_f64.powf(rng.random::<f64>()) * 0.05);
        terms.extend([center, -center].map(|center| Gaussian { amplitude, center, width }));
    }
    (Kind::Lobes(pairs), TipFunction::gaussian_sum(terms).ok())
}

fn table(rng: &mut ChaCha20Rng) -> (Kind, Option<TipFunction>) {
    let rows = (8.0 * 250_f64.powf(rng.random::<f64>())) as usize;
    let (shape, length) = (rng.random_range(0..5), rng.random_range(4.0..12.0));
    let (lobe, at) = (rng.random_range(-0.3..0.5), rng.random_range(1.0..3.0));
    let f = |x: f64| match shape {
        0 => (-0.5 * x * x).exp(),
        1 => (1.0 + x * x).powi(-4),
        2 => 1.0 / x.cosh(),
        3 => {
            (-0.5 * x * x).exp()
                + lobe * ((-2.0 * (x - at).powi(2)).exp() + (-2.0 * (x + at).powi(2)).exp())
        }
        _ => (1.0 - (x / 3.0).powi(2)).max(0.0).powi(3),
    };
    let x: Vec<f64> = (0..rows).map(|i| length * i as f64 / (rows - 1) as f64).collect();
    let f: Vec<f64> = x.iter().map(|x| f(*x)).collect();
    (Kind::Table(rows), TipFunction::table(&x, &f).ok())
}
