//! Figures of surfaces and images.

use super::axes::{MAP, NATURAL, SURFACE, surface_map};
use super::drawn::{Drawn, View};
use super::quantity::Quantity;
use super::tip::model_name;
use crate::axis::extremes;
use crate::error::FigureError;
use crate::number::short;
use stickslip::{
    CurveDocument, FigureDocument, PanelDocument, StyleName, SurfaceCurve, SurfaceDocument,
};

/// Largest number of surfaces with their own panels; more are overlaid in colours.
const MOST_PANELS: usize = 8;
/// Width of the untouched surface shown on either side, in σ.
const UNTOUCHED: f64 = 6.0;
/// Change relative to all heights below which a surface counts as untouched.
const LEVEL: f64 = 1e-3;

impl Drawn for SurfaceDocument {
    fn figure(&self, view: &View) -> Result<FigureDocument, FigureError> {
        let model = &self.parameters.model;
        let far = if self.parameters.far_behind { ", far behind the tip" } else { "" };
        let title = format!("{}{far}", model_name(model));
        let panels =
            if self.images.is_empty() { curves(&self.surfaces, view) } else { images(self) };
        Ok(FigureDocument::new("surface", &title, vec![model.clone()], panels))
    }
}

/// A height map for every time, with a common colour scale.
fn images(document: &SurfaceDocument) -> Vec<PanelDocument> {
    let heights = document.images.iter().flat_map(|image| image.u.iter().flatten().copied());
    let range = extremes(heights.filter(|u| u.is_finite()));
    let range = range.filter(|(low, high)| low < high).map(|(low, high)| [low, high]);
    let panel = |image: &stickslip::SurfaceImage| {
        let map = Some(surface_map((&image.x, &image.y), image.u.clone(), range));
        PanelDocument { map, ..PanelDocument::new(&time(image.t), MAP) }
    };
    document.images.iter().map(panel).collect()
}

/// Panels with the same axes: overlaid surfaces would hide each other.
fn curves(surfaces: &[SurfaceCurve], view: &View) -> Vec<PanelDocument> {
    let all = surfaces.iter().flat_map(|s| s.u.iter().copied().filter(|u| u.is_finite()));
    let Some((low, high)) = extremes(all) else { return vec![] };
    let shown: Vec<[f64; 2]> = surfaces.iter().filter_map(|s| touched(s, high - low)).collect();
    let from = shown.iter().map(|range| range[0]).fold(f64::INFINITY, f64::min);
    let to = shown.iter().map(|range| range[1]).fold(f64::NEG_INFINITY, f64::max);
    let x_range = view.x_range.or((from < to).then_some([from, to]));
    let air = 0.06 * (high - low);
    let y_range = (high - low > 1e-6).then_some([low - air, high + air]);
    let panel = |surface: &SurfaceCurve| {
        // The line ends where the tip has not come yet.
        let end = touched(surface, high - low).map_or(f64::INFINITY, |range| range[1]);
        let shown = surface.x.partition_point(|x| *x <= end);
        let (x, u) = (&surface.x[..shown], &surface.u[..shown.min(surface.u.len())]);
        let curve = CurveDocument::new(StyleName::Line, &time(surface.t), x, u);
        let panel = PanelDocument::of_curves(SURFACE, vec![curve]);
        PanelDocument { natural: NATURAL, x_range, y_range, ..panel }
    };
    let panels: Vec<PanelDocument> = surfaces.iter().map(panel).collect();
    if panels.len() <= MOST_PANELS {
        return panels;
    }
    overlaid(panels)
}

/// All curves in the first panel, with different colours and dashes.
fn overlaid(panels: Vec<PanelDocument>) -> Vec<PanelDocument> {
    use stickslip::ColourName::{Black, Blue, Green, Orange, Purple, Sky, Vermillion};
    const COLOURS: [stickslip::ColourName; 7] =
        [Blue, Vermillion, Green, Purple, Orange, Sky, Black];
    const STYLES: [StyleName; 3] = [StyleName::Line, StyleName::Dashed, StyleName::Dotted];
    let mut all = panels.into_iter();
    let Some(mut first) = all.next() else { return vec![] };
    first.curves.extend(all.flat_map(|panel| panel.curves));
    for (i, curve) in first.curves.iter_mut().enumerate() {
        curve.colour = Some(COLOURS[i % COLOURS.len()]);
        curve.style = STYLES[i / COLOURS.len() % STYLES.len()];
    }
    vec![first]
}

/// The range of positions without the surface far from the tip's path.
fn touched(surface: &SurfaceCurve, span: f64) -> Option<[f64; 2]> {
    let (first, last) = (*surface.x.first()?, *surface.x.last()?);
    let end = *surface.u.last()?;
    let places = surface.x.iter().zip(&surface.u);
    let beyond = places.rev().position(|(_, u)| (u - end).abs() > LEVEL * span);
    let beyond = beyond.map(|back| surface.x.len().min(surface.u.len()) - 1 - back);
    let to = beyond.map_or(last, |i| (surface.x[i] + UNTOUCHED).min(last));
    Some([first, to])
}

/// A label such as "t = 457".
fn time(t: f64) -> String {
    format!("t = {}", Quantity::new(t, "Γ/k").in_text(&short(t)))
}
