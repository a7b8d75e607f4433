//! Stick-slip of an AFM tip on a soft surface: one closed delay equation instead of a PDE.
//!
//! Depend on this crate to use stickslip from your own program. It has two parts.
//!
//! - The subjects, each a crate of its own: [`tip`], the closed equation with its memories and its integrator;
//!   [`outcome`], the regime of a run; [`surface`], u(x,t) afterwards; [`stability`] and [`cycles`]; [`raster`];
//!   [`measurement`]; [`units`]; [`verify`]; [`convolution`], sums of a kernel.
//! - Questions and documents. A question, such as [`Cycle`], is data; [`Ask::ask`] answers it with a [`Document`]. The
//!   other documents are the JSON files that the program writes and reads, with their schemas.
//!
//! This crate opens no files and reads no command line. All numbers are dimensionless (lengths in tip widths σ, times
//! in Γ/k) unless their description gives another unit.
//!
//! ```
//! use stickslip::tip::TipFunction;
//! use stickslip::{Ask, Context, Indentation, Run, RunDocument, Tip, read};
//!
//! let tip = Tip(TipFunction::gaussian(1.0)?);
//! let run = Run::new(tip, Indentation::given(1.2), 1.0, 50.0).ask(&Context::default())?; // α = 1.2, r = 1, to t = 50
//! assert_eq!(run.regime.to_string(), "steady"); // below αc = 1.879
//! // A text that is no complete document of the requested format is refused with a reason.
//! let refused = read::<RunDocument>("{}", RunDocument::FORMAT).unwrap_err();
//! assert!(refused.to_string().contains("format is missing"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![allow(
    rustdoc::broken_intra_doc_links,
    reason = "t[i] is an entry, also in the descriptions of the schemas"
)]
#![cfg_attr(
    not(feature = "schema"),
    allow(unused_imports, reason = "attributes of parameters use what only schemas need")
)]

mod ask;
mod distinct;
mod document;
mod documents;
pub mod parameter;
pub mod schema;

pub use stickslip_convolution as convolution;
pub use stickslip_cycles as cycles;
pub use stickslip_measurement as measurement;
pub use stickslip_outcome as outcome;
pub use stickslip_raster as raster;
pub use stickslip_stability as stability;
pub use stickslip_surface as surface;
pub use stickslip_tip as tip;
pub use stickslip_units as units;
pub use stickslip_verify as verify;

pub use ask::*;
pub use document::{Document, Question};
pub use documents::checkpoint::{CheckpointHead, Mark, Order, RunFormat};
pub use documents::compare::{
    ClosedDocument, ClosedWork, CompareDocument, CompareFound, CompareParameters,
    DifferenceDocument, GridDocument, GridName, GridWork,
};
pub use stickslip_cycles::{End as EndName, Parameter as OverName, SpecialKind};
pub use stickslip_raster::{Path as PathName, Pattern, Regime as RasterRegimeName};
pub use stickslip_stability::{BoundaryBranch, Criticality, OnsetKind, RasterKind};
pub use stickslip_tip::friction::{Hold, Loop};
pub use stickslip_tip::{Gaussian, MemoryChoice, Noise, Pulse};
pub use stickslip_verify::Difference;

pub use documents::figure::{
    ArrowName, CellsDocument, ColourName, ColoursName, CurveDocument, FigureDocument,
    FigureParameters, MapDocument, NoteDocument, PanelDocument, ScaleName, StyleName,
};
pub use documents::history::{FARTHEST, History};
pub use documents::in_units::{Dimension, InUnits, KnownScales, dimension};
pub use documents::large::{
    read_raster, read_run, read_sweep, write_any, write_raster, write_raster_surface,
    write_raster_sweep, write_run, write_surface, write_sweep,
};
pub use documents::outcome::{
    OscillationDocument, RegimeName, SwingDocument, TransientDocument, digits, to_its_digits,
};
pub use documents::physical::{
    InUnit, Physical, arrays as arrays_in_units, columns as columns_in_units,
};
pub use documents::raster::{
    ComparedLine, HeightMap, KeptLine, LineHistory, RasterCompareDocument, RasterCompareFound,
    RasterCompareParameters, RasterCompared, RasterComparedWork, RasterFound, RasterHistory,
    RasterLine, RasterSamples, RasterSurfaceDocument, RasterSweepFound, RasterSweepPoint,
};
pub use documents::read::{Kind, Unusable, from_json, identified, kind_of, read, read_from};
pub use documents::reproduction::{
    NumberDocument, ReproductionDocument, ReproductionFound, ReproductionParameters,
};
pub use documents::run_lines::{RunHead, RunLine};
#[cfg(feature = "schema")]
pub use documents::schemas::derived;
pub use documents::schemas::{SCHEMAS, schema};
pub use documents::software::{FORMAT_VERSION, Software};
pub use documents::stability::{
    CertificateDocument, ComplexDocument, CriticalDocument, LimitsDocument, OnsetDocument,
    SnakingDocument, SolveFor, StabilityFound, TrappingDocument,
};
pub use documents::surface::{
    AcrossParameters, SurfaceCurve, SurfaceDocument, SurfaceFound, SurfaceImage, SurfaceParameters,
};
pub use documents::sweep::{
    AxisDocument, AxisName, EnsembleDocument, RegimeCounts, ShardDocument, SourceName,
    StatisticsDocument, SweepDocument, SweepFound, SweepParameters, SweepPoint, SweepPoints,
    SweepRunParameters,
};
pub use documents::table::{Array, Column, Named, Rows, Tabular};
pub use documents::verification::{EndingName, LinesDocument, VerificationDocument};
pub use documents::verify::{ClaimDocument, VerifyDocument};

pub use documents::work::{SteadyState, WorkDocument};
pub use documents::write::{List, is_harmful, write, write_lists};

/// The README's example is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
