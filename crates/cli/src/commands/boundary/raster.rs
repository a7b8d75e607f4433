//! `stickslip boundary --pitch-range`.

use super::{range, spacing};
use crate::arguments::{BoundaryArguments, Interval};
use crate::commands::footprint::footprint;
use crate::commands::grooves::left;
use crate::commands::in_units::scales;
use crate::commands::job::Job;
use crate::commands::model::{refused_wider, wider};
use crate::commands::progress::Progress;
use crate::failure::{Failure, Typed};
use stickslip::{
    Document, Physical, RasterBoundaryDocument, RasterBoundaryFound, RasterBoundaryParameters,
};
use stickslip_stability::{Raster, RasterCritical, RasterPath, StabilityError};
use stickslip_tip::{Footprint, TipFunction, Wider};

const OPTION: &str = "--pitch-range";

pub(super) fn boundary(
    arguments: &BoundaryArguments,
    typed: &Interval,
    tip: TipFunction,
) -> Result<(), Failure> {
    let r = arguments.r.ok_or_else(|| Failure::input("--r", "give the support velocity, --r R"))?;
    let (footprint, width_y) = footprint(arguments.width_y, &tip)?;
    let (ends, points) = range(OPTION, typed, arguments.points)?;
    let law = wider(&arguments.wider);
    let left = left(arguments.length, &law, r)?;
    let tip_file = arguments.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, Some(r))?;
    let job = Job::open::<RasterBoundaryDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let spacing = spacing(arguments);
    let parameters = RasterBoundaryParameters {
        tip: (&tip).into(),
        r,
        width_y,
        pitch_range: ends,
        points,
        spacing,
        depth_limit: law.depth_limit,
        healing_time: law.healing_time,
        inertia: law.inertia,
        length: arguments.length,
    };
    let mut found = RasterBoundaryFound::default();
    let mut progress = Progress::new(0.0, points as f64).at_every_call();
    let (pitches, mut left_out) = (spacing.values(ends, points), vec![]);
    for (n, pitch) in pitches.into_iter().enumerate() {
        match thresholds(&footprint, law, (r, pitch), left) {
            Ok((one_way, zigzag)) => {
                found.pitch.push(pitch);
                found.alpha.push(one_way.alpha);
                found.q.push(one_way.q);
                found.kappa.push(one_way.kappa.unwrap_or_default());
                found.crest_angle.push(one_way.crest_angle.unwrap_or(90.0));
                found.alpha_zigzag.push(zigzag);
            }
            // That nothing grows is an answer of the wider law.
            Err(StabilityError::NoCrossing { .. }) if !law.is_papers() => left_out.push(pitch),
            Err(error) => return Err(refused(&error, r, typed)),
        }
        progress.counted(n as f64 + 1.0, || format!("{} of {points} pitches", n + 1));
    }
    let remarks = remark(&left_out).into_iter().collect();
    let document: RasterBoundaryDocument = Document::new(parameters, found, remarks);
    job.finish(document.in_units(scales.as_ref()))
}

/// Where ripples of lines that go one way begin to grow, and the α of a zigzag; of that none over a surface that heals, and
/// none where nothing grows.
fn thresholds(
    footprint: &Footprint,
    law: Wider,
    (r, pitch): (f64, f64),
    left: f64,
) -> Result<(RasterCritical, Option<f64>), StabilityError> {
    let raster = Raster::new(footprint, law, (r, pitch), left)?;
    let one_way = raster.critical(RasterPath::OneWay)?;
    match raster.critical(RasterPath::Zigzag) {
        Ok(zigzag) => Ok((one_way, Some(zigzag.alpha))),
        Err(StabilityError::HealingZigzag | StabilityError::NoCrossing { .. }) => {
            Ok((one_way, None))
        }
        Err(error) => Err(error),
    }
}

fn remark(left_out: &[f64]) -> Option<String> {
    let (first, last) = (left_out.first()?, left_out.last()?);
    Some(format!(
        "{} pitches from {first} to {last} are left out: no ripple grows there, however large alpha",
        left_out.len()
    ))
}

fn refused(error: &StabilityError, r: f64, typed: &Interval) -> Failure {
    match error {
        StabilityError::R(_) => Failure::input(format!("--r {}", Typed(r)), error),
        StabilityError::NoSupport => Failure::input("--no-spring", error),
        StabilityError::Corner => Failure::input("--depth-limit", error),
        StabilityError::Wider(error) => refused_wider(error),
        StabilityError::PapersLawOnly(_) | StabilityError::NoRipples => {
            Failure::input("--tip", error)
        }
        error => typed.refused(OPTION, error),
    }
}
