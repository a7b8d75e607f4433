//! Test of the model against the data, and the amount of information in the data.
//!
//! Noise is estimated from the component that does not repeat with the wavelength, without a model. A residual that
//! does repeat is an error of the model, and so are components of twice the wavelength, and changes along the track.

use super::comb::{Comb, Level, Rows};
use super::data::Data;
use super::noise::{Noise, one_line};
use super::problem::Problem;
use super::subspace::{beyond, by_noise, dot, probability, size};
use crate::least_squares::Minimum;
use std::ops::Range;

/// Tests of the residuals of one data set. A probability is that of an equally large or larger quantity by chance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Judged {
    /// Probability of the residual of the wave, or of the smooth residual of a series; `None` if there are too few
    /// rows.
    pub misfit: Option<f64>,
    /// Probability of the component of twice the wavelength.
    pub doubling: Option<f64>,
    /// Probability of the change of the ripples along the track.
    pub drift: Option<f64>,
    /// Whether ripples differ from one another by a smooth and large component.
    pub irregular: bool,
    /// Number of independent rows that would contain as much information.
    pub effective: Option<f64>,
    /// Standard deviation of the noise, from the component that does not repeat, in the unit of the data.
    pub noise: Option<f64>,
    /// Number of wavelengths along the track.
    pub wavelengths: Option<f64>,
}

impl Judged {
    /// Whether the residual of the model is compatible with chance.
    pub fn is_explained(&self) -> bool {
        let above = |p: Option<f64>, least: f64| p.is_none_or(|p| p >= least);
        !self.irregular
            && above(self.misfit, MISFIT)
            && above(self.doubling, CHANGE)
            && above(self.drift, CHANGE)
    }
}

/// Probability by chance below which a model does not explain the data.
pub(super) const MISFIT: f64 = 0.005;
/// The same for alternating and for changing ripples, which most data do not have.
pub(super) const CHANGE: f64 = 0.001;
/// Root mean square of correlated differences between ripples, relative to the ripples, above which they cannot be
/// noise of an instrument.
const IRREGULAR: f64 = 0.3;
/// Number of harmonics that contain most of an error of the model.
const FIRST: usize = 3;
/// Relative error of the computed waves.
const KNOWN: f64 = 3e-5;

/// Tests of all data.
pub(super) struct Verdict {
    pub(super) each: Vec<Judged>,
    /// Probability by chance of the residual of one model for all data.
    pub(super) joint: Option<f64>,
    /// Noise of each data set, in units of [`Problem::noise`].
    noises: Vec<Noise>,
    ranges: Vec<Range<usize>>,
    /// Degrees of freedom of the estimate of the noise.
    pub(super) freedom: f64,
}

/// Input of the tests.
pub(super) struct Evidence<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) best: &'a Minimum,
    /// Derivatives of the residuals by all search variables.
    pub(super) slopes: &'a [Vec<f64>],
    /// Wavelength, in the unit of the data.
    pub(super) length: Option<f64>,
    /// Changes of the residuals with other possible footprints.
    pub(super) shifts: &'a [Vec<f64>],
}

/// State of the test of one data set.
struct Part {
    judged: Judged,
    noise: Noise,
    freedom: f64,
    /// Columns of arbitrary waves, on these rows alone.
    tests: Vec<Vec<f64>>,
    /// Linear columns of the model, on these rows alone.
    linear: Vec<Vec<f64>>,
    residuals: Vec<f64>,
}

impl Evidence<'_> {
    pub(super) fn verdict(&self) -> Option<Verdict> {
        let mut from = 0;
        let range = |data: &Data| {
            from += data.rows();
            from - data.rows()..from
        };
        let ranges: Vec<Range<usize>> = self.problem.data.iter().map(range).collect();
        let parts: Option<Vec<Part>> =
            ranges.iter().enumerate().map(|(i, range)| self.part(i, range.clone())).collect();
        let parts = parts?;
        let joint = if parts.len() > 1 { self.joint(&parts, &ranges) } else { None };
        Some(Verdict {
            each: parts.iter().map(|part| part.judged).collect(),
            joint,
            freedom: parts.iter().map(|part| part.freedom).sum(),
            noises: parts.into_iter().map(|part| part.noise).collect(),
            ranges,
        })
    }

    /// A column with the weights removed, so that waves are sinusoidal.
    fn unweighted(&self, i: usize, column: &[f64]) -> Vec<f64> {
        column.iter().zip(&self.problem.weights[i]).map(|(v, w)| v / w.max(1e-6)).collect()
    }

    fn part(&self, i: usize, range: Range<usize>) -> Option<Part> {
        let problem = self.problem;
        let here = |column: &Vec<f64>| self.unweighted(i, &column[range.clone()]);
        let linear = problem.linear(&self.best.parameters, i)?;
        let linear: Vec<Vec<f64>> = linear.iter().map(|v| self.unweighted(i, v)).collect();
        let left = here(&self.best.residuals);
        // Of rows that count less, what counts.
        let weights = &problem.weights[i];
        let residuals: Vec<f64> = left.iter().zip(weights).map(|(r, w)| r * w * w).collect();
        let mut base = linear.clone();
        base.extend(self.slopes.iter().map(here));
        let shifts: Vec<Vec<f64>> = self.shifts.iter().map(here).collect();
        let data = &problem.data[i];
        let comb = Rows::of(data).and_then(|mut rows| {
            let scale = problem.noise[i];
            for (y, (plain, counted)) in rows.y.iter_mut().zip(left.iter().zip(&residuals)) {
                *y = *y / scale - plain + counted;
            }
            let comb =
                Comb::near(&rows, self.length?, problem.pattern.waves)?.moved(&rows, self.length?);
            Some((rows, comb))
        });
        let Some((rows, comb)) = comb else {
            return Some(self.without_waves(data, (base, linear), residuals));
        };
        let besides = comb.besides(&rows);
        let quiet = comb.noise(&rows, &besides);
        let wave = size_of(&rows);
        let known = (KNOWN * wave).powi(2) * rows.y.len() as f64;
        let quiet = quiet.and(known);
        let Level { scale, freedom } = comb.level(&rows, &besides, &quiet);
        let chance = |base: &[Vec<f64>], more: &[Vec<f64>], shifts: &[Vec<f64>]| {
            let directions = beyond(base, more);
            let size = size(&directions, &residuals, &|v| quiet.times(v), shifts)?;
            by_noise(size / scale, directions.len(), freedom)
        };
        let few = chance(&base, &comb.first(&rows, FIRST), &shifts);
        let all = chance(&base, &comb.all(&rows), &shifts);
        let whole = [&*base, &comb.all(&rows)].concat();
        let (mut doubling, mut drift) = (None, None);
        if !besides.is_empty() {
            let (doubled, drifting) = (comb.doubled(&rows), comb.drifting(&rows));
            doubling = chance(&[&*whole, &drifting].concat(), &doubled, &[]);
            drift = chance(&[&*whole, &doubled].concat(), &drifting, &[]);
        }
        // Two looks, either of which may be by chance.
        let misfit = few.zip(all).map(|(few, all)| (2.0 * few.min(all)).min(1.0)).or(all);
        let noise = comb.noise(&rows, &[]).and(known);
        let irregular = noise.deviation() > IRREGULAR * wave && !noise.is_white();
        let judged = Judged {
            misfit,
            doubling,
            irregular,
            drift,
            effective: Some(noise.effective()),
            noise: Some(noise.deviation() * problem.noise[i]),
            wavelengths: Some(comb.count),
        };
        let freedom = comb.freedom(&noise, 0);
        Some(Part { judged, noise, freedom, tests: comb.all(&rows), linear, residuals })
    }

    /// The test of a series, or of a track with too few rows for waves of any shape.
    fn without_waves(
        &self,
        data: &Data,
        (base, linear): (Vec<Vec<f64>>, Vec<Vec<f64>>),
        residuals: Vec<f64>,
    ) -> Part {
        let rows = residuals.len();
        let numbers = beyond(&[], &base).len();
        let tests = smooth(data);
        let directions = beyond(&base, &tests);
        let left = rows.saturating_sub(numbers + directions.len());
        let along: f64 = directions.iter().map(|q| dot(q, &residuals).powi(2)).sum();
        let sum = dot(&residuals, &residuals);
        let misfit = (left >= LEFT && sum > 0.0).then(|| {
            let square = ((sum - along) / left as f64).max(f64::MIN_POSITIVE);
            let times = |v: &[f64]| v.iter().map(|v| v * square).collect::<Vec<f64>>();
            probability(&directions, &residuals, &times, &[], left as f64)
        });
        let freedom = rows.saturating_sub(numbers).max(1) as f64;
        let noise = if data.is_series() {
            Noise::white(rows, sum / freedom)
        } else {
            let lines = Rows::of(data).map_or_else(|| one_line(rows), |rows| rows.lines);
            Noise::of(&residuals, &lines, (numbers, rows))
        };
        let judged = Judged { misfit: misfit.flatten(), ..Judged::default() };
        Part { judged, noise, freedom, tests: vec![], linear, residuals }
    }

    /// The joint test of all data: parameters that suit each set alone may not suit all.
    fn joint(&self, parts: &[Part], ranges: &[Range<usize>]) -> Option<f64> {
        let rows = self.problem.rows();
        let placed = |columns: &[Vec<f64>], range: &Range<usize>| -> Vec<Vec<f64>> {
            let one = |column: &Vec<f64>| {
                let mut whole = vec![0.0; rows];
                whole[range.clone()].copy_from_slice(column);
                whole
            };
            columns.iter().map(one).collect()
        };
        let plain = |column: &Vec<f64>| -> Vec<f64> {
            let of =
                |(i, range): (usize, &Range<usize>)| self.unweighted(i, &column[range.clone()]);
            ranges.iter().enumerate().flat_map(of).collect()
        };
        let mut base: Vec<Vec<f64>> = self.slopes.iter().map(plain).collect();
        let mut tests = vec![];
        for (part, range) in parts.iter().zip(ranges) {
            base.extend(placed(&part.linear, range));
            tests.extend(placed(&part.tests, range));
        }
        let residuals: Vec<f64> = parts.iter().flat_map(|part| part.residuals.clone()).collect();
        let times = |v: &[f64]| -> Vec<f64> {
            let of = |(part, range): (&Part, &Range<usize>)| part.noise.times(&v[range.clone()]);
            parts.iter().zip(ranges).flat_map(of).collect()
        };
        let shifts: Vec<Vec<f64>> = self.shifts.iter().map(plain).collect();
        let freedom = parts.iter().map(|part| part.freedom).sum();
        probability(&beyond(&base, &tests), &residuals, &times, &shifts, freedom)
    }
}

/// Smallest number of degrees of freedom for the test of a series.
const LEFT: usize = 3;

/// Smooth functions of the velocities and loads of a series.
fn smooth(data: &Data) -> Vec<Vec<f64>> {
    let of = |a: &[f64], b: &[f64], powers: (i32, i32)| -> Vec<f64> {
        a.iter().zip(b).map(|(a, b)| a.ln().powi(powers.0) * b.ln().powi(powers.1)).collect()
    };
    match data {
        Data::Onsets { velocity, .. } => {
            [0, 1, 2, 3].map(|k| of(velocity, velocity, (k, 0))).to_vec()
        }
        Data::Wavelengths { velocity, load, .. } => {
            [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)].map(|k| of(velocity, load, k)).to_vec()
        }
        _ => vec![],
    }
}

/// Root mean square of a track minus its background.
fn size_of(rows: &Rows) -> f64 {
    let left = crate::projection::project(&rows.ground(), &rows.y).map(|found| found.residuals);
    left.map_or(0.0, |left| (dot(&left, &left) / left.len() as f64).sqrt())
}

impl Verdict {
    /// The product J'ΣJ of the derivatives J with the covariance Σ of the noise.
    pub(super) fn between(&self, slopes: &[Vec<f64>]) -> nalgebra::DMatrix<f64> {
        let times = |v: &Vec<f64>| -> Vec<f64> {
            let each = self.noises.iter().zip(&self.ranges);
            each.flat_map(|(noise, range)| noise.times(&v[range.clone()])).collect()
        };
        let moved: Vec<Vec<f64>> = slopes.iter().map(times).collect();
        nalgebra::DMatrix::from_fn(slopes.len(), slopes.len(), |i, j| dot(&slopes[i], &moved[j]))
    }

    pub(super) fn is_explained(&self) -> bool {
        self.joint.is_none_or(|p| p >= MISFIT) && self.each.iter().all(Judged::is_explained)
    }
}
