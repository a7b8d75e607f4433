//! A run in the plane as a scene: the surface from above with the tip on its spring, the lag, and y0.

use super::axes::{ACROSS, LAG, NATURAL};
use super::carving::{past, whole};
use super::plane::Plane;
use super::tip::run_title;
use crate::axis::extremes;
use crate::error::FigureError;
use crate::scene::{Moment, Scene, Shot};
use stickslip::{CurveDocument, FigureDocument, PanelDocument, RunDocument, StyleName};
use stickslip_tip::Support;

/// A run in the plane between two times.
pub(super) struct Wandering {
    plane: Plane,
    still: FigureDocument,
    /// Heights that the colours cover.
    colours: Option<[f64; 2]>,
    /// For each panel below the map: the curve, and its labels.
    curves: Vec<(CurveDocument, (&'static str, &'static str))>,
}

impl Wandering {
    /// # Errors
    /// The run has no dense history, is damaged, or has no time in common with the request.
    pub(super) fn of(run: &RunDocument, shot: &Shot) -> Result<Self, FigureError> {
        let plane = Plane::of(run, shot.times)?;
        let times = plane.times();
        let t: Vec<f64> = plane.instants(times[1]).collect();
        let trajectory = plane.trajectory();
        let curve = |of: &dyn Fn(f64) -> f64| {
            let values: Vec<f64> = t.iter().map(|t| of(*t)).collect();
            CurveDocument::new(StyleName::Line, "", &t, &values)
        };
        let mut curves = vec![(curve(&|t| trajectory.y0(t)), ACROSS)];
        if !matches!(trajectory.support(), Support::None) {
            curves.insert(0, (curve(&|t| trajectory.lag(t)), LAG));
        }
        let model = run.parameters.model_parameters();
        let mut still = FigureDocument::new("wandering", &run_title(run), vec![model]);
        let mut map = plane.seen(times[1], None)?;
        let colours = map.map.as_mut().and_then(|map| {
            let heights = extremes(map.z.iter().flatten().copied());
            map.z_range = heights.filter(|(low, high)| low < high).map(Into::into);
            map.z_range
        });
        map.curves.clear();
        still.panels = vec![map];
        still.panels.extend(curves.iter().map(|(curve, labels)| whole(curve, *labels, times)));
        Ok(Self { plane, still, colours, curves })
    }
}

impl Scene for Wandering {
    fn still(&self) -> FigureDocument {
        self.still.clone()
    }

    fn times(&self) -> [f64; 2] {
        self.plane.times()
    }

    fn moment(&mut self, t: f64) -> Result<Moment, FigureError> {
        let mut panels = vec![self.plane.seen(t, self.colours)?];
        panels.extend(self.curves.iter().enumerate().map(|(i, (curve, labels))| {
            let trajectory = self.plane.trajectory();
            let is_across = i + 1 == self.curves.len();
            let now = if is_across { trajectory.y0(t) } else { trajectory.lag(t) };
            let mut panel = PanelDocument::new("", *labels);
            panel.natural = NATURAL;
            panel.curves = past(curve, t, now).into();
            panel
        }));
        let (unit, note) = ("Γ/k".into(), String::new());
        let (tip, support) = (self.plane.tip(t).into(), self.plane.support(t).map(Into::into));
        Ok(Moment { t, unit, note, panels, tip, support })
    }
}
