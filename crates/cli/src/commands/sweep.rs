//! `stickslip sweep`.

mod axes;
pub(crate) mod divided;
mod grid;
pub(crate) mod merge;
mod point;
mod raster;
mod started;
mod work;

use super::finished::Finished;
use super::job::{Job, judge_places};
use crate::arguments::{SweepArguments, SweepThen};
use crate::arithmetic::arithmetic;
use crate::commands::in_units::scales;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use divided::Divided;
use grid::Grid;
use std::panic::{AssertUnwindSafe, catch_unwind};
use stickslip::{Document, Physical, SweepDocument, SweepFound, SweepPoint};
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
    let tip_file = arguments.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, grid.parameters.velocity())?;
    if arguments.plot.is_some() {
        // Before hours of work.
        judge_sweep(&grid.parameters).map_err(|error| Failure::input("--plot", error))?;
    }
    let job = Job::open::<SweepDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let indices: Vec<usize> = grid.indices().collect();
    let is_done = |file| merge::is_done::<SweepDocument>(file, &grid.parameters, &indices);
    if arguments.if_needed && job.file().is_some_and(is_done) {
        return Ok(());
    }
    let finished = match job.file() {
        Some(file) => Finished::beside(file, &grid.parameters, |index| grid.parameters.has(index))?,
        None => Finished::in_memory(),
    };
    let interrupt = Interrupt::listen()?;
    let work = (threads, grid.together());
    let mut finished = compute(&indices, finished, work, &interrupt, |indices, take| {
        judged(indices, &grid, take);
    })?;
    let points = finished.take_in_order();
    let found = SweepFound { points, ensembles: None, arithmetic: Some(arithmetic()), crc32: None };
    let document: SweepDocument = Document::new(grid.parameters, found, vec![]);
    job.finish(document.sealed()?.in_units(scales.as_ref()))?;
    finished.remove();
    Ok(())
}

/// Number of threads; 0 means the number of cores.
fn threads(asked: Option<usize>) -> Result<usize, Failure> {
    match asked {
        None => Ok(0),
        Some(threads) if (1..=MOST_THREADS).contains(&threads) => Ok(threads),
        Some(threads) => {
            let message = format!("must be 1 to {MOST_THREADS}");
            Err(Failure::input(format!("--threads {threads}"), message))
        }
    }
}

/// These points; if a library panics, each by itself, and a point with an error where it does so again.
fn judged(indices: &[usize], grid: &Grid, take: &mut dyn FnMut(SweepPoint)) {
    let mut missing = indices.to_vec();
    let mut each = |point: SweepPoint| {
        missing.retain(|index| *index != point.index);
        take(point);
    };
    if catch_unwind(AssertUnwindSafe(|| point::points(indices, grid, &mut each))).is_ok() {
        return;
    }
    for index in missing {
        let alone = AssertUnwindSafe(|| point::points(&[index], grid, take));
        if catch_unwind(alone).is_err() {
            let error = "the computation failed for an unknown reason: please report it";
            take(SweepPoint { error: Some(error.into()), ..grid.place(index).empty(index, None) });
        }
    }
}
