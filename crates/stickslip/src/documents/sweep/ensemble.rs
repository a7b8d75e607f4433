//! Points that differ in the seed of their noise alone, taken together.

use super::{AxisName, SweepParameters, SweepPoint};
use crate::RegimeName;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What points come to that differ in the seed of their noise alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EnsembleDocument {
    /// Index of the first of them; the others follow it.
    pub first: usize,
    /// How many there are.
    pub count: usize,
    /// How many end in each regime.
    pub regimes: RegimeCounts,
    /// Of the periods of those in stick-slip, in Γ/k; null where none is.
    pub period: Option<StatisticsDocument>,
    /// Of their wavelengths, in σ.
    pub wavelength: Option<StatisticsDocument>,
    /// Of their amplitudes, in σ.
    pub amplitude_x0: Option<StatisticsDocument>,
    /// Of the amplitudes of the surface that they leave, in kσ²/a.
    pub amplitude_u: Option<StatisticsDocument>,
    /// Of the mean of l over the second half of each run, in σ, whatever its regime.
    pub mean_l: Option<StatisticsDocument>,
    /// Of its standard deviation there, in σ.
    pub deviation_l: Option<StatisticsDocument>,
}

/// How many points end in each regime.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegimeCounts {
    /// Steady.
    pub steady: usize,
    /// Stick-slip.
    pub stick_slip: usize,
    /// Trapped.
    pub trapped: usize,
    /// Drifting.
    pub drifting: usize,
    /// Not settled.
    pub transient: usize,
    /// Failed, as their `error` says.
    pub failed: usize,
}

/// Of some numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StatisticsDocument {
    /// How many.
    pub count: usize,
    /// Their mean.
    pub mean: f64,
    /// Standard deviation of one of them, by N - 1; null of a single one.
    pub deviation: Option<f64>,
    /// Standard error of the mean; null of a single one.
    pub error: Option<f64>,
    /// The least.
    pub least: f64,
    /// The median: of an even number, half-way between the two in the middle.
    pub median: f64,
    /// The largest.
    pub largest: f64,
}

impl EnsembleDocument {
    /// The ensembles of a whole grid, in which seeds vary fastest; `None` where there are none.
    pub fn all(parameters: &SweepParameters, points: &[SweepPoint]) -> Option<Vec<Self>> {
        let seeds = parameters.axes.last().filter(|axis| axis.name == AxisName::Seed)?;
        let is_whole = parameters.shard.is_none() && points.len() == parameters.points();
        is_whole.then(|| points.chunks(seeds.values.len().max(1)).map(Self::of).collect())
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
    /// Of these numbers; `None` of none. By two passes, so that nothing cancels.
    fn of(mut numbers: Vec<f64>) -> Option<Self> {
        numbers.sort_by(f64::total_cmp);
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
