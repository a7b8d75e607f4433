//! `stickslip compare`.

mod across;
mod closed;
mod grid;
mod pace;
mod plane;
mod raster;

use super::ask::{option, refusal, refuse_unknown};
use super::job::{Job, judge_places};
use super::run::disturbance::{disturbed, files_read};
use crate::arguments::CompareArguments;
use crate::failure::{Failure, Typed};
use crate::files::distinct::Named;
use crate::session::Session;
use grid::{Discretisation, Motion};
use serde_json::{Map, Value};
use stickslip::{
    ClosedDocument, CompareDocument, CompareFound, CompareParameters, DifferenceDocument, Document,
    GridName, KnownScales, Physical, Run, RunScenario, parameter,
};
use stickslip_tip::Scenario;
use stickslip_tip::sorting::ends;

/// Number of heights compared.
const POINTS: usize = 2001;

pub(crate) fn compare(session: &Session, arguments: &CompareArguments) -> Result<(), Failure> {
    let CompareArguments { options, area, answer: place, .. } = arguments;
    let values = options.values(session)?;
    if values.get("lines").is_some_and(|lines| !lines.is_null()) || area.area.is_some() {
        return raster::compare(session, arguments, values);
    }
    judge_places(&place.outlet, place.plot.as_deref(), &files(arguments))?;
    let scales = options.scales(session, &place.in_units, &values)?;
    let comparison = Comparison::of(session, arguments, values, scales.as_ref())?;
    let job = Job::open(session, CompareDocument::FORMAT, &place.outlet, place.plot.as_deref())?;
    let sides = match &comparison.scenario {
        RunScenario::Along(scenario) => on_its_line(&comparison, scenario)?,
        RunScenario::Across(scenario) => across::sides(&comparison, scenario)?,
    };
    let document = document(arguments, &comparison, sides)?;
    job.finish(document.in_units(scales.as_ref()))
}

/// Results of both sides, closed equation and grid, and the positions of their surfaces.
struct Sides {
    x: Vec<f64>,
    closed: ClosedDocument,
    motion: Motion,
}

/// Both sides of a tip that is held on its line.
fn on_its_line(comparison: &Comparison, scenario: &Scenario) -> Result<Sides, Failure> {
    let closed = closed::run(comparison, scenario)?;
    let x = comparison.positions(|t| closed.run.trajectory.x0(t))?;
    let motion = grid::run(comparison, scenario, &x)?;
    let closed = closed.document(scenario, &motion.t, comparison.grid_until, &x)?;
    Ok(Sides { x, closed, motion })
}

/// The checked options.
struct Comparison<'a> {
    session: &'a Session,
    question: Run,
    scenario: RunScenario,
    discretisation: Discretisation,
    /// Time at which the grid ends.
    grid_until: f64,
    /// Time limit of each side, in seconds.
    time_limit: f64,
}

impl<'a> Comparison<'a> {
    fn of(
        session: &'a Session,
        arguments: &CompareArguments,
        values: Map<String, Value>,
        scales: Option<&KnownScales>,
    ) -> Result<Self, Failure> {
        let (question, whole) = run_of(session, arguments, values, scales)?;
        for name in ["sample_every", "sample_at"] {
            if arguments.options.has(name) {
                session.remark(format_args!(
                    "stickslip: {} has no effect on one run: its samples are at the steps of the grid",
                    option(name)
                ));
            }
        }
        let scenario = whole.along();
        let second_order = match whole {
            RunScenario::Along(_) => grid::SECOND_ORDER,
            RunScenario::Across(_) if arguments.grid == GridName::Uniform => {
                return Err(plane::uniform_refused());
            }
            RunScenario::Across(_) => plane::SECOND_ORDER,
        };
        let (usual, tip) = (question.tolerance, scenario.model.tip());
        let discretisation = Discretisation::of(arguments, usual, (tip, second_order))?;
        let start = scenario.start_time();
        let grid_until = arguments.grid_until.unwrap_or(scenario.until);
        if !(grid_until > start && grid_until <= scenario.until) {
            let message = format!("must lie between the start at t = {start} and --until");
            return Err(Failure::number("--grid-until", grid_until, message));
        }
        let (longest, step) = (grid_until - start, arguments.step.unwrap_or(0.0));
        if step > longest {
            let message =
                format!("is longer than the run of the grid: must be at most {}", Typed(longest));
            return Err(Failure::number("--step", step, message));
        }
        let time_limit = time_limit(arguments)?;
        Ok(Self { session, question, scenario: whole, discretisation, grid_until, time_limit })
    }

    /// Least and largest value of a coordinate until the grid ends.
    fn range(&self, coordinate: impl Fn(f64) -> f64) -> (f64, f64) {
        let times = super::surface::evenly(self.scenario.span().0, self.grid_until, POINTS);
        ends(times.into_iter().map(coordinate))
    }

    /// Positions at which the surfaces are compared: all within reach of the tip during the run.
    fn positions(&self, x0: impl Fn(f64) -> f64) -> Result<Vec<f64>, Failure> {
        let ((low, high), reach) = (self.range(x0), self.discretisation.reach);
        self.discretisation.fits(high - low + 2.0 * reach)?;
        Ok(super::surface::evenly(low - reach, high + reach, POINTS))
    }
}

/// The files that the command reads.
fn files(arguments: &CompareArguments) -> Vec<Named<'_>> {
    let CompareArguments { options, disturbance, support_path, .. } = arguments;
    let [tip_file, parameters] = options.files();
    let read = files_read(tip_file.1, disturbance, support_path.as_deref());
    [&read[..], &[parameters]].concat()
}

/// The run that both sides compute.
fn run_of(
    session: &Session,
    arguments: &CompareArguments,
    values: Map<String, Value>,
    scales: Option<&KnownScales>,
) -> Result<(Run, RunScenario), Failure> {
    let CompareArguments { options, disturbance, support_path, .. } = arguments;
    refuse_unknown::<Run, _>(options, &values, "a run: --lines N or --area FILE make it a raster")?;
    let run: Run = parameter::question(values)?;
    let files = files(arguments);
    let refused = |failure| refusal(failure, &options.tip, &files);
    let disturbance = (disturbance, support_path.as_deref());
    let (run, scenario) = disturbed(session, run, disturbance, scales, refused)?;
    match &scenario {
        RunScenario::Along(scenario) => {
            scenario.initial_surface().map_err(|error| refused(run.refused(&error)))?;
        }
        RunScenario::Across(scenario) => {
            scenario.texture().map_err(|error| refused(run.refused_across(error)))?;
        }
    }
    Ok((run, scenario))
}

/// Time limit of each side, in seconds.
fn time_limit(arguments: &CompareArguments) -> Result<f64, Failure> {
    let time_limit = arguments.time_limit;
    if time_limit.is_nan() || time_limit <= 0.0 {
        let message = "must be a number of seconds above 0";
        return Err(Failure::number("--time-limit", time_limit, message));
    }
    Ok(time_limit)
}

fn document(
    arguments: &CompareArguments,
    comparison: &Comparison,
    sides: Sides,
) -> Result<CompareDocument, Failure> {
    let Sides { x, closed, motion: Motion { t, grid } } = sides;
    let (start, until) = comparison.scenario.span();
    let spans = [comparison.grid_until, until].map(|t| t - start);
    let rates = [grid.work.seconds / spans[0], closed.work.seconds / spans[1]];
    let across = closed.y0.as_ref().zip(grid.y0.as_ref());
    let max_difference = DifferenceDocument {
        x0: largest_difference(&closed.x0, &grid.x0),
        y0: across.map(|(closed, grid)| largest_difference(closed, grid)),
        u: largest_difference(&closed.u, &grid.u),
    };
    let DifferenceDocument { x0, y0, u } = max_difference;
    if !(x0.is_finite() && y0.is_none_or(f64::is_finite) && u.is_finite()) {
        let advice = "the grid's motion is no longer finite: shorten --step, or leave it out";
        return Err(Failure::Run(advice.into()));
    }
    let parameters = CompareParameters {
        run: comparison.question.clone(),
        grid: arguments.grid,
        spacing: comparison.discretisation.spacing,
        grid_tolerance: comparison.discretisation.tolerance(),
        step: arguments.step,
        grid_until: comparison.grid_until,
    };
    let speedup = rates[0] / rates[1];
    let found = CompareFound { t, x, closed, grid, max_difference, speedup };
    Ok(Document::new(parameters, found, vec![]))
}

/// The largest difference; NaN if either value is NaN.
fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |most, d| if d.is_nan() || d > most { d } else { most })
}
