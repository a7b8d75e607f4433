//! `stickslip boundary --pitch-range`.

use super::{abscissas, range};
use crate::arguments::{BoundaryArguments, Interval};
use crate::commands::footprint::footprint;
use crate::commands::in_units::scales;
use crate::commands::job::Job;
use crate::commands::progress::Progress;
use crate::failure::{Failure, Typed};
use stickslip_documents::{
    FORMAT_VERSION, Physical, RasterBoundaryDocument, RasterBoundaryParameters, Software,
    SpacingName,
};
use stickslip_stability::{Raster, RasterPath, StabilityError};
use stickslip_tip::TipFunction;

const OPTION: &str = "--pitch-range";

pub(super) fn boundary(
    arguments: &BoundaryArguments,
    typed: &Interval,
    tip: TipFunction,
) -> Result<(), Failure> {
    let r = arguments.r.ok_or_else(|| Failure::input("--r", "give the support velocity, --r R"))?;
    let (footprint, width_y) = footprint(arguments.width_y, &tip)?;
    let (ends, points) = range(OPTION, typed, arguments.points)?;
    let tip_file = arguments.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, Some(r))?;
    let job = Job::open::<RasterBoundaryDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let spacing =
        if arguments.logarithmic { SpacingName::Logarithmic } else { SpacingName::Linear };
    let mut document = RasterBoundaryDocument {
        format: RasterBoundaryDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        physical: None,
        parameters: RasterBoundaryParameters {
            tip: (&tip).into(),
            r,
            width_y,
            pitch_range: ends,
            points,
            spacing,
        },
        pitch: abscissas(ends, points, spacing),
        alpha: vec![],
        q: vec![],
        kappa: vec![],
        crest_angle: vec![],
        alpha_zigzag: vec![],
        remarks: vec![],
    };
    let refused = |error: StabilityError| match error {
        StabilityError::R(_) => Failure::input(format!("--r {}", Typed(r)), error),
        error => typed.refused(OPTION, error),
    };
    let mut progress = Progress::new(0.0, points as f64).at_every_call();
    for (n, pitch) in document.pitch.iter().enumerate() {
        let raster = Raster::new(&footprint, r, *pitch).map_err(refused)?;
        let one_way = raster.critical(RasterPath::OneWay).map_err(refused)?;
        document.alpha.push(one_way.alpha);
        document.q.push(one_way.q);
        document.kappa.push(one_way.kappa.unwrap_or_default());
        document.crest_angle.push(one_way.crest_angle.unwrap_or(90.0));
        let zigzag = raster.critical(RasterPath::Zigzag);
        document.alpha_zigzag.push(zigzag.ok().map(|at| at.alpha));
        progress.counted(n as f64 + 1.0, || format!("{} of {points} pitches", n + 1));
    }
    job.finish(document.in_units(scales.as_ref()))
}
