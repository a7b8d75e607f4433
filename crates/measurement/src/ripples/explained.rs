//! The settled pattern of the model that explains the wave of an image, and 95 % intervals.

use super::travelling::{Lines, Travelling, crest_angle};
use super::wave::{HARMONICS, UNKNOWNS, Wave, height, phase};
use super::{Lag, RippleProfile, Ripples};
use crate::interval::{Estimate, crossing, student};
use crate::least_squares::{Minimum, Residuals, differences, matrix_of, minimum, squares};
use nalgebra::{Cholesky, Complex, DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};
use std::borrow::Cow;
use std::cell::RefCell;
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;
use stickslip_tip::sorting::sort_by_number;

/// Degrees of freedom of the errors: those of the blocks of the image.
const BLOCK_FREEDOM: f64 = 15.0;
/// First values of the stiffness κ_y across the lines in a search for it, and the range of ln κ_y.
const STIFFNESSES: [f64; 6] = [1.5, 3.0, 6.0, 12.0, 30.0, 100.0];
const STIFFNESS_LOGS: RangeInclusive<f64> = -0.7..=6.9;
/// Weight of a known number: it then deviates by 1e-5 for a residual of 1.
const EXACT: f64 = 1e5;
/// First values of the swing, the relative variation of θ'.
const SWINGS: [f64; 3] = [0.3, 0.6, 1.0];
/// Step of the parameters, which are of order 1.
const STEP: f64 = 1e-5;
/// Weight of a held quantity over the reciprocal of its standard deviation: the quantity then misses its goal by 1e-4 of
/// the offset from the best value.
const HELD: f64 = 100.0;
/// Largest deviation of a held quantity from its goal, as a fraction of the distance from the best value to the goal.
const MISSED: f64 = 0.05;
/// Least fraction of the quantile up to which a profile must be known.
const NEAR: f64 = 0.8;
/// Largest logarithm of the ratio of an end of an interval to the value.
const FARTHEST: f64 = 3.0;

/// The wave of the image against that of the model. Parameters: swing (the relative variation of θ'), ln r, κσ, the logarithm
/// of the gain of the heights, phase and, if it is free, ln κ_y.
pub(super) struct Problem<'a> {
    lines: &'a Lines,
    wave: &'a Wave,
    known: Known,
    sigma: f64,
    /// Whether the tip moved towards larger x, and whether the lines followed each other towards larger y.
    way: (bool, bool),
    /// The wave in coordinates along the directions of the scan, q and κ in 1/σ: q, κ, Re B_k, Im B_k.
    data: DVector<f64>,
    /// L⁻¹ of the covariance LLᵀ of the data.
    whitening: DMatrix<f64>,
    start: Vec<f64>,
    /// q of linear theory, from which Newton's method starts.
    q: f64,
    /// The last pattern, from which the next one starts.
    last: RefCell<Option<Travelling>>,
}

/// Quantities that are known besides the wave.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Known {
    /// α and r; `None` where unknown.
    pub(super) numbers: [Option<f64>; 2],
    /// Whether κ_y is free.
    pub(super) frees_stiffness: bool,
    /// Whether the lag of the model is wanted.
    pub(super) seeks_lag: bool,
    /// Logarithm of |L|, the amplitude of the first harmonic of the lag, in σ, and its standard deviation.
    pub(super) lag: Option<[f64; 2]>,
}

impl Known {
    fn count(&self) -> usize {
        self.numbers.iter().flatten().count() + usize::from(self.lag.is_some())
    }
}

impl<'a> Problem<'a> {
    /// `None` if linear theory has no such wave.
    pub(super) fn new(
        lines: &'a Lines,
        wave: &'a Wave,
        (sigma, known): (f64, Known),
        way: (bool, bool),
    ) -> Option<Self> {
        let (forward, upward) = way;
        // A mirrored x makes (q, κ) of (-q, κ), whose conjugate is (q, -κ); a mirrored y makes (q, -κ).
        let mut signs = [1.0; UNKNOWNS];
        signs[1] = if forward == upward { 1.0 } else { -1.0 };
        if !forward {
            (0..HARMONICS).for_each(|k| signs[3 + 2 * k] = -1.0);
        }
        let scale = |i: usize| signs[i] * if i < 2 { sigma } else { 1.0 };
        let data = DVector::from_fn(UNKNOWNS, |i, _| scale(i) * wave.values[i]);
        let covariance = DMatrix::from_fn(UNKNOWNS, UNKNOWNS, |i, j| {
            scale(i) * scale(j) * wave.covariance[(i, j)]
        });
        let whitening = Cholesky::new(covariance)?.l().lu().try_inverse()?;
        let (q, kappa) = (data[0], data[1]);
        let start = if known.frees_stiffness {
            // κ_y at which the neutral wave comes closest to the known numbers.
            let near = |stiffness: &f64| {
                let (alpha, r) = lines.with_stiffness(Some(*stiffness)).neutral(q, kappa)?;
                let off = |(value, known): (f64, Option<f64>)| {
                    known.map_or(0.0, |known| (value / known).ln().powi(2))
                };
                let [of_alpha, of_r] = known.numbers;
                Some((off((alpha, of_alpha)) + off((r, of_r)), r, *stiffness))
            };
            let best = STIFFNESSES.iter().filter_map(near).min_by(|a, b| a.0.total_cmp(&b.0));
            let (_, r, stiffness) = best?;
            vec![0.0, r.ln(), kappa, 0.0, 0.0, stiffness.ln()]
        } else {
            vec![0.0, lines.neutral(q, kappa)?.1.ln(), kappa, 0.0, 0.0]
        };
        let last = RefCell::default();
        Some(Self { lines, wave, known, sigma, way, data, whitening, start, q, last })
    }

    /// The lines with the κ_y of these parameters, if it is free.
    fn lines_at(&self, at: &[f64]) -> Cow<'a, Lines> {
        match at.get(5) {
            Some(log) => Cow::Owned(self.lines.with_stiffness(Some(log.exp()))),
            None => Cow::Borrowed(self.lines),
        }
    }

    /// Degrees of freedom of χ².
    fn freedom(&self) -> f64 {
        (UNKNOWNS + self.known.count() - self.start.len()) as f64
    }

    /// The pattern, found from the last one if that is near, otherwise from linear theory by increasing the swing.
    fn pattern(&self, at: &[f64]) -> Option<Travelling> {
        let (swing, r, kappa) = (at[0], at[1].exp(), at[2]);
        if !(swing > 0.0 && swing < 2.0 && r.is_finite()) {
            return None;
        }
        if at.get(5).is_some_and(|log| !STIFFNESS_LOGS.contains(log)) {
            return None;
        }
        let lines = self.lines_at(at);
        let last = self.last.borrow().clone();
        let near = last.and_then(|near| lines.pattern(r, kappa, swing, Ok(&near)));
        let found = near.or_else(|| lines.pattern(r, kappa, swing, Err(self.q))).or_else(|| {
            let mut near = lines.pattern(r, kappa, 0.25 * swing, Err(self.q))?;
            for part in [0.5, 0.75, 1.0] {
                near = lines.pattern(r, kappa, part * swing, Ok(&near))?;
            }
            Some(near)
        })?;
        self.last.replace(Some(found.clone()));
        Some(found)
    }

    /// The wave of the pattern, and its deviations from known numbers.
    fn predicted(&self, at: &[f64]) -> Option<(DVector<f64>, Vec<f64>)> {
        let found = self.pattern(at)?;
        let [alpha, r] = self.known.numbers;
        let numbers =
            [alpha.map(|known| found.alpha.ln() - known.ln()), r.map(|known| at[1] - known.ln())];
        let mut off: Vec<f64> = numbers.into_iter().flatten().map(|off| off * EXACT).collect();
        off.extend(self.known.lag.map(|[log, error]| (found.lag().norm().ln() - log) / error));
        let mut values = DVector::zeros(UNKNOWNS);
        (values[0], values[1]) = (found.q, at[2]);
        for k in 1..=HARMONICS {
            let turn = Complex::from_polar(at[3].exp(), k as f64 * at[4]);
            let height = found.heights[k - 1] * turn;
            (values[2 * k], values[2 * k + 1]) = (height.re, height.im);
        }
        Some((values, off))
    }

    /// The pattern closest to the wave.
    pub(super) fn closest(&self) -> Option<Minimum> {
        let from = |swing: f64| {
            let mut start = self.start.clone();
            start[0] = swing;
            let model = self.pattern(&start)?.heights[0];
            let data = Complex::new(self.data[2], self.data[3]);
            start[3] = (data.norm() / model.norm()).ln();
            start[4] = (data / model).arg();
            minimum(self, &start)
        };
        SWINGS.into_iter().filter_map(from).min_by(|a, b| a.sum.total_cmp(&b.sum))
    }

    /// Probability of an equally large χ² by chance.
    pub(super) fn misfit(&self, best: &Minimum) -> f64 {
        let freedom = self.freedom();
        FisherSnedecor::new(freedom, BLOCK_FREEDOM).map_or(0.0, |law| law.sf(best.sum / freedom))
    }

    pub(super) fn solved(&self, best: &Minimum) -> Option<Ripples> {
        let around = Around::of(self, best)?;
        let alpha = around.estimate(|at| Some(self.pattern(at)?.alpha.ln()))?;
        let r = around.estimate(|at| Some(at[1]))?;
        let at = &best.parameters;
        let stiffness = match at.get(5) {
            Some(_) => Some(around.estimate(|at| at.get(5).copied())?),
            None => None,
        };
        let lag = if self.known.seeks_lag { Some(self.lag(&around)?) } else { None };
        let found = self.pattern(at)?;
        let (forward, upward) = self.way;
        let (wavelength, angle, amplitude) = self.shape(around.quantile);
        Some(Ripples {
            alpha,
            r,
            stiffness,
            lag,
            lateral: None,
            wavelength,
            crest_angle: angle,
            amplitude,
            wave_vector: [self.wave.q(), self.wave.kappa()],
            phase: self.wave.harmonic(1).arg(),
            profile: self.profile(&found, at),
            height_gain: at[3].exp() / (self.sigma * self.sigma),
            neutral_alpha: self.lines_at(at).pattern(r.value, at[2], 1e-3, Err(self.q))?.alpha,
            forward,
            upward,
            part: None,
            retrace: None,
            misfit: self.misfit(best),
            modulation: self.wave.modulation,
            residual: self.wave.residual,
            explained: self.wave.explained,
        })
    }

    /// The lag of the closest pattern, with its phase in the coordinates of the image.
    fn lag(&self, around: &Around) -> Option<Lag> {
        let size = around.estimate(|at| Some(self.pattern(at)?.lag().norm().ln()))?;
        let found = self.pattern(&around.best.parameters)?;
        let ahead = (found.lag() / found.heights[0]).arg();
        Some(Lag { size, ahead: if self.way.0 { ahead } else { -ahead } })
    }

    /// The mean ripple of the image beside that of the pattern.
    fn profile(&self, pattern: &Travelling, at: &[f64]) -> RippleProfile {
        let turned = |(k, height): (usize, &Complex<f64>)| {
            let height = height * Complex::from_polar(at[3].exp(), (k + 1) as f64 * at[4]);
            if self.way.0 { height } else { height.conj() }
        };
        let model: Vec<Complex<f64>> = pattern.heights.iter().enumerate().map(turned).collect();
        let crest = -self.wave.harmonic(1).arg();
        let length = self.wave.q().hypot(self.wave.kappa());
        let row = |(part, [mean, error]): (usize, &[f64; 2])| {
            let phase = phase(part);
            let away = (phase - crest + PI).rem_euclid(TAU) - PI;
            [away / length, *mean, *error, height(&model, phase)]
        };
        let mut rows: Vec<[f64; 4]> = self.wave.folded.iter().enumerate().map(row).collect();
        sort_by_number(&mut rows, |item| item[0]);
        let [distance, height, error, model] =
            [0, 1, 2, 3].map(|i| rows.iter().map(|row| row[i]).collect());
        RippleProfile { distance, height, error, model }
    }

    /// Wavelength, crest angle and amplitude of the wave in the image.
    fn shape(&self, quantile: f64) -> (Estimate, Estimate, Estimate) {
        let [q, kappa] = [self.wave.q(), self.wave.kappa()];
        let length = q.hypot(kappa);
        let c = &self.wave.covariance;
        let error = |i: usize, by: [f64; 2]| {
            let square = by[0] * by[0] * c[(i, i)]
                + 2.0 * by[0] * by[1] * c[(i, i + 1)]
                + by[1] * by[1] * c[(i + 1, i + 1)];
            quantile * square.max(0.0).sqrt()
        };
        let wavelength = TAU / length;
        let turned = error(0, [kappa / (length * length), -q / (length * length)]);
        let first = self.wave.harmonic(1);
        let size = first.norm();
        (
            Estimate::about(
                wavelength,
                error(0, [q, kappa].map(|v| wavelength * v / (length * length))),
            ),
            Estimate::about(crest_angle(q, kappa), turned.to_degrees()),
            Estimate::about(2.0 * size, 2.0 * error(2, [first.re / size, first.im / size])),
        )
    }
}

impl Residuals for Problem<'_> {
    fn at(&self, parameters: &[f64]) -> Option<Vec<f64>> {
        let (wave, known) = self.predicted(parameters)?;
        let off = &self.whitening * (wave - &self.data);
        Some(off.iter().copied().chain(known).collect())
    }

    fn derivatives(&self, here: &[f64], parameters: &[f64]) -> Option<Vec<Vec<f64>>> {
        differences(self, (here, parameters), STEP)
    }
}

/// The neighbourhood of the closest pattern, for intervals by profile likelihood: an interval contains the values of a quantity
/// for which some pattern is close enough to the wave. At strong noise α is far from linear in the parameters.
struct Around<'a> {
    problem: &'a Problem<'a>,
    best: &'a Minimum,
    /// Covariance of the parameters if the model is linear in them. It is not multiplied by the reduced χ²: with this factor
    /// 99 % of the intervals of settled ripples, not 95 %, contained the true value. Where χ² is larger than by chance there are
    /// no intervals.
    covariance: DMatrix<f64>,
    /// Half of a 95 % interval, in standard deviations.
    quantile: f64,
}

impl<'a> Around<'a> {
    fn of(problem: &'a Problem, best: &'a Minimum) -> Option<Self> {
        let slopes = problem.derivatives(&best.residuals, &best.parameters)?;
        let jacobian = matrix_of(slopes);
        let covariance = jacobian.tr_mul(&jacobian).lu().try_inverse()?;
        Some(Self { problem, best, covariance, quantile: student(BLOCK_FREEDOM) })
    }

    /// The quantity whose logarithm is `log` of the parameters, and its interval.
    fn estimate(&self, log: impl Fn(&[f64]) -> Option<f64>) -> Option<Estimate> {
        let at = &self.best.parameters;
        let value = log(at)?;
        let slope = (0..at.len()).map(|i| {
            let beside = |step: f64| {
                let mut there = at.clone();
                there[i] += step;
                log(&there)
            };
            Some((beside(STEP)? - beside(-STEP)?) / (2.0 * STEP))
        });
        let slope = DVector::from_vec(slope.collect::<Option<Vec<f64>>>()?);
        let toward = &self.covariance * &slope;
        let variance = slope.dot(&toward);
        let deviation = variance.sqrt();
        let root = |offset: f64| {
            let start = at.iter().zip(&toward).map(|(at, t)| at + t / variance * offset);
            let held = Held {
                problem: self.problem,
                log: &log,
                goal: value + offset,
                weight: HELD / deviation,
            };
            // From where all go if they are linear, and from where they are: a single search may end beside the minimum.
            let starts = [start.collect::<Vec<f64>>(), at.clone()];
            let found = starts.iter().filter_map(|start| minimum(&held, start));
            let found = found.min_by(|a, b| a.sum.total_cmp(&b.sum))?;
            // A search that does not get to the goal says nothing.
            let off = found.residuals.last().map_or(f64::INFINITY, |off| off.abs());
            if off > 1.0 + MISSED * HELD * (offset / deviation).abs() {
                return None;
            }
            let own = found.residuals.len() - 1;
            let more = squares(&found.residuals[..own]) - self.best.sum;
            Some(more.max(0.0).sqrt())
        };
        let guess = self.quantile * deviation;
        let end = |side: f64| {
            let (end, points) = crossing(root, self.quantile, (side * guess, FARTHEST));
            // Failed searches exclude nothing.
            end.filter(|_| points.iter().any(|(_, root)| *root > NEAR * self.quantile))
        };
        Some(Estimate {
            value: value.exp(),
            low: end(-1.0).map_or(0.0, |offset| (value + offset).exp()),
            high: end(1.0).map_or(f64::INFINITY, |offset| (value + offset).exp()),
        })
    }
}

/// The problem with one more residual, which holds the logarithm of a quantity at `goal`.
struct Held<'a, F> {
    problem: &'a Problem<'a>,
    log: &'a F,
    goal: f64,
    weight: f64,
}

impl<F: Fn(&[f64]) -> Option<f64>> Residuals for Held<'_, F> {
    fn at(&self, parameters: &[f64]) -> Option<Vec<f64>> {
        let mut residuals = self.problem.at(parameters)?;
        residuals.push(self.weight * ((self.log)(parameters)? - self.goal));
        Some(residuals)
    }

    fn derivatives(&self, here: &[f64], parameters: &[f64]) -> Option<Vec<Vec<f64>>> {
        differences(self, (here, parameters), STEP)
    }
}
