//! A point of a sweep, and the method that found its motion.

use crate::RegimeName;
use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_cycles::Cycle;
use stickslip_outcome::{Motion, Outcome};

/// The method that found the motion at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SourceName {
    /// Linear theory: steady motion is stable, or nearly so, because α is below αc.
    Stability,
    /// The stable periodic solution of (18).
    Cycle,
    /// The end of a run, from a disturbed steady state unless the sweep sets another start.
    Run,
}

/// The word in documents.
impl std::fmt::Display for SourceName {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.serialize(out)
    }
}

/// One point of a sweep.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepPoint {
    /// Index in the grid.
    pub index: usize,
    /// Width of the footprint, in σ, if it varies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Side-lobe weight β, if given.
    pub beta: Option<f64>,
    /// r, dimensionless.
    pub r: f64,
    /// α, dimensionless; null where αc(r) + D could not be found.
    pub alpha: Option<f64>,
    /// Values of the further axes, in their order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<f64>,
    /// αc(r), if there is one.
    pub critical_alpha: Option<f64>,
    /// The regime that the tip settles into; "transient" if a run of thousands of time units did not settle. Null if
    /// `error` is given.
    pub regime: Option<RegimeName>,
    /// The method that found the regime.
    pub source: Option<SourceName>,
    /// Period of l(t), in Γ/k.
    pub period: Option<f64>,
    /// Error of `period`, in Γ/k.
    #[serde(default)]
    pub period_error: Option<f64>,
    /// Wavelength of the surface far behind the tip, in σ.
    pub wavelength: Option<f64>,
    /// Error of `wavelength`, in σ.
    #[serde(default)]
    pub wavelength_error: Option<f64>,
    /// Half peak-to-peak of l, in σ.
    pub amplitude_x0: Option<f64>,
    /// Error of `amplitude_x0`, in σ.
    #[serde(default)]
    pub amplitude_x0_error: Option<f64>,
    /// Half peak-to-peak of the surface far behind the tip, in kσ²/a; on a healing surface, of U(x) in u = U e^{-D/(r
    /// T_h)}, with the healing time T_h and the distance D behind the support. For cycles, and for requested runs.
    pub amplitude_u: Option<f64>,
    /// Error of `amplitude_u`, in kσ²/a.
    #[serde(default)]
    pub amplitude_u_error: Option<f64>,
    /// Mean of l at 2,001 evenly spaced times in the second half of the run, in σ; for requested runs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean_l: Option<f64>,
    /// Standard deviation of l at the times of `mean_l`, in σ: a measure of oscillation or noise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub deviation_l: Option<f64>,
    /// Mean distance that the tip moves between slips in the second half of a requested run, in σ. A slip is a fall of
    /// l by more than `deviation_l`. Null for steady and trapped tips, and for fewer than three slips.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slip_distance: Option<f64>,
    /// Standard error of `slip_distance`, in σ, from the scatter of the distances.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slip_distance_error: Option<f64>,
    /// Number of maxima of l in one period.
    pub slips: Option<usize>,
    /// Largest modulus of the Floquet multipliers except that of a shift in time; for cycles only. The error is at most
    /// 5e-8 for a modulus above 0.01 and at most 1e-6 below.
    pub multiplier: Option<f64>,
    /// The reason why there is no result.
    pub error: Option<String>,
}

impl SweepPoint {
    /// A point without results: its index, β, r and α.
    pub fn at(index: usize, beta: Option<f64>, r: f64, alpha: Option<f64>) -> Self {
        Self { index, beta, r, alpha, ..Self::default() }
    }

    /// Adds the motion that the tip settles into at this point.
    #[must_use]
    pub fn settled(mut self, motion: Motion) -> Self {
        match motion {
            Motion::Steady => {
                self.regime = Some(RegimeName::Steady);
                self.source = Some(SourceName::Stability);
            }
            Motion::Cycle(cycle) => self.is_periodic(&cycle),
            Motion::Run(outcome) => self.ended(&outcome),
        }
        self
    }

    fn is_periodic(&mut self, cycle: &Cycle) {
        (self.regime, self.source) = (Some(RegimeName::StickSlip), Some(SourceName::Cycle));
        (self.period, self.wavelength) = (Some(cycle.period()), Some(cycle.wavelength()));
        self.amplitude_x0 = Some(cycle.amplitude_x0());
        self.amplitude_u = Some(cycle.amplitude_u());
        let error = cycle.error();
        (self.period_error, self.wavelength_error) = (Some(error), Some(self.r * error));
        self.amplitude_x0_error = Some(error);
        self.amplitude_u_error = Some(cycle.amplitude_u_error());
        self.slips = Some(cycle.slips());
        let moduli = cycle.nontrivial_multipliers().map(|m| m.norm());
        self.multiplier = moduli.max_by(f64::total_cmp);
    }

    fn ended(&mut self, outcome: &Outcome) {
        (self.regime, self.source) = (Some(outcome.regime.into()), Some(SourceName::Run));
        if let Some(motion) = &outcome.oscillation {
            (self.period, self.wavelength) = (Some(motion.period), Some(motion.wavelength));
            self.period_error = Some(motion.period_error);
            self.wavelength_error = Some(motion.wavelength_error);
            self.amplitude_x0 = Some(motion.amplitude_x0);
            self.amplitude_x0_error = Some(motion.amplitude_x0_error);
            self.slips = Some(motion.slips);
        }
    }
}
