//! The schemas of all documents, by name.

use crate::{
    BoundaryDocument, CheckpointHead, CompareDocument, ContinueDocument, CycleDocument,
    FigureDocument, FitDocument, FitImageDocument, FrictionDocument, LoadMapDocument,
    MeasuredTipDocument, RasterBoundaryDocument, RasterCompareDocument, RasterDocument,
    RasterStabilityDocument, RasterSurfaceDocument, RasterSweepDocument, ReproductionDocument,
    ResponseDocument, RunDocument, RunLine, SnakingBoundaryDocument, StabilityDocument,
    SurfaceDocument, SweepDocument, UnitsDocument, VerifyDocument, WalkerDocument, WalkingDocument,
};

use schemars::{Schema, schema_for};

/// The name of a document, which follows "stickslip/" in its `format`, and its schema.
pub type NamedSchema = (&'static str, fn() -> Schema);

/// All documents with a schema.
pub const SCHEMAS: [NamedSchema; 29] = [
    ("run", || schema_for!(RunDocument)),
    ("run-lines", || schema_for!(RunLine)),
    ("checkpoint", || schema_for!(CheckpointHead)),
    ("verify", || schema_for!(VerifyDocument)),
    ("surface", SurfaceDocument::schema),
    ("stability", StabilityDocument::schema),
    ("walking", WalkingDocument::schema),
    ("walker", WalkerDocument::schema),
    ("boundary", BoundaryDocument::schema),
    ("compare", CompareDocument::schema),
    ("response", ResponseDocument::schema),
    ("cycle", CycleDocument::schema),
    ("continue", ContinueDocument::schema),
    ("raster", || schema_for!(RasterDocument)),
    ("raster-compare", RasterCompareDocument::schema),
    ("raster-sweep", RasterSweepDocument::schema),
    ("raster-surface", || schema_for!(RasterSurfaceDocument)),
    ("raster-stability", RasterStabilityDocument::schema),
    ("raster-boundary", RasterBoundaryDocument::schema),
    ("load-map", LoadMapDocument::schema),
    ("snaking-boundary", SnakingBoundaryDocument::schema),
    ("sweep", SweepDocument::schema),
    ("tip", MeasuredTipDocument::schema),
    ("fit", FitDocument::schema),
    ("fit-image", FitImageDocument::schema),
    ("friction", FrictionDocument::schema),
    ("units", || schema_for!(UnitsDocument)),
    ("figure", || schema_for!(FigureDocument)),
    ("reproduction", ReproductionDocument::schema),
];

/// The JSON Schema (draft 2020-12) of the document with this name.
pub fn schema(name: &str) -> Option<Schema> {
    SCHEMAS.iter().find(|(other, _)| *other == name).map(|(_, schema)| schema())
}
