//! Figure of a raster: the surface with its crests, and the lags, which the instrument measures as lateral force.

use super::axes::{MAP, SPRING, SURFACE, differences, evenly, heights_within, surface_map};
use super::drawn::{Drawn, View};
#[cfg(feature = "animation")]
use super::growing::Growing;
use super::quantity::Quantity;
use super::tip::raster_title;
use crate::error::FigureError;
use crate::number::short;
#[cfg(feature = "animation")]
use crate::scene::{Scene, Shot};
use std::f64::consts::{PI, TAU};
use stickslip::{
    ColourName, ColoursName, ComparedLine, CurveDocument, FigureDocument, HeightMap, MapDocument,
    PanelDocument, PathName, RasterCompareDocument, RasterDocument, RasterSurfaceDocument,
    StyleName,
};

/// Ends of the patch with marked crests, as fractions of the length of the lines.
const MARKED: (f64, f64) = (0.4, 0.65);
/// Centre of this patch across the lines, and its largest width across, as fractions of the extent of the lines.
const MARKED_LINES: f64 = 0.72;
const MARKED_PART: f64 = 0.4;
/// Largest number of crests that leaves the surface visible.
const MOST_CRESTS: i64 = 24;
/// Largest number of lines with a drawn path of the tip, and points of each.
const MOST_PATHS: usize = 64;
const POINTS_OF_A_PATH: u32 = 300;
impl Drawn for RasterDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let parameters = &self.parameters;
        let title = raster_title(parameters);
        let map = self.height_map()?;
        let mut surface = PanelDocument::new(&heading(self), MAP);
        let wave = self.pattern.as_ref().and_then(|p| p.q.zip(p.kappa));
        if let Some(wave) = wave {
            let is_lines = parameters.plan()?.area.pitch(parameters.path).is_some();
            surface.curves.extend(is_lines.then(|| crests(&map, wave)).flatten());
        }
        if parameters.stiffness_across.is_some() {
            surface.curves.push(paths(self)?);
        }
        let x = map.x.clone();
        let z_range = heights_within(&map);
        surface.map = Some(MapDocument { z_range, ..heights(map) });
        let (models, panels) = (vec![parameters.model_parameters()], vec![surface, lags(self, x)?]);
        // Beside its passes the strip of one line would be far smaller than they.
        let columns = if parameters.path == PathName::Repeat { 1 } else { 2 };
        Ok(FigureDocument { columns, ..FigureDocument::new("raster", &title, models, panels) })
    }

    #[cfg(feature = "animation")]
    fn scene(&self, shot: &Shot) -> Result<Box<dyn Scene>, FigureError> {
        Ok(Box::new(Growing::of(self, shot)?))
    }
}

impl Drawn for RasterCompareDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let parameters = &self.parameters.raster;
        let title = format!("Raster and grid, {}", raster_title(parameters));
        let mut panels = vec![];
        let map = HeightMap { x: self.x.clone(), y: self.y.clone(), u: self.closed_u.clone() };
        let off = self.closed_u.iter().zip(&self.grid_u);
        let row = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a - b).collect();
        let apart = HeightMap { u: off.map(row).collect(), ..map.clone() };
        if is_even(&map.x) && is_even(&map.y) {
            let mut surface = PanelDocument::new("closed equation", MAP);
            surface.map = Some(heights(map));
            let mut difference = PanelDocument::new("difference from the grid", MAP);
            let z_label = "Δu (kσ²/a)".into();
            difference.map =
                Some(MapDocument { z_label, colours: ColoursName::BlueRed, ..heights(apart) });
            panels = vec![surface, difference];
        }
        let panel = |label: &str, sides: fn(&ComparedLine) -> Option<[&Vec<f64>; 2]>| {
            let columns = |line| sides(line).map(|[a, b]| [&*line.t, a, b]);
            let labels = ("t since the start of a line (Γ/k)", label);
            differences(labels, self.lines.iter().filter_map(columns))
        };
        panels.push(panel("|Δx₀| (σ)", |line| Some([&line.closed_x0, &line.grid_x0])));
        if self.max_difference.y0.is_some() {
            panels.push(panel("|Δy₀| (σ)", |line| {
                Some([line.closed_y0.as_ref()?, line.grid_y0.as_ref()?])
            }));
        }
        let models = vec![parameters.model_parameters()];
        Ok(FigureDocument::new("raster-compare", &title, models, panels))
    }
}

impl Drawn for RasterSurfaceDocument {
    /// A height map, or profiles if there are too few rows for a map.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let title = raster_title(&self.parameters);
        let panel = |map: &HeightMap| {
            if is_even(&map.x) && is_even(&map.y) {
                let map = Some(heights(map.clone()));
                return PanelDocument { map, ..PanelDocument::new("", MAP) };
            }
            let curve = |(y, u): (&f64, &Vec<f64>)| {
                CurveDocument::new(StyleName::Line, &format!("y = {}", short(*y)), &map.x, u)
            };
            PanelDocument::of_curves(SURFACE, map.y.iter().zip(&map.u).map(curve).collect())
        };
        let models = vec![self.parameters.model_parameters()];
        let panels = self.surfaces.iter().map(panel).collect();
        Ok(FigureDocument::new("raster-surface", &title, models, panels))
    }
}

/// Whether these positions are evenly spaced, as a map requires.
fn is_even(v: &[f64]) -> bool {
    let [first, .., last] = v else { return false };
    let step = (last - first) / (v.len() - 1) as f64;
    let off = |(i, x): (usize, &f64)| (x - first - step * i as f64).abs() > 1e-6 * step.abs();
    v.len() > 2 && step > 0.0 && !v.iter().enumerate().any(off)
}

/// A heading such as "ripples: 6.12 ± 0.21 σ at 46.0 ± 2.2°, coherence 0.998".
fn heading(document: &RasterDocument) -> String {
    let regime = document.regime;
    let Some(p) = &document.pattern else { return regime.to_string() };
    let [length, angle] = p.in_words();
    let length = length.zip(p.wavelength).map(|(plain, value)| {
        Quantity { value, error: p.wavelength_error, unit: "σ" }.in_text(&plain)
    });
    let coherence = format!("coherence {:.3}", p.coherence_same_way.unwrap_or(p.coherence));
    let wave = match (length, angle) {
        (Some(length), Some(angle)) => Some(format!("{length} at {angle}")),
        (Some(length), None) => Some(length),
        (None, Some(angle)) => Some(format!("crests at {angle}")),
        (None, None) => None,
    };
    let parts: Vec<String> = wave.into_iter().chain([coherence]).collect();
    // A number and its error stay on one line.
    format!("{regime}: {}", parts.join(", ")).replace(" ± ", "\u{a0}±\u{a0}")
}

fn heights(map: HeightMap) -> MapDocument {
    surface_map((&map.x, &map.y), map.u, None)
}

/// Crests of the wave with the reported wavelength and angle, in phase with the surface on the patch: straight lines
/// qx + κy + φ = 2πm.
fn crests(map: &HeightMap, (q, kappa): (f64, f64)) -> Option<CurveDocument> {
    let (x, y) = patch(map)?;
    let phase = phase(map, (&x, &y), (q, kappa))?;
    Some(crest_lines((&x, &y), (q, kappa), phase))
}

/// The straight lines qx + κy + φ = 2πm within a rectangle.
pub(super) fn crest_lines(
    (x, y): (&[f64; 2], &[f64; 2]),
    (q, kappa): (f64, f64),
    phase: f64,
) -> CurveDocument {
    let turns = |x: f64, y: f64| (q * x + kappa * y + phase) / TAU;
    let corners = [(x[0], y[0]), (x[0], y[1]), (x[1], y[0]), (x[1], y[1])];
    let all = corners.map(|(x, y)| turns(x, y));
    let first = all.iter().copied().fold(f64::INFINITY, f64::min).ceil() as i64;
    let last = all.iter().copied().fold(f64::NEG_INFINITY, f64::max).floor() as i64;
    let every = (last.saturating_sub(first) / MOST_CRESTS).max(0) as usize + 1;
    let mut points: (Vec<f64>, Vec<f64>) = (vec![], vec![]);
    for m in (first..=last).step_by(every) {
        for end in ends(TAU * m as f64 - phase, (q, kappa), (x, y)).into_iter().flatten() {
            points.0.push(end.0);
            points.1.push(end.1);
        }
        // The next begins elsewhere.
        points.0.push(points.0.last().copied().unwrap_or(0.0));
        points.1.push(f64::NAN);
    }
    CurveDocument::new(StyleName::Line, "", &points.0, &points.1).coloured(ColourName::Vermillion)
}

/// Ranges of the patch in x and y: along the middle of the lines, among the last half of the lines.
fn patch(map: &HeightMap) -> Option<([f64; 2], [f64; 2])> {
    let ([left, .., right], [low, .., high]) = (&*map.x, &*map.y) else { return None };
    let (length, across) = (right - left, high - low);
    let x = [left + MARKED.0 * length, left + MARKED.1 * length];
    let middle = low + MARKED_LINES * across;
    let half = 0.5 * (x[1] - x[0]).min(MARKED_PART * across);
    Some((x, [middle - half, middle + half]))
}

/// Phase φ of the sum Σ w u e^{-i(qx + κy)} over the patch; u are the heights minus the mean of their row, w is a window.
fn phase(map: &HeightMap, (x, y): (&[f64; 2], &[f64; 2]), (q, kappa): (f64, f64)) -> Option<f64> {
    let part = |at: f64, ends: &[f64; 2]| (at - ends[0]) / (ends[1] - ends[0]);
    let window = |part: f64| {
        if (0.0..=1.0).contains(&part) { (PI * part).sin().powi(2) } else { 0.0 }
    };
    let across: Vec<f64> = map.x.iter().map(|at| window(part(*at, x))).collect();
    let total: f64 = across.iter().sum();
    let (mut cos, mut sin) = (0.0, 0.0);
    for (row, at) in map.u.iter().zip(&map.y) {
        let mean = row.iter().zip(&across).map(|(u, w)| u * w).sum::<f64>() / total;
        let weight = window(part(*at, y));
        for ((u, w), along) in row.iter().zip(&across).zip(&map.x) {
            let turn = q * along + kappa * at;
            cos += weight * w * (u - mean) * turn.cos();
            sin -= weight * w * (u - mean) * turn.sin();
        }
    }
    (cos.hypot(sin) > 0.0).then(|| sin.atan2(cos))
}

/// Intersections of the line qx + κy = c with a rectangle.
fn ends(c: f64, (q, kappa): (f64, f64), (x, y): (&[f64; 2], &[f64; 2])) -> Option<[(f64, f64); 2]> {
    let inside = |at: f64, ends: &[f64; 2]| {
        let slack = 1e-9 * (ends[1] - ends[0]);
        (ends[0] - slack..=ends[1] + slack).contains(&at)
    };
    let sides = x.iter().map(|x| (*x, (c - q * x) / kappa)).filter(|(_, at)| inside(*at, y));
    let levels = y.iter().map(|y| ((c - kappa * y) / q, *y)).filter(|(at, _)| inside(*at, x));
    let found: Vec<(f64, f64)> = sides.chain(levels).collect();
    let apart = |a: &(f64, f64), b: &(f64, f64)| (a.0 - b.0).hypot(a.1 - b.1);
    let first = *found.first()?;
    let last = *found.iter().max_by(|a, b| apart(a, &first).total_cmp(&apart(b, &first)))?;
    Some([first, last])
}

/// The paths of the tip over the surface, of all lines or of evenly spaced ones.
fn paths(document: &RasterDocument) -> Result<CurveDocument, FigureError> {
    let (_, lines) = document.scanned()?;
    let every = lines.len().div_ceil(MOST_PATHS);
    let (mut x, mut y) = (vec![], vec![]);
    for line in lines.iter().step_by(every) {
        let end = line.trajectory().end();
        for t in evenly([0.0, end], POINTS_OF_A_PATH) {
            x.push(line.x0(t));
            y.push(line.y0(t));
        }
        // The next begins elsewhere.
        x.push(line.x0(end));
        y.push(f64::NAN);
    }
    Ok(CurveDocument::new(StyleName::Line, "", &x, &y).coloured(ColourName::Silver))
}

/// The lag along each line against the position x of the support.
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
    let mut panel = PanelDocument::new("", ("support at x (σ)", y_label));
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
    let (z_label, colours) = (SPRING.into(), ColoursName::Grey);
    panel.map = Some(MapDocument { x, y, z, z_label, colours, z_range: None });
    Ok(panel)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every mark runs along a crest of the surface, perpendicular to its wave vector. Test surface: a given wave
    /// with a slope and a harmonic.
    #[test]
    fn marks_run_along_crests() {
        for (q, kappa) in [(0.99, -0.96), (0.8, 0.4), (0.5, 1.1), (0.9, 0.0)] {
            let x: Vec<f64> = (0..=400).map(|i| 0.25 * f64::from(i)).collect();
            let y: Vec<f64> = (0..200).map(|n| 0.5 * f64::from(n)).collect();
            let wave = |x: f64, y: f64| {
                let turn = q * x + kappa * y + 0.7;
                turn.cos() + 0.2 * (2.0 * turn).cos()
            };
            let row = |y: &f64| x.iter().map(|x| wave(*x, *y) + 0.01 * x - 3.0).collect();
            let u = y.iter().map(row).collect();
            let marks = crests(&HeightMap { x, y, u }, (q, kappa)).unwrap();
            let (mut count, mut from): (usize, Option<(f64, f64)>) = (0, None);
            for (x, y) in marks.x.iter().zip(&marks.y) {
                let Some(y) = y.filter(|y| y.is_finite()) else {
                    from = None;
                    continue;
                };
                assert!(wave(*x, y) > 1.15, "{q} {kappa}: {}", wave(*x, y));
                if let Some((x0, y0)) = from {
                    let along = q * (x - x0) + kappa * (y - y0);
                    assert!(along.abs() < 1e-9 * (1.0 + (x - x0).hypot(y - y0)), "{along}");
                    count += 1;
                }
                from = Some((*x, y));
            }
            assert!(count >= 3, "{q} {kappa}: {count}");
        }
    }
}
