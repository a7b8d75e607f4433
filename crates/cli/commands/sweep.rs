//! `stickslip sweep`.

mod axes;
mod grid;
pub(crate) mod merge;
mod point;
mod raster;
mod started;
mod work;

use super::finished::Finished;
use super::job::{Job, judge_places};
use crate::arguments::{OutletArguments, SweepArguments, SweepThen};
use crate::arithmetic::arithmetic;
use crate::commands::in_units::scales;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use grid::Grid;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use stickslip_documents::{
    EnsembleDocument, FORMAT_VERSION, Physical, Software, SweepDocument, SweepParameters,
    SweepPoint,
};
use stickslip_figures::judge_sweep;
use work::compute;

const MOST_THREADS: usize = 4096;

pub(crate) fn sweep(arguments: &SweepArguments) -> Result<(), Failure> {
    match &arguments.then {
        Some(SweepThen::Merge(merged)) => return merge::merge(merged),
        Some(SweepThen::Raster(rasters)) => return raster::sweep(rasters),
        None => {}
    }
    let threads = threads(arguments.threads)?;
    let read = [("--tip-file", arguments.tip_file.as_deref())];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let grid = Grid::asked(arguments)?;
    let r = Some(&*grid.parameters.r).filter(|r| r.len() == 1).map(|r| r[0]);
    let scales = scales(&arguments.in_units, arguments.tip_file.as_deref(), r)?;
    let job = job(&arguments.outlet, arguments.plot.as_deref(), &grid.parameters)?;
    let finished = match job.file() {
        Some(file) => Finished::beside(file, &grid.parameters, |index| grid.parameters.has(index))?,
        None => Finished::in_memory(),
    };
    let interrupt = Interrupt::listen()?;
    let indices: Vec<usize> = grid.indices().collect();
    let finished = compute(&indices, finished, threads, &interrupt, |index| judged(index, &grid))?;
    let document = sealed(grid.parameters, finished.in_order(), Some(arithmetic()))?;
    job.finish(document.in_units(scales.as_ref()))?;
    finished.remove();
    Ok(())
}

/// Where a sweep goes, which is found out before hours of work.
fn job(
    outlet: &OutletArguments,
    plot: Option<&Path>,
    parameters: &SweepParameters,
) -> Result<Job, Failure> {
    if plot.is_some() {
        judge_sweep(parameters).map_err(|error| Failure::input("--plot", error))?;
    }
    Job::open::<SweepDocument>(outlet, plot)
}

/// The document of a finished sweep, with its checksum.
fn sealed(
    parameters: SweepParameters,
    points: Vec<SweepPoint>,
    arithmetic: Option<String>,
) -> Result<SweepDocument, Failure> {
    let mut document = SweepDocument {
        format: SweepDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        physical: None,
        ensembles: EnsembleDocument::all(&parameters, &points),
        parameters,
        points,
        arithmetic,
        crc32: None,
    };
    document.crc32 = Some(checksum(&document)?);
    Ok(document)
}

/// CRC-32 of parameters, points and how the machine rounds, as this program writes them, however the document is
/// laid out.
fn checksum(document: &SweepDocument) -> Result<u32, Failure> {
    let text = serde_json::to_vec(&(&document.parameters, &document.points, &document.arithmetic));
    Ok(crc32fast::hash(&text.map_err(|error| Failure::Run(error.to_string()))?))
}

/// 0: as many as there are cores.
fn threads(asked: Option<usize>) -> Result<usize, Failure> {
    match asked {
        None => Ok(0),
        Some(threads) if (1..=MOST_THREADS).contains(&threads) => Ok(threads),
        Some(threads) => {
            let message = format!("1 to {MOST_THREADS} will do");
            Err(Failure::input(format!("--threads {threads}"), message))
        }
    }
}

/// A point; where a library panics, one that failed.
fn judged(index: usize, grid: &Grid) -> SweepPoint {
    let place = grid.place(index);
    let empty = place.empty(index, None);
    let point = AssertUnwindSafe(|| point::point(index, place, grid.parameters.tolerance));
    catch_unwind(point).unwrap_or_else(|_| SweepPoint {
        error: Some(
            "the computation failed for a reason that it cannot tell: please report it".into(),
        ),
        ..empty
    })
}
