//! Labels and ranges of axes: the criterion for a logarithmic axis, and the heights that colours cover.

use crate::axis::extremes;
use stickslip::{
    ColoursName, CurveDocument, HeightMap, MapDocument, PanelDocument, ScaleName, StyleName,
};

/// r, (12).
pub(super) const R: &str = "r = Γv₀/(kσ)";
/// α, (13).
pub(super) const ALPHA: &str = "α = ΓNa/(k²σ²)";
/// Labels that replace those of r and α where scales are known: the quantities to which r and α are proportional.
pub(super) const V0: &str = "velocity of the support v₀ (kσ/Γ)";
pub(super) const N: &str = "indentation rate N (k²σ²/(aΓ))";
/// Labels of l against time.
pub(super) const L: (&str, &str) = ("t (Γ/k)", "l = rt − r − x₀ (σ)");
/// Labels of the tip's velocity against time.
pub(super) const VELOCITY: (&str, &str) = ("t (Γ/k)", "ẋ₀ (kσ/Γ)");
/// Labels of the spring extension against time, for a support on a path: the lateral force.
pub(super) const LAG: (&str, &str) = ("t (Γ/k)", "R − x₀ (σ)");
/// Label of the spring extension for a support of constant velocity.
pub(super) const LAG_OF_STEADY_SUPPORT: &str = "rt − x₀ (σ)";
/// Label of the spring extension in a map.
pub(super) const SPRING: &str = "lag (σ)";
/// The label that replaces these three where the scale of forces is known.
pub(super) const SPRING_FORCE: &str = "lateral force (kσ)";
/// The name of a curve of the extension, and its name where the axis is labelled as a force.
pub(super) const EXTENSION: [&str; 2] = ["R(t) − x₀(t)", "lateral force"];
/// Labels of the position of a tip without a spring.
pub(super) const POSITION: (&str, &str) = ("t (Γ/k)", "x₀ (σ)");
/// Label of the position of the support.
pub(super) const WAY: &str = "R (σ)";
/// Labels of the external force against time.
pub(super) const FORCE: (&str, &str) = ("t (Γ/k)", "F_{ext} (kσ)");
/// Labels of the surface.
pub(super) const SURFACE: (&str, &str) = ("x (σ)", "u (kσ²/a)");

/// Labels of a map of the surface.
pub(super) const MAP: (&str, &str) = ("x (σ)", "y (σ)");
/// Labels of y0 against time.
pub(super) const ACROSS: (&str, &str) = ("t (Γ/k)", "y₀ (σ)");

/// Typical size of the dimensionless quantities: far smaller variations are round-off.
pub(super) const NATURAL: Option<f64> = Some(1.0);

/// Ratio of largest to smallest value above which an axis is logarithmic.
pub(super) const WIDE: f64 = 30.0;

/// The colour scale covers the heights between these fractions of the length, because pits at the ends are deeper.
const COLOURED: (f64, f64) = (0.2, 0.85);

/// The label of measured numbers with their unit, if it is known.
pub(super) fn labelled(name: &str, unit: Option<&str>) -> String {
    format!("{name} ({})", unit.unwrap_or("unit of the data"))
}

/// The label of measured numbers minus those of a curve, with their unit, if it is known.
pub(super) fn residual(of: &str, unit: Option<&str>) -> String {
    let unit = unit.map(|unit| format!(" ({unit})")).unwrap_or_default();
    format!("data − {of}{unit}")
}

/// A unit as it follows a number.
pub(super) fn after_number(unit: Option<&str>) -> String {
    unit.map(|unit| format!(" {unit}")).unwrap_or_default()
}

/// A map of the surface; its colours cover these heights, by default all.
pub(super) fn surface_map(
    (x, y): (&[f64], &[f64]),
    u: Vec<Vec<f64>>,
    z_range: Option<[f64; 2]>,
) -> MapDocument {
    let (x, y, z_label) = (x.to_vec(), y.to_vec(), SURFACE.1.into());
    MapDocument { x, y, z: u, z_label, colours: ColoursName::Cividis, z_range }
}

/// The absolute differences of pairs of columns against a third column, on a logarithmic axis.
pub(super) fn differences<'a>(
    labels: (&str, &str),
    columns: impl Iterator<Item = [&'a [f64]; 3]>,
) -> PanelDocument {
    let curve = |[x, a, b]: [&[f64]; 3]| {
        let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        // Equal values have no place on a logarithmic axis.
        let shown: Vec<f64> = apart.map(|d| if d > 0.0 { d } else { f64::NAN }).collect();
        CurveDocument::new(StyleName::Line, "", x, &shown)
    };
    let (y_scale, curves) = (ScaleName::Logarithmic, columns.map(curve).collect());
    PanelDocument { y_scale, curves, ..PanelDocument::new("", labels) }
}

/// Positions from one end to the other in this number of equal steps.
pub(super) fn evenly(
    [from, to]: [f64; 2],
    steps: u32,
) -> impl Iterator<Item = f64> + Clone + use<> {
    (0..=steps).map(move |i| from + (to - from) * f64::from(i) / f64::from(steps))
}

/// The lowest and the highest height away from the ends of the lines.
pub(super) fn heights_within(map: &HeightMap) -> Option<[f64; 2]> {
    let (low, high) = (map.x.first()?, map.x.last()?);
    let (from, to) = (low + COLOURED.0 * (high - low), low + COLOURED.1 * (high - low));
    let inside = |x: &f64| (from..=to).contains(x);
    let of = |row: &Vec<f64>| -> Vec<f64> {
        map.x.iter().zip(row).filter(|(x, _)| inside(x)).map(|(_, u)| *u).collect()
    };
    let (low, high) = extremes(map.u.iter().flat_map(of))?;
    (low < high).then_some([low, high])
}
