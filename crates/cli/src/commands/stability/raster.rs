//! `stickslip stability --pitch`.

use crate::arguments::StabilityArguments;
use crate::commands::in_units::scales;
use crate::commands::job::Job;
use crate::commands::model::{model_under, tip, wider};
use crate::failure::{Failure, Typed};
use stickslip::lines::{self, footprint, left};
use stickslip::{
    Document, KnownScales, ModelParameters, PathName, Physical, RasterGrowth,
    RasterStabilityDocument, RasterStabilityFound, RasterStabilityParameters, Refused,
};
use stickslip_stability::{Raster, RasterCritical, RasterPath, StabilityError};
use stickslip_tip::{Footprint, TipFunction, Wider};

/// Wave numbers at which growth is told.
const WAVE_NUMBERS: u32 = 200;
/// Of the band of f: beyond, ripples neither grow nor do they hold.
const SHOWN: f64 = 0.4;

/// What scans, and how.
struct Scan {
    law: Wider,
    tip: TipFunction,
    width_y: Option<f64>,
    path: PathName,
    r: f64,
    raster: Raster,
}

/// A threshold, or that there is none.
type Threshold = Result<RasterCritical, StabilityError>;

pub(super) fn stability(arguments: &StabilityArguments) -> Result<(), Failure> {
    let scan = Scan::asked(arguments)?;
    let scales = scales_of(arguments)?;
    let job = Job::open::<RasterStabilityDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let critical = scan.critical(arguments)?;
    let document = document(arguments, scan, critical)?;
    job.finish(document.in_units(scales.as_ref()))
}

/// What the result is told in.
fn scales_of(arguments: &StabilityArguments) -> Result<Option<KnownScales>, Failure> {
    let model = &arguments.model;
    scales(&arguments.in_units, model.tip.tip_file.as_deref(), model.r)
}

impl Scan {
    fn asked(arguments: &StabilityArguments) -> Result<Self, Failure> {
        let (law, tip) = (wider(&arguments.model.wider), tip(&arguments.model.tip)?);
        let (footprint, width_y) = footprint(arguments.width_y, &tip)?;
        let path = arguments.path.unwrap_or(PathName::OneWay);
        let missing = "the support velocity is missing: give --r R";
        let r = arguments.model.r.ok_or_else(|| Failure::input("--r", missing))?;
        let raster = raster(arguments, (&footprint, law), path, r)?;
        Ok(Self { law, tip, width_y, path, r, raster })
    }

    /// Of a repeated line none.
    fn critical(&self, arguments: &StabilityArguments) -> Result<Option<Threshold>, Failure> {
        let path = match self.path {
            PathName::OneWay => RasterPath::OneWay,
            PathName::Zigzag => RasterPath::Zigzag,
            PathName::Repeat => return Ok(None),
        };
        let given = &arguments.model;
        let is_given = given.alpha.is_some() || given.alpha_above.is_some();
        match self.raster.critical(path) {
            // That nothing grows is an answer for a given α.
            Err(error) if !(is_given && matches!(error, StabilityError::NoCrossing { .. })) => {
                Err(refused(&error, (self.r, arguments.pitch)))
            }
            threshold => Ok(Some(threshold)),
        }
    }
}

fn raster(
    arguments: &StabilityArguments,
    (footprint, law): (&Footprint, Wider),
    path: PathName,
    r: f64,
) -> Result<Raster, Failure> {
    let pitch = match (path, arguments.pitch) {
        (PathName::Repeat, Some(pitch)) => {
            let message = "has no meaning with --path repeat: leave one of them out";
            return Err(Failure::input(format!("--pitch {}", Typed(pitch)), message));
        }
        (PathName::Repeat, None) if !law.is_papers() => {
            let message = "linear theory of a repeated line covers the basic law only: leave out --depth-limit, \
                           --healing-time and --inertia";
            return Err(Failure::input("--path repeat", message));
        }
        // That of no other line.
        (PathName::Repeat, None) => 1e6,
        (_, Some(pitch)) => pitch,
        (_, None) => {
            return Err(Failure::input("--pitch", "give the distance of the lines, --pitch D"));
        }
    };
    let left = left(arguments.length, &law, r)?;
    Raster::new(footprint, law, (r, pitch), left)
        .map_err(|error| refused(&error, (r, arguments.pitch)))
}

/// What a raster was refused for, by its option.
fn refused(error: &StabilityError, (r, pitch): (f64, Option<f64>)) -> Failure {
    let given = || Refused::number("pitch", pitch.unwrap_or_default(), "");
    lines::refused(error, r, given).into()
}

fn document(
    arguments: &StabilityArguments,
    scan: Scan,
    threshold: Option<Threshold>,
) -> Result<RasterStabilityDocument, Failure> {
    let Scan { law, tip, width_y, path, r, raster } = scan;
    let given = &arguments.model;
    let is_given = given.alpha.is_some() || given.alpha_above.is_some();
    if !is_given && threshold.is_none() {
        let message = "a repeated line has no critical α: give --alpha A for the growth there";
        return Err(Failure::input("--alpha", message));
    }
    let band = tip.band();
    let critical = threshold.as_ref().and_then(|threshold| threshold.as_ref().ok());
    let at = critical.filter(|_| !is_given).map(|at| at.alpha);
    let model = model_under((law, tip), r, (at.or(given.alpha), given.alpha_above))?;
    let alpha = model.alpha();
    let mut remarks = vec![];
    if let Some(Err(none)) = &threshold {
        remarks.push(format!("critical: {none}"));
    }
    if path == PathName::Zigzag && is_given {
        remarks.push("growth: on a zigzag only the threshold is known".into());
    }
    if path == PathName::Repeat {
        remarks.push("critical: another pass deepens some ripple of the groove at every α".into());
    }
    let parameters = RasterStabilityParameters {
        model: ModelParameters::of(&model, given.alpha_above),
        width_y,
        path,
        pitch: arguments.pitch,
        length: arguments.length,
        at_critical_point: !is_given,
    };
    let is_below = |threshold: &Threshold| threshold.as_ref().map_or(true, |at| alpha < at.alpha);
    let stable = threshold.as_ref().filter(|_| is_given).map(is_below);
    let growth = (is_given && path != PathName::Zigzag).then(|| growth(&raster, path, alpha, band));
    Ok(Document::new(
        parameters,
        RasterStabilityFound { critical: critical.map(Into::into), stable, growth },
        remarks,
    ))
}

fn growth(raster: &Raster, path: PathName, alpha: f64, band: f64) -> RasterGrowth {
    growth_of(band, |q| {
        let z = match path {
            PathName::Repeat => raster.repeat_gain(alpha, q),
            _ => raster.growth(alpha, q),
        };
        z.to_polar()
    })
}

/// |z| and arg z over wave numbers.
fn growth_of(band: f64, z: impl Fn(f64) -> (f64, f64)) -> RasterGrowth {
    let number = |i: u32| SHOWN * band * f64::from(i) / f64::from(WAVE_NUMBERS);
    let q: Vec<f64> = (1..=WAVE_NUMBERS).map(number).collect();
    let (factor, phase) = q.iter().map(|q| z(*q)).unzip();
    RasterGrowth { factor, phase, q }
}
