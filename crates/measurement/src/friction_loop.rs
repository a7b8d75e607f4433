//! Numbers of a friction loop: lateral force on the way there (trace) and back (retrace) over the same positions.
//!
//! ```text
//! friction = mean of (F_there - F_back)/2,   offset = mean of (F_there + F_back)/2,   work = ∮ F dx
//! ```
//!
//! Each way begins with sticking: the force rises to the static peak. Beyond it the tip slides, or sticks and slips, about
//! the kinetic force. Errors of means come from batches of the force, whose number follows from its correlation length.
//! The error of the peak comes from the noise of the rows near it.

use crate::interval::{Estimate, median, student};
use crate::profile::MEDIAN_OF_NORMAL;
use stickslip_tip::sorting::sort_by_number;
use thiserror::Error;

/// Forces on the way there and on the way back, at the same ascending positions, in any units.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionLoop {
    x: Vec<f64>,
    there: Vec<f64>,
    back: Vec<f64>,
}

/// Numbers of a loop with their 95 % intervals, in the units of the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopNumbers {
    /// Kinetic friction force: half of the mean difference of both ways, over positions more than twice as far from the
    /// reversals as the static peak; if there is no peak and too little of such a way, over all positions behind the rise.
    pub friction: Estimate,
    /// Half of the mean difference of both ways along the whole loop: ∮ F dx over twice its length.
    pub mean: Estimate,
    /// Mean of both ways over the same positions as `friction`: the zero of the instrument, and slopes of the sample.
    pub offset: Estimate,
    /// First maximum of the force after the reversal, less the offset; mean of both ways.
    pub static_peak: Estimate,
    /// The peak over the friction force: above 1 if starting to slide takes more force than sliding on.
    pub peak_ratio: f64,
    /// ∮ F dx: the work done in a cycle, the area of the loop.
    pub work: Estimate,
    /// Distance in x from the reversal to the static peak, over which the force changes sign; mean of both ways.
    pub reversal: f64,
    /// Slope of the force on the way from the reversal to the static peak: stiffness of lever and contact in series, if
    /// x is the position of the support.
    pub stiffness: Estimate,
    /// Standard deviation of the noise from row to row.
    pub noise: f64,
}

/// The reason why a loop has no numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum LoopError {
    /// Too few rows, or columns of different lengths.
    #[error("{0} rows: at least {FEWEST} are needed, and as many in each column")]
    Rows(usize),
    /// A value that is not finite, or positions that do not ascend.
    #[error("row {0}: positions must ascend, and all values be finite")]
    Value(usize),
    /// The force never stops rising, or the ways do not differ.
    #[error(
        "no sliding is seen: the force rises to the end of the way, or both ways have the same force, or the force of the trace \
         is the smaller one: are trace and retrace exchanged, or is the sign of the force the other?"
    )]
    NoSliding,
    /// The force falls from a peak too far from the reversal, or has only just risen.
    #[error(
        "the tip slides steadily on too little of the way: the force is largest {0} of {1} rows after the reversal, and the part of \
         the way that is more than twice as far from either end has fewer than {least} rows: scan further", least = FEWEST / 2
    )]
    Short(usize, usize),
}

/// Smallest number of rows.
const FEWEST: usize = 24;
/// Fall below the largest force so far, in standard deviations of the noise, that ends a peak.
const FALL: f64 = 6.0;
/// A parabola through 2 (`BESIDE` + 1) rows determines the height of a peak.
const BESIDE: usize = 3;
/// Number of batches for the error of a mean: at most, and at least.
const BATCHES: (usize, usize) = (16, 4);

impl FrictionLoop {
    /// A loop of forces at ascending positions.
    ///
    /// # Errors
    /// Too few rows, values that are not finite, or positions that do not ascend.
    pub fn new(x: Vec<f64>, there: Vec<f64>, back: Vec<f64>) -> Result<Self, LoopError> {
        if x.len() < FEWEST || there.len() != x.len() || back.len() != x.len() {
            return Err(LoopError::Rows(x.len()));
        }
        let is_bad = |i: usize| {
            let finite = x[i].is_finite() && there[i].is_finite() && back[i].is_finite();
            !finite || i > 0 && x[i] <= x[i - 1]
        };
        match (0..x.len()).find(|i| is_bad(*i)) {
            Some(i) => Err(LoopError::Value(i + 1)),
            None => Ok(Self { x, there, back }),
        }
    }

    /// A loop of two tracks, positions and forces in any order: the second is interpolated at the positions of the first, where
    /// both overlap.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of_tracks(
        there: (Vec<f64>, Vec<f64>),
        back: (Vec<f64>, Vec<f64>),
    ) -> Result<Self, LoopError> {
        let (x, there) = ascending(there)?;
        let (over, back) = ascending(back)?;
        if x.is_empty() || over.len() < FEWEST {
            return Err(LoopError::Rows(x.len().min(over.len())));
        }
        let last = over.len() - 1;
        // Units that were converted differ in their last digit.
        let slack = 1e-9 * (over[last] - over[0]);
        let within = over[0] - slack..=over[last] + slack;
        let rows = x.into_iter().zip(there).filter(|(x, _)| within.contains(x));
        let (x, there): (Vec<f64>, Vec<f64>) = rows.unzip();
        let at = |x: &f64| {
            let above = over.partition_point(|other| other < x).clamp(1, last);
            let part = (x - over[above - 1]) / (over[above] - over[above - 1]);
            back[above - 1] + part * (back[above] - back[above - 1])
        };
        let back = x.iter().map(at).collect();
        Self::new(x, there, back)
    }

    /// Positions, and forces on the way there and back.
    pub fn rows(&self) -> [&[f64]; 3] {
        [&self.x, &self.there, &self.back]
    }

    /// Friction, static peak, work and stiffness.
    ///
    /// # Errors
    /// [`LoopError::NoSliding`].
    pub fn numbers(&self) -> Result<LoopNumbers, LoopError> {
        let noise = f64::hypot(noise(&self.there), noise(&self.back)) / f64::sqrt(2.0);
        let rows = self.x.len();
        let mirrored = |values: &[f64]| values.iter().rev().map(|v| -v).collect::<Vec<f64>>();
        // Both ways as if they went forward: position and force change sign.
        let back = Way { x: mirrored(&self.x), force: mirrored(&self.back) };
        let there = Way { x: self.x.clone(), force: self.there.clone() };
        let peaks = [there.peak(noise)?, back.peak(noise)?];
        // The fall from the peak takes about as long as the rise to it.
        let beyond = |times: fn(&Peak) -> usize| {
            let [there, back] = peaks.each_ref().map(|peak| times(peak) * peak.at);
            there.min(rows)..rows.saturating_sub(back)
        };
        let mut both = beyond(|_| 2);
        if both.len() < FEWEST / 2 {
            both = beyond(|peak| if peak.falls { 2 } else { 1 });
        }
        if both.len() < FEWEST / 2 {
            return Err(LoopError::Short(peaks[0].at.max(peaks[1].at) + 1, rows));
        }
        let pairs = || self.there[both.clone()].iter().zip(&self.back[both.clone()]);
        let friction = mean(&pairs().map(|(a, b)| 0.5 * (a - b)).collect::<Vec<f64>>());
        let offset = mean(&pairs().map(|(a, b)| 0.5 * (a + b)).collect::<Vec<f64>>());
        if friction.value <= 0.0 {
            return Err(LoopError::NoSliding);
        }
        // The offset is that of either way, with the other sign on the way back.
        let peak = 0.5 * (peaks[0].height + peaks[1].height);
        let quantile = student((2 * BESIDE) as f64);
        let width = quantile * 0.5 * f64::hypot(peaks[0].error, peaks[1].error);
        let [first, second] = [there.rise(&peaks[0], noise), back.rise(&peaks[1], noise)];
        let error = quantile * 0.5 * f64::hypot(first.1, second.1);
        let stiffness = Estimate::about(0.5 * (first.0 + second.0), error);
        let reversal = 0.5 * (peaks[0].way + peaks[1].way);
        let work = self.work(noise, &friction, both.len());
        let twice = 2.0 * (self.x[rows - 1] - self.x[0]);
        let mean =
            Estimate { value: work.value / twice, low: work.low / twice, high: work.high / twice };
        Ok(LoopNumbers {
            friction,
            mean,
            offset,
            static_peak: Estimate::about(peak, width),
            peak_ratio: peak / friction.value,
            work,
            reversal,
            stiffness,
            noise,
        })
    }

    /// ∮ F dx by the trapezoidal rule. Its error: that of the mean force over the sliding part, and noise on the rest.
    fn work(&self, noise: f64, friction: &Estimate, sliding: usize) -> Estimate {
        let difference: Vec<f64> = self.there.iter().zip(&self.back).map(|(a, b)| a - b).collect();
        let steps = self.x.windows(2).zip(difference.windows(2));
        let value: f64 = steps.map(|(x, d)| 0.5 * (x[1] - x[0]) * (d[0] + d[1])).sum();
        let length = self.x[self.x.len() - 1] - self.x[0];
        let part = sliding as f64 / self.x.len() as f64;
        let spacing = length / (self.x.len() - 1) as f64;
        let rest = (self.x.len() - sliding) as f64;
        let error = f64::hypot(
            (friction.high - friction.low) * length * part,
            student(f64::INFINITY) * noise * spacing * (2.0 * rest).sqrt(),
        );
        Estimate::about(value, error)
    }
}

/// A track by ascending position.
fn ascending((x, force): (Vec<f64>, Vec<f64>)) -> Result<(Vec<f64>, Vec<f64>), LoopError> {
    if x.len() != force.len() {
        return Err(LoopError::Rows(x.len().min(force.len())));
    }
    if let Some(i) = x.iter().zip(&force).position(|(x, f)| !(x.is_finite() && f.is_finite())) {
        return Err(LoopError::Value(i + 1));
    }
    let mut rows: Vec<(f64, f64)> = x.into_iter().zip(force).collect();
    sort_by_number(&mut rows, |item| item.0);
    match rows.windows(2).position(|pair| pair[0].0 >= pair[1].0) {
        Some(i) => Err(LoopError::Value(i + 2)),
        None => Ok(rows.into_iter().unzip()),
    }
}

/// One way, forward.
struct Way {
    x: Vec<f64>,
    force: Vec<f64>,
}

/// The static peak of a way.
struct Peak {
    /// Index of the row.
    at: usize,
    height: f64,
    /// Standard deviation of the height.
    error: f64,
    /// Distance from the reversal.
    way: f64,
    /// Whether the force falls after it.
    falls: bool,
}

impl Way {
    /// The first maximum after which the force falls by more than the noise explains; if it never falls, the first row that
    /// reaches the sliding force.
    fn peak(&self, noise: f64) -> Result<Peak, LoopError> {
        let last = self.force.len() - 1;
        let mut at = 0;
        for (i, force) in self.force.iter().enumerate() {
            if *force > self.force[at] {
                at = i;
            } else if self.force[at] - force > FALL * noise.max(1e-12 * self.force[at].abs()) {
                break;
            }
        }
        // Sliding without a peak: the largest value is a fluctuation, and sliding begins where the force has risen.
        let settled = self.force[self.force.len() / 2..].iter().sum::<f64>()
            / (self.force.len() - self.force.len() / 2) as f64;
        let enough = settled - 2.0 * noise;
        let falls = self.force[at] - settled > FALL * noise.max(1e-12 * settled.abs());
        if let Some(first) = self.force.iter().position(|force| *force >= enough)
            && !falls
        {
            at = first;
        }
        if at + BESIDE >= last {
            return Err(LoopError::NoSliding);
        }
        let (height, error) = self.height(at, noise);
        Ok(Peak { at, height, error, way: self.x[at] - self.x[0], falls })
    }

    /// Height of a peak, and its standard deviation from the noise and from the rise between two rows. The height is the end
    /// of a parabola through the rows up to the peak, which may be sharp.
    fn height(&self, at: usize, noise: f64) -> (f64, f64) {
        let rows = at.saturating_sub(2 * BESIDE + 1)..at + 1;
        let scale = self.x[at] - self.x[rows.start];
        if rows.len() < 4 {
            return (self.force[at], noise);
        }
        let power = |n: i32| -> Vec<f64> {
            rows.clone().map(|i| ((self.x[i] - self.x[at]) / scale).powi(n)).collect()
        };
        let columns = [power(0), power(1), power(2)];
        let data = &self.force[rows.clone()];
        let fitted = |data: &[f64]| crate::projection::project(&columns, data);
        let Some(found) = fitted(data) else {
            return (self.force[at], noise);
        };
        // The height is linear in the data: the sum of the squares of its weights.
        let weights = (0..data.len()).map(|i| {
            let mut unit = vec![0.0; data.len()];
            unit[i] = 1.0;
            fitted(&unit).map_or(1.0, |p| p.coefficients[0])
        });
        let noise = noise * weights.map(|w| w * w).sum::<f64>().sqrt();
        let rise = found.coefficients[1] / scale * (self.x[at] - self.x[at - 1]);
        (found.coefficients[0], noise.hypot(0.5 * rise))
    }

    /// Slope of the line through the rows from the reversal to half of the rise, and its standard deviation.
    fn rise(&self, peak: &Peak, noise: f64) -> (f64, f64) {
        let half = 0.5 * (self.force[0] + peak.height);
        let end = self.force.iter().position(|force| *force > half).unwrap_or(1).max(2);
        let rows = &self.x[..=end.min(peak.at.max(2))];
        let middle = rows.iter().sum::<f64>() / rows.len() as f64;
        let square: f64 = rows.iter().map(|x| (x - middle).powi(2)).sum();
        let slope: f64 =
            rows.iter().zip(&self.force).map(|(x, force)| (x - middle) * force).sum::<f64>()
                / square;
        (slope, noise / square.sqrt())
    }
}

/// Mean with its interval, from the scatter of [`batches`].
fn mean(values: &[f64]) -> Estimate {
    let count = values.len() as f64;
    let value = values.iter().sum::<f64>() / count;
    let batches = batches(values, value);
    let size = values.len() / batches;
    let means: Vec<f64> =
        values.chunks_exact(size).map(|part| part.iter().sum::<f64>() / size as f64).collect();
    let middle = means.iter().sum::<f64>() / means.len() as f64;
    let square: f64 = means.iter().map(|m| (m - middle).powi(2)).sum();
    let freedom = means.len() as f64 - 1.0;
    let error = student(freedom) * (square / freedom / means.len() as f64).sqrt();
    Estimate::about(value, error)
}

/// Number of batches, within limits: each is twice as long as the distance at which the correlation has changed sign
/// twice (a period of stick-slip).
fn batches(values: &[f64], mean: f64) -> usize {
    let off: Vec<f64> = values.iter().map(|v| v - mean).collect();
    let correlation =
        |lag: usize| -> f64 { off.iter().zip(&off[lag..]).map(|(a, b)| a * b).sum::<f64>() };
    let mut changes = 0;
    let mut positive = true;
    let limit = values.len() / BATCHES.1;
    let lag = (1..limit).find(|lag| {
        let now = correlation(*lag) > 0.0;
        changes += usize::from(now != positive);
        positive = now;
        changes == 2
    });
    (values.len() / (2 * lag.unwrap_or(limit)).max(1)).clamp(BATCHES.1, BATCHES.0)
}

/// Standard deviation of the noise from row to row, from the median of the absolute second differences.
fn noise(values: &[f64]) -> f64 {
    let sizes = values.windows(3).map(|v| (v[0] - 2.0 * v[1] + v[2]).abs() / f64::sqrt(6.0));
    median(sizes).unwrap_or(0.0) / MEDIAN_OF_NORMAL
}
