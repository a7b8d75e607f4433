//! The strongest waves of an area.

use super::sheet::{Sheet, halves_of};
use rayon::prelude::*;
use std::f64::consts::PI;
use stickslip_convolution::Transform;
use stickslip_tip::sorting::sort_by_number;

/// A maximum of the power |Σ window u e^{-i(qx + κy)}|².
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wave {
    pub(super) q: f64,
    pub(super) kappa: f64,
    pub(super) power: f64,
}

/// Smallest number of waves along a line in the search: lower wave numbers were removed with mean and slope.
const FEWEST_SEEN: f64 = 1.0;
/// Number of samples in the width of a peak.
const PER_PEAK: f64 = 2.0;
/// Largest wave number of the search, as a fraction of the bandwidth. The groove of a sharp pit has less than e^{-6}
/// of its power beyond.
const LOOKED_AT: f64 = 0.4;
/// Smallest angle of the crests of ripples to the scan axis, in degrees, as in linear theory.
const FLATTEST: f64 = 22.5;
/// Smallest power of a rival, relative to the strongest wave.
const RIVAL: f64 = 0.5;

impl Wave {
    /// Angle of the crests to the lines, in degrees.
    pub(super) fn angle(&self) -> f64 {
        self.q.atan2(self.kappa.abs()).to_degrees()
    }

    /// The relief of the second half of the lines over that of the first: in total, and of this wave.
    pub(super) fn changes(&self, sheet: &Sheet) -> [f64; 2] {
        let [before, after] = halves_of(&sheet.u);
        let halves = sheet
            .halves()
            .map(|half| half.power(self.q, self.kappa).sqrt() / half.u.nrows() as f64);
        [after / before, halves[1] / halves[0]]
    }

    /// The same wave with x and y exchanged, with a positive wave number along the new lines.
    pub(super) fn exchanged(&self) -> Self {
        let sign = if self.kappa < 0.0 { -1.0 } else { 1.0 };
        Self { q: sign * self.kappa, kappa: sign * self.q, power: self.power }
    }

    /// Whether the crests are closer to the lines than to the diagonal: those of trenches and pairs.
    pub(super) fn is_along_the_lines(&self) -> bool {
        self.angle() < FLATTEST
    }

    pub(super) fn length(&self) -> f64 {
        std::f64::consts::TAU / self.q.hypot(self.kappa)
    }

    /// The strongest wave with at least `fewest` wavelengths along the lines, followed by its rivals. These have at least
    /// half of its power, or their slopes have more power; they may be longer.
    pub(super) fn strongest(sheet: &Sheet, fewest: f64) -> Vec<Self> {
        let (dq, dk) = sheet.resolution();
        let peaks = Self::peaks(sheet, (FEWEST_SEEN * PER_PEAK) as i64);
        let is_whole = |wave: &&Self| wave.q >= (fewest - 0.5 / PER_PEAK) * dq;
        let highest = peaks.iter().filter(is_whole).max_by(|a, b| a.power.total_cmp(&b.power));
        let Some(highest) = highest else { return vec![] };
        // Between samples a peak is up to a seventh higher than on them.
        let is_near = |wave: &&Self| wave.rivals(highest, 0.8);
        let refined = peaks.iter().filter(is_near);
        let refined =
            refined.map(|wave| (wave, wave.refined(sheet, (dq / PER_PEAK, dk / PER_PEAK))));
        let refined: Vec<(&Self, Self)> = refined.collect();
        let whole = refined.iter().filter(|(peak, _)| is_whole(peak)).map(|(_, wave)| *wave);
        let Some(first) = whole.max_by(|a, b| a.power.total_cmp(&b.power)) else { return vec![] };
        let mut others: Vec<Self> = refined.into_iter().map(|(_, wave)| wave).collect();
        others.retain(|wave| *wave != first && wave.q > 0.0 && wave.rivals(&first, 1.0));
        sort_by_number(&mut others, |item| -item.power);
        others.insert(0, first);
        others
    }

    /// Whether the wave has at least `factor` times half of the power of another, or its slopes `factor` times the power.
    fn rivals(&self, other: &Self, factor: f64) -> bool {
        let slopes = |wave: &Self| (wave.q.powi(2) + wave.kappa.powi(2)) * wave.power;
        self.power >= factor * RIVAL * other.power || slopes(self) >= factor * slopes(other)
    }

    /// The strongest wave, including those that are uniform along the lines, followed by its rivals. It has at least
    /// `fewest` wavelengths in one of the two directions, and a wave number across the lines of at most `most`.
    pub(super) fn strongest_of_all(sheet: &Sheet, fewest: f64, most: f64) -> Vec<Self> {
        let (dq, dk) = sheet.resolution();
        let mut peaks = Self::peaks(sheet, 0);
        let is_whole = |wave: &Self| {
            let least = fewest - 0.5 / PER_PEAK;
            wave.q >= least * dq || wave.kappa.abs() >= least * dk
        };
        // Of a wave along the lines one of the two signs of κ.
        peaks.retain(|wave| {
            is_whole(wave) && wave.kappa.abs() <= most && (wave.q > 0.0 || wave.kappa > 0.0)
        });
        let by_power = |a: &Self, b: &Self| b.power.total_cmp(&a.power);
        let Some(highest) = peaks.iter().copied().min_by(by_power) else { return vec![] };
        peaks.retain(|wave| wave.power >= 0.8 * RIVAL * highest.power);
        let steps = (dq / PER_PEAK, dk / PER_PEAK);
        let mut waves: Vec<Self> = peaks.iter().map(|wave| wave.refined(sheet, steps)).collect();
        waves.iter_mut().filter(|wave| wave.q < 0.0).for_each(|wave| {
            (wave.q, wave.kappa) = (-wave.q, -wave.kappa);
        });
        sort_by_number(&mut waves, |wave| -wave.power);
        let first = waves[0];
        let is_same = |wave: &Self| {
            (wave.q - first.q).abs() < 0.5 * dq && (wave.kappa - first.kappa).abs() < 0.5 * dk
        };
        waves
            .retain(|wave| *wave == first || (!is_same(wave) && wave.power >= RIVAL * first.power));
        waves
    }

    /// All local maxima of the power from the sample `first` of q on.
    fn peaks(sheet: &Sheet, first: i64) -> Vec<Self> {
        let (dq, _) = sheet.resolution();
        let transform = Transform::at_least((PER_PEAK * sheet.u.nrows() as f64) as usize);
        let half = transform.length() as i64 / 2;
        let (step_q, step_k) = (dq / PER_PEAK, PI / sheet.pitch / half as f64);
        let last = (LOOKED_AT * sheet.band / step_q) as i64;
        // One more at either end, which is looked at and not taken.
        let row = |i: i64| sheet.powers(step_q * i as f64, &transform);
        let power: Vec<Vec<f64>> = (first - 1..=last + 1).into_par_iter().map(row).collect();
        let columns = 2 * half as usize;
        let mut peaks = vec![];
        for n in 1..power.len().saturating_sub(1) {
            for (j, here) in power[n].iter().enumerate() {
                // Beyond ±π/d phases begin again.
                let near = [j + columns - 1, j, j + 1].map(|j| j % columns);
                let is_top =
                    power[n - 1..n + 2].iter().all(|row| near.iter().all(|j| row[*j] <= *here));
                if is_top && *here > 0.0 {
                    let q = step_q * (first - 1 + n as i64) as f64;
                    let kappa = step_k * (j as i64 - half) as f64;
                    peaks.push(Self { q, kappa, power: *here });
                }
            }
        }
        peaks
    }

    /// The maximum of the peak, by parabolas through the logarithm of the power.
    fn refined(mut self, sheet: &Sheet, (mut step_q, mut step_k): (f64, f64)) -> Self {
        let within = [step_q, step_k];
        let start = self;
        for _ in 0..8 {
            let top = |left: f64, right: f64, here: f64| {
                let (left, right, here) = (left.ln(), right.ln(), here.ln());
                let bend = left - 2.0 * here + right;
                if bend < 0.0 { (0.5 * (left - right) / bend).clamp(-1.0, 1.0) } else { 0.0 }
            };
            let here = sheet.power(self.q, self.kappa);
            let sides = [-1.0, 1.0].map(|s| sheet.power(self.q + s * step_q, self.kappa));
            self.q += step_q * top(sides[0], sides[1], here);
            self.q = self.q.clamp(start.q - within[0], start.q + within[0]);
            let along = sheet.along(self.q);
            let at = |kappa: f64| sheet.across(&along, kappa);
            let sides = [-1.0, 1.0].map(|s| at(self.kappa + s * step_k));
            self.kappa += step_k * top(sides[0], sides[1], at(self.kappa));
            self.kappa = self.kappa.clamp(start.kappa - within[1], start.kappa + within[1]);
            (step_q, step_k) = (0.4 * step_q, 0.4 * step_k);
        }
        let edge = PI / sheet.pitch;
        if self.kappa.abs() > edge {
            self.kappa -= 2.0 * edge * self.kappa.signum();
        }
        self.power = sheet.power(self.q, self.kappa);
        self
    }
}
