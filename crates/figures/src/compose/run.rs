//! A run: spring, velocity, force, surface.

mod ground;

use super::dense::{Part, Quantity};
use super::drawn::{Drawn, View};
use super::labels::{FORCE, L, NATURAL, VELOCITY};
use super::tip::model_name;
use crate::error::FigureError;
use crate::number::{seven_digits, short};
use ground::{Ground, MARGIN};
use stickslip_documents::{
    CurveDocument, FigureDocument, PanelDocument, PulseParameters, RunDocument, RunParameters,
    StyleName, to_its_digits,
};
use stickslip_surface::Surface;
use stickslip_tip::{Scenario, Step, Trajectory};

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
        if self.history.is_none() {
            figure
                .remarks
                .push("drawn from the samples: without its history, a run has no more".into());
            figure.panels = sampled(self);
            return Ok(figure);
        }
        let trajectory = self.trajectory()?;
        let part = Part::of(&trajectory, view.x_range);
        let r = trajectory.r();
        let (l, velocity) = (move |step: &Step, t| step.l(r, t), |step: &Step, t| step.velocity(t));
        let shown = Shown::of(self, part, &l);
        let steady = self.steady_state.l;
        let mut rows = vec![
            shown.motion(
                &trajectory,
                (L, &l, "l(t)"),
                (steady, format!("steady state, l₀ = {}", short(steady))),
            ),
            shown.motion(
                &trajectory,
                (VELOCITY, &velocity, "ẋ₀(t)"),
                (r, format!("support, r = {}", short(r))),
            ),
        ];
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
}

/// Columns of a figure of two: the whole is wider than the detail.
const COLUMNS: usize = 3;

/// What of a run is shown, and the length in time of the detail beside it if its oscillations are many.
#[derive(Debug, Clone, Copy)]
struct Shown<'a> {
    part: Part<'a>,
    /// Periods, in which there may be several slips.
    oscillations: usize,
    detail: Option<f64>,
}

/// The whole, and the end of it beside it.
type Row = (PanelDocument, Option<PanelDocument>);

impl<'a> Shown<'a> {
    fn of(run: &RunDocument, part: Part<'a>, l: Quantity) -> Self {
        let maxima = part.maxima(l);
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
        (constant, constant_name): (f64, String),
    ) -> Row {
        let Some(length) = self.detail else {
            return (against(labels, self.part.line(name, of), constant, &constant_name), None);
        };
        let name = format!("{name}, lowest to highest");
        let band = self.part.envelope(&name, of, self.oscillations);
        let end = self.part.tail(trajectory, length);
        let mut detail = against(labels, end.line("at the end", of), constant, "");
        detail.x_range = Some([end.span.0, end.span.1]);
        (against(labels, band, constant, &constant_name), Some(detail))
    }
}

fn title(run: &RunDocument) -> String {
    let name = model_name(&run.parameters.model);
    let motion = run.oscillation.as_ref().map_or(String::new(), |o| {
        let rounded = || seven_digits(format!("{:.4e}", o.period).parse().unwrap_or(o.period));
        let period = o.period_error.map_or_else(rounded, |error| to_its_digits(o.period, error));
        format!(", T = {period}")
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
        against(
            L,
            curve("l(t), samples", &samples.l),
            steady,
            &format!("steady state, l₀ = {}", short(steady)),
        ),
        against(
            VELOCITY,
            curve("ẋ₀(t), samples", &samples.velocity),
            r,
            &format!("support, r = {}", short(r)),
        ),
    ]
}

/// The force, if there is one.
fn force(run: &RunParameters, (from, to): (f64, f64)) -> Option<PanelDocument> {
    if run.pulses.is_empty() && run.force.is_none() {
        return None;
    }
    let force = run.scenario().ok()?.force;
    let evenly = |from: f64, to: f64, n: usize| {
        (0..=n).map(move |i| from + (to - from) * i as f64 / n as f64)
    };
    let near =
        |p: &PulseParameters| evenly(p.time - 5.0 * p.width, p.time + 5.0 * p.width, PULSE_POINTS);
    let table = run.force.iter().flat_map(|table| table.t.iter().copied());
    let pulses = run.pulses.iter().flat_map(near);
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
    shown: Shown,
) -> Result<Row, FigureError> {
    let initial = scenario.initial_surface().map_err(|e| FigureError::Damaged(e.to_string()))?;
    let surface = Surface::new(&scenario.model, &initial, trajectory);
    let (from, end) = shown.part.span;
    let (from, tip) = (trajectory.x0(from), trajectory.x0(end));
    let ground = Ground { surface, start: trajectory.start(), end, tip };
    let all = (from.min(tip) - MARGIN, from.max(tip) + MARGIN);
    let Some(length) = shown.detail else {
        return Ok((ground.lines(all, true, shown.oscillations)?, None));
    };
    let length = length * trajectory.r();
    let detail = ground.lines((tip - length, tip + MARGIN), false, 0)?;
    Ok((ground.envelope(all, length / SHOWN, shown.oscillations)?, Some(detail)))
}
