//! `stickslip compare`.

mod closed;
mod grid;
mod pace;
mod raster;

use super::ask::{context, refusal, refuse_strangers};
use super::job::{Job, judge_places};
use super::run::disturbance::{disturbed, files_read, warn_of_idle};
use crate::arguments::CompareArguments;
use crate::commands::in_units::scales;
use crate::failure::{Failure, Typed};
use crate::files::distinct::Named;
use closed::Closed;
use grid::{Discretisation, Motion};
use serde_json::{Map, Value};
use stickslip::{
    Ask, CompareDocument, CompareFound, CompareParameters, DifferenceDocument, Document,
    KnownScales, Physical, Run, parameter,
};
use stickslip_tip::Scenario;

/// Number of heights compared.
const POINTS: usize = 2001;

pub(crate) fn compare(arguments: &CompareArguments) -> Result<(), Failure> {
    let CompareArguments { options, area, answer: place, .. } = arguments;
    if options.has("lines") || area.area.is_some() {
        return raster::compare(arguments);
    }
    judge_places(&place.outlet, place.plot.as_deref(), &files(arguments))?;
    let values = options.values()?;
    let tip_file = options.tip.tip_file.as_deref();
    let scales = scales(&place.in_units, tip_file, values.get("r").and_then(Value::as_f64))?;
    let asked = Asked::of(arguments, values, scales.as_ref())?;
    let job = Job::open::<CompareDocument>(&place.outlet, place.plot.as_deref())?;
    let closed = closed::run(&asked)?;
    let x = asked.positions(&closed)?;
    let motion = grid::run(&asked, &x)?;
    let document = document(arguments, &asked, &closed, motion, x)?;
    job.finish(document.in_units(scales.as_ref()))
}

/// The checked options.
struct Asked {
    question: Run,
    scenario: Scenario,
    discretisation: Discretisation,
    /// Time at which the grid ends.
    grid_until: f64,
    /// Time limit of either side, in seconds.
    time_limit: f64,
}

impl Asked {
    fn of(
        arguments: &CompareArguments,
        values: Map<String, Value>,
        scales: Option<&KnownScales>,
    ) -> Result<Self, Failure> {
        let (question, scenario) = run_of(arguments, values, scales)?;
        warn_of_idle(&arguments.disturbance, &question, (scenario.start_time(), scenario.until));
        let discretisation =
            Discretisation::of(arguments, question.tolerance, scenario.model.tip())?;
        let start = scenario.start_time();
        let grid_until = arguments.grid_until.unwrap_or(scenario.until);
        if !(grid_until > start && grid_until <= scenario.until) {
            return Err(Failure::input(
                format!("--grid-until {}", Typed(grid_until)),
                format!("must lie between the start at t = {start} and --until"),
            ));
        }
        let (longest, step) = (grid_until - start, arguments.step.unwrap_or(0.0));
        if step > longest {
            return Err(Failure::input(
                format!("--step {}", Typed(step)),
                format!("is longer than the run of the grid: must be at most {}", Typed(longest)),
            ));
        }
        let time_limit = time_limit(arguments)?;
        Ok(Self { question, scenario, discretisation, grid_until, time_limit })
    }

    /// Positions at which the surfaces are compared: all within reach of the tip during the run.
    fn positions(&self, closed: &Closed) -> Result<Vec<f64>, Failure> {
        let times = super::surface::evenly(self.scenario.start_time(), self.grid_until, POINTS);
        let x0 = times.iter().map(|t| closed.trajectory.x0(*t));
        let (low, high) =
            x0.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let reach = self.discretisation.reach;
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
    arguments: &CompareArguments,
    values: Map<String, Value>,
    scales: Option<&KnownScales>,
) -> Result<(Run, Scenario), Failure> {
    let CompareArguments { options, disturbance, support_path, .. } = arguments;
    refuse_strangers::<Run, _>(
        options,
        &values,
        "a run: --lines N or --area FILE make it a raster",
    )?;
    let run: Run = parameter::question(values)?;
    if let Some(stiffness) = run.stiffness_across {
        let message = "there is no grid for a tip that gives way across the scan: leave it out";
        return Err(Failure::input(format!("--stiffness-across {}", Typed(stiffness)), message));
    }
    let run = disturbed(run, disturbance, support_path.as_deref(), scales)?;
    let files = files(arguments);
    let refused = |failure| refusal(failure, &options.tip, &files);
    let run = run.resolved(&context()).map_err(refused)?;
    let scenario = run.prepared().map_err(refused)?;
    let initial = scenario.initial_surface();
    initial.map_err(|error| refused(run.refused(&error)))?;
    Ok((run, scenario))
}

/// Time limit of either side, in seconds.
fn time_limit(arguments: &CompareArguments) -> Result<f64, Failure> {
    let time_limit = arguments.time_limit;
    if time_limit.is_nan() || time_limit <= 0.0 {
        return Err(Failure::input(
            format!("--time-limit {}", Typed(time_limit)),
            "must be a number of seconds above 0",
        ));
    }
    Ok(time_limit)
}

fn document(
    arguments: &CompareArguments,
    asked: &Asked,
    closed: &Closed,
    motion: Motion,
    x: Vec<f64>,
) -> Result<CompareDocument, Failure> {
    let Motion { t, grid } = motion;
    let closed_document = closed.document(&asked.scenario, &t, asked.grid_until, &x)?;
    let spans = [asked.grid_until, asked.scenario.until].map(|t| t - asked.scenario.start_time());
    let rates = [grid.work.seconds / spans[0], closed_document.work.seconds / spans[1]];
    let max_difference = DifferenceDocument {
        x0: largest_difference(&closed_document.x0, &grid.x0),
        u: largest_difference(&closed_document.u, &grid.u),
    };
    if !(max_difference.x0.is_finite() && max_difference.u.is_finite()) {
        let advice = "the grid's motion is no longer finite: shorten --step, or leave it out";
        return Err(Failure::Run(advice.into()));
    }
    let (parameters, speedup) = (parameters(arguments, asked), rates[0] / rates[1]);
    Ok(Document::new(
        parameters,
        CompareFound { t, x, closed: closed_document, grid, max_difference, speedup },
        vec![],
    ))
}

/// The largest difference; NaN if either value is NaN.
fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |most, d| if d.is_nan() || d > most { d } else { most })
}

fn parameters(arguments: &CompareArguments, asked: &Asked) -> CompareParameters {
    CompareParameters {
        run: asked.question.clone(),
        grid: arguments.grid,
        spacing: asked.discretisation.spacing,
        grid_tolerance: asked.discretisation.tolerance(),
        step: arguments.step,
        grid_until: asked.grid_until,
    }
}
