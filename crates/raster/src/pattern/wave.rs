//! The wave vector of a sheet of heights.

use ndarray::{Array1, Array2};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Heights on evenly spaced points of evenly spaced lines, less the mean and slope of each line.
pub(super) struct Sheet {
    pub(super) u: Array2<f64>,
    pub(super) from: f64,
    pub(super) spacing: f64,
    pub(super) pitch: f64,
    /// Beyond this wave number there is nothing.
    band: f64,
    /// sin² that fades both ends, of the points of a line and of the lines.
    windows: (Vec<f64>, Vec<f64>),
}

/// Where the power |Σ window u e^{-i(qx + κy)}|² has a maximum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wave {
    pub(super) q: f64,
    pub(super) kappa: f64,
    pub(super) power: f64,
}

/// Fewer waves on a sheet than these are no ripples but its shape.
const FEWEST_WAVES: f64 = 2.0;
/// Samples in the width of a peak.
const PER_PEAK: f64 = 2.0;
/// Of the band: what is looked through. The groove of a sharp pit has less than e^{-6} of its power beyond.
const LOOKED_AT: f64 = 0.4;
/// Within so many widths of a peak of κ = 0 all lines do alike, by the edge from which they all start.
const ALIKE: f64 = 3.0;
/// What is oblique is no ripple where it has less than this part of the power of the strongest wave.
const FAR_WEAKER: f64 = 0.1;
/// Waves of this part of the power of the strongest are as strong.
const AS_STRONG: f64 = 0.5;

fn window(count: usize) -> Vec<f64> {
    (0..count).map(|i| (PI * (i as f64 + 0.5) / count as f64).sin().powi(2)).collect()
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
        let windows = (window(u.ncols()), window(u.nrows()));
        Self { u, from, spacing, pitch, band, windows }
    }

    /// Half peak-to-peak.
    pub(super) fn amplitude(&self) -> f64 {
        let ends = |(low, high): (f64, f64), u: &f64| (low.min(*u), high.max(*u));
        let (low, high) = self.u.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
        0.5 * (high - low)
    }

    /// What is left in the last third of the lines of what is in the first, root mean square, line means and slopes taken out.
    pub(super) fn kept_along(&self) -> f64 {
        let third = self.u.ncols() / 3;
        let part = |from: usize| -> f64 {
            let rows = self.u.rows().into_iter();
            let part: Vec<f64> =
                rows.flat_map(|row| row.to_vec()[from..from + third].to_vec()).collect();
            let mean = part.iter().sum::<f64>() / part.len() as f64;
            part.iter().map(|u| (u - mean).powi(2)).sum::<f64>().sqrt()
        };
        part(self.u.ncols() - third) / part(0)
    }

    /// How far slopes all point one way, whichever: 1 where u is made of straight crests, 0 where it is the same in all
    /// directions. (λ1 - λ2)/(λ1 + λ2) of the mean of ∇u ∇uᵀ.
    pub(super) fn straightness(&self) -> f64 {
        let (rows, columns) = self.u.dim();
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for n in 1..rows - 1 {
            for i in 1..columns - 1 {
                let x = (self.u[(n, i + 1)] - self.u[(n, i - 1)]) / (2.0 * self.spacing);
                let y = (self.u[(n + 1, i)] - self.u[(n - 1, i)]) / (2.0 * self.pitch);
                (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
            }
        }
        (xx - yy).hypot(2.0 * xy) / (xx + yy)
    }

    /// Wave numbers that differ by less than these are the same to it.
    fn resolution(&self) -> (f64, f64) {
        let (rows, columns) = self.u.dim();
        (TAU / (self.spacing * columns as f64), TAU / (self.pitch * rows as f64))
    }

    /// Σ_i window u_n(x_i) e^{-iqx_i} of every line.
    fn along(&self, q: f64) -> Array1<Complex64> {
        let factor = |(i, window): (usize, &f64)| {
            Complex64::from_polar(*window, -q * self.spacing * i as f64)
        };
        let factors: Vec<Complex64> = self.windows.0.iter().enumerate().map(factor).collect();
        let line =
            |row: ndarray::ArrayView1<f64>| row.iter().zip(&factors).map(|(u, f)| f * u).sum();
        self.u.rows().into_iter().map(line).collect()
    }

    /// The same over the lines.
    fn across(&self, along: &Array1<Complex64>, kappa: f64) -> f64 {
        let turn = Complex64::from_polar(1.0, -kappa * self.pitch);
        let (mut phase, mut sum) = (Complex64::new(1.0, 0.0), Complex64::default());
        for (value, window) in along.iter().zip(&self.windows.1) {
            sum += value * phase * window;
            phase *= turn;
        }
        sum.norm_sqr()
    }

    fn power(&self, q: f64, kappa: f64) -> f64 {
        self.across(&self.along(q), kappa)
    }
}

impl Wave {
    /// Whether all lines do alike.
    pub(super) fn is_upright(&self, sheet: &Sheet) -> bool {
        self.kappa.abs() <= ALIKE * sheet.resolution().1
    }

    /// The wave vector of the ripples: that of the oblique ones, unless what all lines do alike is far stronger; and of
    /// those that are as strong the longest, the others being it and what it is modulated by.
    pub(super) fn of_ripples(sheet: &Sheet) -> Option<Self> {
        let peaks = Self::peaks(sheet);
        let (dq, dk) = sheet.resolution();
        let power = |wave: &&Self| wave.power;
        let strongest = |waves: &[&Self]| waves.iter().map(power).fold(0.0, f64::max);
        let all: Vec<&Self> = peaks.iter().collect();
        let oblique: Vec<&Self> =
            peaks.iter().filter(|wave| wave.kappa.abs() > ALIKE * dk).collect();
        let is_oblique = strongest(&oblique) > FAR_WEAKER * strongest(&all);
        let candidates = if is_oblique { oblique } else { all };
        let least = AS_STRONG * strongest(&candidates);
        let strong = candidates.into_iter().filter(|wave| wave.power >= least);
        let longest = strong.min_by(|a, b| a.q.hypot(a.kappa).total_cmp(&b.q.hypot(b.kappa)))?;
        Some(longest.refined(sheet, (dq / PER_PEAK, dk / PER_PEAK)))
    }

    /// Where the power is larger than all around, q > 0.
    fn peaks(sheet: &Sheet) -> Vec<Self> {
        let (dq, dk) = sheet.resolution();
        let (step_q, step_k) = (dq / PER_PEAK, dk / PER_PEAK);
        let half = (PI / sheet.pitch / step_k).round() as i64;
        let first = (FEWEST_WAVES * PER_PEAK) as i64;
        let last = (LOOKED_AT * sheet.band / step_q) as i64;
        let row = |i: i64| -> Vec<f64> {
            let along = sheet.along(step_q * i as f64);
            (-half..half).map(|j| sheet.across(&along, step_k * j as f64)).collect()
        };
        let power: Vec<Vec<f64>> = (first..=last).map(row).collect();
        let columns = 2 * half as usize;
        let mut peaks = vec![];
        for (n, row) in power.iter().enumerate() {
            let rows = &power[n.saturating_sub(1)..power.len().min(n + 2)];
            for (j, here) in row.iter().enumerate() {
                // Beyond ±π/d phases begin again.
                let near = [j + columns - 1, j, j + 1].map(|j| j % columns);
                if rows.iter().all(|row| near.iter().all(|j| row[*j] <= *here)) {
                    let q = step_q * (first + n as i64) as f64;
                    let kappa = step_k * (j as i64 - half) as f64;
                    peaks.push(Self { q, kappa, power: *here });
                }
            }
        }
        peaks
    }

    /// The top of the peak, by parabolas through the logarithm of the power.
    fn refined(mut self, sheet: &Sheet, (mut step_q, mut step_k): (f64, f64)) -> Self {
        for _ in 0..8 {
            let top = |left: f64, right: f64, here: f64| {
                let (left, right, here) = (left.ln(), right.ln(), here.ln());
                let bend = left - 2.0 * here + right;
                if bend < 0.0 { (0.5 * (left - right) / bend).clamp(-1.0, 1.0) } else { 0.0 }
            };
            let here = sheet.power(self.q, self.kappa);
            let sides = [-1.0, 1.0].map(|s| sheet.power(self.q + s * step_q, self.kappa));
            self.q += step_q * top(sides[0], sides[1], here);
            let along = sheet.along(self.q);
            let at = |kappa: f64| sheet.across(&along, kappa);
            let sides = [-1.0, 1.0].map(|s| at(self.kappa + s * step_k));
            self.kappa += step_k * top(sides[0], sides[1], at(self.kappa));
            (step_q, step_k) = (0.4 * step_q, 0.4 * step_k);
        }
        self.power = sheet.power(self.q, self.kappa);
        self
    }
}
