//! `stickslip/response`.

use crate::documents::table::{Array, Column, Named, Tabular};
use crate::{
    CertificateDocument, ComplexDocument, Document, ModelParameters, PulseParameters, Question,
    SteadyState,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Linear response of steady motion to weak pulses. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseFound {
    /// The motion that the pulses disturb.
    pub steady_state: SteadyState,
    /// Terms of (A.9) by falling Re λ.
    pub modes: Vec<ModeDocument>,
    /// Time t0, in Γ/k, that the residues refer to, the center of the last pulse: from `valid_from` on,
    /// l(t) - l0 = Σ residue e^{λ(t-t0)}.
    pub origin: f64,
    /// Time, in Γ/k, from which on, after the last pulse, the modes left out are estimated to add less than
    /// `valid_to` of the leading mode. While a pulse lasts the sum over modes is off by up to a half of the whole: the
    /// samples of that time are had by the inverse Laplace transform instead, to 1e-9 of their largest.
    pub valid_from: f64,
    /// 1e-6, a ratio.
    pub valid_to: f64,
    /// That no mode right of the last is missing.
    pub certificate: CertificateDocument,
    /// l at the times asked for.
    pub samples: ResponseSamples,
}

/// The document of that.
pub type ResponseDocument = Document<ResponseParameters>;

impl Question for ResponseParameters {
    const FORMAT: &'static str = "stickslip/response";
    type Answer = ResponseFound;
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct ResponseParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// Gaussian pulses of external force.
    pub pulses: Vec<PulseParameters>,
    /// Least number of modes.
    pub modes: usize,
    /// The samples begin where a run from this position, in σ, would.
    pub start_position: f64,
    /// Time of the last sample, in Γ/k.
    pub until: f64,
}

/// residue e^{λ(t-t0)}.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModeDocument {
    /// λ, in k/Γ.
    pub lambda: ComplexDocument,
    /// Its residue, in σ.
    pub residue: ComplexDocument,
}

/// Columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseSamples {
    /// Times, in Γ/k.
    pub t: Vec<f64>,
    /// l = rt - r - x0, in σ; null where it has grown beyond all numbers.
    pub l: Vec<Option<f64>>,
    /// l - l0, in σ, with all its digits where that is small.
    pub deviation: Vec<Option<f64>>,
}

impl Tabular for ResponseFound {
    fn columns(&self) -> Vec<Named<'_>> {
        let ResponseSamples { t, l, deviation } = &self.samples;
        vec![
            ("t", Column::of(t)),
            ("l", Column::optional(l)),
            ("deviation", Column::optional(deviation)),
        ]
    }

    /// The samples, and the modes.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let samples = self.columns().into_iter();
        let samples = samples.filter_map(|(name, column)| Some((name, column.array()?)));
        let of = |name, of: fn(&ModeDocument) -> f64| {
            (name, Array::vector(self.modes.iter().map(of).collect::<Vec<_>>()))
        };
        let modes = [
            of("lambda_re", |m| m.lambda.re),
            of("lambda_im", |m| m.lambda.im),
            of("residue_re", |m| m.residue.re),
            of("residue_im", |m| m.residue.im),
        ];
        samples.chain(modes).collect()
    }
}
