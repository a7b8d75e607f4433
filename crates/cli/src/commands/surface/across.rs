//! Surfaces of a tip that moves in both coordinates.

use super::places::{MOST_PIXELS, Places};
use super::write::{self, SurfaceFormat};
use crate::arguments::SurfaceArguments;
use crate::failure::Failure;
use crate::session::Session;
use stickslip::{AcrossParameters, RunDocument, SurfaceDocument, SurfaceParameters};
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
    let surface = SurfaceAcross::new(&scenario, &trajectory).map_err(Failure::run)?;
    // Curves are those along the line y = 0.
    let y = if places.y.is_empty() { &[0.0][..] } else { &places.y };
    let rows = |t: f64| surface.image(t, &places.x, y).map_err(|error| error.to_string());
    let across = AcrossParameters {
        width_y: document.parameters.width_y,
        transverse_stiffness_needed: None,
    };
    let parameters = SurfaceParameters {
        model: document.parameters.model_parameters(),
        far_behind: false,
        across: (!places.y.is_empty()).then_some(across),
    };
    write::surfaces(job, parameters, &places, (scales, in_metres), rows)
}
