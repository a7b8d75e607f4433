//! `stickslip surface`.

mod across;
mod image;
mod of_raster;
mod places;
mod write;

pub(crate) use places::evenly;

use crate::arguments::SurfaceArguments;
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::files::input::{RunOrRaster, read_scanned};
use crate::session::Session;
use image::Images;
use ndarray::{Array1, Array2, Axis};
use places::Places;
use stickslip::{SurfaceDocument, SurfaceParameters, Unusable};
use stickslip_surface::{Surface, SurfaceError};
use write::SurfaceFormat;

pub(crate) fn surface(session: &Session, arguments: &SurfaceArguments) -> Result<(), Failure> {
    let format = SurfaceFormat::of(session, arguments)?;
    let read =
        [("RUN.json", Some(&*arguments.run)), ("--units", arguments.in_units.units.as_deref())];
    let written = [("--output", Some(&*arguments.output)), ("--plot", arguments.plot.as_deref())];
    distinct(&written, &read)?;
    let document = match read_scanned(session, &arguments.run)? {
        RunOrRaster::Run(document) => document,
        RunOrRaster::Raster(raster) => {
            return of_raster::surface(session, arguments, &raster, format);
        }
    };
    format.judge_of_run(arguments)?;
    if document.parameters.stiffness_across.is_some() {
        return across::surface(session, arguments, &document, format);
    }
    let damaged =
        |message: String| Failure::file("RUN.json", &arguments.run, format!("damaged: {message}"));
    let unusable = |error: Unusable| damaged(error.to_string());
    let model = document.parameters.model_parameters().model().map_err(unusable)?;
    let trajectory = document.trajectory().map_err(unusable)?;
    let scenario = document.parameters.scenario().map_err(|failure| unusable(failure.into()))?;
    let initial = scenario.initial_surface().map_err(|error| damaged(error.to_string()))?;
    let places = Places::requested(arguments, &trajectory, format.most_pixels())?;
    let physical = document.physical.as_ref();
    let (scales, in_metres) = format.scales(session, arguments, physical, model.r())?;
    let images = Images::requested(arguments, &model, &places)?;
    let surface = Surface::new(&model, &initial, &trajectory);
    if let (Some(images), Some(unit), true) = (&images, in_metres, places.is_large(&places.y)) {
        images.warn(session);
        let t = places.t[0];
        let title = write::title(t, model.alpha(), model.r());
        let rows = |y: &[f64]| images.heights(&surface, t, (&places.x, y));
        return write::large(arguments, (&places, &places.y), &title, unit, rows);
    }
    let job = format.job(session, SurfaceDocument::FORMAT, arguments)?;
    images.iter().for_each(|images| images.warn(session));
    let rows = |t: f64| match &images {
        Some(images) => images.heights(&surface, t, (&places.x, &places.y)),
        None if arguments.far_behind => row(surface.far_behind(t, &places.x)),
        None => row(surface.heights(t, &places.x)),
    };
    let parameters = SurfaceParameters {
        model: document.parameters.model_parameters(),
        far_behind: arguments.far_behind,
        across: images.as_ref().map(Images::parameters),
    };
    write::surfaces(job, parameters, &places, (scales, in_metres), rows)
}

/// Heights on a line as an image of one row.
fn row(heights: Result<Array1<f64>, SurfaceError>) -> Result<Array2<f64>, String> {
    heights.map(|heights| heights.insert_axis(Axis(0))).map_err(|error| error.to_string())
}
