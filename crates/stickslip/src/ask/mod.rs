//! Questions: data that one function answers.
//!
//! A question is a struct whose fields are its parameters, such as [`Cycle`](crate::Cycle). [`Ask::ask`] answers it
//! with a [`Document`], which contains both, or rejects it and names the invalid parameter. The interfaces (command
//! line, Python, web page) convert input to questions and write documents; they compute nothing.
//!
//! ```
//! use stickslip::{Ask, Context, Cycle, Indentation, Tip};
//! use stickslip::tip::TipFunction;
//!
//! let tip = Tip(TipFunction::triple_gaussian(1.0, 1.0)?); // β = 1, width 1
//! let found = Cycle::new(tip, Indentation::above_critical(0.01), 1.0).ask(&Context::default())?;
//! assert!((found.period - 6.693688892159).abs() < 1e-8); // by harmonic balance with 30 digits
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod across;
pub(crate) mod boundary;
pub(crate) mod context;
pub(crate) mod continuation;
pub(crate) mod cycle;
pub mod exponents;
pub(crate) mod failure;
pub(crate) mod fit;
pub(crate) mod fit_image;
pub(crate) mod force_tracks;
pub(crate) mod friction;
pub mod lines;
pub(crate) mod load_map;
pub(crate) mod measured_tip;
pub(crate) mod model;
pub(crate) mod moving;
pub(crate) mod points;
pub(crate) mod question;
pub(crate) mod raster;
pub(crate) mod raster_boundary;
pub(crate) mod raster_stability;
pub(crate) mod raster_sweep;
pub(crate) mod response;
pub(crate) mod run;
pub(crate) mod run_found;
pub(crate) mod run_many;
pub(crate) mod sampling;
pub(crate) mod snaking_boundary;
pub(crate) mod stability;
pub(crate) mod sweep;
pub(crate) mod units;
pub(crate) mod walker;
pub(crate) mod walker_motion;
pub(crate) mod walking;

pub use boundary::{
    Boundary, BoundaryDocument, BoundaryFound, LimitColumns, OnsetColumns, SpacingName,
};
pub use context::Context;
pub use continuation::{Continue, ContinueDocument, ContinueFound, CycleBranch, SpecialDocument};
pub use cycle::{Cycle, CycleDocument, CycleFound, CycleProfile, CycleWork};
pub use failure::{Failure, Refused, Typed};
pub use fit::{
    AlternativeDocument, DataFitted, Fit, FitDocument, FitFound, FreeName, Measured, NumberFitted,
    NumberHeld,
};
pub use fit_image::{FitImage, FitImageDocument, FitImageFound, LateralDocument, SlowScanName};
pub use force_tracks::RunForces;
pub use friction::{ForceTrack, Friction, FrictionDocument, FrictionFound, LoopColumns};
pub use load_map::{LoadMap, LoadMapDocument, LoadMapFound, LoadPoint, LoadWidths};
pub use measured_tip::{
    CandidateDocument, EstimateDocument, GaussianSumDocument, MeasuredImage, MeasuredProfile,
    MeasuredTip, MeasuredTipDocument, MeasuredTipFound, SideDocument, SidesDocument,
};
pub use model::{Law, LayerDocument, ModelParameters, TipDocument, judge_details};
pub use moving::{Moved, Moving};
pub use points::{Points, each_point, on_threads};
pub use question::{Indentation, NamedTip, Tip, TipName};
pub use raster::{AreaDocument, Raster, RasterDocument};
pub use raster_boundary::{
    RasterBoundary, RasterBoundaryDocument, RasterBoundaryFound, ThresholdColumns,
};
pub use raster_stability::{
    RasterCriticalDocument, RasterGrowth, RasterStability, RasterStabilityDocument,
    RasterStabilityFound,
};
pub use raster_sweep::{RasterSweep, RasterSweepDocument};
pub use response::{ModeDocument, Response, ResponseDocument, ResponseFound, ResponseSamples};
pub use run::{
    ForceTable, Profile, Run, RunDocument, RunScenario, StartName, SupportPathParameters,
    SurfaceTable,
};
pub use run_found::{RunEnd, RunFound, SampleLine, Samples};
pub use run_many::ask_runs;
pub use sampling::{Sampling, Times};
pub use snaking_boundary::{
    SnakingBoundary, SnakingBoundaryDocument, SnakingBoundaryFound, SnakingCrossing,
};
pub use stability::{Stability, StabilityDocument};
pub use sweep::Sweep;
pub use units::{CriticalUnits, LagDocument, Units, UnitsDocument};
pub use walker::{OrbitDocument, Walker, WalkerDocument, WalkerFound, WalkerWork};
pub use walker_motion::{CircleDocument, WalkerRegime};
pub use walking::{WalkDocument, Walking, WalkingDocument, WalkingFound};

use crate::{Document, Question};

/// A question that one function answers.
pub trait Ask: Question {
    /// The velocity r of the support, if there is one; together with v0 of an experiment it defines a scale of time.
    fn support_velocity(&self) -> Option<f64> {
        None
    }

    /// The question with its derived parameters computed, such as α of αc(r) + D: the form that documents contain.
    ///
    /// # Errors
    /// A parameter is out of its range, or contradicts another.
    fn resolved(self, _context: &Context) -> Result<Self, Failure> {
        Ok(self)
    }

    /// The answer to a resolved question, and warnings about it.
    ///
    /// # Errors
    /// A parameter is out of its range; nothing was found; the work was cancelled.
    fn answer(&self, context: &Context) -> Result<(Self::Answer, Vec<String>), Failure>;

    /// The document of the question, resolved and answered.
    ///
    /// # Errors
    /// As [`resolved`](Self::resolved) and [`answer`](Self::answer).
    fn ask(self, context: &Context) -> Result<Document<Self>, Failure> {
        context.within(|| self.resolved(context))?.answered(context)
    }

    /// The document of a resolved question.
    ///
    /// # Errors
    /// As [`answer`](Self::answer).
    fn answered(self, context: &Context) -> Result<Document<Self>, Failure> {
        let (answer, remarks) = context.within(|| self.answer(context))?;
        Ok(Document::new(self, answer, remarks))
    }
}
