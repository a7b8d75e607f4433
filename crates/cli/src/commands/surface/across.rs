//! Surfaces of a tip that moves in both coordinates.

use super::places::{MOST_PIXELS, Places};
use super::write::{self, SurfaceFormat};
use crate::arguments::SurfaceArguments;
use crate::failure::Failure;
use crate::session::Session;
use stickslip::{
    AcrossParameters, Document, Physical, RunDocument, SurfaceCurve, SurfaceDocument, SurfaceFound,
    SurfaceImage, SurfaceParameters,
};
use stickslip_surface::SurfaceAcross;
use stickslip_tip::Trajectory;

/// Curves along the line y = 0, or images.
pub(super) fn surface(
    session: &Session,
    arguments: &SurfaceArguments,
    document: &RunDocument,
    format: SurfaceFormat,
) -> Result<(), Failure> {
    let named = format!("RUN.json {}", arguments.run.display());
    let damaged = |message: String| Failure::input(&named, format!("damaged: {message}"));
    let (scenario, trajectory) =
        document.trajectory_across().map_err(|error| damaged(error.to_string()))?;
    if arguments.far_behind {
        let message =
            "is for a tip that is held on its line, and that of this run is not: leave it out";
        return Err(Failure::input("--far-behind", message));
    }
    if arguments.width_y.is_some() {
        let message = "is set by the run, whose tip is free to move across the scan: leave it out";
        return Err(Failure::input("--width-y", message));
    }
    let steps = trajectory.steps().iter().map(|step| step.along).collect();
    let along = Trajectory::under(*scenario.along.model.wider(), scenario.along.support(), steps);
    let places = Places::requested(arguments, &along, MOST_PIXELS)?;
    let (physical, r) = (document.physical.as_ref(), scenario.along.model.r());
    let (scales, in_metres) = format.scales(session, arguments, physical, r)?;
    let job = format.job(session, SurfaceDocument::FORMAT, arguments)?;
    let surface = SurfaceAcross::new(&scenario, &trajectory);
    let surface = surface.map_err(Failure::run)?;
    let found = found(&surface, &places)?;
    let across = AcrossParameters {
        width_y: document.parameters.width_y,
        transverse_stiffness_needed: None,
    };
    let parameters = SurfaceParameters {
        model: document.parameters.model_parameters(),
        far_behind: false,
        across: (!places.y.is_empty()).then_some(across),
    };
    let result: SurfaceDocument = Document::new(parameters, found, vec![]);
    let result = result.in_units(scales.as_ref());
    match in_metres {
        None => job.finish(result),
        Some(unit) => job.finish_bytes(&write::field(&result, &places, unit), result),
    }
}

fn found(surface: &SurfaceAcross, places: &Places) -> Result<SurfaceFound, Failure> {
    let Places { t, x, y, .. } = places;
    let mut found = SurfaceFound { surfaces: vec![], images: vec![] };
    for t in t {
        let rows = if y.is_empty() { &[0.0][..] } else { y };
        let image = surface.image(*t, x, rows).map_err(Failure::run)?;
        let mut u = image.rows().into_iter().map(|row| row.to_vec());
        if y.is_empty() {
            let u = u.next().unwrap_or_default();
            found.surfaces.push(SurfaceCurve { t: *t, x: x.clone(), u });
        } else {
            found.images.push(SurfaceImage { t: *t, x: x.clone(), y: y.clone(), u: u.collect() });
        }
    }
    Ok(found)
}
