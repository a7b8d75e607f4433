//! Heights of a raster: points, profiles and images.

use super::places::{OR_GSF, Places, evenly};
use super::write::{SurfaceFormat, large};
use crate::arguments::SurfaceArguments;
use crate::commands::raster::field;
use crate::failure::Failure;
use crate::session::Session;
use stickslip::{Physical, RasterDocument, RasterSurfaceDocument, Unusable};
use stickslip_raster::Scanned;
use stickslip_tip::sorting::ends;

pub(super) fn surface(
    session: &Session,
    arguments: &SurfaceArguments,
    raster: &RasterDocument,
    format: SurfaceFormat,
) -> Result<(), Failure> {
    refuse_of_runs(arguments)?;
    let damaged =
        |error: Unusable| Failure::file("RASTER.json", &arguments.run, format!("damaged: {error}"));
    let (plan, lines) = raster.scanned().map_err(damaged)?;
    let (low, high) = plan.area.ends();
    let (from, to) = (low - plan.reach_across(), high + plan.reach_across());
    let places = Places::over(arguments, vec![0.0], (from, to), format.most_pixels())?;
    let y = match (&arguments.y, places.y.is_empty()) {
        (Some(y), _) => y.clone(),
        (None, false) => places.y.clone(),
        (None, true) => {
            let (first, last) = ends((0..plan.lines()).map(|n| plan.track(n).y));
            if last > first { evenly(first, last, plan.lines()) } else { vec![first] }
        }
    };
    judge_size(&places, &y, format.most_pixels())?;
    let (physical, r) = (raster.physical.as_ref(), plan.law.model.r());
    let (scales, in_metres) = format.scales(session, arguments, physical, r)?;
    if let (Some(unit), true) = (in_metres, places.is_large(&y)) {
        let model = &plan.law.model;
        let title = format!("u(x,y) of a raster, alpha {}, r {}", model.alpha(), model.r());
        let scanned = Scanned::new(&plan, &lines);
        let rows = |y: &[f64]| Ok(scanned.heights(&places.x, y));
        return large(arguments, (&places, &y), &title, unit, rows);
    }
    let job = format.job(session, RasterSurfaceDocument::FORMAT, arguments)?;
    let document = RasterSurfaceDocument::of(raster, places.x, y).map_err(damaged)?;
    let document = document.in_units(scales.as_ref());
    let Some(unit) = in_metres else { return job.finish(document) };
    let bytes = field(&document.parameters, &document.surfaces[0], unit);
    job.finish_bytes(&bytes, document)
}

/// Rejects too many heights; by default the rows are the lines, of which there may be a million.
fn judge_size(places: &Places, y: &[f64], most: f64) -> Result<(), Failure> {
    let (columns, rows) = (places.x.len() as f64, y.len() as f64);
    if columns * rows <= most {
        return Ok(());
    }
    let least = places.spacing.unwrap_or(1.0) * columns * rows / most;
    let message = format!(
        "make {columns} columns of {rows} rows, more than fit in memory; take --spacing {least:.3e} or more, or \
             fewer rows by --y or --y-range{OR_GSF}"
    );
    Err(Failure::input("--spacing and --y", message))
}

/// Rejects options that have no meaning for a raster.
fn refuse_of_runs(arguments: &SurfaceArguments) -> Result<(), Failure> {
    let given = [
        ("--at", arguments.at.is_some()),
        ("--far-behind", arguments.far_behind),
        ("--width-y", arguments.width_y.is_some()),
    ];
    let message =
        "a raster is shown after its last line, with its own footprint: leave the option out";
    Failure::if_given(&given, message)
}
