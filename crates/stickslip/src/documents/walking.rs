//! `stickslip/walking`.

use crate::documents::table::{Column, Named, Tabular};
use crate::{CertificateDocument, ComplexDocument, Document, ModelParameters, Question};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_stability::Walk;

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
pub type WalkingDocument = Document<WalkingParameters>;

impl Question for WalkingParameters {
    const FORMAT: &'static str = "stickslip/walking";
    type Answer = WalkingFound;
}

/// The tip, and what was asked.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct WalkingParameters {
    /// Footprint and α; r is 0.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// Number of growth exponents asked for, of each walk.
    pub roots: usize,
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
