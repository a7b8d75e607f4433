//! A run: spring, velocity, force, surface.

use super::dense::{Part, Quantity};
use super::tip::model_name;
use super::{Drawn, View};
use crate::error::FigureError;
use crate::number::{seven_digits, short};
use stickslip_documents::{
    CurveDocument, FigureDocument, NoteDocument, PanelDocument, RunDocument, StyleName,
};
use stickslip_surface::Surface;
use stickslip_tip::{Scenario, Step, Trajectory};

mod ground;

pub(super) const L: (&str, &str) = ("t (Γ/k)", "l = rt − r − x_0 (σ)");
pub(super) const VELOCITY: (&str, &str) = ("t (Γ/k)", "ẋ_0 (kσ/Γ)");
const FORCE: (&str, &str) = ("t (Γ/k)", "F_{ext} (kσ)");

/// Natural size of the dimensionless quantities: variations far below are round-off.
pub(super) const NATURAL: Option<f64> = Some(1.0);

/// From so many oscillations on their envelope is drawn, and the last of them beside it.
const MANY: usize = 50;
const SHOWN: f64 = 6.0;
/// Points of a force, and of each pulse.
const FORCE_POINTS: usize = 2000;
const PULSE_POINTS: usize = 120;

impl Drawn for RunDocument {
    fn figure(&self, view: &View) -> Result<FigureDocument, FigureError> {
        let model = self.parameters.model.clone();
        let mut figure = FigureDocument::new("run", &title(self), vec![model]);
        let scenario = self.parameters.scenario()?;
        if self.history.is_none() {
            figure.remarks.push("drawn from the samples: without its history, a run has no more".into());
            figure.panels = sampled(self);
            return Ok(figure);
        }
        let trajectory = self.trajectory()?;
        let part = Part::of(&trajectory, view.x_range);
        let r = trajectory.r();
        let (l, velocity) = (move |step: &Step, t| step.l(r, t), |step: &Step, t| step.velocity(t));
        let oscillations = part.maxima(&l);
        let steady = self.steady_state.l;
        let quantities: [(_, Quantity, _, _); 2] = [
            (L, &l, "l(t)", (steady, format!("steady state, l_0 = {}", short(steady)))),
            (VELOCITY, &velocity, "ẋ_0(t)", (r, format!("support, r = {}", short(r)))),
        ];
        let many = oscillations > MANY;
        let period = self.oscillation.as_ref().map(|o| o.period);
        let period = period.unwrap_or((part.span.1 - part.span.0) / oscillations.max(1) as f64);
        for (labels, of, name, (constant, constant_name)) in quantities {
            let whole = if many {
                part.envelope(&format!("{name}, from lowest to highest"), of, oscillations)
            } else {
                part.line(name, of)
            };
            figure.panels.push(against(labels, whole, constant, &constant_name));
            if many {
                let last = part.tail(&trajectory, SHOWN * period);
                let mut panel = against((labels.0, ""), last.line("the end", of), constant, "");
                panel.x_range = Some([last.span.0, last.span.1]);
                figure.panels.push(panel);
            }
        }
        let columns = if many { 3 } else { 1 };
        if let Some(force) = force(&scenario, part.span) {
            figure.panels.push(force);
        }
        figure.panels.extend(surfaces(&scenario, &trajectory, part, many.then_some(period))?);
        figure.columns = columns;
        for (i, panel) in figure.panels.iter_mut().enumerate() {
            // Of each pair the first is the wider one; a force stands alone.
            panel.span = match (many, panel.y_label.as_str()) {
                (false, _) | (true, "") => 1,
                (true, _) => 2,
            };
            if panel.y_label == FORCE.1 {
                panel.span = columns;
            }
            let _ = i;
        }
        Ok(figure)
    }
}

fn title(run: &RunDocument) -> String {
    let name = model_name(&run.parameters.model);
    let motion = run.oscillation.as_ref().map_or(String::new(), |o| {
        format!(", T = {}", seven_digits(format!("{:.4e}", o.period).parse().unwrap_or(o.period)))
    });
    format!("{name}: {}{motion}", run.regime)
}

/// A curve against time with a constant.
pub(super) fn against(
    labels: (&str, &str),
    curve: CurveDocument,
    constant: f64,
    constant_name: &str,
) -> PanelDocument {
    let mut panel = PanelDocument::new("", labels);
    panel.natural = NATURAL;
    let ends: Vec<f64> = curve.x.first().into_iter().chain(curve.x.last()).copied().collect();
    let level = vec![constant; ends.len()];
    panel.curves = vec![curve, CurveDocument::new(StyleName::Dashed, constant_name, &ends, &level)];
    panel
}

/// l and the velocity at the samples.
fn sampled(run: &RunDocument) -> Vec<PanelDocument> {
    let (samples, steady, r) = (&run.samples, run.steady_state.l, run.parameters.model.r);
    let curve = |name, y| CurveDocument::new(StyleName::Line, name, &samples.t, y);
    vec![
        against(L, curve("l(t), samples", &samples.l), steady, &format!("steady state, l_0 = {}", short(steady))),
        against(VELOCITY, curve("ẋ_0(t), samples", &samples.velocity), r, &format!("support, r = {}", short(r))),
    ]
}

/// The force, if there is one.
fn force(scenario: &Scenario, (from, to): (f64, f64)) -> Option<PanelDocument> {
    let force = &scenario.force;
    if force.is_none() {
        return None;
    }
    let evenly = |from: f64, to: f64, n: usize| {
        (0..=n).map(move |i| from + (to - from) * i as f64 / n as f64)
    };
    let near = |time: f64, width: f64| evenly(time - 5.0 * width, time + 5.0 * width, PULSE_POINTS);
    let pulses = force.pulses().iter().flat_map(|pulse| near(pulse.time, pulse.width));
    let table = force.table().map_or(&[][..], |(t, _)| t).iter().copied();
    let mut t: Vec<f64> = evenly(from, to, FORCE_POINTS).chain(pulses).chain(table).collect();
    t.retain(|t| (from..=to).contains(t));
    t.sort_by(f64::total_cmp);
    let value: Vec<f64> = t.iter().map(|t| force.value(*t)).collect();
    let mut panel = PanelDocument::new("", FORCE);
    panel.curves = vec![CurveDocument::new(StyleName::Line, "external force", &t, &value)];
    Some(panel)
}

/// The surface at the end of what is shown: all of it, and, where there are many ripples, the last of them.
fn surfaces(
    scenario: &Scenario,
    trajectory: &Trajectory,
    part: Part,
    period: Option<f64>,
) -> Result<Vec<PanelDocument>, FigureError> {
    let initial = scenario.initial_surface().map_err(|e| FigureError::Damaged(e.to_string()))?;
    let surface = Surface::new(&scenario.model, &initial, trajectory);
    let end = part.span.1;
    let tip = trajectory.x0(end);
    let ground = ground::Ground { surface, start: trajectory.start(), end, tip };
    let from = trajectory.x0(part.span.0);
    let (low, high) = (from.min(tip) - ground::MARGIN, from.max(tip) + ground::MARGIN);
    let Some(period) = period else {
        return Ok(vec![ground.lines((low, high), true)?]);
    };
    let wavelength = period * trajectory.r();
    let near = (tip - SHOWN * wavelength, tip + ground::MARGIN);
    Ok(vec![ground.envelope((low, high), wavelength)?, {
        let mut panel = ground.lines(near, false)?;
        panel.y_label.clear();
        panel
    }])
}

fn note_at(text: String, place: (f64, f64)) -> NoteDocument {
    NoteDocument::new(&text, place)
}
