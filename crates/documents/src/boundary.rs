//! `stickslip/boundary`.

use crate::table::{Column, Named, Tabular};
use crate::{
    CriticalityName, FORMAT_VERSION, InUnits, ModelParameters, OnsetKindName, Software, TipDocument,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use stickslip_stability::{BoundaryBranch, Critical, onset_at};
use stickslip_tip::{TipFunction, Wider};

/// The stability boundary. `Omega`, `r`, `alpha` and the columns of `onset` have equal lengths.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoundaryDocument {
    /// "stickslip/boundary"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// What was asked for.
    pub parameters: BoundaryParameters,
    /// Ω = ω/r of the oscillation that is born, in 1/σ.
    #[serde(rename = "Omega")]
    pub wave_number: Vec<f64>,
    /// r, ascending; those at which steady motion is stable for every α are left out.
    pub r: Vec<f64>,
    /// αc(r), the first crossing: steady motion is stable below.
    pub alpha: Vec<f64>,
    /// What is born there.
    pub onset: OnsetColumns,
    /// The whole curve (42), (43) within the range of r, by stretches on which Ω runs without a gap.
    /// Where there are several, or where one turns back in r, its parts above αc(r) are where further
    /// pairs of roots cross. None under a wider law.
    pub branches: Vec<BranchDocument>,
    /// Under a wider law: whether linear theory decides, for each r.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub kind: Vec<OnsetKindName>,
    /// Under a wider law: what leaves nothing unstable.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<LimitColumns>,
    /// What is left out, and why; empty if nothing is.
    pub remarks: Vec<String>,
    /// Numbers of it in nm, s and nN, where it was asked for these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

impl BoundaryDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/boundary";

    /// The curve through these critical points, without what a wider law adds.
    pub fn new<'a>(
        parameters: BoundaryParameters,
        along: impl Iterator<Item = &'a Critical> + Clone,
        onset: OnsetColumns,
    ) -> Self {
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            physical: None,
            parameters,
            wave_number: along.clone().map(|at| TAU / at.wavelength).collect(),
            r: along.clone().map(|at| at.r).collect(),
            alpha: along.map(|at| at.alpha).collect(),
            onset,
            branches: vec![],
            kind: vec![],
            limits: None,
            remarks: vec![],
        }
    }
}

/// How the range of r is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SpacingName {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Logarithmic,
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoundaryParameters {
    /// Footprint f.
    pub tip: TipDocument,
    /// First and last r.
    pub r_range: [f64; 2],
    /// Number of r.
    pub points: usize,
    /// How that range is divided.
    pub spacing: SpacingName,
    /// b of (61), in kσ²/a, where there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_limit: Option<f64>,
    /// T, in Γ/k, where the surface heals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub healing_time: Option<f64>,
    /// M, in Γ²/k, where the tip has inertia.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<f64>,
}

/// Depth limits and memories under which no α makes steady motion unstable.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitColumns {
    /// Every r that was asked for, also those without a critical α.
    pub r: Vec<f64>,
    /// b_c of each, in kσ²/a: at a depth limit b below it steady motion is stable at every α, with the healing and
    /// the inertia of `parameters`. Null where nothing is unstable at any b, or where the height under the steady
    /// tip is 0, the corner of |h|.
    pub least_depth_limit: Vec<Option<f64>>,
    /// The memory length rT, in σ, below which steady motion is stable at every α, without a depth limit. Null
    /// where there is none for this tip.
    pub memory_length: Option<f64>,
}

/// The small oscillation along the boundary, to leading order in α - αc. Null where that says nothing.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnsetColumns {
    /// Whether the oscillation is born with amplitude 0, beyond αc, or is there before.
    pub criticality: Vec<Option<CriticalityName>>,
    /// d(a²)/dα, a half the peak-to-peak of l, in σ².
    pub amplitude_squared_slope: Vec<Option<f64>>,
    /// dT/dα along the branch, in Γ/k.
    pub period_slope: Vec<Option<f64>>,
    /// First Lyapunov coefficient, in k/(Γσ²).
    pub lyapunov: Vec<Option<f64>>,
}

/// A stretch of the curve, evenly spaced in Ω.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BranchDocument {
    /// Ω, ascending, in 1/σ.
    #[serde(rename = "Omega")]
    pub wave_number: Vec<f64>,
    /// r, dimensionless, (42).
    pub r: Vec<f64>,
    /// α, dimensionless, (43).
    pub alpha: Vec<f64>,
}

impl OnsetColumns {
    /// What is born at each of these points of the boundary.
    pub fn along(tip: &TipFunction, boundary: &[Critical]) -> Self {
        let mut columns = Self::default();
        boundary.iter().for_each(|at| columns.push(tip, at));
        columns
    }

    /// Of so many points, none of which is known.
    #[must_use]
    pub fn unknown(points: usize) -> Self {
        Self {
            criticality: vec![None; points],
            amplitude_squared_slope: vec![None; points],
            period_slope: vec![None; points],
            lyapunov: vec![None; points],
        }
    }

    /// Adds what is born at a point of the boundary.
    pub fn push(&mut self, tip: &TipFunction, at: &Critical) {
        let onset = onset_at(tip, *at).ok();
        self.criticality.push(onset.map(|o| o.criticality.into()));
        self.amplitude_squared_slope.push(onset.map(|o| o.amplitude_squared_slope));
        self.period_slope.push(onset.map(|o| o.period_slope));
        self.lyapunov.push(onset.map(|o| o.lyapunov));
    }
}

impl BoundaryParameters {
    /// These of a law.
    #[must_use]
    pub fn new(
        (tip, wider): (&TipFunction, &Wider),
        r_range: [f64; 2],
        (points, spacing): (usize, SpacingName),
    ) -> Self {
        let Wider { depth_limit, healing_time, inertia, .. } = *wider;
        Self { tip: tip.into(), r_range, points, spacing, depth_limit, healing_time, inertia }
    }

    /// A point of the boundary as a model.
    #[must_use]
    pub fn at(&self, r: f64, alpha: f64) -> ModelParameters {
        let Self { depth_limit, healing_time, inertia, .. } = *self;
        let papers = ModelParameters::papers(self.tip.clone(), alpha, None, r);
        ModelParameters { depth_limit, healing_time, inertia, ..papers }
    }
}

impl From<BoundaryBranch> for BranchDocument {
    fn from(branch: BoundaryBranch) -> Self {
        let BoundaryBranch { wave_number, r, alpha } = branch;
        Self { wave_number, r, alpha }
    }
}

impl Tabular for BoundaryDocument {
    /// The boundary, a row for each r.
    fn columns(&self) -> Vec<Named<'_>> {
        let OnsetColumns { amplitude_squared_slope, period_slope, lyapunov, .. } = &self.onset;
        vec![
            ("Omega", Column::of(&self.wave_number)),
            ("r", Column::of(&self.r)),
            ("alpha", Column::of(&self.alpha)),
            ("amplitude_squared_slope", Column::optional(amplitude_squared_slope)),
            ("period_slope", Column::optional(period_slope)),
            ("lyapunov", Column::optional(lyapunov)),
        ]
    }

    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }
}
