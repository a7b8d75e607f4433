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
use stickslip_tip::planar::Trajectory;

/// A run in the plane between two times.
pub(super) struct Wandering {
    plane: Plane,
    still: FigureDocument,
    /// Heights that the colours cover.
    colours: Option<[f64; 2]>,
    /// The panels below the map.
    tracks: Vec<Track>,
}

/// A quantity against time.
struct Track {
    of: fn(&Trajectory, f64) -> f64,
    labels: (&'static str, &'static str),
    curve: CurveDocument,
}

impl Wandering {
    pub(super) fn of(run: &RunDocument, shot: &Shot) -> Result<Self, FigureError> {
        let plane = Plane::of(run, shot.times)?;
        let times = plane.times();
        let t: Vec<f64> = plane.instants(times[1]).collect();
        let trajectory = plane.trajectory();
        let track = |of: fn(&Trajectory, f64) -> f64, labels| {
            let values: Vec<f64> = t.iter().map(|t| of(trajectory, *t)).collect();
            Track { of, labels, curve: CurveDocument::new(StyleName::Line, "", &t, &values) }
        };
        let has_spring = !matches!(trajectory.support(), Support::None);
        let lag = has_spring.then(|| track(Trajectory::lag, LAG));
        let tracks: Vec<Track> = lag.into_iter().chain([track(Trajectory::y0, ACROSS)]).collect();
        let model = run.parameters.model_parameters();
        let mut map = plane.seen(times[1], None)?;
        let colours = map.map.as_mut().and_then(|map| {
            let heights = extremes(map.z.iter().flatten().copied());
            map.z_range = heights.filter(|(low, high)| low < high).map(Into::into);
            map.z_range
        });
        map.curves.clear();
        let tracked = tracks.iter().map(|track| whole(&track.curve, track.labels, times));
        let panels = [map].into_iter().chain(tracked).collect();
        let still = FigureDocument::new("wandering", &run_title(run), vec![model], panels);
        Ok(Self { plane, still, colours, tracks })
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
        panels.extend(self.tracks.iter().map(|Track { of, labels, curve }| {
            let curves = past(curve, t, of(self.plane.trajectory(), t)).into();
            PanelDocument { natural: NATURAL, ..PanelDocument::of_curves(*labels, curves) }
        }));
        let (unit, note) = ("Γ/k".into(), String::new());
        let (tip, support) = (self.plane.tip(t).into(), self.plane.support(t).map(Into::into));
        Ok(Moment { t, unit, note, panels, tip, support })
    }
}
