//! The schemas of all documents, and the tables of parameters: files, made from the types by `make reference`.

#[cfg(feature = "schema")]
use crate::parameter::declared::declared;
use crate::parameter::{Declared, Kind, Parameter, Parameters};
use crate::{
    Boundary, BoundaryDocument, CheckpointHead, CompareDocument, CompareParameters, Continue,
    ContinueDocument, Cycle, CycleDocument, FigureDocument, Fit, FitDocument, FitImage,
    FitImageDocument, Friction, FrictionDocument, GridName, LoadMap, LoadMapDocument, MeasuredTip,
    MeasuredTipDocument, Raster, RasterBoundary, RasterBoundaryDocument, RasterCompareDocument,
    RasterCompareParameters, RasterDocument, RasterStability, RasterStabilityDocument,
    RasterSurfaceDocument, RasterSweep, RasterSweepDocument, ReproductionDocument,
    ReproductionParameters, Response, ResponseDocument, Run, RunDocument, RunFormat, RunLine,
    SnakingBoundary, SnakingBoundaryDocument, Stability, StabilityDocument, SurfaceDocument,
    SurfaceParameters, Sweep, SweepDocument, SweepParameters, TipName, Units, UnitsDocument,
    VerifyDocument, Walker, WalkerDocument, Walking, WalkingDocument,
};
#[cfg(feature = "schema")]
use schemars::{Schema, schema_for};

macro_rules! documents {
    ($($name:literal: $schema:expr),+ $(,)?) => {
        /// The JSON Schemas (draft 2020-12) of all documents, by the name that follows "stickslip/" in their `format`.
        pub const SCHEMAS: &[(&str, &str)] = &[
            $(($name, include_str!(concat!("../../schemas/documents/", $name, ".json")))),+
        ];

        #[cfg(feature = "schema")]
        const DOCUMENTS: &[Derived] = &[$(($name, || $schema)),+];
    };
}

documents! {
    "run": schema_for!(RunDocument),
    "run-lines": schema_for!(RunLine),
    "checkpoint": schema_for!(CheckpointHead),
    "verify": schema_for!(VerifyDocument),
    "surface": SurfaceDocument::schema(),
    "stability": StabilityDocument::schema(),
    "walking": WalkingDocument::schema(),
    "walker": WalkerDocument::schema(),
    "boundary": BoundaryDocument::schema(),
    "compare": CompareDocument::schema(),
    "response": ResponseDocument::schema(),
    "cycle": CycleDocument::schema(),
    "continue": ContinueDocument::schema(),
    "raster": schema_for!(RasterDocument),
    "raster-compare": RasterCompareDocument::schema(),
    "raster-sweep": RasterSweepDocument::schema(),
    "raster-surface": schema_for!(RasterSurfaceDocument),
    "raster-stability": RasterStabilityDocument::schema(),
    "raster-boundary": RasterBoundaryDocument::schema(),
    "load-map": LoadMapDocument::schema(),
    "snaking-boundary": SnakingBoundaryDocument::schema(),
    "sweep": SweepDocument::schema(),
    "tip": MeasuredTipDocument::schema(),
    "fit": FitDocument::schema(),
    "fit-image": FitImageDocument::schema(),
    "friction": FrictionDocument::schema(),
    "units": schema_for!(UnitsDocument),
    "figure": schema_for!(FigureDocument),
    "reproduction": ReproductionDocument::schema(),
}

macro_rules! parameters {
    ($($question:ident),+ $(,)?) => {
        $(impl Parameters for $question {
            const DECLARED: Declared =
                include!(concat!("../../schemas/parameters/", stringify!($question), ".rs"));
        })+

        #[cfg(feature = "schema")]
        const QUESTIONS: &[Derived] = &[$((stringify!($question), || schema_for!($question))),+];
    };
}

parameters! {
    Boundary, CompareParameters, Continue, Cycle, Fit, FitImage, Friction, GridName, LoadMap,
    MeasuredTip, Raster, RasterBoundary, RasterCompareParameters, RasterStability, RasterSweep,
    ReproductionParameters, Response, Run, RunFormat, SnakingBoundary, Stability,
    SurfaceParameters, Sweep, SweepParameters, TipName, Units, Walker, Walking,
}

/// The JSON Schema of the document with this name, as text.
pub fn schema(name: &str) -> Option<&'static str> {
    SCHEMAS.iter().find(|(other, _)| *other == name).map(|(_, text)| *text)
}

/// A name, and the schema that schemars derives for it.
#[cfg(feature = "schema")]
type Derived = (&'static str, fn() -> Schema);

/// The contents of all files in the folder `schemas` of this crate, as the types are now, each with its name.
#[cfg(feature = "schema")]
pub fn derived() -> Vec<(String, String)> {
    let document = |(name, schema): &Derived| (format!("documents/{name}.json"), pretty(&schema()));
    let question =
        |(name, schema): &Derived| (format!("parameters/{name}.rs"), declared(schema().as_value()));
    DOCUMENTS.iter().map(document).chain(QUESTIONS.iter().map(question)).collect()
}

#[cfg(feature = "schema")]
fn pretty(schema: &Schema) -> String {
    format!("{}\n", serde_json::to_string_pretty(schema).unwrap_or_default())
}
