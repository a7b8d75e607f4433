//! The question `walking`: the speeds of a tip that no spring drags.

use super::exponents::{failed, judge_count, remarks};
use crate::documents::table::{Column, Named, Tabular};
use crate::{
    Ask, CertificateDocument, ComplexDocument, Context, Document, Failure, ModelParameters,
    Question, Refused,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_stability::{self as theory, Walk};

/// Steady walks of a tip that no spring drags, x0 = vt. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WalkingFound {
    /// 1/(T² f''(0)): below this α, which is negative, a tip at rest begins to walk. Null where the surface does not heal.
    pub walking_alpha: Option<f64>,
    /// All of them by rising speed, each with its mirror image to the other side left out.
    pub walks: Vec<WalkDocument>,
}

/// The document of that.
pub type WalkingDocument = Document<Walking>;

impl Question for Walking {
    const FORMAT: &'static str = "stickslip/walking";
    type Answer = WalkingFound;
}

/// Steady walks of a footprint without a spring, and their growth exponents.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Walking {
    /// Footprint and α; r is 0.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// Least number of growth exponents of each walk.
    pub roots: usize,
}

impl Ask for Walking {
    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        judge_count("roots", self.roots)?;
        if !self.model.law.no_spring {
            let why = "a tip on its spring does not walk: give {no_spring}";
            return Err(Refused::whole("no_spring", why).into());
        }
        Ok(self)
    }

    fn answer(&self, _: &Context) -> Result<(WalkingFound, Vec<String>), Failure> {
        let model = self.model.model().map_err(|error| Failure::Failed(error.to_string()))?;
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
        let healing_time = model.wider().healing_time;
        let walking_alpha = healing_time.map(|time| theory::walking_alpha(model.tip(), time));
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
    /// Whether every deviation decays, but for a shift along the way.
    pub stable: bool,
    /// Growth exponents λ by falling real part, in k/Γ, the one above the real axis first of each pair; the 0 of a shift is
    /// among them.
    pub roots: Vec<ComplexDocument>,
    /// That none is missing.
    pub certificate: CertificateDocument,
}

impl From<&Walk> for WalkDocument {
    fn from(walk: &Walk) -> Self {
        let roots = walk.spectrum.roots.iter();
        Self {
            speed: walk.speed,
            weight: walk.weight,
            stable: walk.unstable_count() == 0,
            roots: roots.map(|z| ComplexDocument { re: z.re, im: z.im }).collect(),
            certificate: (&walk.spectrum.certificate).into(),
        }
    }
}

impl Tabular for WalkingFound {
    /// The growth exponents of each speed.
    fn columns(&self) -> Vec<Named<'_>> {
        let column = |of: fn(&WalkDocument, &ComplexDocument) -> f64| {
            let rows =
                self.walks.iter().flat_map(|walk| walk.roots.iter().map(move |z| of(walk, z)));
            Column::from(rows.collect::<Vec<f64>>())
        };
        vec![
            ("speed", column(|walk, _| walk.speed)),
            ("re", column(|_, root| root.re)),
            ("im", column(|_, root| root.im)),
        ]
    }
}
