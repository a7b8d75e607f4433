//! The figure of the stability boundary.

use super::axis::Axis;
use super::curve::{Curve, Pen};
use super::panel::{Note, Panel, Shade};
use super::sheet::sheet;
use super::style::{TALL, VERMILLION};

/// The critical α over r, both positive, the unstable region above it shaded, and the lines within
/// that where further pairs of roots cross. An SVG document.
pub(crate) fn boundary(
    title: &str,
    r: &[f64],
    alpha: &[f64],
    further: &[(&[f64], &[f64])],
) -> String {
    let label = Some("boundary, α = αc(r)".to_owned());
    let curves = vec![Curve { x: r, y: alpha, pen: Pen::MAIN, label }];
    let labels = ("r = Γv₀/(kσ)", "α = ΓNa/(k²σ²)");
    let mut fitted = Panel::fitted(labels, curves, TALL, 1.0);
    // They may go to infinity: the axes are those of the boundary.
    for (i, (r, alpha)) in further.iter().enumerate() {
        let label = (i == 0).then(|| "where pairs of roots cross".to_owned());
        fitted.curves.push(Curve { x: r, y: alpha, pen: Pen::BEFORE, label });
    }
    let x = Axis::new(fitted.x.low, fitted.x.high, 9.0);
    let y = Axis::new(0.0, fitted.y.high, 8.0);
    let shades = vec![Shade::Above(r, alpha, VERMILLION)];
    let notes = notes(r, alpha, &x, &y);
    sheet(title, &[Panel { x, y, shades, notes, ..fitted }])
}

/// A name in either region, where it is highest, but away from the sides.
fn notes(r: &[f64], alpha: &[f64], x: &Axis, y: &Axis) -> Vec<Note<'static>> {
    let inside = |r: f64| (0.2..0.8).contains(&((r - x.low) / (x.high - x.low)));
    let middle: Vec<_> =
        r.iter().zip(alpha).filter(|(r, a)| inside(**r) && a.is_finite()).collect();
    let lowest = middle.iter().min_by(|a, b| a.1.total_cmp(b.1));
    let highest = middle.iter().max_by(|a, b| a.1.total_cmp(b.1));
    let note = |text, r: f64, from: f64, to: f64| Note { text, x: r, y: 0.5 * (from + to) };
    let unstable = lowest.map(|(r, a)| note("unstable", **r, **a, y.high));
    let stable = highest.map(|(r, a)| note("stable", **r, y.low, **a));
    unstable.into_iter().chain(stable).collect()
}
