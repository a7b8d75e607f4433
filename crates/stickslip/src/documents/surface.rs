//! `stickslip/surface`.

use crate::documents::table::{Array, Column, Named, Tabular, joined};
use crate::schema::JsonSchema;
use crate::{Document, ModelParameters, Question};
use serde::{Deserialize, Serialize};

/// Surfaces reconstructed from a run. Lengths in σ, times in Γ/k, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceFound {
    /// One curve per time; empty if images were requested.
    pub surfaces: Vec<SurfaceCurve>,
    /// One image per time, in three dimensions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub images: Vec<SurfaceImage>,
}

/// A surface and the question that it answers.
pub type SurfaceDocument = Document<SurfaceParameters>;

impl Question for SurfaceParameters {
    const FORMAT: &'static str = "stickslip/surface";
    type Answer = SurfaceFound;
}

/// The parameters of a reconstructed surface.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct SurfaceParameters {
    /// Footprint, α and r of the run.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// Whether the initial surface was omitted, (35).
    pub far_behind: bool,
    /// Parameters of images.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub across: Option<AcrossParameters>,
}

/// Parameters of images besides those of the run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AcrossParameters {
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ; null if the tip has its own f(x,y).
    pub width_y: Option<f64>,
    /// k'/k above which y0 = 0 is certainly stable in steady motion, where k' is the transverse spring constant (52);
    /// null if no k' is known to be sufficient.
    pub transverse_stiffness_needed: Option<f64>,
}

/// u(x,y,t) at one t.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceImage {
    /// Time, in Γ/k.
    pub t: f64,
    /// Positions along the scan, in σ.
    pub x: Vec<f64>,
    /// Positions across the scan, in σ.
    pub y: Vec<f64>,
    /// Heights, in kσ²/a: a row for each y.
    pub u: Vec<Vec<f64>>,
}

/// u(x,t) at one t.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceCurve {
    /// Time, in Γ/k.
    pub t: f64,
    /// Positions, in σ.
    pub x: Vec<f64>,
    /// Heights at the positions `x`, in kσ²/a.
    pub u: Vec<f64>,
}

impl Tabular for SurfaceFound {
    /// A row for each position, one time after the other.
    fn columns(&self) -> Vec<Named<'_>> {
        let Self { surfaces, images, .. } = self;
        let Some(first) = images.first() else {
            let joined = |of: fn(&SurfaceCurve) -> &Vec<f64>| -> Column {
                surfaces.iter().map(of).collect()
            };
            let t = surfaces.iter().flat_map(|s| s.x.iter().map(|_| s.t)).collect();
            return vec![("t", t), ("x", joined(|s| &s.x)), ("u", joined(|s| &s.u))];
        };
        let (columns, rows) = (first.x.len(), first.y.len());
        let t: Vec<f64> = images.iter().map(|image| image.t).collect();
        vec![
            ("t", Column::Repeated { values: t.into(), each: columns * rows }),
            ("x", Column::Repeated { values: (&first.x).into(), each: 1 }),
            ("y", Column::Repeated { values: (&first.y).into(), each: columns }),
            ("u", heights(images).into()),
        ]
    }

    /// `u` has an axis for t, one for y in an image, and one for x.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let Self { surfaces, images, .. } = self;
        if let Some(first) = images.first() {
            let t: Vec<f64> = images.iter().map(|image| image.t).collect();
            let shape = vec![images.len(), first.y.len(), first.x.len()];
            return vec![
                ("t", Array::vector(t)),
                ("x", Array::vector(&first.x)),
                ("y", Array::vector(&first.y)),
                ("u", Array { shape, values: heights(images).into() }),
            ];
        }
        let x = surfaces.first().map(|surface| surface.x.as_slice()).unwrap_or_default();
        let t: Vec<f64> = surfaces.iter().map(|surface| surface.t).collect();
        let u: Vec<Vec<f64>> = surfaces.iter().map(|surface| surface.u.clone()).collect();
        vec![("t", Array::vector(t)), ("x", Array::vector(x)), ("u", Array::matrix(&u))]
    }
}

fn heights(images: &[SurfaceImage]) -> Vec<f64> {
    joined(images.iter().flat_map(|image| &image.u))
}
