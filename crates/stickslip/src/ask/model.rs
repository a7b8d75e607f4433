//! The model in a document.

use crate::parameter::{NOTHING_DRAGS, option};
use crate::schema::JsonSchema;
use crate::{Refused, Unusable};
use serde::{Deserialize, Serialize};
use stickslip_tip::{
    Across, Footprint, Gaussian, Layer, Model, TipFunction, TipFunctionError, Wider,
};

/// The footprint f(x), x in units of σ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "name", rename_all = "kebab-case", deny_unknown_fields)]
pub enum TipDocument {
    /// A sum of a exp(-(x-c)²/(2w²)): the triple Gaussian (48), a Gaussian, or a tip from a file.
    Gaussians {
        /// The terms of the sum.
        gaussians: Vec<Gaussian>,
    },
    /// J0(x).
    Bessel {},
    /// cos x.
    Cosine {},
    /// f(x,0) of a footprint f(x,y) in three dimensions, a sum of layers g(x)h(y).
    Footprint {
        /// The terms of the sum.
        layers: Vec<LayerDocument>,
    },
}

/// A layer g(x)h(y), where g is a sum of Gaussians and h(y) = exp(-(y-d)²/(2v²)) + exp(-(y+d)²/(2v²)), or
/// exp(-y²/(2v²)) for d = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LayerDocument {
    /// d, in σ
    pub center_y: f64,
    /// v, in σ
    pub width_y: f64,
    /// g, a sum of Gaussians.
    pub gaussians: Vec<Gaussian>,
}

impl From<&TipFunction> for TipDocument {
    fn from(tip: &TipFunction) -> Self {
        match (tip.footprint(), tip) {
            (Some(footprint), _) => {
                Self::Footprint { layers: footprint.layers().iter().map(layer_document).collect() }
            }
            (None, TipFunction::Bessel) => Self::Bessel {},
            (None, TipFunction::Cosine) => Self::Cosine {},
            (None, tip) => Self::Gaussians { gaussians: gaussian_documents(tip) },
        }
    }
}

fn gaussian_documents(tip: &TipFunction) -> Vec<Gaussian> {
    match tip {
        TipFunction::Gaussians(sum) => sum.terms().to_vec(),
        TipFunction::Bessel | TipFunction::Cosine => vec![],
    }
}

fn layer_document(layer: &Layer) -> LayerDocument {
    LayerDocument {
        center_y: layer.across.center,
        width_y: layer.across.width,
        gaussians: gaussian_documents(&layer.along),
    }
}

impl TipDocument {
    /// The tip function of this document.
    ///
    /// # Errors
    /// The document defines no valid tip: for instance a width is 0, or f varies too fast for any lattice.
    pub fn tip(&self) -> Result<TipFunction, Unusable> {
        let tip = self.as_described().map_err(Unusable::new)?;
        judge_details(&tip)?;
        Ok(tip)
    }

    fn as_described(&self) -> Result<TipFunction, TipFunctionError> {
        match self {
            Self::Bessel {} => Ok(TipFunction::Bessel),
            Self::Cosine {} => Ok(TipFunction::Cosine),
            Self::Gaussians { gaussians } => sum_of(gaussians),
            Self::Footprint { layers } => {
                let layer = |layer: &LayerDocument| -> Result<Layer, TipFunctionError> {
                    let across = Across { center: layer.center_y, width: layer.width_y };
                    Ok(Layer { along: sum_of(&layer.gaussians)?, across })
                };
                let layers = layers.iter().map(layer).collect::<Result<_, _>>()?;
                Footprint::from_layers(layers).map(TipFunction::of_footprint)
            }
        }
    }
}

/// Largest number of half-waves at the bandwidth of f within its reach. A Gaussian has about 80; a table of 2,000 rows
/// has 15,000. The lattice of the groove has twice as many cells.
const MOST_DETAILS: f64 = 1e5;

/// Rejects a tip function with too much detail over its reach: the lattice of the groove would not fit in memory.
///
/// # Errors
/// The tip has more than 1e5 half-waves at its bandwidth within its reach.
pub fn judge_details(tip: &TipFunction) -> Result<(), Unusable> {
    let details = tip.reach().map_or(0.0, |reach| reach * tip.band());
    if details <= MOST_DETAILS {
        return Ok(());
    }
    Err(Unusable::new(
        "its widest terms reach too far compared with the width of its narrowest: more than fit in memory; leave out \
         one or the other",
    ))
}

fn sum_of(gaussians: &[Gaussian]) -> Result<TipFunction, TipFunctionError> {
    TipFunction::asymmetric_sum(gaussians.to_vec())
}

/// Extensions of the basic model. Without any, a question is about the basic model.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Law {
    /// Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).
    #[schemars(extend("x-option" = option("B", "Extended model", 10)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_limit: Option<f64>,
    /// Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.
    #[schemars(extend("x-option" = option("T", "Extended model", 11)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub healing_time: Option<f64>,
    /// Inertia M of the tip, in Γ²/k; above 0.
    #[schemars(extend("x-option" = option("M", "Extended model", 12)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<f64>,
    /// No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the
    /// initial surface is flat.
    #[schemars(extend("x-option" = option("", "Extended model", 13)))]
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub no_spring: bool,
}

impl From<Wider> for Law {
    fn from(Wider { depth_limit, healing_time, inertia, spring }: Wider) -> Self {
        Self { depth_limit, healing_time, inertia, no_spring: !spring }
    }
}

impl From<Law> for Wider {
    fn from(Law { depth_limit, healing_time, inertia, no_spring }: Law) -> Self {
        Self { depth_limit, healing_time, inertia, spring: !no_spring }
    }
}

impl Law {
    /// Rejects models without steady motion behind a support: no spring, or a footprint without decay on a surface
    /// that does not heal.
    pub(crate) fn dragged(self, tip: &TipFunction) -> Result<Wider, Refused> {
        if self.no_spring {
            return Err(Refused::whole("no_spring", NOTHING_DRAGS));
        }
        self.fading(tip)?;
        Ok(self.into())
    }

    /// Rejects a footprint without decay on a surface that does not heal.
    pub(crate) fn fading(self, tip: &TipFunction) -> Result<(), Refused> {
        if *tip == TipFunction::Cosine && self.healing_time.is_none() {
            let why = "never decays, so that the groove integral of steady motion diverges: give {healing_time}";
            return Err(Refused::word("tip", "cosine", why));
        }
        Ok(())
    }
}

/// Footprint, α, r and extensions of the basic model.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct ModelParameters {
    /// Footprint f.
    pub tip: TipDocument,
    /// Dimensionless indentation rate α (13).
    pub alpha: f64,
    /// D, if α was given as αc(r) + D; dimensionless.
    pub alpha_above: Option<f64>,
    /// Dimensionless support velocity r (12); 0 without a spring.
    pub r: f64,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
}

impl ModelParameters {
    /// The parameters of the basic model.
    pub fn papers(tip: TipDocument, alpha: f64, alpha_above: Option<f64>, r: f64) -> Self {
        Self { tip, alpha, alpha_above, r, law: Law::default() }
    }

    /// The parameters of a model, with D if its α was given as αc(r) + D.
    pub fn of(model: &Model, alpha_above: Option<f64>) -> Self {
        let (tip, law) = (model.tip().into(), (*model.wider()).into());
        Self { tip, alpha: model.alpha(), alpha_above, r: model.r(), law }
    }

    /// The model of these parameters.
    ///
    /// # Errors
    /// The tip, α or r is invalid.
    pub fn model(&self) -> Result<Model, Unusable> {
        let tip = self.tip.tip()?;
        Model::under(self.wider(), tip, self.alpha, self.r).map_err(Unusable::new)
    }

    /// The extensions of the basic model.
    pub fn wider(&self) -> Wider {
        self.law.into()
    }
}
