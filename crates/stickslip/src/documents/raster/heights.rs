//! `stickslip/raster-surface`.

use crate::documents::table::{Array, Column, Named, Tabular};
use crate::parameter::strictly;
use crate::schema::JsonSchema;
use crate::{
    FORMAT_VERSION, HeightMap, InUnits, Physical, Raster, RasterDocument, Software, Unusable,
};
use serde::{Deserialize, Serialize};

/// Surfaces of a raster. Lengths in σ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterSurfaceDocument {
    /// "stickslip/raster-surface"
    pub format: String,
    /// Version of the format; 1.
    pub format_version: u32,
    /// The program that wrote the document.
    pub software: Software,
    /// The parameters of the raster.
    #[serde(deserialize_with = "strictly")]
    pub parameters: Raster,
    /// One surface, after the last line.
    pub surfaces: Vec<HeightMap>,
    /// The numbers in nm, s and nN, if requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

impl RasterSurfaceDocument {
    /// The value of the field `format`.
    pub const FORMAT: &'static str = "stickslip/raster-surface";

    /// The heights of a raster at every y and every x.
    ///
    /// # Errors
    /// The raster is damaged.
    pub fn of(raster: &RasterDocument, x: Vec<f64>, y: Vec<f64>) -> Result<Self, Unusable> {
        Ok(Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            physical: None,
            parameters: raster.parameters.clone(),
            surfaces: vec![raster.heights(x, y)?],
        })
    }
}

impl Physical for RasterSurfaceDocument {
    fn physical_mut(&mut self) -> &mut Option<InUnits> {
        &mut self.physical
    }
}

impl Tabular for RasterSurfaceDocument {
    /// A row for each position.
    fn columns(&self) -> Vec<Named<'_>> {
        let Some(HeightMap { x, y, u }) = self.surfaces.first() else { return vec![] };
        vec![
            ("x", Column::Repeated { values: x.into(), each: 1 }),
            ("y", Column::Repeated { values: y.into(), each: x.len() }),
            ("u", u.concat().into()),
        ]
    }

    /// `u` has a row for each y.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let Some(HeightMap { x, y, u }) = self.surfaces.first() else { return vec![] };
        vec![("x", Array::vector(x)), ("y", Array::vector(y)), ("u", Array::matrix(u))]
    }

    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }
}
