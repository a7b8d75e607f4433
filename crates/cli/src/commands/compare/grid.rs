//! The grid's side of a comparison.

use super::Comparison;
use super::pace::{Unit, Watch, timed};
use crate::arguments::CompareArguments;
use crate::failure::{Failure, Typed};
use stickslip::{GridDocument, GridName, GridWork};
use stickslip_grid::{
    Footprint, Gaussian, GridError, Method, Path, Problem, Request, Run, Start, Stepping, Wider,
    Work, solve_observed,
};
use stickslip_tip::tip_function::BAND_OF_A_GAUSSIAN;
use stickslip_tip::{InitialSurface, Scenario, TipFunction};

/// The widest lattice spacing that is exact to round-off, in widths of the tip.
const EXACT: f64 = std::f64::consts::PI / BAND_OF_A_GAUSSIAN;
/// Default spacing of the second-order grids, in widths of the tip.
pub(super) const SECOND_ORDER: f64 = 0.01;
/// Cells on either side in the support of the sinc, for errors at round-off.
const SINC_HALF_WIDTH: usize = 80;
/// Largest number of cells: eight vectors of this length are 190 MB.
const MOST_CELLS: f64 = 3e6;
/// Number of samples to which the motion is thinned; at most twice as many are kept.
const SAMPLES: usize = 2048;

/// A checked discretisation.
pub(super) struct Discretisation {
    pub(super) name: GridName,
    gaussians: Vec<Gaussian>,
    pub(super) reach: f64,
    pub(super) spacing: f64,
    smallest_width: f64,
    pub(super) stepping: Stepping,
}

impl Discretisation {
    /// `second_order` is the default spacing of the second-order grids, in widths of the tip.
    pub(super) fn of(
        arguments: &CompareArguments,
        usual: f64,
        (tip, second_order): (&TipFunction, f64),
    ) -> Result<Self, Failure> {
        let (TipFunction::Gaussians(sum), Some(reach)) = (tip, tip.reach()) else {
            let message = "never decays, and a grid takes f as 0 beyond a reach: take a tip that decays, such \
            as triple-gaussian";
            let cosine = *tip == TipFunction::Cosine;
            let option = if cosine { "--tip cosine" } else { "--tip bessel" };
            return Err(Failure::input(option, message));
        };
        let name = arguments.grid;
        let gaussians: Vec<Gaussian> = sum
            .terms()
            .iter()
            .map(|g| Gaussian { amplitude: g.amplitude, center: g.center, width: g.width })
            .collect();
        let smallest_width = gaussians.iter().fold(f64::INFINITY, |w, g| w.min(g.width));
        let spacing = arguments.spacing.unwrap_or(match name {
            GridName::Uniform | GridName::Windowed => second_order * smallest_width,
            GridName::Spectral => EXACT * smallest_width,
            GridName::Sinc => std::f64::consts::PI / tip.band(),
        });
        if !(spacing > 0.0 && spacing <= smallest_width) {
            let message = format!(
                "must be above 0, and at most the width of the tip, {}",
                Typed(smallest_width)
            );
            return Err(Failure::number("--spacing", spacing, message));
        }
        let stepping = stepping(arguments, usual)?;
        Ok(Self { name, gaussians, reach, spacing, smallest_width, stepping })
    }

    /// Checks the number of cells over a length.
    pub(super) fn fits(&self, length: f64) -> Result<(), Failure> {
        let cells = length / self.spacing;
        if cells <= MOST_CELLS {
            return Ok(());
        }
        let message = format!(
            "would make {cells:.1e} cells, more than fit in memory; take {:.1e} or more, or a \
                 smaller --grid-until",
            length / MOST_CELLS
        );
        Err(Failure::number("--spacing", self.spacing, message))
    }

    /// Local error allowed, if steps are adaptive.
    pub(super) fn tolerance(&self) -> Option<f64> {
        Some(self.stepping.atol).filter(|atol| atol.is_finite())
    }

    fn method(&self, (from, to): (f64, f64)) -> Method {
        let spacing = self.spacing;
        match self.name {
            GridName::Uniform => Method::Uniform { spacing, from, to },
            GridName::Windowed => Method::Windowed { spacing },
            GridName::Spectral => Method::Spectral {
                gaussians: self.gaussians.clone(),
                spacing: spacing / self.smallest_width,
            },
            GridName::Sinc => Method::Sinc { spacing, half_width: SINC_HALF_WIDTH },
        }
    }
}

/// Smallest tolerance; smaller errors are round-off.
const LEAST_TOLERANCE: f64 = 1e-15;

pub(super) fn stepping(arguments: &CompareArguments, usual: f64) -> Result<Stepping, Failure> {
    match (arguments.step, arguments.grid_tolerance) {
        (Some(step), _) => Ok(Stepping::fixed(Failure::unless_positive("--step", step)?)),
        (None, Some(tolerance)) if tolerance > 0.0 && tolerance < LEAST_TOLERANCE => {
            let why = "is below round-off: the grid would never end";
            let message = format!("{why}: must be {LEAST_TOLERANCE:e} or more");
            Err(Failure::number("--grid-tolerance", tolerance, message))
        }
        (None, Some(tolerance)) => {
            Ok(Stepping::absolute(Failure::unless_positive("--grid-tolerance", tolerance)?))
        }
        (None, None) => Ok(Stepping::absolute(usual)),
    }
}

/// The motion at the ends of the grid's steps, and the final surface.
pub(super) struct Motion {
    pub(super) t: Vec<f64>,
    pub(super) grid: GridDocument,
}

/// Runs the grid from the scenario's initial condition, over the domain of `x`.
pub(super) fn run(
    comparison: &Comparison,
    scenario: &Scenario,
    x: &[f64],
) -> Result<Motion, Failure> {
    let Comparison { discretisation, grid_until, .. } = comparison;
    let model = &scenario.model;
    let f = |x: f64| model.tip().value(x);
    let force = |t: f64| scenario.force.value(t);
    let method = discretisation.method((x[0], x[x.len() - 1]));
    let request = Request { times: &[*grid_until], points: x };
    let explain = |error| explain(comparison, error);
    let footprint = Footprint::new(&f, discretisation.reach).map_err(explain)?;
    let texture = texture(scenario)?;
    let support = scenario.support();
    let position = |t: f64| support.position(t);
    let law = wider(scenario, &position);
    let start = start(scenario, &law, footprint, texture.as_ref());
    let problem = Problem::under(law, (model.alpha(), model.r()), footprint, start)
        .map_err(explain)?
        .with_force(&force);

    let once = || -> Result<((Run, Samples), f64), Failure> {
        let (mut watch, mut samples) = (watch(comparison), Samples::default());
        let mut step = |t: f64, x0: f64| {
            samples.take(t, [x0, 0.0]);
            watch.reached(t)
        };
        let stepping = &discretisation.stepping;
        let run = solve_observed(&problem, &method, stepping, &request, &mut step);
        watch.ended(run.map(|run| (run, samples)).map_err(explain))
    };
    let ((run, samples), seconds) = timed(once)?;
    let grid = GridDocument {
        x0: samples.column(0),
        y0: None,
        u: run.u,
        work: grid_work(&run.work, seconds),
    };
    Ok(Motion { t: samples.t, grid })
}

/// The counts of a grid that took this many seconds.
pub(super) fn grid_work(work: &Work, seconds: f64) -> GridWork {
    GridWork {
        steps: work.steps,
        rejected: work.rejected,
        right_hand_sides: work.right_hand_sides,
        cells_updated: work.cells_updated,
        seconds,
    }
}

/// The part of the initial surface that is not a groove: noise and profile.
fn texture(scenario: &Scenario) -> Result<Option<InitialSurface>, Failure> {
    if scenario.noise.is_none() && scenario.profile.is_none() {
        return Ok(None);
    }
    let scenario = Scenario { start: stickslip_tip::Start::Flat, ..scenario.clone() };
    scenario.initial_surface().map(Some).map_err(Failure::run)
}

/// The law in the types of the grid, with this position of the support if it moves on a path.
pub(super) fn wider<'a>(scenario: &'a Scenario, position: &'a dyn Fn(f64) -> f64) -> Wider<'a> {
    let path = scenario.path.as_ref().map(|path| Path { position, knots: path.knots().0 });
    let stickslip_tip::Wider { depth_limit, healing_time, inertia, spring } =
        *scenario.model.wider();
    let velocity = scenario.velocity_at_start();
    let inertia = inertia.map(|mass| (mass, velocity));
    Wider { depth_limit, healing_time, inertia, spring, path }
}

/// The initial condition for the grid. Texture, f and force are passed as functions of the closed equation's data.
fn start<'a>(
    scenario: &Scenario,
    law: &Wider,
    footprint: Footprint<'a>,
    texture: Option<&'a InitialSurface>,
) -> Start<'a> {
    let (position, kick) = (scenario.start_position, scenario.kick);
    let (alpha, r) = (scenario.model.alpha(), scenario.model.r());
    let start = match scenario.start {
        stickslip_tip::Start::Steady
            if scenario.model.wider().is_basic() && scenario.path.is_none() =>
        {
            Start::steady(alpha, r, footprint, position, kick)
        }
        stickslip_tip::Start::Steady => {
            Start::steady_under(law, (alpha, r), footprint, position, kick)
        }
        stickslip_tip::Start::Flat => {
            Start::new(scenario.start_time(), position - kick, |_| 0.0, |_| 0.0)
        }
    };
    match texture {
        None => start,
        Some(u) => start.on_top_of(|x| u.texture(x), |x| u.slope_and_curvature(x).0),
    }
}

/// The observer of a grid's steps.
pub(super) fn watch(comparison: &Comparison) -> Watch {
    let span = (comparison.scenario.span().0, comparison.grid_until);
    Watch::new(comparison.session, Unit::Time("--grid-until"), span, comparison.time_limit)
}

/// The motion at every 2^n-th step, thinned as it grows.
pub(super) struct Samples {
    pub(super) t: Vec<f64>,
    position: Vec<[f64; 2]>,
    every: usize,
    seen: usize,
}

impl Default for Samples {
    fn default() -> Self {
        Self { t: vec![], position: vec![], every: 1, seen: 0 }
    }
}

impl Samples {
    pub(super) fn take(&mut self, t: f64, position: [f64; 2]) {
        self.seen += 1;
        if !self.seen.is_multiple_of(self.every) {
            return;
        }
        self.t.push(t);
        self.position.push(position);
        if self.t.len() == 2 * SAMPLES {
            self.t = self.t.iter().skip(1).step_by(2).copied().collect();
            self.position = self.position.iter().skip(1).step_by(2).copied().collect();
            self.every *= 2;
        }
    }

    /// x0 or y0.
    pub(super) fn column(&self, axis: usize) -> Vec<f64> {
        self.position.iter().map(|position| position[axis]).collect()
    }
}

/// The error with the option that causes an error of the grid.
pub(super) fn explain(comparison: &Comparison, error: GridError) -> Failure {
    match error {
        GridError::Defect { .. } => {
            Failure::number("--spacing", comparison.discretisation.spacing, error)
        }
        GridError::StepTooSmall { .. } | GridError::LeftGrid { .. } => {
            let advice = "another --step or --grid-tolerance, or an earlier --grid-until, may help: a deep groove is \
            stiff, and the grids are explicit";
            Failure::Run(format!("grid: {error}; {advice}"))
        }
        error => Failure::Run(format!("grid: {error}")),
    }
}
