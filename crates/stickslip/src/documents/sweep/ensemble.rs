//! Ensembles: points that differ only in the seed of their noise.

use super::{AxisName, SweepParameters, SweepPoint, SweepPoints};
use crate::schema::JsonSchema;
use crate::{Points, RegimeName};
use serde::{Deserialize, Serialize};
use stickslip_tip::sorting::sort_numbers;

/// Statistics of points that differ only in the seed of their noise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EnsembleDocument {
    /// Index of the first point; the others follow it.
    pub first: usize,
    /// Number of points.
    pub count: usize,
    /// Number of points in each regime.
    pub regimes: RegimeCounts,
    /// Statistics of the periods of points in stick-slip, in Γ/k; null if there are none.
    pub period: Option<StatisticsDocument>,
    /// Statistics of the wavelengths of points in stick-slip, in σ; null if there are none.
    pub wavelength: Option<StatisticsDocument>,
    /// Statistics of the amplitudes of x0 of points in stick-slip, in σ; null if there are none.
    pub amplitude_x0: Option<StatisticsDocument>,
    /// Statistics of the amplitudes of the surface far behind the tip, in kσ²/a.
    pub amplitude_u: Option<StatisticsDocument>,
    /// Statistics of the mean of l over the second half of each run, in σ, in all regimes.
    pub mean_l: Option<StatisticsDocument>,
    /// Statistics of the standard deviation of l over the second half of each run, in σ.
    pub deviation_l: Option<StatisticsDocument>,
    /// Statistics of the mean distance between slips in each run, in σ, whether its motion is periodic or not.
    #[serde(default)]
    pub slip_distance: Option<StatisticsDocument>,
}

/// Number of points in each regime.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegimeCounts {
    /// Number of steady points.
    pub steady: usize,
    /// Number of points in stick-slip.
    pub stick_slip: usize,
    /// Number of trapped points.
    pub trapped: usize,
    /// Number of drifting points.
    pub drifting: usize,
    /// Number of transient points, which have not settled.
    pub transient: usize,
    /// Number of failed points, with the reason in their `error`.
    pub failed: usize,
}

/// Statistics of a set of numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StatisticsDocument {
    /// Number of values.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the values, with `count` - 1 in the denominator; null if there is only one.
    pub deviation: Option<f64>,
    /// Standard error of the mean; null if there is only one number.
    pub error: Option<f64>,
    /// Smallest number.
    pub least: f64,
    /// Median: for an even count, the mean of the middle two.
    pub median: f64,
    /// Largest number.
    pub largest: f64,
}

impl EnsembleDocument {
    /// The ensembles of a whole grid, in which seeds vary fastest; `None` if seeds do not vary.
    pub fn all(parameters: &SweepParameters, points: &SweepPoints) -> Option<Vec<Self>> {
        let seeds = parameters.axes.last().filter(|axis| axis.name == AxisName::Seed)?;
        let is_whole = parameters.shard.is_none() && points.len() == parameters.points();
        let (count, each) = (points.len(), seeds.values.len().max(1));
        let member = |first: usize| (first..count.min(first + each)).map(|place| points.at(place));
        let ensemble = |first| Self::of(&member(first).collect::<Vec<_>>());
        is_whole.then(|| (0..count).step_by(each).map(ensemble).collect())
    }

    fn of(points: &[SweepPoint]) -> Self {
        let numbers = |of: fn(&SweepPoint) -> Option<f64>| {
            StatisticsDocument::of(points.iter().filter_map(of).collect())
        };
        Self {
            first: points.first().map_or(0, |point| point.index),
            count: points.len(),
            regimes: RegimeCounts::of(points),
            period: numbers(|point| point.period),
            wavelength: numbers(|point| point.wavelength),
            amplitude_x0: numbers(|point| point.amplitude_x0),
            amplitude_u: numbers(|point| point.amplitude_u),
            mean_l: numbers(|point| point.mean_l),
            deviation_l: numbers(|point| point.deviation_l),
            slip_distance: numbers(|point| point.slip_distance),
        }
    }
}

impl RegimeCounts {
    fn of(points: &[SweepPoint]) -> Self {
        let mut counts = Self::default();
        for point in points {
            *match point.regime {
                Some(RegimeName::Steady) => &mut counts.steady,
                Some(RegimeName::StickSlip) => &mut counts.stick_slip,
                Some(RegimeName::Trapped) => &mut counts.trapped,
                Some(RegimeName::Drifting) => &mut counts.drifting,
                // No point of a sweep gives way across the scan.
                Some(RegimeName::Transient | RegimeName::Snaking) => &mut counts.transient,
                None => &mut counts.failed,
            } += 1;
        }
        counts
    }
}

impl StatisticsDocument {
    /// The statistics of these numbers, `None` without any. Computed in two passes, which avoids cancellation.
    fn of(mut numbers: Vec<f64>) -> Option<Self> {
        sort_numbers(&mut numbers);
        let (least, largest) = (*numbers.first()?, *numbers.last()?);
        let count = numbers.len();
        let mean = numbers.iter().sum::<f64>() / count as f64;
        let squares: f64 = numbers.iter().map(|x| (x - mean).powi(2)).sum();
        let deviation = (count > 1).then(|| (squares / (count as f64 - 1.0)).sqrt());
        let median = f64::midpoint(numbers[(count - 1) / 2], numbers[count / 2]);
        let error = deviation.map(|deviation| deviation / (count as f64).sqrt());
        Some(Self { count, mean, deviation, error, least, median, largest })
    }
}
