//! Heights on a rectangle of evenly spaced lines.

use ndarray::{Array1, Array2, ArrayView2, Axis, Slice};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use std::ops::Range;
use stickslip_convolution::Transform;
use stickslip_tip::sorting::ends;

/// Heights on evenly spaced points of evenly spaced lines, minus the mean and slope of each line or minus a plane.
pub(super) struct Sheet {
    pub(super) u: Array2<f64>,
    pub(super) from: f64,
    pub(super) spacing: f64,
    pub(super) pitch: f64,
    /// Largest wave number of the heights.
    pub(super) band: f64,
    /// sin² windows (Hann), of the points of a line and of the lines.
    pub(super) windows: (Vec<f64>, Vec<f64>),
}

/// Number of lines that a thread sums together: another one begins for no less.
const TOGETHER: usize = 32;

fn window(count: usize) -> Vec<f64> {
    (0..count).map(|i| (PI * (i as f64 + 0.5) / count as f64).sin().powi(2)).collect()
}

fn root_mean_square<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), u| (sum + u * u, count + 1));
    (sum / count.max(1) as f64).sqrt()
}

/// (Σe)²/Σe²: the effective number of contributions.
pub(super) fn participating(e: &[f64]) -> f64 {
    let squares: f64 = e.iter().map(|e| e * e).sum();
    if squares > 0.0 { e.iter().sum::<f64>().powi(2) / squares } else { 0.0 }
}

impl Sheet {
    pub(super) fn new(
        mut u: Array2<f64>,
        (from, spacing): (f64, f64),
        pitch: f64,
        band: f64,
    ) -> Self {
        let middle = 0.5 * (u.ncols() as f64 - 1.0);
        let moment: f64 = (0..u.ncols()).map(|i| (i as f64 - middle).powi(2)).sum();
        for mut row in u.rows_mut() {
            let mean = row.sum() / row.len() as f64;
            let tilt = row.iter().enumerate().map(|(i, u)| u * (i as f64 - middle)).sum::<f64>();
            let tilt = tilt / moment;
            row.iter_mut().enumerate().for_each(|(i, u)| *u -= mean + tilt * (i as f64 - middle));
        }
        Self::of(u, (from, spacing), pitch, band)
    }

    /// Heights minus a plane: a relief that is uniform along the lines remains.
    pub(super) fn about_a_plane(mut u: Array2<f64>, at: (f64, f64), pitch: f64, band: f64) -> Self {
        let middle = |count: usize| 0.5 * (count as f64 - 1.0);
        let (rows, columns) = u.dim();
        let off = |n: usize, count: usize| n as f64 - middle(count);
        let moment = |count: usize| (0..count).map(|n| off(n, count).powi(2)).sum::<f64>();
        let mean = u.sum() / u.len() as f64;
        let tilt = |of: &dyn Fn((usize, usize)) -> f64, moment: f64, beside: usize| {
            let sum: f64 = u.indexed_iter().map(|(at, u)| u * of(at)).sum();
            sum / (moment * beside as f64)
        };
        let across = tilt(&|(n, _)| off(n, rows), moment(rows), columns);
        let along = tilt(&|(_, i)| off(i, columns), moment(columns), rows);
        for ((n, i), u) in u.indexed_iter_mut() {
            *u -= mean + across * off(n, rows) + along * off(i, columns);
        }
        Self::of(u, at, pitch, band)
    }

    fn of(u: Array2<f64>, (from, spacing): (f64, f64), pitch: f64, band: f64) -> Self {
        let windows = (window(u.ncols()), window(u.nrows()));
        Self { u, from, spacing, pitch, band, windows }
    }

    /// The same heights with x and y exchanged; the new y counts from the first of the former points.
    pub(super) fn exchanged(&self) -> Self {
        let u = self.u.t().as_standard_layout().into_owned();
        Self::of(u, (0.0, self.pitch), self.spacing, self.band)
    }

    /// A part of the heights, unchanged.
    pub(super) fn part(&self, rows: Range<usize>, columns: Range<usize>) -> Self {
        let from = self.from + self.spacing * columns.start as f64;
        let u = cut(self.u.view(), rows, columns).to_owned();
        Self::of(u, (from, self.spacing), self.pitch, self.band)
    }

    /// The first and the last half of the lines.
    pub(super) fn halves(&self) -> [Self; 2] {
        let (rows, columns) = self.u.dim();
        [0..rows / 2, rows / 2..rows].map(|half| self.part(half, 0..columns))
    }

    pub(super) fn quarters(&self) -> [Self; 4] {
        let (rows, columns) = self.u.dim();
        quarters(rows, columns).map(|(rows, columns)| self.part(rows, columns))
    }

    /// The heights minus the mean over all lines.
    pub(super) fn unlike(&self) -> Array2<f64> {
        let rows = self.u.nrows() as f64;
        &self.u - &(self.u.sum_axis(Axis(0)) / rows)
    }

    /// Half peak-to-peak.
    pub(super) fn amplitude(&self) -> f64 {
        let (low, high) = ends(self.u.iter().copied());
        0.5 * (high - low)
    }

    /// Root mean square in the first, the middle and the last third of the length of the lines.
    pub(super) fn thirds(&self) -> [f64; 3] {
        let (rows, columns) = self.u.dim();
        let third = columns / 3;
        [0..third, third..columns - third, columns - third..columns]
            .map(|part| root_mean_square(cut(self.u.view(), 0..rows, part).iter()))
    }

    /// Effective number of lines that contain the relief.
    pub(super) fn visible_rows(&self) -> f64 {
        let rows = self.u.rows().into_iter();
        participating(&rows.map(|row| row.iter().map(|u| u * u).sum()).collect::<Vec<_>>())
    }

    /// Alignment of slopes: 1 if u consists of straight crests, 0 if it is isotropic. (λ1 - λ2)/(λ1 + λ2) of the mean
    /// of ∇u ∇uᵀ, the structure tensor, weighted by the squares of the windows.
    pub(super) fn straightness(&self) -> f64 {
        let (rows, columns) = self.u.dim();
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for n in 1..rows - 1 {
            for i in 1..columns - 1 {
                let weight = (self.windows.0[i] * self.windows.1[n]).powi(2);
                let x = (self.u[(n, i + 1)] - self.u[(n, i - 1)]) / (2.0 * self.spacing);
                let y = (self.u[(n + 1, i)] - self.u[(n - 1, i)]) / (2.0 * self.pitch);
                (xx, xy, yy) = (xx + weight * x * x, xy + weight * x * y, yy + weight * y * y);
            }
        }
        (xx - yy).hypot(2.0 * xy) / (xx + yy)
    }

    /// Smallest differences of wave numbers, along and across the lines, that can be distinguished.
    pub(super) fn resolution(&self) -> (f64, f64) {
        let (rows, columns) = self.u.dim();
        (TAU / (self.spacing * columns as f64), TAU / (self.pitch * rows as f64))
    }

    /// Σ_i window u_n(x_i) e^{-iqx_i} of every line.
    pub(super) fn along(&self, q: f64) -> Array1<Complex64> {
        let factor = |(i, window): (usize, &f64)| {
            Complex64::from_polar(*window, -q * (self.from + self.spacing * i as f64))
        };
        let factors: Vec<Complex64> = self.windows.0.iter().enumerate().map(factor).collect();
        let line = |n: usize| self.u.row(n).iter().zip(&factors).map(|(u, f)| f * u).sum();
        let lines = (0..self.u.nrows()).into_par_iter().with_min_len(TOGETHER);
        lines.map(line).collect::<Vec<_>>().into()
    }

    /// |Σ_n window a_n e^{-iκy_n}|² over all lines n, where `along` contains a_n.
    pub(super) fn across(&self, along: &Array1<Complex64>, kappa: f64) -> f64 {
        let turn = Complex64::from_polar(1.0, -kappa * self.pitch);
        let (mut phase, mut sum) = (Complex64::new(1.0, 0.0), Complex64::default());
        for (value, window) in along.iter().zip(&self.windows.1) {
            sum += value * phase * window;
            phase *= turn;
        }
        sum.norm_sqr()
    }

    /// The powers at κ = 2πj/(pitch N), for j from -N/2 on, where N is the even length of the transform, at least the
    /// number of lines.
    pub(super) fn powers(&self, q: f64, transform: &Transform) -> Vec<f64> {
        let along = self.along(q);
        let mut sums: Vec<Complex64> =
            along.iter().zip(&self.windows.1).map(|(value, window)| value * window).collect();
        sums.resize(transform.length(), Complex64::default());
        transform.of(&mut sums);
        sums.rotate_right(transform.length() / 2);
        sums.iter().map(Complex64::norm_sqr).collect()
    }

    /// The power |Σ window u e^{-i(qx + κy)}|².
    pub(super) fn power(&self, q: f64, kappa: f64) -> f64 {
        self.across(&self.along(q), kappa)
    }
}

/// Root mean square of the first and of the last half of the rows.
pub(super) fn halves_of(u: &Array2<f64>) -> [f64; 2] {
    let (rows, columns) = u.dim();
    [0..rows / 2, rows / 2..rows]
        .map(|half| root_mean_square(cut(u.view(), half, 0..columns).iter()))
}

/// The part with these rows and columns.
pub(super) fn cut<T>(
    mut of: ArrayView2<'_, T>,
    rows: Range<usize>,
    columns: Range<usize>,
) -> ArrayView2<'_, T> {
    of.slice_axis_inplace(Axis(0), Slice::from(rows));
    of.slice_axis_inplace(Axis(1), Slice::from(columns));
    of
}

/// Rows and columns of the four quarters.
pub(super) fn quarters(rows: usize, columns: usize) -> [(Range<usize>, Range<usize>); 4] {
    let (r, c) = (rows / 2, columns / 2);
    [(0..r, 0..c), (0..r, c..columns), (r..rows, 0..c), (r..rows, c..columns)]
}
