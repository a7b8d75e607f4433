//! `stickslip compare --lines`: a raster against the full equations on rows of cells.

use super::grid::stepping;
use super::pace::{PATIENCE, stopped, timed};
use super::time_limit;
use crate::arguments::CompareArguments;
use crate::commands::ask::refuse_strangers;
use crate::commands::in_units::scales;
use crate::commands::job::{Job, judge_places};
use crate::commands::progress::Progress;
use crate::commands::raster::{files_read, question};
use crate::commands::surface::evenly;
use crate::failure::{Failure, Typed};
use serde_json::Value;
use std::ops::ControlFlow;
use std::time::Instant;
use stickslip::{
    Document, GridName, GridWork, Physical, Raster, RasterCompareDocument, RasterCompareFound,
    RasterCompareParameters, RasterCompared,
};
use stickslip_grid::{GridError, Layer, RowMethod, Scan, ScanLine, Scanned, Stepping, scan};
use stickslip_raster::{Line, Path, Plan, RasterError, Scanning};

/// Number of heights compared on each row.
const POINTS: usize = 501;

pub(super) fn compare(arguments: &CompareArguments) -> Result<(), Failure> {
    let CompareArguments { options, area, disturbance, answer: place, .. } = arguments;
    judge_places(&place.outlet, place.plot.as_deref(), &files_read(options, area))?;
    let values = options.values()?;
    refuse_strangers::<Raster, _>(options, &values, "a raster (--lines or --area)")?;
    let tip_file = options.tip.tip_file.as_deref();
    let scales = scales(&place.in_units, tip_file, values.get("r").and_then(Value::as_f64))?;
    let (parameters, plan) =
        question(options, values, (area, &disturbance.pulse), scales.as_ref())?;
    if let Some(stiffness) = parameters.stiffness_across {
        let message = "there is no grid for a tip that is free to move across: leave it out";
        return Err(Failure::input(format!("--stiffness-across {}", Typed(stiffness)), message));
    }
    let sampling = &parameters.sampling;
    let (stepping, limit) = (stepping(arguments, parameters.tolerance)?, time_limit(arguments)?);
    let (grid, method) = method(arguments.grid)?;
    let spacing = spacing(arguments, method, &plan)?;
    // Its own steps, unless times are asked for, which it would have to step to.
    let is_asked = sampling.sample_at.is_some() || sampling.sample_every.is_some();
    let times = if is_asked { parameters.times(&plan)? } else { vec![] };
    let job = Job::open::<RasterCompareDocument>(&place.outlet, place.plot.as_deref())?;
    let (low, high) = plan.area.ends();
    let x = evenly(low - plan.reach_across(), high + plan.reach_across(), POINTS);
    let (lines, seconds) = closed(&plan, limit)?;
    let (scanned, grid_seconds) =
        on_cells(&plan, (method, spacing), &stepping, (&times, &x), limit)?;
    let work = GridWork {
        steps: scanned.work.steps,
        rejected: scanned.work.rejected,
        right_hand_sides: scanned.work.right_hand_sides,
        cells_updated: scanned.work.cells_updated,
        seconds: grid_seconds,
    };
    let asked_for = |x0: &Vec<f64>| times.iter().copied().zip(x0.iter().copied()).collect();
    let motions = if is_asked { scanned.x0.iter().map(asked_for).collect() } else { scanned.steps };
    let compared = RasterCompared { x, motions, y: scanned.y, u: scanned.u, work };
    let tolerance = Some(stepping.atol).filter(|atol| atol.is_finite());
    let (grid_tolerance, step) = (tolerance, arguments.step);
    let parameters =
        RasterCompareParameters { raster: parameters, grid, spacing, grid_tolerance, step };
    let found = RasterCompareFound::new((&plan, &lines, seconds), compared);
    let document: RasterCompareDocument = Document::new(parameters, found, vec![]);
    job.finish(document.in_units(scales.as_ref()))
}

/// The discretisation along x: exact to round-off, or of second order.
fn method(asked: GridName) -> Result<(GridName, RowMethod), Failure> {
    match asked {
        GridName::Spectral | GridName::Sinc => Ok((GridName::Sinc, RowMethod::Sinc)),
        GridName::Windowed => Ok((GridName::Windowed, RowMethod::ThreePoint)),
        GridName::Uniform => {
            let message = "is not available for a raster: take sinc (exact along x) or windowed (second order)";
            Err(Failure::input("--grid uniform", message))
        }
    }
}

/// Δx: by default the widest that is exact to round-off, or a fiftieth of it for second order.
fn spacing(arguments: &CompareArguments, method: RowMethod, plan: &Plan) -> Result<f64, Failure> {
    let bands = plan.footprint.layers().iter().map(|layer| layer.along.band());
    let exact = std::f64::consts::PI / bands.fold(0.0, f64::max);
    match arguments.spacing {
        None if method == RowMethod::Sinc => Ok(exact),
        None => Ok(0.02 * exact),
        Some(spacing) if spacing > 0.0 && spacing <= exact => Ok(spacing),
        Some(spacing) => Err(Failure::input(
            format!("--spacing {}", Typed(spacing)),
            format!("must be above 0, and at most {exact:.4} for cells that hold this tip"),
        )),
    }
}

/// All lines, and their computing time.
fn closed(plan: &Plan, limit: f64) -> Result<(Vec<Line>, f64), Failure> {
    let failed = |error: RasterError| Failure::Run(error.to_string());
    timed(|| {
        let clock = Instant::now();
        let mut scanning = Scanning::new(plan).map_err(failed)?;
        while scanning.next_line().map_err(failed)?.is_some() {
            let done = scanning.lines().len() as f64;
            too_slow(clock, done, plan.lines(), limit).map_or(Ok(()), Err)?;
        }
        // A cancelled scan has no next line either.
        stopped().map_or(Ok(()), Err)?;
        let seconds = clock.elapsed().as_secs_f64();
        Ok((scanning.into_lines(), seconds))
    })
}

fn on_cells(
    plan: &Plan,
    rows: (RowMethod, f64),
    stepping: &Stepping,
    asked: (&[f64], &[f64]),
    limit: f64,
) -> Result<(Scanned, f64), Failure> {
    type Function<'a> = Box<dyn Fn(f64) -> f64 + 'a>;
    let parts = plan.footprint.layers();
    let functions: Vec<(Function, Function)> = parts
        .iter()
        .map(|part| -> (Function, Function) {
            (Box::new(|x| part.along.value(x)), Box::new(|y| part.across.value(y)))
        })
        .collect();
    let layers: Vec<Layer> =
        functions.iter().map(|(along, across)| Layer { along, across }).collect();
    let way = |n: usize| {
        let track = plan.track(n);
        ScanLine { y: track.y, from: track.start, to: track.x(track.length) }
    };
    let lines: Vec<ScanLine> = (0..plan.lines()).map(way).collect();
    let (model, wider) = (&plan.law.model, plan.law.model.wider());
    let reach = plan.footprint.layers().iter().filter_map(|layer| layer.along.reach());
    let problem = Scan {
        model: (model.alpha(), model.r()),
        law: (wider.depth_limit, wider.healing_time, wider.inertia),
        layers: &layers,
        reach: (reach.fold(0.0, f64::max), plan.reach_across()),
        lines: &lines,
        zigzag: plan.path == Path::Zigzag,
        force: &|t| plan.disturbance.value(t),
    };
    let clock = Instant::now();
    let mut failure = None;
    let mut progress = Progress::new(0.0, lines.len() as f64).at_every_call();
    let mut watch = |done: f64| {
        progress.counted(done, || format!("grid: {} of {} lines", done.floor(), lines.len()));
        failure = too_slow(clock, done, lines.len(), limit);
        if failure.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let scanned = scan(&problem, rows, stepping, asked, &mut watch);
    let seconds = clock.elapsed().as_secs_f64();
    match (failure, scanned) {
        (Some(failure), _) => Err(failure),
        (None, scanned) => Ok((scanned.map_err(explain)?, seconds)),
    }
}

/// An error if the pace predicts a time beyond the limit, or if the work is cancelled.
fn too_slow(clock: Instant, done: f64, lines: usize, limit: f64) -> Option<Failure> {
    if let Some(failure) = stopped() {
        return Some(failure);
    }
    let seconds = clock.elapsed().as_secs_f64();
    let needed = seconds * lines as f64 / done;
    // Before a line is done nobody knows what lines take.
    let is_known = done >= 1.0 && seconds >= PATIENCE.min(limit) && needed > limit;
    if !is_known && seconds <= limit {
        return None;
    }
    let fewer = (0.5 * limit * done / seconds).floor().max(1.0);
    Some(Failure::input(
        format!("--time-limit {}", Typed(limit)),
        format!("this would take about {needed:.0} s: take about {fewer} lines, or a higher limit"),
    ))
}

fn explain(error: GridError) -> Failure {
    let advice = "another --step or --grid-tolerance, or fewer lines, may help: a deep groove is stiff, and the grid \
    is explicit";
    Failure::Run(format!("grid: {error}; {advice}"))
}
