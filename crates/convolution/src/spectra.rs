//! Densities as Fourier sums over one range of the lattice, and fields from such sums.

use std::f64::consts::{PI, TAU};

use rustfft::num_complex::Complex;

use crate::lattice::dyadic_at_most;
use crate::plan::{UPSAMPLING, fast_length};
use crate::transforms::Transforms;
use crate::window::{WIDTH, Window};
use crate::{Density, Field, Rows};

/// Fourier transforms of densities, and inverse transforms to fields, over one range of x:
///
/// ```text
/// ρ̂(k) = Σ_j w_j e^{-ik(y_j − origin)},      S(x) = (1/P) Σ_k Ŝ(k) e^{ik(x − origin)}
/// ```
///
/// at the wave numbers k = 2πj/P, j = 0, 1, …, up to the band; P is slightly longer than the range. For one kernel and
/// one density use a [`Convolver`](crate::Convolver); here many densities, stored as few numbers, are added under
/// different kernels before one inverse transform.
///
/// **Guarantee.** The error of ρ̂ is at most 1e-14 Σ|w|, and that of S at most 1e-14 relative to Σ|Ŝ|/P, provided
/// that all sources and all contributions to S lie inside the range: S repeats with period P.
#[derive(Clone)]
pub struct Spectra {
    spacing: f64,
    first: i64,
    length: usize,
    /// 1/φ̂ at the wave numbers.
    window: Vec<f64>,
    cells: Vec<f64>,
    transforms: Transforms,
}

impl Spectra {
    /// Transforms for kernels with the bandwidth `band`, over a range that contains `from` and `to`.
    ///
    /// # Panics
    /// The bandwidth is not positive, or the range is empty or not finite.
    pub fn new(band: f64, from: f64, to: f64) -> Self {
        assert!(band > 0.0 && band.is_finite(), "band {band}");
        assert!(from.is_finite() && to.is_finite() && from < to, "a stretch from {from} to {to}");
        let spacing = dyadic_at_most(PI / (UPSAMPLING * band));
        let first = (from / spacing).floor() as i64 - WIDTH as i64;
        let last = (to / spacing).ceil() as i64 + WIDTH as i64;
        let length = fast_length((last - first) as usize + 1);
        let transforms = Transforms::new(length);
        let of_mode =
            |mode: usize| 1.0 / Window::shared().transform(TAU * mode as f64 / length as f64);
        Self {
            spacing,
            first,
            length,
            window: (0..transforms.modes.len()).map(of_mode).collect(),
            cells: vec![0.0; length],
            transforms,
        }
    }

    /// The spacing required of densities.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Origin of the phases.
    pub fn origin(&self) -> f64 {
        self.first as f64 * self.spacing
    }

    /// The wave numbers, from 0 on.
    pub fn wave_numbers(&self) -> impl ExactSizeIterator<Item = f64> + use<> {
        let lowest = TAU / (self.length as f64 * self.spacing);
        (0..self.window.len()).map(move |mode| mode as f64 * lowest)
    }

    /// Valid positions of sources and targets.
    pub fn range(&self) -> std::ops::RangeInclusive<f64> {
        let at = |cell: i64| (self.first + cell) as f64 * self.spacing;
        at(WIDTH as i64)..=at(self.length as i64 - 1 - WIDTH as i64)
    }

    /// ρ̂ of a whole density.
    ///
    /// # Panics
    /// The density has another spacing, or sources outside of the range.
    pub fn of(&mut self, density: &Density) -> Vec<Complex<f64>> {
        let same = density.spacing().to_bits() == self.spacing.to_bits();
        assert!(same, "density of spacing {}, not {}", density.spacing(), self.spacing);
        let (range, end) = (density.range(), self.first + self.length as i64);
        let inside = range.is_empty() || (range.start >= self.first && range.end <= end);
        assert!(inside, "sources in the cells {range:?}, beyond {}..{end}", self.first);
        density.copy_window(self.first, &mut self.cells);
        self.transformed()
    }

    /// Empty rows over the range, for sources or for sums.
    pub fn rows(&self, count: usize) -> Rows {
        Rows::new(self.spacing, self.first, self.length, count)
    }

    /// ρ̂ of a row of sources, of [`rows`](Self::rows) made by these spectra.
    pub fn of_row(&mut self, rows: &Rows, row: usize) -> Vec<Complex<f64>> {
        rows.copy(row, &mut self.cells);
        self.transformed()
    }

    fn transformed(&mut self) -> Vec<Complex<f64>> {
        self.transforms.forward(&self.cells);
        self.transforms.modes.iter().zip(&self.window).map(|(mode, window)| mode * window).collect()
    }

    /// S(x) from these Ŝ.
    ///
    /// # Panics
    /// The number of Ŝ differs from that of wave numbers.
    pub fn field(&mut self, spectrum: &[Complex<f64>]) -> Field {
        let mut cells = vec![0.0; self.length];
        self.invert(spectrum, &mut cells);
        Field::of_cells(self.spacing, self.first, cells)
    }

    /// Sets a row of sums, of [`rows`](Self::rows) made by these spectra, to S(x) from these Ŝ.
    ///
    /// # Panics
    /// As [`field`](Self::field).
    pub fn set_row(&mut self, rows: &mut Rows, row: usize, spectrum: &[Complex<f64>]) {
        let mut cells = std::mem::take(&mut self.cells);
        self.invert(spectrum, &mut cells);
        rows.set(row, &cells);
        self.cells = cells;
    }

    fn invert(&mut self, spectrum: &[Complex<f64>], cells: &mut [f64]) {
        assert_eq!(spectrum.len(), self.window.len(), "one number for each wave number");
        let scale = 1.0 / (self.spacing * self.length as f64);
        let modes = self.transforms.modes.iter_mut();
        for ((mode, given), window) in modes.zip(spectrum).zip(&self.window) {
            *mode = given * (window * scale);
        }
        self.transforms.backward(cells);
    }
}
