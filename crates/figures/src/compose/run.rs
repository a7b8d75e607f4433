//! Figure of a run: spring, velocity, force, surface.

mod ground;

use super::axes::{ACROSS, EXTENSION, FORCE, L, LAG, NATURAL, POSITION, VELOCITY, WAY, evenly};
#[cfg(feature = "animation")]
use super::carving::Carving;
use super::dense::{Part, Quantity};
use super::drawn::{Drawn, View};
use super::plane::Plane;
use super::quantity::Quantity as Said;
use super::tip::run_title;
#[cfg(feature = "animation")]
use super::wandering::Wandering;
use crate::error::{FigureError, damaged};
use crate::number::short;
#[cfg(feature = "animation")]
use crate::scene::{Scene, Shot};
use ground::{Ground, MARGIN};
use stickslip::{CurveDocument, FigureDocument, PanelDocument, Pulse, Run, RunDocument, StyleName};
use stickslip_surface::Surface;
use stickslip_tip::sorting::sort_numbers;
use stickslip_tip::{Scenario, Step, Support, Trajectory};

/// Number of oscillations above which their envelope is drawn, with the last ones in a second panel.
const MANY: usize = 50;
const SHOWN: f64 = 6.0;
/// Number of points of a force, and of each pulse.
const FORCE_POINTS: u32 = 2000;
const PULSE_POINTS: u32 = 120;
/// Number of points of a friction loop.
const LOOP_POINTS: u32 = 4000;

impl Drawn for RunDocument {
    fn figure(&self, view: &View) -> Result<FigureDocument, FigureError> {
        let model = self.parameters.model_parameters();
        let mut figure = FigureDocument::new("run", &run_title(self), vec![model], vec![]);
        if self.parameters.stiffness_across.is_some() {
            figure.panels = sampled(self);
            figure.panels.extend(across(self, view)?);
            return Ok(figure);
        }
        if self.history.is_none() {
            figure.remarks.push("drawn from the samples, because the run has no history".into());
            figure.panels = sampled(self);
            return Ok(figure);
        }
        let trajectory = self.trajectory()?;
        let part = Part::of(&trajectory, view.x_range);
        let (support, velocity) = (trajectory.support(), |step: &Step, t| step.velocity(t));
        let first = |step: &Step, t: f64| step.followed(support, t);
        let (labels, name) = match support {
            Support::Moving(_) => (L, "l(t)"),
            Support::Path(_) => (LAG, EXTENSION[0]),
            Support::None => (POSITION, "x₀(t)"),
        };
        let shown = Shown::of(self, part, &first);
        let mut rows = vec![
            shown.motion(&trajectory, (labels, &first, name), steady(self)),
            shown.motion(&trajectory, (VELOCITY, &velocity, "ẋ₀(t)"), dragged(self)),
        ];
        rows.extend(loops(&trajectory, part.span).map(|panel| (panel, None)));
        rows.extend(force(&self.parameters, part.span).map(|panel| (panel, None)));
        rows.push(surfaces(&self.parameters.scenario()?, &trajectory, shown)?);
        figure.columns = if shown.detail.is_some() { COLUMNS } else { 1 };
        for (mut whole, detail) in rows {
            whole.span = if detail.is_some() { COLUMNS - 1 } else { figure.columns };
            figure.panels.push(whole);
            figure.panels.extend(detail);
        }
        Ok(figure)
    }

    #[cfg(feature = "animation")]
    fn scene(&self, shot: &Shot) -> Result<Box<dyn Scene>, FigureError> {
        if self.history.is_none() {
            let why = "an animation is drawn from the history, which was left out: run it again with --history all";
            return Err(FigureError::Still(why.into()));
        }
        if self.parameters.stiffness_across.is_some() {
            return Ok(Box::new(Wandering::of(self, shot)?));
        }
        Ok(Box::new(Carving::of(self, shot)?))
    }
}

/// Columns of a figure with detail panels: the whole run takes more than the detail.
const COLUMNS: usize = 3;

/// The visible part of a run, and the duration of the detail panel if there are many oscillations.
#[derive(Debug, Clone, Copy)]
struct Shown<'a> {
    part: Part<'a>,
    /// Number of periods; each may contain several slips.
    oscillations: usize,
    detail: Option<f64>,
}

/// A panel of the whole run, and one of its end.
type Row = (PanelDocument, Option<PanelDocument>);

impl<'a> Shown<'a> {
    fn of(run: &RunDocument, part: Part<'a>, l: Quantity) -> Self {
        // On a path there are no oscillations to be counted: where the tip keeps up, every rounding is a maximum.
        let on_path = run.parameters.support_path.is_some();
        let maxima = if on_path { 0 } else { part.maxima(l) };
        let mean = (part.span.1 - part.span.0) / maxima.max(1) as f64;
        let (period, slips) =
            run.oscillation.as_ref().map_or((mean, 1), |o| (o.period, o.slips.max(1)));
        let detail = (maxima > MANY).then_some(SHOWN * period);
        Self { part, oscillations: maxima / slips, detail }
    }

    fn motion(
        &self,
        trajectory: &Trajectory,
        (labels, of, name): ((&str, &str), Quantity, &str),
        level: Option<Level>,
    ) -> Row {
        let Some(length) = self.detail else {
            let mut panel = against(labels, self.part.line(name, of), level.as_ref());
            panel.x_range = Some(self.part.span.into());
            return (panel, None);
        };
        let name = format!("{name}, lowest to highest");
        let band = self.part.envelope(&name, of, self.oscillations);
        let end = self.part.tail(trajectory, length);
        let nameless = level.as_ref().map(|(value, _)| (*value, String::new()));
        let mut detail = against(labels, end.line("at the end", of), nameless.as_ref());
        detail.x_range = Some([end.span.0, end.span.1]);
        let mut whole = against(labels, band, level.as_ref());
        whole.x_range = Some(self.part.span.into());
        (whole, Some(detail))
    }
}

/// A constant level, and its name.
pub(super) type Level = (f64, String);

/// The level l0, if the support moves steadily.
fn steady(run: &RunDocument) -> Option<Level> {
    let steady = run.steady_state.as_ref().filter(|_| run.parameters.support_path.is_none())?;
    Some(steady_level(steady.l))
}

/// The level r, if the support moves steadily.
fn dragged(run: &RunDocument) -> Option<Level> {
    let moves = run.parameters.support_path.is_none() && !run.parameters.law.no_spring;
    let r = run.parameters.r.unwrap_or_default();
    moves.then(|| support_level(r))
}

/// The level l0 of steady motion.
pub(super) fn steady_level(l: f64) -> Level {
    (l, format!("steady state, l₀ = {}", Said::new(l, "σ").in_text(&short(l))))
}

/// The velocity of the support.
pub(super) fn support_level(r: f64) -> Level {
    let velocity = Said::new(r, "kσ/Γ").in_text(&format!("r = {}", short(r)));
    (r, format!("support, {velocity}"))
}

/// The lag against the position of a support on a path: the friction loop.
fn loops(trajectory: &Trajectory, (from, to): (f64, f64)) -> Option<PanelDocument> {
    let Support::Path(path) = trajectory.support() else { return None };
    let even = evenly([from, to], LOOP_POINTS);
    let knots = path.knots().0.iter().copied().filter(|t| (from..=to).contains(t));
    let mut t: Vec<f64> = even.chain(knots).collect();
    sort_numbers(&mut t);
    let way: Vec<f64> = t.iter().map(|t| trajectory.support().position(*t)).collect();
    let lag: Vec<f64> = t.iter().map(|t| trajectory.lag(*t)).collect();
    let curve = CurveDocument::new(StyleName::Line, "lateral force", &way, &lag);
    Some(PanelDocument::of_curves((WAY, LAG.1), vec![curve]))
}

/// A curve against time, with a constant level.
pub(super) fn against(
    labels: (&str, &str),
    curve: CurveDocument,
    level: Option<&Level>,
) -> PanelDocument {
    let ends: Vec<f64> = curve.x.first().into_iter().chain(curve.x.last()).copied().collect();
    let level = level.map(|(level, name)| {
        CurveDocument::new(StyleName::Dashed, name, &ends, &vec![*level; ends.len()])
    });
    let curves = [curve].into_iter().chain(level).collect();
    PanelDocument { natural: NATURAL, ..PanelDocument::of_curves(labels, curves) }
}

/// y0 against time, and the path of the tip in the plane, on the surface if the run has a history.
fn across(run: &RunDocument, view: &View) -> Result<Vec<PanelDocument>, FigureError> {
    let (samples, Some(y0)) = (&run.samples, &run.samples.y0) else { return Ok(vec![]) };
    let swing = CurveDocument::new(StyleName::Line, "y₀(t), samples", &samples.t, y0);
    let swing = against(ACROSS, swing, None);
    if run.history.is_some() {
        let plane = Plane::of(run, view.x_range).or_else(|_| Plane::of(run, None))?;
        return Ok(vec![swing, plane.seen(plane.times()[1], None)?]);
    }
    let path = CurveDocument::new(StyleName::Line, "path of the tip", &samples.x0, y0);
    Ok(vec![swing, PanelDocument::of_curves(("x₀ (σ)", "y₀ (σ)"), vec![path])])
}

/// l and the velocity at the samples.
fn sampled(run: &RunDocument) -> Vec<PanelDocument> {
    let samples = &run.samples;
    let curve = |name: &str, y| CurveDocument::new(StyleName::Line, name, &samples.t, y);
    let first = match (&samples.l, &samples.lag) {
        (Some(l), _) => (L, curve("l(t), samples", l)),
        (None, Some(lag)) => (LAG, curve(&format!("{}, samples", EXTENSION[0]), lag)),
        (None, None) => (POSITION, curve("x₀(t), samples", &samples.x0)),
    };
    let velocity = curve("ẋ₀(t), samples", &samples.velocity);
    vec![
        against(first.0, first.1, steady(run).as_ref()),
        against(VELOCITY, velocity, dragged(run).as_ref()),
    ]
}

/// The force, if there is one.
fn force(run: &Run, (from, to): (f64, f64)) -> Option<PanelDocument> {
    if run.pulses.is_empty() && run.force.is_none() {
        return None;
    }
    let force = run.scenario().ok()?.force;
    let near = |p: &Pulse| evenly([p.time - 5.0 * p.width, p.time + 5.0 * p.width], PULSE_POINTS);
    let table = run.force.iter().flat_map(|table| table.t.iter().copied());
    let pulses = run.pulses.iter().flat_map(near);
    let mut t: Vec<f64> = evenly([from, to], FORCE_POINTS).chain(pulses).chain(table).collect();
    t.retain(|t| (from..=to).contains(t));
    sort_numbers(&mut t);
    let value: Vec<f64> = t.iter().map(|t| force.value(*t)).collect();
    let curve = CurveDocument::new(StyleName::Line, "external force", &t, &value);
    let panel = PanelDocument::of_curves(FORCE, vec![curve]);
    Some(PanelDocument { x_range: Some([from, to]), ..panel })
}

/// The surface at the end of the visible part: all of it, and, if there are many ripples, the last of them.
fn surfaces(
    scenario: &Scenario,
    trajectory: &Trajectory,
    shown: Shown,
) -> Result<Row, FigureError> {
    let initial = scenario.initial_surface().map_err(damaged)?;
    let surface = Surface::new(&scenario.model, &initial, trajectory);
    let (from, end) = shown.part.span;
    let (from, tip) = (trajectory.x0(from), trajectory.x0(end));
    let ground = Ground { surface, start: trajectory.start(), end, tip };
    let all = (from.min(tip) - MARGIN, from.max(tip) + MARGIN);
    let Some(length) = shown.detail else {
        return Ok((ground.lines(all, true, shown.oscillations)?, None));
    };
    let end_velocity = trajectory.support().velocity(end).abs();
    let length = length * end_velocity.max(0.01);
    let detail = ground.lines((tip - length, tip + MARGIN), false, 0)?;
    Ok((ground.envelope(all, length / SHOWN, shown.oscillations)?, Some(detail)))
}
