//! `stickslip compare --stiffness-across`: a tip that is free to move across the scan, against cells of a plane.

use super::closed::closed_work;
use super::grid::{Discretisation, Motion, Samples, explain, grid_work, watch, wider};
use super::pace::{Unit, Watch, timed};
use super::plane::Plane;
use super::{Comparison, Sides};
use crate::failure::Failure;
use stickslip::{ClosedDocument, GridDocument};
use stickslip_grid::{
    PlaneMethod, PlaneProblem, PlaneRequest, PlaneStart, Product, Wider, solve_plane,
};
use stickslip_surface::SurfaceAcross;
use stickslip_tip::planar::{
    PlanarError, PlanarRunning, PlanarScenario, Step, Texture, Trajectory,
};
use stickslip_tip::{Start, Work};

/// Both sides of a tip that is free to move across the scan; the surfaces are those on the line y = 0.
pub(super) fn sides(comparison: &Comparison, scenario: &PlanarScenario) -> Result<Sides, Failure> {
    let Discretisation { name, spacing, .. } = comparison.discretisation;
    let footprint = scenario.along.model.tip().footprint();
    let footprint = footprint.ok_or(PlanarError::NoFootprint);
    let footprint = footprint.map_err(|error| comparison.question.refused_across(error))?;
    let plane = Plane::of(name, spacing, footprint)?;
    let closed = Closed::of(comparison, scenario)?;
    let x = comparison.positions(|t| closed.trajectory.x0(t))?;
    plane.fit(x[x.len() - 1] - x[0], comparison.range(|t| closed.trajectory.y0(t)))?;
    let motion = on_cells(comparison, scenario, (&plane.products, &plane.method), &x)?;
    let closed = closed.document(scenario, &motion.t, comparison.grid_until, &x)?;
    Ok(Sides { x, closed, motion })
}

/// A finished run of the closed equation and its time.
struct Closed {
    trajectory: Trajectory,
    work: Work,
    memory: &'static str,
    seconds: f64,
}

impl Closed {
    fn of(comparison: &Comparison, scenario: &PlanarScenario) -> Result<Self, Failure> {
        let ((steps, work, memory), seconds) = timed(|| steps(comparison, scenario))?;
        let along = &scenario.along;
        let trajectory = Trajectory::under(*along.model.wider(), along.support(), steps);
        Ok(Self { trajectory, work, memory, seconds })
    }

    /// The document: x0 and y0 at the times t, u at the positions x on the line y = 0 at the time `end`.
    fn document(
        &self,
        scenario: &PlanarScenario,
        t: &[f64],
        end: f64,
        x: &[f64],
    ) -> Result<ClosedDocument, Failure> {
        let Self { trajectory, work, memory, seconds } = self;
        let surface = SurfaceAcross::new(scenario, trajectory).map_err(Failure::run)?;
        let u = surface.image(end.min(trajectory.end()), x, &[0.0]);
        Ok(ClosedDocument {
            x0: t.iter().map(|t| trajectory.x0(*t)).collect(),
            y0: Some(t.iter().map(|t| trajectory.y0(*t)).collect()),
            u: u.map_err(Failure::run)?.into_iter().collect(),
            work: closed_work(work, (*memory).into(), *seconds),
        })
    }
}

/// The steps of a run with their counts and the memory.
type Made = (Vec<Step>, Work, &'static str);

/// A run and its time in seconds.
fn steps(comparison: &Comparison, scenario: &PlanarScenario) -> Result<(Made, f64), Failure> {
    let refused = |error| comparison.question.refused_across(error);
    let span = (scenario.along.start_time(), scenario.along.until);
    let mut watch =
        Watch::new(comparison.session, Unit::Time("--until"), span, comparison.time_limit);
    watch = watch.of_short_steps();
    let mut integrate = || -> Result<Made, Failure> {
        let (mut running, mut steps) = (PlanarRunning::new(scenario).map_err(refused)?, vec![]);
        while let Some(step) = running.step().map_err(refused)? {
            steps.push(step);
            if watch.reached(step.end()).is_break() {
                break;
            }
        }
        Ok((steps, running.work(), running.memory().0))
    };
    let made = integrate();
    watch.ended(made)
}

/// Runs the grid from the scenario's initial condition.
fn on_cells(
    comparison: &Comparison,
    scenario: &PlanarScenario,
    (products, method): (&[Product], &PlaneMethod),
    x: &[f64],
) -> Result<Motion, Failure> {
    let PlanarScenario { along, stiffness_across, force_across, .. } = scenario;
    let model = (along.model.alpha(), along.model.r());
    let support = along.support();
    let position = |t: f64| support.position(t);
    let law = wider(along, &position);
    let texture = scenario.texture().map_err(Failure::run)?;
    let start = start(scenario, &law, products, texture);
    let problem = PlaneProblem {
        model,
        stiffness_across: *stiffness_across,
        line: 0.0,
        products,
        wider: law,
        force: &|t| [along.force.value(t), force_across.value(t)],
        start,
    };
    let points: Vec<[f64; 2]> = x.iter().map(|x| [*x, 0.0]).collect();
    let request = PlaneRequest { times: &[comparison.grid_until], points: &points };
    let ((run, samples), seconds) = timed(|| {
        let (mut watch, mut samples) = (watch(comparison), Samples::default());
        let mut step = |t: f64, at: [f64; 2]| {
            samples.take(t, at);
            watch.reached(t)
        };
        let stepping = &comparison.discretisation.stepping;
        let run = solve_plane(&problem, method, stepping, &request, &mut step);
        watch.ended(run.map(|run| (run, samples)).map_err(|error| explain(comparison, error)))
    })?;
    let work = grid_work(&run.work, seconds);
    let [x0, y0] = [0, 1].map(|axis| samples.column(axis));
    Ok(Motion { t: samples.t, grid: GridDocument { x0, y0: Some(y0), u: run.u, work } })
}

/// The initial condition for the grid. Texture and force are those of the closed equation's data.
fn start<'a>(
    scenario: &PlanarScenario,
    law: &Wider,
    products: &'a [Product],
    texture: Texture,
) -> PlaneStart<'a> {
    let along = &scenario.along;
    let start = match along.start {
        Start::Steady => {
            let model = (along.model.alpha(), along.model.r());
            PlaneStart::steady(law, model, products, along.start_position)
        }
        Start::Flat => PlaneStart::flat(along.start_time(), [along.start_position, 0.0]),
    };
    let start = start.displaced([-along.kick, scenario.kick_across]);
    if texture.is_flat() {
        return start;
    }
    let (time, position) = (start.time, start.position);
    PlaneStart::new(time, position, move |at| {
        let (carved, texture) = (start.surface(at), texture.height_and_slopes(at[0], at[1]));
        [0, 1, 2].map(|i| carved[i] + texture[i])
    })
}
