//! A run as a scene: the tip on its spring, the surface that it carves, and the spring force.

use super::axes::{LAG, NATURAL, SURFACE, VELOCITY, evenly};
use super::dense::{Part, duration, shown};
use super::tip::run_title;
use crate::axis::extremes;
use crate::error::{FigureError, damaged};
use crate::scene::{Moment, Scene, Shot};
use stickslip::{ColourName, CurveDocument, FigureDocument, PanelDocument, RunDocument, StyleName};
use stickslip_surface::Surface;
use stickslip_tip::{InitialSurface, Model, Step, Support, Trajectory};

/// Periods shown by default, and the least number of them.
const PERIODS: (f64, f64) = (6.0, 2.2);
/// Path shown by default, in σ, unless periods are longer.
const PATH: f64 = 48.0;
/// Surface shown behind the tip and ahead of tip and support, in σ.
const BEHIND: f64 = 12.0;
const AHEAD: f64 = 4.0;
/// Points of the surface.
const POINTS: u32 = 800;
/// Number of times at which the range of the heights is determined.
const LOOKS: u32 = 24;
/// Air below the heights and above them, for tip and spring, relative to their span.
const AIR: (f64, f64) = (0.12, 0.75);

/// A run between two times.
pub(super) struct Carving {
    title: String,
    document: RunDocument,
    model: Model,
    initial: InitialSurface,
    trajectory: Trajectory,
    times: [f64; 2],
    x: Vec<f64>,
    heights: [f64; 2],
    /// Spring extension or velocity against time.
    trail: CurveDocument,
}

impl Carving {
    pub(super) fn of(run: &RunDocument, shot: &Shot) -> Result<Self, FigureError> {
        let trajectory = run.trajectory()?;
        let scenario = run.parameters.scenario()?;
        let initial = scenario.initial_surface().map_err(damaged)?;
        let times = times(run, &trajectory, shot)?;
        let (x, trail) = (positions(&trajectory, times), trail(&trajectory, times));
        let mut carving = Self {
            title: run_title(run),
            document: run.clone(),
            model: scenario.model,
            initial,
            trajectory,
            times,
            x,
            heights: [0.0, 1.0],
            trail,
        };
        carving.heights = carving.range()?;
        Ok(carving)
    }

    /// u(x, t) at every x.
    fn surface(&self, t: f64, x: &[f64]) -> Result<Vec<f64>, FigureError> {
        let surface = Surface::new(&self.model, &self.initial, &self.trajectory);
        let u = surface.heights(t, x).map_err(damaged)?;
        Ok(u.to_vec())
    }

    /// Lowest and highest ordinate: of the surface, with air below it and above it.
    fn range(&self) -> Result<[f64; 2], FigureError> {
        let mut all: Vec<f64> = vec![];
        for t in evenly(self.times, LOOKS) {
            all.extend(extremes(self.surface(t, &self.x)?).into_iter().flat_map(|(a, b)| [a, b]));
        }
        let (low, high) = extremes(all).unwrap_or((0.0, 1.0));
        let span = (high - low).max(1e-6 * NATURAL.unwrap_or(1.0));
        Ok([low - AIR.0 * span, high + AIR.1 * span])
    }

    fn labels(&self) -> (&'static str, &'static str) {
        if matches!(self.trajectory.support(), Support::None) { VELOCITY } else { LAG }
    }
}

impl Scene for Carving {
    fn still(&self) -> FigureDocument {
        let model = self.document.parameters.model_parameters();
        let mut ground = PanelDocument::new("", SURFACE);
        let ends = self.x.first().zip(self.x.last());
        ground.x_range = ends.map(|(first, last)| [*first, *last]);
        ground.y_range = Some(self.heights);
        let panels = vec![ground, whole(&self.trail, self.labels(), self.times)];
        FigureDocument::new("carving", &self.title, vec![model], panels)
    }

    fn times(&self) -> [f64; 2] {
        self.times
    }

    fn moment(&mut self, t: f64) -> Result<Moment, FigureError> {
        let u = self.surface(t, &self.x)?;
        let x0 = self.trajectory.x0(t);
        let height = self.surface(t, &[x0])?[0];
        let support = match self.trajectory.support() {
            Support::None => None,
            support => Some((support.position(t), height)),
        };
        let ground = vec![CurveDocument::new(StyleName::Line, "", &self.x, &u)];
        let force = past(&self.trail, t, quantity(&self.trajectory, t)).into();
        let panels = vec![
            PanelDocument::of_curves(SURFACE, ground),
            PanelDocument::of_curves(self.labels(), force),
        ];
        let (unit, note) = ("Γ/k".into(), String::new());
        Ok(Moment { t, unit, note, panels, tip: (x0, height), support })
    }
}

/// Axes with a whole curve against time in the background.
pub(super) fn whole(curve: &CurveDocument, labels: (&str, &str), times: [f64; 2]) -> PanelDocument {
    let curves = vec![curve.clone().coloured(ColourName::Silver)];
    let panel = PanelDocument::of_curves(labels, curves);
    PanelDocument { natural: NATURAL, x_range: Some(times), ..panel }
}

/// The part of a curve before time t, and a dot at its value at t, `now`.
pub(super) fn past(curve: &CurveDocument, t: f64, now: f64) -> [CurveDocument; 2] {
    let past = curve.x.partition_point(|at| *at < t);
    let (mut x, mut y) = (curve.x[..past].to_vec(), curve.y[..past].to_vec());
    x.push(t);
    y.push(Some(now));
    let line = CurveDocument { x, y, ..curve.clone() };
    [line, CurveDocument::new(StyleName::Dots, "", &[t], &[now])]
}

/// The spring extension, or the velocity of a tip without a spring.
fn quantity(trajectory: &Trajectory, t: f64) -> f64 {
    match trajectory.support() {
        Support::None => trajectory.velocity(t),
        _ => trajectory.lag(t),
    }
}

fn trail(trajectory: &Trajectory, times: [f64; 2]) -> CurveDocument {
    let of = |step: &Step, t| match trajectory.support() {
        Support::None => step.velocity(t),
        support => step.lag(support, t),
    };
    Part::of(trajectory, Some(times)).line("", &of)
}

/// First and last time: as requested, or the last ripples.
fn times(run: &RunDocument, trajectory: &Trajectory, shot: &Shot) -> Result<[f64; 2], FigureError> {
    let (start, end) = (trajectory.start(), trajectory.end());
    if let Some(times) = shot.times {
        return shown("run", [start, end], times);
    }
    let path = duration(PATH, (trajectory.x0(end) - trajectory.x0(start), end - start));
    let ripples = run.oscillation.as_ref().map(|o| {
        let period = o.period;
        (PERIODS.0 * period).min(path.max(PERIODS.1 * period))
    });
    Ok([start.max(end - ripples.unwrap_or(path)), end])
}

/// Positions from behind the tip to ahead of its support.
fn positions(trajectory: &Trajectory, times: [f64; 2]) -> Vec<f64> {
    let tip = evenly(times, POINTS).map(|t| trajectory.x0(t));
    let support = trajectory.support();
    let there = evenly(times, POINTS).filter(|_| *support != Support::None);
    let support = there.map(|t| support.position(t));
    let (low, high) = extremes(tip.chain(support)).unwrap_or((0.0, 1.0));
    evenly([low - BEHIND, high + AHEAD], POINTS).collect()
}
