//! Figure of a limit cycle: spring, velocity, and the ripple far behind the tip.

use super::axes::{L, NATURAL, SURFACE, VELOCITY, evenly};
use super::dense::Part;
use super::drawn::{Drawn, View};
use super::quantity::Quantity;
use super::run::{against, steady_level, support_level};
use super::tip::model_name;
use crate::axis::extremes;
use crate::error::{FigureError, damaged};
use crate::number::seven_digits;
use stickslip::{CurveDocument, CycleDocument, FigureDocument, PanelDocument, StyleName, Unusable};
use stickslip_surface::Surface;
use stickslip_tip::{InitialSurface, Model, Step, Support, Trajectory, nodes_and_weights};

/// Number of wavelengths of the ripple shown.
const WAVELENGTHS: f64 = 3.0;
const POINTS: u32 = 1500;
/// Largest number of periods computed on either side of those shown; a wave that would need more is much shorter than
/// the tip and leaves no ripple.
const MOST_PERIODS: f64 = 3000.0;
/// Largest number of steps in all these periods: 300 MB with their history.
const MOST_STEPS: f64 = 1e6;

impl Drawn for CycleDocument {
    fn figure(&self, view: &View) -> Result<FigureDocument, FigureError> {
        let question = &self.parameters;
        let model = question.model().map_err(Unusable::new)?;
        let parameters = question.model_parameters();
        let stable = if self.stable { "stable" } else { "unstable" };
        let name = model_name(&parameters);
        let period = Quantity::new(self.period, "Γ/k").in_text(&seven_digits(self.period));
        let title = format!("{name}: {stable} cycle, T = {period}");
        let (r, steady) = (model.r(), model.steady_l());
        let motion = self.history.under(*model.wider(), Support::Moving(r))?;
        let part = Part::of(&motion, view.x_range);
        let l = part.line("l(t)", &|step, t| step.l(r, t));
        let velocity = part.line("ẋ₀(t)", &|step, t| step.velocity(t));
        let mut panels = vec![
            against(L, l, Some(&steady_level(steady))),
            against(VELOCITY, velocity, Some(&support_level(r))),
        ];
        panels.extend(ripple(&model, &motion)?);
        Ok(FigureDocument::new("cycle", &title, vec![parameters], panels))
    }
}

/// u far behind the tip, after infinitely long motion.
fn ripple(model: &Model, motion: &Trajectory) -> Result<Option<PanelDocument>, FigureError> {
    // The ripple follows from the motion alone.
    let period = motion.end() - motion.start();
    let wavelength = model.r() * period;
    if model.wider().healing_time.is_some() {
        return Ok(None);
    }
    // From out of reach before to out of reach behind; a motion leaves the mean by less than its peak-to-peak.
    let reach = model.tip().reach().unwrap_or(0.0) + swing(motion, model.r());
    let before = (reach / wavelength).ceil() + 1.0;
    let steps = motion.steps().len() as f64;
    if !(before < MOST_PERIODS && (2.0 * before + WAVELENGTHS) * steps < MOST_STEPS) {
        return Ok(None);
    }
    let periods = (2.0 * before + WAVELENGTHS) as usize;
    let steps = (0..periods).flat_map(|i| {
        let shift = period * i as f64;
        motion.steps().iter().map(move |step| Step { t: step.t + shift, ..*step })
    });
    let support = Support::Moving(model.r());
    let long = Trajectory::under(*model.wider(), support, steps.collect());
    let from = motion.x0(motion.start()) + before * wavelength;
    let x: Vec<f64> = evenly([0.0, WAVELENGTHS * wavelength], POINTS).collect();
    let shifted: Vec<f64> = x.iter().map(|x| from + x).collect();
    let flat = InitialSurface::flat();
    let u = Surface::new(model, &flat, &long).far_behind(long.end(), &shifted);
    let u = u.map_err(damaged)?.to_vec();
    let curves = vec![CurveDocument::new(StyleName::Line, "u far behind the tip", &x, &u)];
    Ok(Some(PanelDocument { natural: NATURAL, ..PanelDocument::of_curves(SURFACE, curves) }))
}

/// Peak-to-peak of l at the nodes, in σ.
fn swing(motion: &Trajectory, r: f64) -> f64 {
    let (nodes, _) = nodes_and_weights();
    let within = |step: &Step| nodes.map(|node| step.l(r, step.t + node * step.h));
    extremes(motion.steps().iter().flat_map(within)).map_or(0.0, |(low, high)| high - low)
}
