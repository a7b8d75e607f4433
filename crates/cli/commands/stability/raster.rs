//! `stickslip stability --pitch`.

mod wider;

use crate::arguments::StabilityArguments;
use crate::commands::footprint::footprint;
use crate::commands::in_units::scales;
use crate::commands::job::Job;
use crate::commands::model::{model_under, tip, wider as wider_law};
use crate::failure::{Failure, Typed};
use stickslip_documents::{
    KnownScales, ModelParameters, PathName, Physical, RasterGrowth, RasterStabilityDocument,
    RasterStabilityParameters,
};
use stickslip_stability::{Raster, RasterCritical, RasterPath, StabilityError};
use stickslip_tip::{Footprint, TipFunction, Wider};

/// Wave numbers at which growth is told.
const WAVE_NUMBERS: u32 = 200;
/// Of the band of f: beyond, ripples neither grow nor do they hold.
const SHOWN: f64 = 0.4;

pub(super) fn stability(arguments: &StabilityArguments) -> Result<(), Failure> {
    if !wider_law(&arguments.model.wider).is_papers() {
        return wider::stability(arguments);
    }
    let tip = tip(&arguments.model.tip)?;
    let (footprint, width_y) = footprint(arguments.width_y, &tip)?;
    let path = arguments.path.unwrap_or(PathName::OneWay);
    let raster = raster(arguments, &footprint, path)?;
    let scales = scales_of(arguments)?;
    let job = Job::open::<RasterStabilityDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let critical = match path {
        PathName::OneWay => Some(critical(arguments, &raster, RasterPath::OneWay)?),
        PathName::Zigzag => Some(critical(arguments, &raster, RasterPath::Zigzag)?),
        PathName::Repeat => None,
    };
    let document = document(arguments, (tip, width_y), path, &raster, critical)?;
    job.finish(document.in_units(scales.as_ref()))
}

/// What the result is told in.
fn scales_of(arguments: &StabilityArguments) -> Result<Option<KnownScales>, Failure> {
    let model = &arguments.model;
    scales(&arguments.in_units, model.tip.tip_file.as_deref(), model.r)
}

fn raster(
    arguments: &StabilityArguments,
    footprint: &Footprint,
    path: PathName,
) -> Result<Raster, Failure> {
    let missing = "the support velocity is missing: give --r R";
    let r = arguments.model.r.ok_or_else(|| Failure::input("--r", missing))?;
    let pitch = match (path, arguments.pitch) {
        (PathName::Repeat, Some(pitch)) => {
            let message = "has no meaning with --path repeat: leave one of them out";
            return Err(Failure::input(format!("--pitch {}", Typed(pitch)), message));
        }
        // That of no other line.
        (PathName::Repeat, None) => 1e6,
        (_, Some(pitch)) => pitch,
        (_, None) => {
            return Err(Failure::input("--pitch", "give the distance of the lines, --pitch D"));
        }
    };
    Raster::new(footprint, r, pitch).map_err(|error| match error {
        StabilityError::R(_) => Failure::input(format!("--r {}", Typed(r)), error),
        error => Failure::input(format!("--pitch {}", Typed(pitch)), error),
    })
}

fn critical(
    arguments: &StabilityArguments,
    raster: &Raster,
    path: RasterPath,
) -> Result<RasterCritical, Failure> {
    raster.critical(path).map_err(|error| {
        let pitch = arguments.pitch.unwrap_or_default();
        Failure::input(format!("--pitch {}", Typed(pitch)), error)
    })
}

fn document(
    arguments: &StabilityArguments,
    (tip, width_y): (TipFunction, Option<f64>),
    path: PathName,
    raster: &Raster,
    critical: Option<RasterCritical>,
) -> Result<RasterStabilityDocument, Failure> {
    let given = &arguments.model;
    let r = given.r.unwrap_or_default();
    let is_given = given.alpha.is_some() || given.alpha_above.is_some();
    if !is_given && critical.is_none() {
        let message = "a repeated line has no critical α: give --alpha A for the growth there";
        return Err(Failure::input("--alpha", message));
    }
    let band = tip.band();
    let at = critical.filter(|_| !is_given).map(|at| at.alpha);
    let model = model_under((Wider::default(), tip), r, (at.or(given.alpha), given.alpha_above))?;
    let alpha = model.alpha();
    let mut remarks = vec![];
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
        length: None,
        at_critical_point: !is_given,
    };
    let stable = critical.filter(|_| is_given).map(|at| alpha < at.alpha);
    let growth = (is_given && path != PathName::Zigzag).then(|| growth(raster, path, alpha, band));
    Ok(RasterStabilityDocument::new(parameters, critical.as_ref(), stable, growth, remarks))
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
