//! Conversion of SI quantities to the dimensionless numbers of the model, and back.
//!
//! A tip of width σ and friction Γ hangs on a spring k, which is dragged at v0. It indents at the rate N and is pushed
//! down slopes with strength a, (1) to (7). In units of σ and Γ/k its velocity is r and its indentation rate α; D is
//! its lag in steady motion:
//!
//! ```text
//!     r = Γ v0/(kσ)    (12)        α = Γ N a/(σ²k²)    (13)        D = (Γ v0 + N a f(0)/v0)/k    (23)
//! ```

mod quantity;

pub use quantity::Unit;

use stickslip_tip::{Model, ModelError, TipFunction};
use thiserror::Error;

/// Measured quantities, in SI units: the friction Γ of the tip (1), spring constant k and velocity v0 of the support (3),
/// force per slope a (4), width σ and indentation rate N (7).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "PhysicalDocument"))]
#[cfg_attr(feature = "schema", schemars(description = "SI values."))]
pub struct Physical {
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

/// SI values of the model's units.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "ScalesDocument"))]
pub struct Scales {
    /// σ in m, for x, l and x0.
    pub length: f64,
    /// Γ/k in s.
    pub time: f64,
    /// kσ²/a in m, for the surface u.
    pub height: f64,
    /// kσ in N, for the external force.
    pub force: f64,
}

/// The reason why SI quantities were rejected.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum UnitsError {
    /// Not a number with a unit.
    #[error(
        "`{text}` is not a quantity in {unit}: write a number and a unit, such as {}",
        unit.example()
    )]
    Syntax {
        /// The text as given.
        text: String,
        /// The expected unit.
        unit: Unit,
    },
    /// A number without a unit.
    #[error("`{text}` has no unit: write a number and a unit, such as {}", unit.example())]
    Bare {
        /// The text as given.
        text: String,
        /// The expected unit.
        unit: Unit,
    },
    /// A quantity that must be positive.
    #[error("{name} is {value} in SI units: it must be a finite number > 0")]
    NotPositive {
        /// Name of the quantity.
        name: &'static str,
        /// Value as given, in SI units.
        value: f64,
    },
    /// The dimensionless numbers are out of range.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl Physical {
    /// Rejects a quantity that is not finite and above 0; N may be 0.
    ///
    /// # Errors
    /// [`UnitsError::NotPositive`].
    pub fn validated(self) -> Result<Self, UnitsError> {
        let positive = [
            ("the damping Γ", self.damping),
            ("the spring constant k", self.stiffness),
            ("the tip width σ", self.tip_width),
            ("the slope force a", self.slope_force),
            ("the velocity v0", self.velocity),
        ];
        for (name, value) in positive {
            if !(value.is_finite() && value > 0.0) {
                return Err(UnitsError::NotPositive { name, value });
            }
        }
        if !(self.indentation_rate.is_finite() && self.indentation_rate >= 0.0) {
            let (name, value) = ("the indentation rate N", self.indentation_rate);
            return Err(UnitsError::NotPositive { name, value });
        }
        Ok(self)
    }

    /// r, (12).
    pub fn r(&self) -> f64 {
        self.damping * self.velocity / (self.stiffness * self.tip_width)
    }

    /// α, (13).
    pub fn alpha(&self) -> f64 {
        self.damping * self.indentation_rate * self.slope_force
            / (self.tip_width * self.stiffness).powi(2)
    }

    /// The dimensionless model with this tip function.
    ///
    /// # Errors
    /// α or r is beyond the range of floating point.
    pub fn model(&self, tip: TipFunction) -> Result<Model, UnitsError> {
        Ok(Model::new(tip, self.alpha(), self.r())?)
    }

    /// Steady lag D of the tip behind the support in m, (23). The paper prints N a/v0 in place of N a f(0)/v0, for f(0) = 1.
    pub fn lag(&self, tip: &TipFunction) -> f64 {
        let groove = self.indentation_rate * self.slope_force * tip.value(0.0) / self.velocity;
        (self.damping * self.velocity + groove) / self.stiffness
    }

    /// SI values of the model's units.
    pub fn scales(&self) -> Scales {
        Scales {
            length: self.tip_width,
            time: self.damping / self.stiffness,
            height: self.stiffness * self.tip_width.powi(2) / self.slope_force,
            force: self.stiffness * self.tip_width,
        }
    }

    /// The inverse: N and v0 that give α and r, with Γ, k, σ and a unchanged.
    pub fn with_alpha_r(&self, alpha: f64, r: f64) -> Self {
        let stiffness_length = self.stiffness * self.tip_width;
        Self {
            indentation_rate: alpha * stiffness_length * stiffness_length
                / (self.damping * self.slope_force),
            velocity: r * stiffness_length / self.damping,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, wanted: f64) {
        assert!((found - wanted).abs() <= 1e-14 * wanted.abs(), "{found} for {wanted}");
    }

    fn example() -> Physical {
        Physical {
            damping: 1e-6,
            stiffness: 0.5,
            tip_width: 50e-9,
            indentation_rate: 20e-9,
            slope_force: 30e-9,
            velocity: 1e-6,
        }
    }

    /// (12), (13), (23) worked out by hand for the example.
    #[test]
    fn dimensionless_numbers_follow_their_definitions() {
        let physical = example().validated().unwrap();
        close(physical.r(), 4e-5);
        close(physical.alpha(), 9.6e-7);
        let tip = TipFunction::gaussian(1.0).unwrap();
        close(physical.lag(&tip), 1.2e-9 + 2e-12);
        // The same lag from the model: r + l0, in units of σ.
        let model = physical.model(tip).unwrap();
        close(model.steady_lag() * physical.scales().length, 1.202e-9);
    }

    #[test]
    fn the_way_back_gives_the_quantities_again() {
        let there = example();
        let back = Physical { indentation_rate: 1.0, velocity: 1.0, ..there }
            .with_alpha_r(there.alpha(), there.r());
        close(back.indentation_rate, there.indentation_rate);
        close(back.velocity, there.velocity);
    }

    #[test]
    fn a_quantity_that_is_not_positive_is_named() {
        let wrong = Physical { stiffness: 0.0, ..example() };
        let error = wrong.validated().unwrap_err();
        assert!(error.to_string().contains("spring constant k is 0"), "{error}");
    }
}
