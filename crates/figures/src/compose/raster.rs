//! Rasters: the surface with its crests, and the lags, which the instrument shows as lateral force.

use super::drawn::{Drawn, View};
use super::tip::model_name;
use crate::axis::extremes;
use crate::error::FigureError;
use crate::number::short;
use stickslip_documents::{
    ColourName, ColoursName, ComparedLine, CurveDocument, FigureDocument, HeightMap, MapDocument,
    PanelDocument, PathName, RasterCompareDocument, RasterDocument, RasterParameters,
    RasterSurfaceDocument, ScaleName, StyleName,
};
use stickslip_raster::Plan;

/// Crests are marked on a strip, of the length and of the lines, with no more marks than leave the surface to be seen.
const MARKED: (f64, f64) = (0.4, 0.6);
const MARKED_LINES: f64 = 0.5;
const MOST_MARKS: usize = 400;
/// Colours are those of the heights between these parts of the length: pits at the ends are deeper.
const COLOURED: (f64, f64) = (0.2, 0.85);

impl Drawn for RasterDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let parameters = &self.parameters;
        let title = format!("{}, {}", model_name(&parameters.model), path_name(parameters));
        let mut figure = FigureDocument::new("raster", &title, vec![parameters.model.clone()]);
        let map = self.height_map()?;
        let mut surface = PanelDocument::new(&heading(self), ("x (σ)", "y (σ)"));
        if self.pattern.is_some() {
            surface.curves.push(crests(&map, &parameters.plan()?));
        }
        let x = map.x.clone();
        let z_range = heights_within(&map);
        surface.map = Some(MapDocument { z_range, ..heights(map) });
        let lags = lags(self, x)?;
        figure.panels = vec![surface, lags];
        figure.columns = 2;
        Ok(figure)
    }
}

impl Drawn for RasterCompareDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let parameters = &self.parameters.raster;
        let model = &parameters.model;
        let title = format!("Raster and grid, {}, {}", model_name(model), path_name(parameters));
        let mut figure = FigureDocument::new("raster-compare", &title, vec![model.clone()]);
        let map = HeightMap { x: self.x.clone(), y: self.y.clone(), u: self.closed_u.clone() };
        let off = self.closed_u.iter().zip(&self.grid_u);
        let row = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a - b).collect();
        let apart = HeightMap { u: off.map(row).collect(), ..map.clone() };
        if is_even(&map.x) && is_even(&map.y) {
            let mut surface = PanelDocument::new("closed equation", ("x (σ)", "y (σ)"));
            surface.map = Some(heights(map));
            let mut difference = PanelDocument::new("less that of the grid", ("x (σ)", "y (σ)"));
            let z_label = "Δu (kσ²/a)".into();
            difference.map =
                Some(MapDocument { z_label, colours: ColoursName::BlueRed, ..heights(apart) });
            figure.panels = vec![surface, difference];
        }
        let mut motions =
            PanelDocument::new("", ("t since the start of a line (Γ/k)", "|Δx₀| (σ)"));
        motions.y_scale = ScaleName::Logarithmic;
        let curve = |line: &ComparedLine| {
            let pairs = line.closed_x0.iter().zip(&line.grid_x0).map(|(a, b)| (a - b).abs());
            // Equal values have no place on a logarithmic axis.
            let apart: Vec<f64> = pairs.map(|d| if d > 0.0 { d } else { f64::NAN }).collect();
            CurveDocument::new(StyleName::Line, "", &line.t, &apart)
        };
        motions.curves = self.lines.iter().map(curve).collect();
        figure.panels.push(motions);
        Ok(figure)
    }
}

impl Drawn for RasterSurfaceDocument {
    /// A height map, or profiles where there are too few rows for one.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let model = &self.parameters.model;
        let title = format!("{}, {}", model_name(model), path_name(&self.parameters));
        let mut figure = FigureDocument::new("raster-surface", &title, vec![model.clone()]);
        for map in &self.surfaces {
            let mut panel;
            if is_even(&map.x) && is_even(&map.y) {
                panel = PanelDocument::new("", ("x (σ)", "y (σ)"));
                panel.map = Some(heights(map.clone()));
            } else {
                panel = PanelDocument::new("", ("x (σ)", "u (kσ²/a)"));
                let curve = |(y, u): (&f64, &Vec<f64>)| {
                    CurveDocument::new(StyleName::Line, &format!("y = {}", short(*y)), &map.x, u)
                };
                panel.curves = map.y.iter().zip(&map.u).map(curve).collect();
            }
            figure.panels.push(panel);
        }
        Ok(figure)
    }
}

/// Whether a map can have these columns or rows.
fn is_even(v: &[f64]) -> bool {
    let [first, .., last] = v else { return false };
    let step = (last - first) / (v.len() - 1) as f64;
    let off = |(i, x): (usize, &f64)| (x - first - step * i as f64).abs() > 1e-6 * step.abs();
    v.len() > 2 && step > 0.0 && !v.iter().enumerate().any(off)
}

fn path_name(parameters: &RasterParameters) -> String {
    let pitch = parameters.pitch.map_or(String::new(), |pitch| format!(", pitch {}", short(pitch)));
    let path = match parameters.path {
        PathName::OneWay => "one-way",
        PathName::Zigzag => "zigzag",
        PathName::Repeat => "one line repeated",
    };
    let shape = parameters.area.as_ref().map_or("", |_| ", an area of its own");
    format!("{path}{pitch}{shape}")
}

/// Such as "ripples: 6.12 σ at 46.0°, coherence 0.998".
fn heading(document: &RasterDocument) -> String {
    let regime = document.regime;
    match &document.pattern {
        None => regime.to_string(),
        Some(p) => {
            format!(
                "{regime}: {:.2} σ at {:.1}°, coherence {:.3}",
                p.wavelength,
                p.crest_angle,
                p.coherence_same_way.unwrap_or(p.coherence)
            )
        }
    }
}

fn heights(map: HeightMap) -> MapDocument {
    MapDocument {
        x: map.x,
        y: map.y,
        z: map.u,
        z_label: "u (kσ²/a)".into(),
        colours: ColoursName::Cividis,
        z_range: None,
    }
}

/// The lowest and the highest between the ends of the lines.
fn heights_within(map: &HeightMap) -> Option<[f64; 2]> {
    let (low, high) = (map.x.first()?, map.x.last()?);
    let (from, to) = (low + COLOURED.0 * (high - low), low + COLOURED.1 * (high - low));
    let inside = |x: &f64| (from..=to).contains(x);
    let of = |row: &Vec<f64>| -> Vec<f64> {
        map.x.iter().zip(row).filter(|(x, _)| inside(x)).map(|(_, u)| *u).collect()
    };
    let (low, high) = extremes(map.u.iter().flat_map(of))?;
    (low < high).then_some([low, high])
}

/// Maxima along the lines, on as many lines as leave the surface to be seen: none where rows of the map are no lines.
fn crests(map: &HeightMap, plan: &Plan) -> CurveDocument {
    let tops = |n: usize| -> Vec<f64> {
        let (track, row) = (plan.track(n), &map.u[n]);
        let part = |i: &usize| track.along(map.x[*i]) / track.length;
        let inside = |i: &usize| (MARKED.0..=MARKED.1).contains(&part(i));
        let is_top = |i: &usize| row[*i] > row[i - 1] && row[*i] >= row[i + 1];
        (1..map.x.len() - 1).filter(inside).filter(is_top).map(|i| map.x[i]).collect()
    };
    let is_lines = plan.area.pitch(plan.path).is_some();
    let lines = if is_lines { map.u.len() } else { 0 };
    let first = (MARKED_LINES * lines as f64) as usize;
    let rows: Vec<Vec<f64>> = (first..lines).map(tops).collect();
    let all: usize = rows.iter().map(Vec::len).sum();
    let every = all.div_ceil(MOST_MARKS).max(1);
    let marked = rows.iter().zip(&map.y[first..]).step_by(every);
    let (x, y): (Vec<f64>, Vec<f64>) =
        marked.flat_map(|(row, y)| row.iter().map(move |x| (*x, *y))).unzip();
    let mut curve = CurveDocument::new(StyleName::Points, "", &x, &y);
    curve.colour = Some(ColourName::Vermillion);
    curve
}

/// The lag along each line, where the support is above x.
fn lags(document: &RasterDocument, x: Vec<f64>) -> Result<PanelDocument, FigureError> {
    let (plan, lines) = document.scanned()?;
    let is_repeated = document.parameters.path == PathName::Repeat;
    // Lines of a shape that do not go up evenly are shown one after the other.
    let is_even = plan.area.pitch(plan.path).is_some();
    let y_label = if is_repeated {
        "pass"
    } else if is_even {
        "y (σ)"
    } else {
        "line"
    };
    let mut panel = PanelDocument::new("lag behind the support", ("support at x (σ)", y_label));
    let r = plan.law.model.r();
    let row = |line: &stickslip_raster::Line| -> Vec<f64> {
        let track = line.track();
        // 0 beside a line of a shape.
        let beyond = |x: f64| !(0.0..=track.length).contains(&x);
        let lag = |x: &f64| match track.along(*x) {
            along if beyond(along) => 0.0,
            along => track.sign() * line.lag(along / r),
        };
        x.iter().map(lag).collect()
    };
    let z = lines.iter().map(row).collect();
    let y = |(n, line): (usize, &stickslip_raster::Line)| {
        if is_even { line.track().y } else { n as f64 + 1.0 }
    };
    let y = lines.iter().enumerate().map(y).collect();
    let (z_label, colours) = ("lag (σ)".into(), ColoursName::Grey);
    panel.map = Some(MapDocument { x, y, z, z_label, colours, z_range: None });
    Ok(panel)
}
