//! The model in a document.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_tip::{Gaussian, Model, TipFunction};

/// The footprint f(x), x in units of σ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "name", rename_all = "kebab-case", deny_unknown_fields)]
pub(crate) enum TipDocument {
    /// A sum of a exp(-(x-c)²/(2w²)): the triple Gaussian (48), a Gaussian, a tip from a file.
    Gaussians {
        /// Its terms.
        gaussians: Vec<GaussianDocument>,
    },
    /// J0(x).
    Bessel {},
}

/// a exp(-(x-c)²/(2w²)).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GaussianDocument {
    /// a
    pub(crate) amplitude: f64,
    /// c, in σ
    pub(crate) center: f64,
    /// w, in σ
    pub(crate) width: f64,
}

impl From<&GaussianDocument> for Gaussian {
    fn from(g: &GaussianDocument) -> Self {
        Self { amplitude: g.amplitude, center: g.center, width: g.width }
    }
}

impl From<&TipFunction> for TipDocument {
    fn from(tip: &TipFunction) -> Self {
        match tip {
            TipFunction::Bessel => Self::Bessel {},
            TipFunction::Gaussians(sum) => {
                let term = |g: &Gaussian| GaussianDocument {
                    amplitude: g.amplitude,
                    center: g.center,
                    width: g.width,
                };
                Self::Gaussians { gaussians: sum.terms().iter().map(term).collect() }
            }
        }
    }
}

/// Footprint, α and r.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ModelParameters {
    /// Footprint f.
    pub(crate) tip: TipDocument,
    /// Dimensionless indentation rate α (13).
    pub(crate) alpha: f64,
    /// D, where α was given as αc(r) + D.
    pub(crate) alpha_above: Option<f64>,
    /// Dimensionless support velocity r (12).
    pub(crate) r: f64,
}

impl ModelParameters {
    pub(crate) fn of(model: &Model, alpha_above: Option<f64>) -> Self {
        Self { tip: model.tip().into(), alpha: model.alpha(), alpha_above, r: model.r() }
    }

    /// The model again.
    pub(crate) fn model(&self) -> Result<Model, String> {
        let tip = match &self.tip {
            TipDocument::Bessel {} => TipFunction::Bessel,
            TipDocument::Gaussians { gaussians } => {
                TipFunction::gaussian_sum(gaussians.iter().map(Gaussian::from).collect())
                    .map_err(|error| error.to_string())?
            }
        };
        Model::new(tip, self.alpha, self.r).map_err(|error| error.to_string())
    }
}
