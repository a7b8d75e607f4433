//! The question `units`: the numbers of the model from measured quantities, and back.

mod solve;

use super::exponents::failed;
use crate::documents::table::{Column, Named, Tabular};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{FORMAT_VERSION, Failure, Indentation, Refused, Software, Tip};
use serde::{Deserialize, Serialize};
use solve::{Given, INDENTATION_RATE, QUANTITIES, QUANTITIES_TOGETHER, is_allowed};
use stickslip_stability::{StabilityError, critical, critical_r, unstable_count};
use stickslip_tip::{Model, Wider};
use stickslip_units::{Physical, Scales};

/// The quantities given; null for a quantity that is solved for. All six give α and r; one may be left out if r or α is
/// given, two if both are given.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Units {
    /// Footprint f of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// Γ in kg/s.
    #[serde(default)]
    pub damping: Option<f64>,
    /// k in N/m.
    #[serde(default)]
    pub stiffness: Option<f64>,
    /// σ in m.
    #[serde(default)]
    pub tip_width: Option<f64>,
    /// N in m/s.
    #[serde(default)]
    pub indentation_rate: Option<f64>,
    /// a in N.
    #[serde(default)]
    pub slope_force: Option<f64>,
    /// v0 in m/s.
    #[serde(default)]
    pub velocity: Option<f64>,
    /// Dimensionless indentation rate α = Γ N a/(σ² k²), (13); 0 or above.
    #[schemars(extend("x-option" = option("A", "Model", 3)))]
    #[serde(default)]
    pub alpha: Option<f64>,
    /// D in α = αc(r) + D, the distance from the critical α (negative below it); dimensionless.
    #[schemars(extend("x-option" = option("D", "Model", 4)))]
    #[serde(default)]
    pub alpha_above: Option<f64>,
    /// Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.
    #[schemars(extend("x-option" = option("R", "Model", 2)))]
    #[serde(default)]
    pub r: Option<f64>,
}

impl Units {
    /// The answer, with critical values of the basic model.
    ///
    /// # Errors
    /// A quantity is out of its range; too few or too many quantities are given; or the missing ones do not follow from
    /// them.
    pub fn answered(self) -> Result<UnitsDocument, Failure> {
        let given = self.given()?;
        let physical = given.solved()?;
        let quantities = |why: String| Refused::whole(QUANTITIES_TOGETHER, why);
        const CHECK: &str = "check the units and prefixes of the quantities";
        let model = physical
            .model(self.tip.0.clone())
            .map_err(|error| quantities(format!("{error}; {CHECK}")))?;
        let law = Wider::default();
        let at_r = critical(&law, &self.tip.0, model.r());
        let at_alpha = critical_r(&law, &self.tip.0, model.alpha());
        let stable = unstable_count(&model).map_err(|error| match error {
            StabilityError::TooFarApart { .. } => quantities(format!("{error}; {CHECK}")).into(),
            error => failed(&error, CHECK),
        })? == 0;
        let scales = physical.scales();
        let (indentation, velocity) = (at_r.as_ref().ok(), at_alpha.as_ref().ok());
        let with = |alpha: f64, r: f64| physical.with_alpha_r(alpha, r);
        let critical = CriticalUnits {
            alpha: indentation.map(|at| at.alpha),
            indentation_rate: indentation.map(|at| with(at.alpha, at.r).indentation_rate),
            period: indentation.map(|at| at.period * scales.time),
            wavelength: indentation.map(|at| at.wavelength * scales.length),
            r: velocity.map(|at| at.r),
            velocity: velocity.map(|at| with(at.alpha, at.r).velocity),
        };
        let why = |name: &str, error: Option<StabilityError>| error.map(|e| format!("{name}: {e}"));
        let remarks = why("critical indentation rate", at_r.err())
            .into_iter()
            .chain(why("critical velocity", at_alpha.err()));
        let parameters = Self { alpha: given.alpha, ..self };
        Ok(UnitsDocument::new(parameters, &physical, &model, critical, stable, remarks.collect()))
    }

    /// Number of quantities left out, of six.
    pub fn left_out(&self) -> usize {
        self.values().iter().filter(|value| value.is_none()).count()
    }

    fn values(&self) -> [Option<f64>; 6] {
        let Self { damping, stiffness, tip_width, indentation_rate, slope_force, velocity, .. } =
            *self;
        [damping, stiffness, tip_width, indentation_rate, slope_force, velocity]
    }

    fn given(&self) -> Result<Given, Refused> {
        let values = self.values();
        for (i, (quantity, value)) in QUANTITIES.iter().zip(values).enumerate() {
            if let Some(value) = value.filter(|value| !is_allowed(i, *value)) {
                let least = if i == INDENTATION_RATE { "0 or above" } else { "above 0" };
                let why = format!("{} must be {least}", quantity.symbol);
                return Err(Refused::number(quantity.name, value, why));
            }
        }
        if let Some(r) = self.r.filter(|r| !(r.is_finite() && *r > 0.0)) {
            let why = "the dimensionless support velocity must be a finite number above 0";
            return Err(Refused::number("r", r, why));
        }
        let given = Given { values, alpha: self.rate()?, r: self.r };
        given.judge_number()?;
        Ok(given)
    }

    /// α, however it is given.
    fn rate(&self) -> Result<Option<f64>, Refused> {
        let indentation = Indentation { alpha: self.alpha, alpha_above: self.alpha_above };
        let (name, typed) = match (self.alpha, self.alpha_above) {
            (None, None) => return Ok(None),
            (_, Some(above)) => ("alpha_above", above),
            (Some(alpha), None) => ("alpha", alpha),
        };
        let alpha = match (self.alpha_above, self.r) {
            (None, _) => self.alpha,
            (Some(_), None) => {
                let why = "αc is a function of r: give {r} R, or {alpha} A instead";
                return Err(Refused::number(name, typed, why));
            }
            (Some(_), Some(r)) => indentation.resolved(&self.tip.0, Wider::default(), r)?.alpha,
        };
        match alpha.filter(|alpha| !(alpha.is_finite() && *alpha >= 0.0)) {
            None => Ok(alpha),
            Some(_) => Err(Refused::number(name, typed, "α must be a finite number, 0 or above")),
        }
    }
}

/// Measured quantities and the numbers of the model.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UnitsDocument {
    /// "stickslip/units"
    pub format: String,
    /// Version of the format; 1.
    pub format_version: u32,
    /// The program that wrote the document.
    pub software: Software,
    /// The quantities given.
    pub parameters: Units,
    /// α = Γ N a/(σ² k²), dimensionless, (13).
    pub alpha: f64,
    /// r = Γ v0/(kσ), dimensionless, (12).
    pub r: f64,
    /// All six quantities.
    pub physical: Physical,
    /// Steady lag of the tip behind the support.
    pub lag: LagDocument,
    /// Units of the model in SI.
    pub scales: Scales,
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
        parameters: Units,
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
            scales: physical.scales(),
            physical: *physical,
            critical,
            stable,
            remarks,
        }
    }
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

/// The onset of stick-slip if one quantity is varied and all others are fixed. A field is null if there is no onset.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalUnits {
    /// αc(r), dimensionless.
    pub alpha: Option<f64>,
    /// N in m/s above which there is stick-slip.
    pub indentation_rate: Option<f64>,
    /// Period at the onset with this `indentation_rate`, in s.
    pub period: Option<f64>,
    /// Wavelength at the onset with this `indentation_rate`, in m.
    pub wavelength: Option<f64>,
    /// rc(α), the largest one, dimensionless.
    pub r: Option<f64>,
    /// v0 in m/s below which there is stick-slip.
    pub velocity: Option<f64>,
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
            Column::words(quantities.iter().map(of))
        };
        vec![
            ("quantity", words(|(name, _, _)| (*name).into())),
            ("value", words(|(_, value, _)| value.map(|v| format!("{v:e}")).unwrap_or_default())),
            ("unit", words(|(_, _, unit)| (*unit).into())),
        ]
    }
}
