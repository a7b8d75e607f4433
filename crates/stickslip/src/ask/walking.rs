//! The question `walking`: the speeds of a tip without a spring.

use super::exponents::{failed, judge_count, remarks};
use crate::documents::table::{Column, Named, Tabular};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, CertificateDocument, ComplexDocument, Context, Document, Failure, Indentation, Law,
    ModelParameters, Question, Refused, Stability, Tip,
};
use serde::{Deserialize, Serialize};
use stickslip_stability::{self as theory, Walk};
use stickslip_tip::Model;

/// Steady walks x0 = vt of a tip without a spring. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WalkingFound {
    /// The negative α below which a tip at rest begins to walk: 1/(T² f''(0)) with the healing time T; a depth limit b
    /// multiplies it by exp(f(0)/(bT|f''(0)|)). Null if the surface does not heal.
    pub walking_alpha: Option<f64>,
    /// All walks by rising speed; of each walk and its mirror image only one is listed.
    pub walks: Vec<WalkDocument>,
}

/// Walks and the question that they answer.
pub type WalkingDocument = Document<Walking>;

impl Question for Walking {
    const FORMAT: &'static str = "stickslip/walking";
    type Answer = WalkingFound;
}

/// Steady walks of a footprint without a spring, and their growth exponents.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Walking {
    /// Footprint f(x) of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α, of either sign.
    #[serde(flatten)]
    pub indentation: Indentation,
    /// Support velocity, always 0: there is no support.
    #[serde(default)]
    pub r: f64,
    /// Extensions of the basic model; there is no spring.
    #[serde(flatten)]
    pub law: Law,
    /// Least number of growth exponents in the list of each walk.
    #[schemars(extend("x-option" = option("N", "Growth exponents", 40)))]
    #[serde(default = "default_roots")]
    pub roots: usize,
}

fn default_roots() -> usize {
    Stability::DEFAULT_ROOTS
}

impl Walking {
    /// Footprint, law, α and r in the form of documents.
    pub fn model_parameters(&self) -> ModelParameters {
        ModelParameters::of_question(&self.tip, self.indentation, self.r, self.law)
    }

    fn model(&self) -> Result<Model, Refused> {
        if let Some(above) = self.indentation.alpha_above {
            let why = "without a spring there is no onset: give {alpha}";
            return Err(Refused::number("alpha_above", above, why));
        }
        if self.r.abs() > 0.0 {
            let why = "without a spring there is no support that could move: leave it out";
            return Err(Refused::number("r", self.r, why));
        }
        self.law.fading(&self.tip.0)?;
        let law = self.law.into();
        let indentation = self.indentation.resolved(&self.tip.0, law, 0.0)?;
        indentation.model(&self.tip.0, law, 0.0)
    }
}

impl Ask for Walking {
    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        judge_count("roots", self.roots)?;
        if !self.law.no_spring {
            let why = "a tip on a spring does not walk: give {no_spring}";
            return Err(Refused::whole("no_spring", why).into());
        }
        self.model()?;
        Ok(self)
    }

    fn answer(&self, _: &Context) -> Result<(WalkingFound, Vec<String>), Failure> {
        let model = self.model()?;
        let speeds = theory::walking_speeds(&model);
        let speeds = speeds.map_err(|error| failed(&error, "move {alpha} a little"))?;
        let (mut walks, mut said) = (vec![], vec![]);
        for speed in speeds {
            let name = format!("walk of speed {speed:.7}");
            match theory::walk(&model, speed, self.roots) {
                Ok(walk) => {
                    said.extend(remarks(&walk.spectrum, Some(self.roots), &name));
                    walks.push(WalkDocument::from(&walk));
                }
                Err(theory::StabilityError::Stopped) => return Err(Failure::Cancelled),
                Err(error) => said.push(format!("{name}: {error}")),
            }
        }
        let walking_alpha = theory::walking_alpha(model.tip(), model.wider());
        Ok((WalkingFound { walking_alpha, walks }, said))
    }
}

/// A steady walk.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WalkDocument {
    /// v, in kσ/Γ.
    pub speed: f64,
    /// Rate of indentation relative to α: below 1 under a depth limit.
    pub weight: f64,
    /// Whether every deviation decays, except a shift along the scan; null if an error of the roots could change it,
    /// as next to the onset of walking.
    pub stable: Option<bool>,
    /// Growth exponents λ by falling real part, in k/Γ; of each complex pair the one above the real axis comes first.
    /// The 0 of a shift is included.
    pub roots: Vec<ComplexDocument>,
    /// Evidence that no exponent is missing.
    pub certificate: CertificateDocument,
}

impl WalkDocument {
    /// The stability in words.
    pub fn stability(&self) -> &'static str {
        match self.stable {
            Some(true) => "stable",
            Some(false) => "unstable",
            None => "stable or not, within errors",
        }
    }
}

impl From<&Walk> for WalkDocument {
    fn from(walk: &Walk) -> Self {
        let roots = walk.spectrum.roots.iter();
        Self {
            speed: walk.speed,
            weight: walk.weight,
            stable: walk.is_stable(),
            roots: roots.map(|z| ComplexDocument { re: z.re, im: z.im }).collect(),
            certificate: (&walk.spectrum.certificate).into(),
        }
    }
}

impl Tabular for WalkingFound {
    /// The growth exponents of each speed, as a table.
    fn columns(&self) -> Vec<Named<'_>> {
        let column = |of: fn(&WalkDocument, &ComplexDocument) -> f64| -> Column {
            self.walks.iter().flat_map(|walk| walk.roots.iter().map(move |z| of(walk, z))).collect()
        };
        vec![
            ("speed", column(|walk, _| walk.speed)),
            ("re", column(|_, root| root.re)),
            ("im", column(|_, root| root.im)),
        ]
    }
}
