//! `stickslip/units`.

use crate::documents::table::{Column, Named, Tabular};
use crate::{FORMAT_VERSION, Software, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_tip::Model;
use stickslip_units::{Physical, Scales};

/// Measured quantities and the numbers of the model.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnitsDocument {
    /// "stickslip/units"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// The quantities given.
    pub parameters: UnitsParameters,
    /// α = Γ N a/(σ² k²), dimensionless, (13).
    pub alpha: f64,
    /// r = Γ v0/(kσ), dimensionless, (12).
    pub r: f64,
    /// All six quantities.
    pub physical: PhysicalDocument,
    /// Steady lag of the tip behind the support.
    pub lag: LagDocument,
    /// Units of the model in SI.
    pub scales: ScalesDocument,
    /// Onset of stick-slip.
    pub critical: CriticalUnits,
    /// Whether steady motion is stable.
    pub stable: bool,
    /// Reasons for each null; may be empty.
    pub remarks: Vec<String>,
}

impl UnitsDocument {
    /// The value of the field `format`.
    pub const FORMAT: &'static str = "stickslip/units";

    /// The document of these quantities.
    pub fn new(
        parameters: UnitsParameters,
        physical: &Physical,
        model: &Model,
        critical: CriticalUnits,
        stable: bool,
        remarks: Vec<String>,
    ) -> Self {
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            parameters,
            alpha: model.alpha(),
            r: model.r(),
            lag: LagDocument {
                metres: physical.lag(model.tip()),
                dimensionless: model.steady_lag(),
            },
            scales: physical.scales().into(),
            physical: physical.into(),
            critical,
            stable,
            remarks,
        }
    }
}

/// The quantities given; null for a quantity that was solved for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnitsParameters {
    /// Footprint f.
    pub tip: TipDocument,
    /// Γ in kg/s.
    pub damping: Option<f64>,
    /// k in N/m.
    pub stiffness: Option<f64>,
    /// σ in m.
    pub tip_width: Option<f64>,
    /// N in m/s.
    pub indentation_rate: Option<f64>,
    /// a in N.
    pub slope_force: Option<f64>,
    /// v0 in m/s.
    pub velocity: Option<f64>,
    /// α, dimensionless.
    pub alpha: Option<f64>,
    /// D, if α was given as αc(r) + D; dimensionless.
    pub alpha_above: Option<f64>,
    /// r, dimensionless.
    pub r: Option<f64>,
}

/// SI values.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PhysicalDocument {
    /// Γ in kg/s.
    pub damping: f64,
    /// k in N/m.
    pub stiffness: f64,
    /// σ in m.
    pub tip_width: f64,
    /// N in m/s.
    pub indentation_rate: f64,
    /// a in N.
    pub slope_force: f64,
    /// v0 in m/s.
    pub velocity: f64,
}

/// The steady lag D of (23).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LagDocument {
    /// (Γ v0 + N a f(0)/v0)/k in m.
    pub metres: f64,
    /// r + α f(0)/r, in σ.
    pub dimensionless: f64,
}

/// SI values of the model's units.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScalesDocument {
    /// σ in m, for x, l and x0.
    pub length: f64,
    /// Γ/k in s.
    pub time: f64,
    /// kσ²/a in m, for the surface u.
    pub height: f64,
    /// kσ in N, for the external force.
    pub force: f64,
}

/// The onset of stick-slip if one quantity is varied and all others are fixed. Null if there is none.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalUnits {
    /// αc(r), dimensionless.
    pub alpha: Option<f64>,
    /// N in m/s above which there is stick-slip.
    pub indentation_rate: Option<f64>,
    /// Period at that N, in s.
    pub period: Option<f64>,
    /// Wavelength at that N, in m.
    pub wavelength: Option<f64>,
    /// rc(α), the largest one, dimensionless.
    pub r: Option<f64>,
    /// v0 in m/s below which there is stick-slip.
    pub velocity: Option<f64>,
}

impl From<&Physical> for PhysicalDocument {
    fn from(physical: &Physical) -> Self {
        Self {
            damping: physical.damping,
            stiffness: physical.stiffness,
            tip_width: physical.tip_width,
            indentation_rate: physical.indentation_rate,
            slope_force: physical.slope_force,
            velocity: physical.velocity,
        }
    }
}

impl From<Scales> for ScalesDocument {
    fn from(scales: Scales) -> Self {
        Self {
            length: scales.length,
            time: scales.time,
            height: scales.height,
            force: scales.force,
        }
    }
}

impl UnitsDocument {
    /// All quantities: name, value if there is one, and unit.
    pub fn quantities(&self) -> [(&'static str, Option<f64>, &'static str); 20] {
        let Self { physical, lag, scales, critical, .. } = self;
        [
            ("damping", Some(physical.damping), "kg/s"),
            ("stiffness", Some(physical.stiffness), "N/m"),
            ("tip_width", Some(physical.tip_width), "m"),
            ("indentation_rate", Some(physical.indentation_rate), "m/s"),
            ("slope_force", Some(physical.slope_force), "N"),
            ("velocity", Some(physical.velocity), "m/s"),
            ("alpha", Some(self.alpha), "1"),
            ("r", Some(self.r), "1"),
            ("lag", Some(lag.metres), "m"),
            ("lag_dimensionless", Some(lag.dimensionless), "1"),
            ("length_scale", Some(scales.length), "m"),
            ("time_scale", Some(scales.time), "s"),
            ("height_scale", Some(scales.height), "m"),
            ("force_scale", Some(scales.force), "N"),
            ("critical_alpha", critical.alpha, "1"),
            ("critical_indentation_rate", critical.indentation_rate, "m/s"),
            ("critical_period", critical.period, "s"),
            ("critical_wavelength", critical.wavelength, "m"),
            ("critical_r", critical.r, "1"),
            ("critical_velocity", critical.velocity, "m/s"),
        ]
    }
}

impl Tabular for UnitsDocument {
    /// The quantities as a table; a missing value is an empty cell.
    fn columns(&self) -> Vec<Named<'_>> {
        let quantities = self.quantities();
        let words = |of: fn(&(&'static str, Option<f64>, &'static str)) -> String| {
            Column::Words(quantities.iter().map(of).collect(), None)
        };
        vec![
            ("quantity", words(|(name, _, _)| (*name).into())),
            ("value", words(|(_, value, _)| value.map(|v| format!("{v:e}")).unwrap_or_default())),
            ("unit", words(|(_, _, unit)| (*unit).into())),
        ]
    }
}
