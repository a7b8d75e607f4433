//! Fourier transforms of the cells of a lattice, and back.

use std::f64::consts::TAU;
use std::sync::Arc;

use rustfft::algorithm::butterflies::{
    Butterfly1, Butterfly2, Butterfly3, Butterfly4, Butterfly5, Butterfly6, Butterfly8,
    Butterfly12, Butterfly16,
};
use rustfft::algorithm::{MixedRadixSmall, Radix3, Radix4};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftDirection};

use crate::plan::{fast_length, is_smooth};

/// The Fourier transform of complex sequences of one length N: `F_k = Σ_n f_n e^{-2πikn/N}`.
#[derive(Clone)]
pub struct Transform(Arc<dyn Fft<f64>>);

impl Transform {
    /// The transform of the least length that is fast, an even product of 2, 3 and 5, and at least this.
    pub fn at_least(length: usize) -> Self {
        Self(planned(fast_length(length), FftDirection::Forward))
    }

    /// The length N.
    pub fn length(&self) -> usize {
        self.0.len()
    }

    /// Replaces a sequence by its transform.
    ///
    /// # Panics
    /// The sequence has another length.
    pub fn of(&self, sequence: &mut [Complex<f64>]) {
        assert_eq!(sequence.len(), self.length(), "length of a transform");
        self.0.process(sequence);
    }
}

/// The transform of a length that is a product of 2, 3 and 5. The planner of rustfft, for any length and for one of several
/// sets of instructions, takes four times as long to compile as the rest of this crate; this one has the same bits on
/// every processor.
fn planned(length: usize, direction: FftDirection) -> Arc<dyn Fft<f64>> {
    // Takes factors out of the length until the rest is no longer than a butterfly that is at hand: their number, and the
    // transform of the rest.
    let without = |factor: usize, longest: usize| {
        let (mut count, mut rest) = (0, length);
        while rest > longest && rest.is_multiple_of(factor) {
            (count, rest) = (count + 1, rest / factor);
        }
        (count, planned(rest, direction))
    };
    match length {
        1 => Arc::new(Butterfly1::new(direction)),
        2 => Arc::new(Butterfly2::new(direction)),
        3 => Arc::new(Butterfly3::new(direction)),
        4 => Arc::new(Butterfly4::new(direction)),
        5 => Arc::new(Butterfly5::new(direction)),
        6 => Arc::new(Butterfly6::new(direction)),
        8 => Arc::new(Butterfly8::new(direction)),
        12 => Arc::new(Butterfly12::new(direction)),
        16 => Arc::new(Butterfly16::new(direction)),
        _ if length.is_multiple_of(5) => {
            let [five, rest] = [5, length / 5].map(|length| planned(length, direction));
            Arc::new(MixedRadixSmall::new(five, rest))
        }
        _ if length.is_multiple_of(4) => {
            let (fours, rest) = without(4, 16);
            Arc::new(Radix4::new_with_base(fours, rest))
        }
        _ => {
            let (threes, rest) = without(3, 6);
            Arc::new(Radix3::new_with_base(threes, rest))
        }
    }
}

/// Transforms of real sequences of one even length N, and the modes from 0 to N/4: the others are not needed.
#[derive(Clone)]
pub(crate) struct Transforms {
    forward: Arc<dyn Fft<f64>>,
    backward: Arc<dyn Fft<f64>>,
    /// `e^{-2πik/N}` of each mode.
    turns: Vec<Complex<f64>>,
    pub(crate) modes: Vec<Complex<f64>>,
    /// Pairs of cells as complex numbers, and their transform.
    pairs: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Transforms {
    pub(crate) fn new(length: usize) -> Self {
        let is_fast = length.is_multiple_of(2) && is_smooth(length);
        assert!(is_fast, "length {length} is not an even product of 2, 3 and 5");
        let [forward, backward] = [FftDirection::Forward, FftDirection::Inverse]
            .map(|direction| planned(length / 2, direction));
        let needed = forward.get_inplace_scratch_len().max(backward.get_inplace_scratch_len());
        let turn = |mode: usize| Complex::cis(-TAU * mode as f64 / length as f64);
        Self {
            turns: (0..=length / 4).map(turn).collect(),
            modes: vec![Complex::ZERO; length / 4 + 1],
            pairs: vec![Complex::ZERO; length / 2],
            scratch: vec![Complex::ZERO; needed],
            forward,
            backward,
        }
    }

    /// Sets the modes to the transform of these cells.
    ///
    /// With `z_n = x_{2n} + i x_{2n+1}` and its transform Z of length M = N/2,
    /// `X_k = (Z_k + Z*_{M-k})/2 - i e^{-2πik/N} (Z_k - Z*_{M-k})/2`.
    pub(crate) fn forward(&mut self, cells: &[f64]) {
        let Self { turns, modes, pairs, scratch, .. } = self;
        for (pair, cells) in pairs.iter_mut().zip(cells.as_chunks().0) {
            let [re, im] = *cells;
            *pair = Complex::new(re, im);
        }
        self.forward.process_with_scratch(pairs, scratch);
        // Z_M is Z_0.
        let falling = pairs.iter().take(1).chain(pairs.iter().rev());
        for (((mode, turn), z), other) in modes.iter_mut().zip(turns).zip(&*pairs).zip(falling) {
            let (sum, difference) = (z + other.conj(), z - other.conj());
            *mode = 0.5 * (sum + Complex::new(difference.im, -difference.re) * *turn);
        }
    }

    /// Sets the cells to the inverse transform of the modes. Both transforms together multiply by the length.
    ///
    /// `Z_k = X_k (1 + i e^{2πik/N})`, `Z*_{M-k} = X_k (1 - i e^{2πik/N})`, as the modes above N/4 are 0.
    pub(crate) fn backward(&mut self, cells: &mut [f64]) {
        let Self { turns, modes, pairs, scratch, .. } = self;
        // The mean of real cells is real.
        modes[0].im = 0.0;
        pairs.fill(Complex::ZERO);
        let last = pairs.len();
        for (k, (mode, turn)) in modes.iter().zip(turns).enumerate() {
            let turned = mode * Complex::new(turn.im, turn.re);
            pairs[k] = mode + turned;
            if k > 0 {
                pairs[last - k] = (mode - turned).conj();
            }
        }
        self.backward.process_with_scratch(pairs, scratch);
        for (cells, pair) in cells.as_chunks_mut().0.iter_mut().zip(pairs) {
            *cells = [pair.re, pair.im];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    /// `Σ_n f_n e^{∓2πikn/N}`
    fn summed(f: &[Complex<f64>], k: usize, sign: f64) -> Complex<f64> {
        let length = f.len();
        let turn = |n: usize| sign * TAU * (k * n % length) as f64 / length as f64;
        f.iter().enumerate().map(|(n, f)| f * Complex::cis(turn(n))).sum()
    }

    fn drawn(count: usize) -> Vec<Complex<f64>> {
        let mut random = chacha20::ChaCha8Rng::seed_from_u64(count as u64);
        let mut number = || random.random_range(-1.0..1.0);
        (0..count).map(|_| Complex::new(number(), number())).collect()
    }

    const LENGTHS: [usize; 16] = [2, 4, 6, 8, 10, 12, 16, 20, 30, 32, 36, 48, 90, 128, 150, 480];

    #[test]
    fn planned_transforms_are_sums() {
        for length in LENGTHS.into_iter().chain([1, 3, 5, 9, 15, 25, 75]) {
            for (direction, sign) in [(FftDirection::Forward, -1.0), (FftDirection::Inverse, 1.0)] {
                let given = drawn(length);
                let mut found = given.clone();
                planned(length, direction).process(&mut found);
                for (k, found) in found.iter().enumerate() {
                    assert!(
                        (found - summed(&given, k, sign)).norm() < 1e-13 * length as f64,
                        "{length} {k}"
                    );
                }
            }
        }
    }

    #[test]
    fn modes_of_real_cells_are_sums_and_give_back_smooth_cells() {
        for length in LENGTHS {
            let mut transforms = Transforms::new(length);
            let mut spectrum = drawn(length / 4 + 1);
            spectrum[0].im = 0.0;
            let mut cells = vec![0.0; length];
            transforms.modes.copy_from_slice(&spectrum);
            transforms.backward(&mut cells);
            let complex: Vec<Complex<f64>> = cells.iter().map(Complex::from).collect();
            for (k, given) in spectrum.iter().enumerate() {
                let found = summed(&complex, k, -1.0);
                assert!((found - length as f64 * given).norm() < 1e-13 * length.pow(2) as f64);
            }
            for k in length / 4 + 1..=length / 2 {
                assert!(summed(&complex, k, -1.0).norm() < 1e-13 * length.pow(2) as f64);
            }
            transforms.forward(&cells);
            for (found, given) in transforms.modes.iter().zip(&spectrum) {
                assert!((found - length as f64 * given).norm() < 1e-13 * length.pow(2) as f64);
            }
        }
    }
}
