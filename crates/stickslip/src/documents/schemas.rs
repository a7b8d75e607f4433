//! The schemas of all documents, by name.

use crate::{
    BoundaryDocument, CheckpointHead, CompareDocument, ContinueDocument, CycleDocument,
    FigureDocument, FitDocument, MeasuredTipDocument, RasterBoundaryDocument,
    RasterCompareDocument, RasterDocument, RasterStabilityDocument, RasterSurfaceDocument,
    RasterSweepDocument, ReproductionDocument, ResponseDocument, RunDocument, RunLine,
    StabilityDocument, SurfaceDocument, SweepDocument, UnitsDocument, VerifyDocument,
    WalkingDocument,
};
use schemars::{Schema, schema_for};

/// The name of a document, which follows "stickslip/" in its `format`, and its schema.
pub type NamedSchema = (&'static str, fn() -> Schema);

/// Every document that has a schema.
pub const SCHEMAS: [NamedSchema; 24] = [
    ("run", || schema_for!(RunDocument)),
    ("run-lines", || schema_for!(RunLine)),
    ("checkpoint", || schema_for!(CheckpointHead)),
    ("verify", || schema_for!(VerifyDocument)),
    ("surface", || schema_for!(SurfaceDocument)),
    ("stability", || schema_for!(StabilityDocument)),
    ("walking", || schema_for!(WalkingDocument)),
    ("boundary", || schema_for!(BoundaryDocument)),
    ("compare", || schema_for!(CompareDocument)),
    ("response", || schema_for!(ResponseDocument)),
    ("cycle", || schema_for!(CycleDocument)),
    ("continue", || schema_for!(ContinueDocument)),
    ("raster", || schema_for!(RasterDocument)),
    ("raster-compare", || schema_for!(RasterCompareDocument)),
    ("raster-sweep", || schema_for!(RasterSweepDocument)),
    ("raster-surface", || schema_for!(RasterSurfaceDocument)),
    ("raster-stability", || schema_for!(RasterStabilityDocument)),
    ("raster-boundary", || schema_for!(RasterBoundaryDocument)),
    ("sweep", || schema_for!(SweepDocument)),
    ("tip", || schema_for!(MeasuredTipDocument)),
    ("fit", || schema_for!(FitDocument)),
    ("units", || schema_for!(UnitsDocument)),
    ("figure", || schema_for!(FigureDocument)),
    ("reproduction", || schema_for!(ReproductionDocument)),
];

/// The JSON Schema (draft 2020-12) of the document of this name.
pub fn schema(name: &str) -> Option<Schema> {
    SCHEMAS.iter().find(|(other, _)| *other == name).map(|(_, schema)| schema())
}
