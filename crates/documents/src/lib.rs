//! What stickslip writes and reads: the JSON documents, field by field, their schemas, and their way from and to
//! the types of the library. Knows no files and no arguments.
//!
//! A document says all that defines it: what a run did is its [`RunDocument`], and [`RunParameters::scenario`] with
//! [`History::trajectory`] is the run again.
//!
//! ```
//! use stickslip_documents::{RunDocument, RunParameters, read};
//! use stickslip_tip::{Model, Scenario, TipFunction};
//!
//! let model = Model::new(TipFunction::gaussian(1.0)?, 1.2, 1.0)?; // α = 1.2, r = 1
//! let parameters = RunParameters::of(&Scenario::new(model, 50.0), None, &[], None);
//! assert!(parameters.scenario()?.until > 49.0);
//! // What is not a whole document of the format asked for is refused with a reason.
//! let refused = read::<RunDocument>("{}", RunDocument::FORMAT).unwrap_err();
//! assert!(refused.to_string().contains("format is missing"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![allow(
    rustdoc::broken_intra_doc_links,
    reason = "t[i] is an entry, also in the descriptions of the schemas"
)]

mod ask;
mod boundary;
mod checkpoint;
mod compare;
mod context;
mod continuation;
mod cycle;
mod failure;
mod figure;
mod fit;
mod history;
mod in_units;
mod measured_tip;
mod model;
mod outcome;
mod physical;
mod question;
mod raster;
mod raster_stability;
mod read;
mod reproduction;
mod response;
mod run;
mod run_lines;
mod scenario;
mod schemas;
mod software;
mod stability;
mod surface;
mod sweep;
mod table;
mod units;
mod verification;
mod walking;
mod work;

pub use ask::{Ask, Document};
pub use boundary::{
    Boundary, BoundaryDocument, BoundaryFound, BranchDocument, LimitColumns, OnsetColumns,
    SpacingName,
};
pub use checkpoint::{CheckpointHead, Mark, Order, RunFormat, Times};
pub use compare::{
    ClosedDocument, ClosedWork, CompareDocument, CompareParameters, DifferenceDocument,
    GridDocument, GridName, GridWork,
};
pub use context::Context;
pub use continuation::{
    ContinueDocument, ContinueParameters, CycleBranch, EndName, OverName, SpecialDocument,
    SpecialName,
};
pub use cycle::{Cycle, CycleDocument, CycleFound, CycleProfile, CycleWork};
pub use failure::{Failure, Refused, Typed};

pub use figure::{
    ArrowName, CellsDocument, ColourName, ColoursName, CurveDocument, FigureDocument,
    FigureParameters, MapDocument, NoteDocument, PanelDocument, ScaleName, StyleName,
};
pub use fit::{
    AlternativeDocument, DataFitted, FitDocument, FitParameters, NumberFitted, NumberHeld,
};
pub use history::{FARTHEST, History};
pub use in_units::{Dimension, InUnits, KnownScales, dimension};
pub use measured_tip::{
    AcrossDocument, CandidateDocument, EstimateDocument, FittedDocument, MeasuredTipDocument,
    MeasuredTipParameters,
};
pub use model::{
    GaussianDocument, Law, LayerDocument, ModelParameters, TipDocument, judge_details,
};
pub use outcome::{
    CreepDocument, DriftDocument, OscillationDocument, RegimeName, TransientDocument, to_its_digits,
};
pub use physical::{InUnit, Physical, arrays as arrays_in_units, columns as columns_in_units};
pub use question::{Indentation, NamedTip, Tip, TipName};
pub use raster::{
    AreaDocument, ComparedLine, HeightMap, KeptLine, LineHistory, LineRegimeName, PathName,
    PatternDocument, RasterCompareDocument, RasterCompareParameters, RasterCompared,
    RasterComparedWork, RasterDocument, RasterHistory, RasterLine, RasterParameters,
    RasterRegimeName, RasterSamples, RasterSurfaceDocument, RasterSweepDocument,
    RasterSweepParameters, RasterSweepPoint, RasterWork,
};
pub use raster_stability::{
    RasterBoundaryDocument, RasterBoundaryParameters, RasterCertificateDocument,
    RasterCriticalDocument, RasterGrowth, RasterStabilityDocument, RasterStabilityParameters,
};
pub use read::{Kind, Unusable, kind_of, read, read_from, told};
pub use reproduction::{NumberDocument, ReproductionDocument, ReproductionParameters};
pub use response::{ModeDocument, ResponseDocument, ResponseParameters, ResponseSamples};
pub use run::{LoopDocument, RunDocument, Samples};
pub use run_lines::{RunEnd, RunHead, RunLine, SampleLine};
pub use scenario::{
    ForceTable, MemoryName, NoiseParameters, Profile, PulseParameters, RunParameters, StartName,
    SupportPathParameters,
};
pub use schemas::{NamedSchema, SCHEMAS, schema};
pub use software::{FORMAT_VERSION, Software};
pub use stability::{
    CertificateDocument, ComplexDocument, CriticalDocument, CriticalityName, LimitsDocument,
    OnsetDocument, OnsetKindName, SolveFor, StabilityDocument, StabilityParameters,
    TrappingDocument,
};
pub use surface::{
    AcrossParameters, SurfaceCurve, SurfaceDocument, SurfaceImage, SurfaceParameters,
};
pub use sweep::{
    AxisDocument, AxisName, EnsembleDocument, RegimeCounts, ShardDocument, SourceName,
    StatisticsDocument, SweepDocument, SweepParameters, SweepPoint, SweepRunParameters,
    SweepStartName,
};
pub use table::{Array, Column, Named, Tabular};
pub use units::{
    CriticalUnits, LagDocument, PhysicalDocument, ScalesDocument, UnitsDocument, UnitsParameters,
};
pub use verification::{
    ClaimDocument, EndingName, LargestDifferenceDocument, LinesDocument, VerificationDocument,
    VerifyDocument,
};
pub use walking::{WalkDocument, WalkingDocument, WalkingParameters};
pub use work::{SteadyState, WorkDocument};
