//! Parameters to fit, and known parameters.

use stickslip_tip::{Model, TipFunction, Wider};

/// A parameter of the model. All are positive, and searched by their logarithms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Name {
    /// α, dimensionless indentation rate.
    Alpha,
    /// r, dimensionless support velocity.
    R,
    /// σ, in the unit of the positions.
    Width,
    /// β of the triple Gaussian.
    Beta,
    /// Depth limit b, in kσ²/a.
    DepthLimit,
    /// Healing time T, in Γ/k.
    HealingTime,
    /// Inertia M, in Γ²/k.
    Inertia,
    /// α per load, in a series at several loads.
    AlphaPerLoad,
    /// r per velocity, in a series at several velocities.
    RPerVelocity,
}

impl Name {
    /// All parameters.
    pub const ALL: [Self; 9] = [
        Self::Alpha,
        Self::R,
        Self::Width,
        Self::Beta,
        Self::DepthLimit,
        Self::HealingTime,
        Self::Inertia,
        Self::AlphaPerLoad,
        Self::RPerVelocity,
    ];

    /// Whether it is a parameter of the extended model only.
    pub(super) fn is_of_extended_model(self) -> bool {
        matches!(self, Self::DepthLimit | Self::HealingTime | Self::Inertia)
    }

    /// The name in documents.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Alpha => "alpha",
            Self::R => "r",
            Self::Width => "width",
            Self::Beta => "beta",
            Self::DepthLimit => "depth_limit",
            Self::HealingTime => "healing_time",
            Self::Inertia => "inertia",
            Self::AlphaPerLoad => "alpha_per_load",
            Self::RPerVelocity => "r_per_velocity",
        }
    }
}

/// The shape of the footprint, in its own σ.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A known tip.
    Known(TipFunction),
    /// The triple Gaussian (48), with β as a parameter.
    Triple,
}

/// Values of the parameters; a parameter may have none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Values([Option<f64>; 9]);

impl Values {
    /// The value of a parameter.
    pub fn get(&self, name: Name) -> Option<f64> {
        self.0[name as usize]
    }

    /// Sets the value of a parameter.
    pub fn set(&mut self, name: Name, value: f64) {
        self.0[name as usize] = Some(value);
    }

    /// A copy with one more value.
    #[must_use]
    pub fn with(mut self, name: Name, value: f64) -> Self {
        self.set(name, value);
        self
    }

    /// The model at this α and r; `None` if the values are invalid.
    pub fn model(&self, shape: &Shape, alpha: f64, r: f64) -> Option<Model> {
        let tip = match shape {
            Shape::Known(tip) => tip.clone(),
            Shape::Triple => TipFunction::triple_gaussian(self.get(Name::Beta)?, 1.0).ok()?,
        };
        let wider = Wider {
            depth_limit: self.get(Name::DepthLimit),
            healing_time: self.get(Name::HealingTime),
            inertia: self.get(Name::Inertia),
            ..Wider::default()
        };
        Model::under(wider, tip, alpha, r).ok()
    }
}
