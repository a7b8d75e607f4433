//! The surface of a run in the plane from above, with the path of the tip on it.

use super::axes::{MAP, evenly, surface_map};
use super::dense::{duration, shown};
use crate::axis::extremes;
use crate::error::{FigureError, damaged};
use stickslip::{ColourName, CurveDocument, PanelDocument, RunDocument, StyleName};
use stickslip_surface::SurfaceAcross;
use stickslip_tip::Support;
use stickslip_tip::planar::{PlanarScenario, Trajectory};

/// Path shown by default, in σ.
const PATH: f64 = 60.0;
/// Surface shown behind the tip, ahead of tip and support, and on either side of the path, in σ.
const BEHIND: f64 = 6.0;
const AHEAD: f64 = 4.0;
const ASIDE: f64 = 3.0;
/// Largest number of columns of the map, and their least distance in σ.
const COLUMNS: f64 = 600.0;
const SPACING: f64 = 0.1;
/// Points of the path of the tip.
const POINTS: u32 = 2000;

/// The surface of a run in the plane, near the path of the tip between two times.
pub(super) struct Plane {
    scenario: PlanarScenario,
    trajectory: Trajectory,
    times: [f64; 2],
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Plane {
    /// The surface between these times; by default where the tip went last.
    pub(super) fn of(run: &RunDocument, times: Option<[f64; 2]>) -> Result<Self, FigureError> {
        let (scenario, trajectory) = run.trajectory_across()?;
        let (start, end) = (trajectory.start(), trajectory.end());
        let way = trajectory.x0(end) - trajectory.x0(start);
        let last = [end - duration(PATH, (way, end - start)), end];
        let times = shown("run", [start, end], times.unwrap_or(last))?;
        let mut plane = Self { scenario, trajectory, times, x: vec![], y: vec![] };
        let (tip, support) = (plane.path(times[1]), plane.instants(times[1]));
        let support = support.filter_map(|t| plane.support(t)).map(|[x, _]| x);
        let x = extremes(tip.iter().map(|[x, _]| *x).chain(support)).unwrap_or((0.0, 1.0));
        let y = extremes(tip.iter().map(|[_, y]| *y).chain([0.0])).unwrap_or((0.0, 1.0));
        let (x, y) = ((x.0 - BEHIND, x.1 + AHEAD), (y.0 - ASIDE, y.1 + ASIDE));
        let spacing = ((x.1 - x.0).max(y.1 - y.0) / COLUMNS).max(SPACING);
        (plane.x, plane.y) = (even(x, spacing), even(y, spacing));
        Ok(plane)
    }

    /// First and last time.
    pub(super) fn times(&self) -> [f64; 2] {
        self.times
    }

    #[cfg(feature = "animation")]
    pub(super) fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// The map of the surface at a time, with the path of the tip until then; colours cover these heights, by default
    /// those of the map.
    pub(super) fn seen(
        &self,
        t: f64,
        colours: Option<[f64; 2]>,
    ) -> Result<PanelDocument, FigureError> {
        let mut panel = PanelDocument::new("", MAP);
        panel.map = Some(surface_map((&self.x, &self.y), self.surface(t)?, colours));
        let (x, y): (Vec<f64>, Vec<f64>) = self.path(t).into_iter().map(|[x, y]| (x, y)).unzip();
        let path = CurveDocument::new(StyleName::Line, "path of the tip", &x, &y);
        panel.curves = vec![path.coloured(ColourName::Silver)];
        Ok(panel)
    }

    fn surface(&self, t: f64) -> Result<Vec<Vec<f64>>, FigureError> {
        let surface = SurfaceAcross::new(&self.scenario, &self.trajectory).map_err(damaged)?;
        let u = surface.image(t, &self.x, &self.y).map_err(damaged)?;
        Ok(u.rows().into_iter().map(|row| row.to_vec()).collect())
    }

    /// Times from the first one shown to `t`.
    pub(super) fn instants(&self, t: f64) -> impl Iterator<Item = f64> + use<> {
        evenly([self.times[0], t], POINTS)
    }

    fn path(&self, t: f64) -> Vec<[f64; 2]> {
        self.instants(t).map(|t| self.tip(t)).collect()
    }

    pub(super) fn tip(&self, t: f64) -> [f64; 2] {
        [self.trajectory.x0(t), self.trajectory.y0(t)]
    }

    /// The support, which stays on the line y = 0.
    pub(super) fn support(&self, t: f64) -> Option<[f64; 2]> {
        match self.trajectory.support() {
            Support::None => None,
            support => Some([support.position(t), 0.0]),
        }
    }
}

fn even((low, high): (f64, f64), spacing: f64) -> Vec<f64> {
    evenly([low, high], ((high - low) / spacing).ceil().max(1.0) as u32).collect()
}
