//! The JSON documents, field by field. `stickslip schema NAME` prints their schemas.

mod boundary;
mod checkpoint;
mod compare;
mod continuation;
mod cycle;
mod figure;
mod model;
mod reproduction;
mod response;
mod run;
mod run_lines;
mod stability;
mod surface;
mod sweep;
mod units;
mod verification;

pub(crate) use boundary::{
    BoundaryDocument, BoundaryParameters, BranchDocument, OnsetColumns, SpacingName,
};
pub(crate) use checkpoint::{CheckpointHead, Order, Times};
pub(crate) use compare::{
    ClosedDocument, ClosedWork, CompareDocument, CompareParameters, DifferenceDocument,
    GridDocument, GridWork,
};
pub(crate) use continuation::{
    ContinueDocument, ContinueParameters, CycleBranch, EndName, SpecialDocument, SpecialName,
};
pub(crate) use cycle::{CycleDocument, CycleParameters, CycleProfile, CycleWork};
pub(crate) use figure::{
    ColoursName, CurveDocument, FigureDocument, FigureParameters, MapDocument, PanelDocument,
    StyleName,
};
pub(crate) use model::{ModelParameters, TipDocument};
pub(crate) use reproduction::{NumberDocument, ReproductionDocument, ReproductionParameters};
pub(crate) use response::{ModeDocument, ResponseDocument, ResponseParameters, ResponseSamples};
pub(crate) use run::{
    ForceTable, History, NoiseParameters, OscillationDocument, Profile, PulseParameters,
    RegimeName, RunDocument, RunParameters, Samples, SteadyState, WorkDocument,
};
pub(crate) use run_lines::{RunEnd, RunHead, RunLine, SampleLine};
pub(crate) use stability::{
    CertificateDocument, ComplexDocument, CriticalityName, OnsetDocument, StabilityDocument,
    StabilityParameters, TrappingDocument,
};
pub(crate) use surface::{
    AcrossParameters, SurfaceCurve, SurfaceDocument, SurfaceImage, SurfaceParameters,
};
pub(crate) use sweep::{ShardDocument, SourceName, SweepDocument, SweepParameters, SweepPoint};
pub(crate) use units::{
    CriticalUnits, LagDocument, PhysicalDocument, ScalesDocument, UnitsDocument, UnitsParameters,
};

pub(crate) use verification::{
    EndingName, LargestDifferenceDocument, LinesDocument, VerificationDocument, VerifyDocument,
};

use clap::ValueEnum;
use schemars::{JsonSchema, Schema, schema_for};
use serde::{Deserialize, Serialize};

/// Version of all documents; it changes when a reader of the old ones would misread the new.
pub(crate) const FORMAT_VERSION: u32 = 1;

/// The program that wrote a document.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Software {
    /// "stickslip"
    pub(crate) name: String,
    /// Of the program, as `stickslip --version` says.
    pub(crate) version: String,
}

impl Software {
    pub(crate) fn this() -> Self {
        Self { name: "stickslip".into(), version: env!("CARGO_PKG_VERSION").into() }
    }
}

/// Documents that have a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SchemaName {
    Run,
    RunLines,
    Checkpoint,
    Verify,
    Surface,
    Stability,
    Boundary,
    Compare,
    Response,
    Cycle,
    Continue,
    Sweep,
    Units,
    Figure,
    Reproduction,
}

impl SchemaName {
    pub(crate) fn schema(self) -> Schema {
        match self {
            Self::Run => schema_for!(RunDocument),
            Self::RunLines => schema_for!(RunLine),
            Self::Checkpoint => schema_for!(CheckpointHead),
            Self::Verify => schema_for!(VerifyDocument),
            Self::Surface => schema_for!(SurfaceDocument),
            Self::Stability => schema_for!(StabilityDocument),
            Self::Boundary => schema_for!(BoundaryDocument),
            Self::Compare => schema_for!(CompareDocument),
            Self::Response => schema_for!(ResponseDocument),
            Self::Cycle => schema_for!(CycleDocument),
            Self::Continue => schema_for!(ContinueDocument),
            Self::Sweep => schema_for!(SweepDocument),
            Self::Units => schema_for!(UnitsDocument),
            Self::Figure => schema_for!(FigureDocument),
            Self::Reproduction => schema_for!(ReproductionDocument),
        }
    }
}
