//! `stickslip/response`.

use super::{
    CertificateDocument, ComplexDocument, ModelParameters, PulseParameters, Software, SteadyState,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Linear response of steady motion to weak pulses. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ResponseDocument {
    /// "stickslip/response"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// What was asked for.
    pub(crate) parameters: ResponseParameters,
    /// The motion that the pulses disturb.
    pub(crate) steady_state: SteadyState,
    /// Terms of (A.9) by falling Re λ.
    pub(crate) modes: Vec<ModeDocument>,
    /// Time t0, in Γ/k, that the residues refer to, the center of the last pulse: from `valid_from` on,
    /// l(t) - l0 = Σ residue e^{λ(t-t0)}.
    pub(crate) origin: f64,
    /// Time, in Γ/k, from which on, after the last pulse, the modes left out are estimated to add less than
    /// `valid_to` of the leading mode. While a pulse lasts the sum is off by up to a half of the whole.
    pub(crate) valid_from: f64,
    /// 1e-6, a ratio.
    pub(crate) valid_to: f64,
    /// That no mode right of the last is missing.
    pub(crate) certificate: CertificateDocument,
    /// l at the times asked for.
    pub(crate) samples: ResponseSamples,
    /// What is short or inexact; empty if nothing is.
    pub(crate) remarks: Vec<String>,
}

impl ResponseDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/response";
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ResponseParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub(crate) model: ModelParameters,
    /// Gaussian pulses of external force.
    pub(crate) pulses: Vec<PulseParameters>,
    /// Least number of modes.
    pub(crate) modes: usize,
    /// The samples begin where a run from this position, in σ, would.
    pub(crate) start_position: f64,
    /// Time of the last sample, in Γ/k.
    pub(crate) until: f64,
}

/// residue e^{λ(t-t0)}.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ModeDocument {
    /// λ, in k/Γ.
    pub(crate) lambda: ComplexDocument,
    /// Its residue, in σ.
    pub(crate) residue: ComplexDocument,
}

/// Columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ResponseSamples {
    /// Times, in Γ/k.
    pub(crate) t: Vec<f64>,
    /// l = rt - r - x0, in σ; null where it has grown beyond all numbers.
    pub(crate) l: Vec<Option<f64>>,
    /// l - l0, in σ, with all its digits where that is small.
    pub(crate) deviation: Vec<Option<f64>>,
}
