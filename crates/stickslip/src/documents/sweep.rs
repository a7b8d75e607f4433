//! The document of `stickslip sweep`.

mod axis;
mod ensemble;
mod point;
mod points;

use crate::documents::table::{Array, Column, Named, Rows, Tabular, as_arrays};
use crate::schema::JsonSchema;
use crate::{Document, InUnits, Law, Question, StartName, Tip};
pub use axis::{AxisDocument, AxisName};
pub use ensemble::{EnsembleDocument, RegimeCounts, StatisticsDocument};
pub use point::{SourceName, SweepPoint};
pub use points::SweepPoints;
use serde::{Deserialize, Serialize};
use stickslip_tip::Wider;

/// The motion that the tip settles into, over a grid of parameters.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepFound {
    /// The points, by rising index.
    #[schemars(with = "Vec<SweepPoint>")]
    pub points: SweepPoints,
    /// Ensembles of points that differ only in the seed of their noise, in the order of the points; present if seeds
    /// vary and all parts are included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ensembles: Option<Vec<EnsembleDocument>>,
    /// Floating-point arithmetic of the machine that computed the points, such as "x86_64-30e62884":
    /// other arithmetic changes the last digits. Null if parts come from machines with different arithmetic.
    #[serde(default)]
    pub arithmetic: Option<String>,
    /// CRC-32 (IEEE) of the JSON `[parameters,points,arithmetic]`, without spaces and with the shortest digits:
    /// `merge` uses it to detect changes.
    #[serde(default)]
    pub crc32: Option<u32>,
}

/// A sweep and the question that it answers.
pub type SweepDocument = Document<SweepParameters>;

impl Question for SweepParameters {
    const FORMAT: &'static str = "stickslip/sweep";
    type Answer = SweepFound;
}

/// The grid: footprints times r times α times further axes, the last varying fastest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct SweepParameters {
    /// Footprints f: each width with each β, if they vary.
    pub tips: Vec<Tip>,
    /// Widths of the footprints, in σ, if several were given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<Vec<f64>>,
    /// Side-lobe weights β of the footprints, if given.
    pub beta: Option<Vec<f64>>,
    /// Dimensionless support velocities r (12).
    pub r: Vec<f64>,
    /// Dimensionless indentation rates α (13), if given as such.
    pub alpha: Option<Vec<f64>>,
    /// D, if the indentation rates were given as αc(r) + D.
    pub alpha_above: Option<Vec<f64>>,
    /// Largest residual of (18) on a cycle, in kσ/Γ, or target for the error of a run, in σ.
    pub tolerance: f64,
    /// Part of the points in this document; by default all.
    pub shard: Option<ShardDocument>,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
    /// Further parameters that vary.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub axes: Vec<AxisDocument>,
    /// Parameters of the runs, if each point is a run from its own initial condition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run: Option<SweepRunParameters>,
}

impl SweepParameters {
    /// The extensions of the basic model.
    pub fn wider(&self) -> Wider {
        self.law.into()
    }

    /// Number of points for each footprint, r and α.
    pub fn inner(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul)
    }

    /// Values of the further axes at the point with this index.
    pub fn at(&self, index: usize) -> Vec<f64> {
        let mut rest = index;
        let last_first = self.axes.iter().rev().map(|axis| {
            let count = axis.values.len().max(1);
            let at = rest % count;
            rest /= count;
            axis.values.get(at).copied().unwrap_or(f64::NAN)
        });
        let mut values: Vec<f64> = last_first.collect();
        values.reverse();
        values
    }
}

impl Tabular for SweepDocument {
    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }

    /// The points as a table. The regime in an array: 0 steady, 1 stick-slip, 2 trapped, 5 transient, NaN if unknown.
    fn columns(&self) -> Vec<Named<'_>> {
        let (points, count) = (&self.points, self.points.len());
        let number = |of: fn(&SweepPoint) -> Option<f64>| -> Column {
            Column::Optional(Rows::new(count, move |row| of(&points.at(row))))
        };
        let words = |of: fn(&SweepPoint) -> Option<String>| {
            Rows::new(count, move |row| of(&points.at(row)).unwrap_or_default())
        };
        let regimes = Rows::new(count, |row| {
            points.at(row).regime.map_or(f64::NAN, |regime| f64::from(regime as u8))
        });
        let regimes =
            Column::Words(words(|p| p.regime.map(|regime| regime.to_string())), Some(regimes));
        let widths = self.parameters.width.as_ref().map(|_| ("width", number(|p| p.width)));
        let place = vec![
            ("beta", number(|p| p.beta)),
            ("r", number(|p| Some(p.r))),
            ("alpha", number(|p| p.alpha)),
        ];
        let axis = |(i, axis): (usize, &AxisDocument)| {
            let values = Rows::new(count, move |row| points.at(row).at.get(i).copied());
            (axis.name.column(), Column::Optional(values))
        };
        let axes = self.parameters.axes.iter().enumerate().map(axis);
        let found = vec![
            ("critical_alpha", number(|p| p.critical_alpha)),
            ("period", number(|p| p.period)),
            ("wavelength", number(|p| p.wavelength)),
            ("amplitude_x0", number(|p| p.amplitude_x0)),
            ("amplitude_u", number(|p| p.amplitude_u)),
            ("slips", number(|p| p.slips.map(|slips| slips as f64))),
            ("multiplier", number(|p| p.multiplier)),
            ("regime", regimes),
            ("source", Column::Words(words(|p| p.source.map(|source| source.to_string())), None)),
        ];
        let of_runs = self.parameters.run.iter().flat_map(|_| {
            [
                ("mean_l", number(|p| p.mean_l)),
                ("deviation_l", number(|p| p.deviation_l)),
                ("slip_distance", number(|p| p.slip_distance)),
            ]
        });
        widths.into_iter().chain(place).chain(axes).chain(found).chain(of_runs).collect()
    }

    fn each_array(&self) -> Box<dyn Iterator<Item = (&'static str, Array<'_>)> + '_> {
        Box::new(as_arrays(self.columns()))
    }
}

/// Part `index` of `of`: the points whose index is `index` - 1 modulo `of`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShardDocument {
    /// Index of the part, from 1 to `of`.
    pub index: usize,
    /// Number of parts.
    pub of: usize,
}

impl ShardDocument {
    /// The single part of a grid that is not divided.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// Whether the point with this index belongs to this part.
    #[must_use]
    pub fn has(self, index: usize) -> bool {
        index.checked_rem(self.of).is_some_and(|rest| rest + 1 == self.index)
    }

    /// The indices of the points in this part, for the given total number.
    pub fn indices(self, points: usize) -> impl Iterator<Item = usize> + use<> {
        (self.index.saturating_sub(1)..points).step_by(self.of.max(1))
    }
}

/// Runs from a given initial condition, instead of the motion that the tip settles into. Parameters that vary are among
/// the axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepRunParameters {
    /// Time at which the runs end, in Γ/k.
    pub until: f64,
    /// Initial condition.
    pub start: StartName,
    /// Start position X, in σ.
    pub start_position: f64,
    /// Kick D, in σ.
    pub kick: f64,
    /// Start velocity V, in kσ/Γ, if given.
    pub start_velocity: Option<f64>,
    /// Amplitude of the noise, in kσ²/a, if given.
    pub noise: Option<f64>,
    /// Spacing of the grid of the noise, in σ, if given.
    pub noise_spacing: Option<f64>,
    /// Seed of the noise, if given.
    pub seed: Option<f64>,
}
