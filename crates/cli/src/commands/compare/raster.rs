//! `stickslip compare --lines`: a raster against the full equations on rows of cells, or on a plane of
//! cells if the tip is free to move across the lines.

use super::grid::{grid_work, stepping};
use super::pace::{Pace, Unit, Watch, stopped, timed};
use super::plane::{self, Plane};
use super::time_limit;
use crate::arguments::CompareArguments;
use crate::commands::ask::refuse_unknown;
use crate::commands::job::{Job, judge_places};
use crate::commands::raster::{files_read, question};
use crate::commands::surface::evenly;
use crate::failure::Failure;
use crate::session::Session;
use serde_json::{Map, Value};
use stickslip::{
    Document, GridName, Physical, Raster, RasterCompareDocument, RasterCompareFound,
    RasterCompareParameters, RasterCompared,
};
use stickslip_grid::{
    GridError, Layer, PlaneScan, RowMethod, Scan, ScanLine, Stepping, scan, scan_plane,
};
use stickslip_raster::{Free, Line, Path, Plan, Scanning};
use stickslip_tip::sorting::sort_numbers;
use stickslip_tip::tip_function::BAND_OF_A_GAUSSIAN;

/// Number of heights compared on each row.
const POINTS: usize = 501;

pub(super) fn compare(
    session: &Session,
    arguments: &CompareArguments,
    values: Map<String, Value>,
) -> Result<(), Failure> {
    let CompareArguments { options, area, disturbance, answer: place, .. } = arguments;
    judge_places(&place.outlet, place.plot.as_deref(), &files_read(options, area))?;
    refuse_unknown::<Raster, _>(options, &values, "a raster (--lines or --area)")?;
    let scales = options.scales(session, &place.in_units, &values)?;
    let (parameters, plan) =
        question(session, options, values, (area, &disturbance.pulse), scales.as_ref())?;
    let sampling = &parameters.sampling;
    let (stepping, limit) = (stepping(arguments, parameters.tolerance)?, time_limit(arguments)?);
    let cells = Cells::of(arguments, &plan)?;
    // The steps of the grid itself, unless times are requested, at which it would have to stop.
    let is_requested = sampling.sample_at.is_some() || sampling.sample_every.is_some();
    let times = if is_requested { parameters.times(&plan)? } else { vec![] };
    let job =
        Job::open(session, RasterCompareDocument::FORMAT, &place.outlet, place.plot.as_deref())?;
    let (low, high) = plan.area.ends();
    let x = evenly(low - plan.reach_across(), high + plan.reach_across(), POINTS);
    let (lines, seconds) = closed(&plan, limit)?;
    let comparison = Comparison { session, plan: &plan, stepping, times, x, limit };
    let compared = match (&plan.free, &cells.plane) {
        (Some(free), Some(plane)) => on_cells(&comparison, free, plane)?,
        _ => on_rows(&comparison, (cells.rows, cells.spacing))?,
    };
    let tolerance = Some(stepping.atol).filter(|atol| atol.is_finite());
    let (grid_tolerance, step) = (tolerance, arguments.step);
    let (grid, spacing) = (cells.grid, cells.spacing);
    let parameters =
        RasterCompareParameters { raster: parameters, grid, spacing, grid_tolerance, step };
    let found = RasterCompareFound::new((&plan, &lines, seconds), compared);
    let document: RasterCompareDocument = Document::new(parameters, found, vec![]);
    job.finish(document.in_units(scales.as_ref()))
}

/// The problem of the grid.
struct Comparison<'a> {
    session: &'a Session,
    plan: &'a Plan,
    stepping: Stepping,
    /// Times on each line; without any, the ends of its steps.
    times: Vec<f64>,
    x: Vec<f64>,
    limit: f64,
}

/// The discretisation: rows of cells, or a plane if the tip is free to move across.
struct Cells {
    grid: GridName,
    rows: RowMethod,
    plane: Option<Plane>,
    /// Δx
    spacing: f64,
}

impl Cells {
    fn of(arguments: &CompareArguments, plan: &Plan) -> Result<Self, Failure> {
        let (on_rows, rows) = method(arguments.grid, plan)?;
        let spacing = spacing(arguments, rows, plan)?;
        if plan.free.is_none() {
            return Ok(Self { grid: on_rows, rows, plane: None, spacing });
        }
        let plane = Plane::of(arguments.grid, spacing, &plan.footprint)?;
        Ok(Self { grid: arguments.grid, rows, plane: Some(plane), spacing })
    }
}

/// The discretisation along x: exact to round-off, or of second order.
fn method(name: GridName, plan: &Plan) -> Result<(GridName, RowMethod), Failure> {
    match name {
        GridName::Spectral | GridName::Sinc => Ok((GridName::Sinc, RowMethod::Sinc)),
        GridName::Windowed => Ok((GridName::Windowed, RowMethod::ThreePoint)),
        GridName::Uniform if plan.free.is_some() => Err(plane::uniform_refused()),
        GridName::Uniform => {
            let message = "is not available for a raster: take sinc (exact along x) or windowed (second order)";
            Err(Failure::input("--grid uniform", message))
        }
    }
}

/// Δx: by default the widest that is exact to round-off, or a fraction of it for second order.
fn spacing(arguments: &CompareArguments, method: RowMethod, plan: &Plan) -> Result<f64, Failure> {
    let bands = plan.footprint.layers().iter().map(|layer| layer.along.band());
    let band = bands.fold(0.0, f64::max);
    let exact = std::f64::consts::PI / band;
    let second_order = match plan.free {
        None => 0.02 * exact,
        Some(_) => plane::SECOND_ORDER * BAND_OF_A_GAUSSIAN / band,
    };
    match arguments.spacing {
        None if method == RowMethod::Sinc => Ok(exact),
        None => Ok(second_order),
        Some(spacing) if spacing > 0.0 && spacing <= exact => Ok(spacing),
        Some(spacing) => Err(Failure::number(
            "--spacing",
            spacing,
            format!("must be above 0, and at most {exact:.4} for cells that hold this tip"),
        )),
    }
}

/// All lines, and their computing time.
fn closed(plan: &Plan, limit: f64) -> Result<(Vec<Line>, f64), Failure> {
    timed(|| {
        let pace = Pace::new(Unit::Lines, (0.0, plan.lines() as f64), limit);
        let mut scanning = Scanning::new(plan).map_err(Failure::run)?;
        while scanning.next_line().map_err(Failure::run)?.is_some() {
            pace.judge(scanning.lines().len() as f64)?;
        }
        // A cancelled scan has no next line either.
        stopped()?;
        let seconds = pace.seconds();
        Ok((scanning.into_lines(), seconds))
    })
}

/// The lines of a plan in the types of the grid.
fn scan_lines(plan: &Plan) -> Vec<ScanLine> {
    let way = |n: usize| {
        let track = plan.track(n);
        ScanLine { y: track.y, from: track.start, to: track.x(track.length) }
    };
    (0..plan.lines()).map(way).collect()
}

/// The raster of a tip that is held on its lines, on rows of cells.
fn on_rows(comparison: &Comparison, rows: (RowMethod, f64)) -> Result<RasterCompared, Failure> {
    let Comparison { plan, stepping, times, x, .. } = comparison;
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
    let lines = scan_lines(plan);
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
    let mut watch = watch(comparison);
    let mut line = |done: f64| watch.reached(done);
    let scanned = scan(&problem, rows, stepping, (times, x), &mut line);
    let (scanned, seconds) = watch.ended(scanned.map_err(explain))?;
    let on_line = |(line, motion): (&ScanLine, Vec<(f64, f64)>)| {
        motion.into_iter().map(|(t, x0)| (t, [x0, line.y])).collect()
    };
    let motions = motions(times, scanned.steps, &scanned.x0);
    Ok(RasterCompared {
        x: x.clone(),
        motions: lines.iter().zip(motions).map(on_line).collect(),
        y: scanned.y,
        u: scanned.u,
        work: grid_work(&scanned.work, seconds),
    })
}

/// The motion on each line: at the requested times, if any, or else at the ends of steps.
fn motions<P: Copy>(
    times: &[f64],
    steps: Vec<Vec<(f64, P)>>,
    at_times: &[Vec<P>],
) -> Vec<Vec<(f64, P)>> {
    if times.is_empty() {
        return steps;
    }
    let line = |at: &Vec<P>| times.iter().copied().zip(at.iter().copied()).collect();
    at_times.iter().map(line).collect()
}

/// The observer of a grid's lines.
fn watch(comparison: &Comparison) -> Watch {
    let Comparison { session, plan, limit, .. } = comparison;
    Watch::new(session, Unit::Lines, (0.0, plan.lines() as f64), *limit)
}

fn explain(error: GridError) -> Failure {
    if let GridError::Cells(_) = error {
        return Failure::input("--spacing", format!("{error}; take a wider one, or fewer lines"));
    }
    let advice = "another --step or --grid-tolerance, or fewer lines, may help: a deep groove is stiff, and the grid \
    is explicit";
    Failure::Run(format!("grid: {error}; {advice}"))
}

fn on_cells(
    comparison: &Comparison,
    free: &Free,
    plane: &Plane,
) -> Result<RasterCompared, Failure> {
    let Comparison { plan, stepping, times, x, .. } = comparison;
    let (model, wider) = (&plan.law.model, plan.law.model.wider());
    let lines = scan_lines(plan);
    let mut y: Vec<f64> = lines.iter().map(|line| line.y).collect();
    sort_numbers(&mut y);
    y.dedup();
    plane.fit(x[x.len() - 1] - x[0], (y[0], y[y.len() - 1]))?;
    let scan = PlaneScan {
        model: (model.alpha(), model.r()),
        law: (wider.depth_limit, wider.healing_time, wider.inertia),
        stiffness_across: free.stiffness,
        products: &plane.products,
        lines: &lines,
        zigzag: plan.path == Path::Zigzag,
        kick: free.kick,
        force: &|t| [plan.disturbance.value(t), free.disturbance.value(t)],
    };
    let points: Vec<[f64; 2]> = y.iter().flat_map(|y| x.iter().map(|x| [*x, *y])).collect();
    let mut watch = watch(comparison);
    let mut line = |done: f64| watch.reached(done);
    let scanned = scan_plane(&scan, &plane.method, stepping, (times, &points), &mut line);
    let (scanned, seconds) = watch.ended(scanned.map_err(explain))?;
    let motions = motions(times, scanned.steps, &scanned.position);
    let u = scanned.u.chunks(x.len()).map(<[f64]>::to_vec).collect();
    Ok(RasterCompared { x: x.clone(), motions, y, u, work: grid_work(&scanned.work, seconds) })
}
