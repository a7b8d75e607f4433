//! The surface after a run, with the tip.

use crate::axis::extremes;
use crate::compose::axes::{NATURAL, SURFACE, evenly};
use crate::compose::quantity::Quantity;
use crate::error::{FigureError, damaged};
use crate::number::short;
use stickslip::{ArrowName, ColourName, CurveDocument, NoteDocument, PanelDocument, StyleName};
use stickslip_surface::Surface;

/// Margin on either side of the tip's path, in σ.
pub(super) const MARGIN: f64 = 12.0;
/// Length of the tip's own groove behind it, in σ.
const GROOVE: f64 = 4.0;
/// If the ripples take less than this fraction of the range of heights, the axes show the ripples alone.
const LEAST_PART: f64 = 0.3;
/// Smallest number of slips that count as ripples.
const FEW: usize = 4;
/// Spacing of the points, and their smallest and largest number.
const SPACING: f64 = 0.1;
const POINTS: (f64, f64) = (1500.0, 120_000.0);
const ENVELOPE: usize = 400;
const RIPPLES: f64 = 1.5;

/// A surface at time `end`, with the position of the tip.
pub(super) struct Ground<'a> {
    pub(super) surface: Surface<'a>,
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) tip: f64,
}

impl Ground<'_> {
    /// The surface and, on request, the initial one.
    pub(super) fn lines(
        &self,
        range: (f64, f64),
        with_start: bool,
        ripples: usize,
    ) -> Result<PanelDocument, FigureError> {
        let x = points(range);
        let u = self.heights(self.end, &x)?;
        let mut panel = self.panel();
        if with_start {
            let before = self.heights(self.start, &x)?;
            panel.curves.push(CurveDocument::new(StyleName::Dotted, "at the start", &x, &before));
        }
        let name = format!("u(x, t = {})", time(self.end));
        panel.curves.push(CurveDocument::new(StyleName::Line, &name, &x, &u));
        self.fit(&mut panel, &x, &u, ripples);
        Ok(panel)
    }

    /// The band from lowest to highest point, for ripples too dense to draw.
    pub(super) fn envelope(
        &self,
        range: (f64, f64),
        wavelength: f64,
        ripples: usize,
    ) -> Result<PanelDocument, FigureError> {
        let x = points(range);
        let u = self.heights(self.end, &x)?;
        let mut panel = self.panel();
        let columns = ((ripples as f64 / RIPPLES) as usize).clamp(8, ENVELOPE);
        let per_column = x.len().div_ceil(columns).max(1);
        let spacing = (range.1 - range.0) / x.len() as f64;
        // Where the tip is, and before it came, nothing is to be smoothed.
        let of = |x: &[f64], u: &[f64]| -> (f64, f64, f64) {
            let (low, high) = extremes(u.iter().copied()).unwrap_or((0.0, 0.0));
            (0.5 * (x[0] + x[x.len() - 1]), low, high)
        };
        let ahead = x.partition_point(|x| *x < self.tip - GROOVE);
        let (behind_x, behind_u) = (&x[..ahead], &u[..ahead]);
        let columns: Vec<(f64, f64, f64)> = behind_x
            .chunks(per_column)
            .zip(behind_u.chunks(per_column))
            .map(|(x, u)| of(x, u))
            .collect();
        let name = format!("u(x, t = {}), lowest to highest", time(self.end));
        // At the usual spacing the surface is resolved, however fast the tip jitters.
        let is_resolved = spacing < (wavelength / 6.0).max(1.1 * SPACING);
        if is_resolved && !columns.is_empty() {
            let mut x: Vec<f64> = columns.iter().map(|c| c.0).collect();
            let last = x.len() - 1;
            (x[0], x[last]) = (behind_x[0], behind_x[behind_x.len() - 1]);
            let high: Vec<f64> = columns.iter().map(|c| c.2).collect();
            let low: Vec<f64> = columns.iter().map(|c| c.1).collect();
            panel.curves.push(CurveDocument::band(&name, &x, &low, &high));
        }
        // From the last ripple on, so that the two are seen to be one.
        let joint = x.partition_point(|x| *x < self.tip - GROOVE - wavelength);
        let rest = CurveDocument::new(StyleName::Line, "", &x[joint..], &u[joint..]);
        panel.curves.push(rest.coloured(ColourName::Blue));
        panel.x_range = Some([range.0, range.1]);
        self.fit(&mut panel, &x, &u, ripples);
        Ok(panel)
    }

    fn heights(&self, t: f64, x: &[f64]) -> Result<Vec<f64>, FigureError> {
        let u = self.surface.heights(t, x);
        u.map(|u| u.to_vec()).map_err(damaged)
    }

    fn panel(&self) -> PanelDocument {
        PanelDocument { natural: NATURAL, ..PanelDocument::new("", SURFACE) }
    }

    /// Fits the ordinates to the ripples behind the tip, if its own pit and the untouched surface would leave too
    /// little space for them; and marks the tip.
    fn fit(&self, panel: &mut PanelDocument, x: &[f64], u: &[f64], count: usize) {
        let all = extremes(u.iter().copied());
        let behind = x.iter().zip(u).filter(|(x, _)| **x < self.tip - GROOVE).map(|(_, u)| *u);
        let (Some((low, high)), Some(ripples)) = (all, extremes(behind)) else { return };
        let span = ripples.1 - ripples.0;
        let natural = NATURAL.unwrap_or(0.0);
        let (mut from, mut to) = (low, high);
        if count >= FEW && span < LEAST_PART * (high - low) && span > 1e-6 * natural {
            (from, to) = (ripples.0 - 0.35 * span, ripples.1 + 0.35 * span);
            let beyond = |text: String, y: f64, arrow| NoteDocument {
                arrow: Some(arrow),
                ..NoteDocument::new(&text, (self.tip, y))
            };
            let air = 0.12 * (to - from);
            if low < from {
                let text = format!("{} at the tip", height(low));
                panel.notes.push(beyond(text, from + air, ArrowName::Down));
            }
            if high > to {
                let text = format!("{} ahead", height(high));
                panel.notes.push(beyond(text, to - air, ArrowName::Up));
            }
            panel.y_range = Some([from, to]);
        } else {
            let pad = 0.06 * (to - from).max(1e-6 * natural);
            (from, to) = (from - pad, to + pad);
        }
        let mark = CurveDocument::new(StyleName::Dashed, "tip", &[self.tip; 2], &[from, to]);
        panel.curves.insert(0, mark.coloured(ColourName::Grey));
    }
}

/// A time for a text.
fn time(t: f64) -> String {
    Quantity::new(t, "Γ/k").in_text(&short(t))
}

fn height(u: f64) -> String {
    Quantity::new(u, "kσ²/a").in_text(&short(u))
}

fn points((low, high): (f64, f64)) -> Vec<f64> {
    let count = ((high - low) / SPACING).clamp(POINTS.0, POINTS.1);
    evenly([low, high], count as u32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_tip::{Model, Scenario, TipFunction, run};

    /// The surface is smooth over the width of the tip, whatever the length of the last jitters.
    #[test]
    fn a_surface_behind_fast_jitter_is_drawn_all_along_the_path() {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let scenario = Scenario::new(Model::new(tip, 1.5, 1.0).unwrap(), 100.0);
        let found = run(&scenario).unwrap();
        let trajectory = &found.trajectory;
        let tip = trajectory.x0(100.0);
        let surface = Surface::new(&scenario.model, &found.initial_surface, trajectory);
        let ground = Ground { surface, start: trajectory.start(), end: 100.0, tip };
        let range = (2.0, tip + MARGIN);
        let panel = ground.envelope(range, 0.1, 200).unwrap();
        let first =
            |curve: &CurveDocument| curve.x.iter().fold(f64::INFINITY, |low, x| low.min(*x));
        let lowest = panel.curves.iter().map(first).fold(f64::INFINITY, f64::min);
        assert!(lowest <= range.0, "drawn from {lowest} on");
    }
}
