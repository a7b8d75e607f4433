//! A raster as a scene: the surface line by line with the tip, and the lag along the line.

use super::axes::{LAG, MAP, NATURAL, evenly, heights_within, surface_map};
use super::dense::shown;
use super::tip::raster_title;
use crate::axis::extremes;
use crate::error::FigureError;
use crate::scene::{Moment, Scene, Shot};
use stickslip::{
    ColourName, CurveDocument, FigureDocument, HeightMap, MapDocument, PanelDocument,
    RasterDocument, StyleName,
};
use stickslip_raster::{Line, Plan};
use stickslip_surface::{carved, carved_across};
use stickslip_tip::sorting::sort_by_number;

/// Largest number of columns and rows of the map: its pixels.
const MOST: usize = 640;
/// Points of the lag along a line.
const POINTS: u32 = 400;

/// A raster between two times, counted from the start of the first line.
pub(super) struct Growing {
    title: String,
    document: RasterDocument,
    plan: Plan,
    lines: Vec<Line>,
    /// Start of each line, and the end of the last.
    starts: Vec<f64>,
    times: [f64; 2],
    /// The surface after the last line.
    whole: HeightMap,
    colours: Option<[f64; 2]>,
    lags: [f64; 2],
    /// The surface after the lines before `done`.
    u: Vec<Vec<f64>>,
    done: usize,
}

impl Growing {
    pub(super) fn of(raster: &RasterDocument, shot: &Shot) -> Result<Self, FigureError> {
        let (plan, lines) = raster.scanned()?;
        let duration = |n: usize| plan.duration(n);
        let mut starts = vec![0.0];
        starts.extend((0..lines.len()).scan(0.0, |end, n| {
            *end += duration(n);
            Some(*end)
        }));
        let end = starts.last().copied().unwrap_or_default();
        let times = shown("raster", [0.0, end], shot.times.unwrap_or([0.0, end]))?;
        let map = raster.height_map()?;
        let whole = raster.heights(sparse(map.x), sparse(map.y))?;
        let times_of = |line: &Line| evenly([0.0, line.trajectory().end()], POINTS);
        let lags = lines.iter().flat_map(|line| times_of(line).map(|t| line.lag(t)));
        let (low, high) = extremes(lags).unwrap_or((0.0, 1.0));
        let air = 0.06 * (high - low).max(1e-6 * NATURAL.unwrap_or(1.0));
        Ok(Self {
            title: raster_title(&raster.parameters),
            document: raster.clone(),
            colours: heights_within(&whole),
            u: vec![vec![0.0; whole.x.len()]; whole.y.len()],
            done: 0,
            lags: [low - air, high + air],
            plan,
            lines,
            starts,
            times,
            whole,
        })
    }

    /// Carves line n into `u`, the surface at the start of the line, up to time t after this start.
    fn carve(&self, n: usize, t: f64, u: &mut [Vec<f64>]) {
        let left = self.plan.law.model.wider().left_after(t);
        if left < 1.0 {
            u.iter_mut().flatten().for_each(|u| *u *= left);
        }
        let line = &self.lines[n];
        if line.is_free() { self.carve_freely(line, t, u) } else { self.carve_on_track(line, t, u) }
    }

    /// Adds the groove of a tip that is free to leave its line.
    fn carve_freely(&self, line: &Line, t: f64, u: &mut [Vec<f64>]) {
        let (mut visits, alpha) = (line.visits_until(t), self.plan.law.model.alpha());
        sort_by_number(&mut visits, |item| item.x);
        let Some((low, high)) = extremes(visits.iter().map(|visit| visit.y)) else { return };
        let (low, high) = (low - self.plan.reach_across(), high + self.plan.reach_across());
        let y = &self.whole.y;
        let rows = y.partition_point(|y| *y < low)..y.partition_point(|y| *y <= high);
        for layer in self.plan.footprint.layers() {
            let carved = carved_across(layer, &visits, &self.whole.x, &y[rows.clone()]);
            for (i, column) in carved.iter().enumerate() {
                let cells = u[rows.clone()].iter_mut().zip(column);
                cells.for_each(|(row, carved)| row[i] -= alpha * carved);
            }
        }
    }

    /// Adds the groove of a tip that is held on its line.
    fn carve_on_track(&self, line: &Line, t: f64, u: &mut [Vec<f64>]) {
        let track = line.track();
        let (mut positions, weights) = line.trajectory().residence(t);
        positions.iter_mut().for_each(|x| *x = track.x(*x));
        let model = &self.plan.law.model;
        let reach = self.plan.reach_across();
        for layer in self.plan.footprint.layers() {
            let along = carved(&layer.along, &positions, &weights, &self.whole.x);
            for (row, y) in u.iter_mut().zip(&self.whole.y) {
                if (y - track.y).abs() > reach {
                    continue;
                }
                let height = -model.alpha() * layer.across.value(y - track.y);
                row.iter_mut().zip(&along).for_each(|(u, along)| *u += height * along);
            }
        }
    }

    /// The surface at time t after the start of line n.
    fn surface(&mut self, n: usize, t: f64) -> Vec<Vec<f64>> {
        let mut u = std::mem::take(&mut self.u);
        if n < self.done {
            self.done = 0;
            u.iter_mut().flatten().for_each(|u| *u = 0.0);
        }
        for m in self.done..n {
            self.carve(m, self.plan.duration(m), &mut u);
        }
        (self.u, self.done) = (u.clone(), n);
        self.carve(n, t, &mut u);
        u
    }

    fn map(&self, z: Vec<Vec<f64>>) -> MapDocument {
        surface_map((&self.whole.x, &self.whole.y), z, self.colours)
    }
}

impl Scene for Growing {
    fn still(&self) -> FigureDocument {
        let model = self.document.parameters.model_parameters();
        let mut surface = PanelDocument::new("", MAP);
        surface.map = Some(self.map(self.whole.u.clone()));
        let mut lag = PanelDocument::new("", (MAP.0, LAG.1));
        let ends = self.whole.x.first().zip(self.whole.x.last());
        lag.x_range = ends.map(|(first, last)| [*first, *last]);
        (lag.natural, lag.y_range) = (NATURAL, Some(self.lags));
        FigureDocument::new("growing", &self.title, vec![model], vec![surface, lag])
    }

    fn times(&self) -> [f64; 2] {
        self.times
    }

    fn moment(&mut self, t: f64) -> Result<Moment, FigureError> {
        let last = self.lines.len() - 1;
        let n = (self.starts.partition_point(|start| *start <= t).max(1) - 1).min(last);
        let since = (t - self.starts[n]).clamp(0.0, self.plan.duration(n));
        let mut surface = PanelDocument::new("", MAP);
        let u = self.surface(n, since);
        surface.map = Some(self.map(u));
        let (line, r) = (&self.lines[n], self.plan.law.model.r());
        let track = line.track();
        let before = n.checked_sub(1).map(|before| &self.lines[before]);
        let before = before.map(|before| trace(before, before.trajectory().end(), r));
        let now = (track.x(r * since), line.lag(since));
        let mut lags = Vec::from_iter(before.map(|before| before.coloured(ColourName::Silver)));
        lags.push(trace(line, since, r));
        lags.push(CurveDocument::new(StyleName::Dots, "", &[now.0], &[now.1]));
        let lag = PanelDocument::of_curves((MAP.0, LAG.1), lags);
        Ok(Moment {
            t,
            unit: "Γ/k".into(),
            note: format!("line {} of {}", n + 1, self.lines.len()),
            panels: vec![surface, lag],
            tip: (line.x0(since), line.y0(since)),
            support: Some((now.0, track.y)),
        })
    }
}

/// The lag along a line until this time, against the position of the support.
fn trace(line: &Line, until: f64, r: f64) -> CurveDocument {
    let times = evenly([0.0, until], POINTS);
    let (x, lag): (Vec<f64>, Vec<f64>) =
        times.map(|t| (line.track().x(r * t), line.lag(t))).unzip();
    CurveDocument::new(StyleName::Line, "", &x, &lag)
}

/// At most [`MOST`] of these evenly spaced positions.
fn sparse(all: Vec<f64>) -> Vec<f64> {
    let every = all.len().div_ceil(MOST).max(1);
    all.into_iter().step_by(every).collect()
}
