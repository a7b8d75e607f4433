//! The figure of growth exponents in the complex plane.

use super::axis::{Axis, Fit};
use super::curve::{Curve, Mark, Pen};
use super::panel::{Panel, Shade};
use super::sheet::sheet;
use super::style::{BLACK, BLUE, TALL, VERMILLION};

/// Part of the width that the unstable half has at least, even when no root is there.
const UNSTABLE_PART: f64 = 0.15;

/// Exponents `re + i im`, each off by at most `error`, the growing ones marked, the unstable half
/// shaded. Those at the critical point are neither. An SVG document.
pub(crate) fn roots(title: &str, re: &[f64], im: &[f64], error: f64) -> String {
    let growing = part(re, im, |re| re > error);
    let decaying = part(re, im, |re| re < -error);
    let neutral = part(re, im, |re| re.abs() <= error);
    let (x, y) = axes(re, im);
    let (upright, level) = ([y.low, y.high], [x.low, x.high]);
    let thin_line = Pen { colour: BLACK, mark: Mark::Line { width: 1.0, dashes: "" } };
    let curves = vec![
        Curve { x: &[0.0; 2], y: &upright, pen: thin_line, label: None },
        Curve { x: &level, y: &[0.0; 2], pen: thin_line, label: None },
        dots(&decaying, BLUE, "decaying"),
        dots(&growing, VERMILLION, "growing"),
        dots(&neutral, BLACK, "neither"),
    ];
    let shades = vec![Shade::Columns(0.0, x.high, VERMILLION)];
    let (x_label, y_label) = ("Re λ (k/Γ)", "Im λ (k/Γ)");
    let notes = Vec::new();
    sheet(
        title,
        &[Panel {
            heading: "",
            x,
            y,
            x_label,
            y_label,
            height: TALL,
            curves,
            shades,
            notes,
            map: None,
        }],
    )
}

/// Abscissas and ordinates of the roots in a part of the plane.
fn part(re: &[f64], im: &[f64], wanted: impl Fn(f64) -> bool) -> (Vec<f64>, Vec<f64>) {
    re.iter().zip(im).filter(|(re, _)| wanted(**re)).map(|(re, im)| (*re, *im)).unzip()
}

fn dots<'a>(points: &'a (Vec<f64>, Vec<f64>), colour: &'static str, name: &str) -> Curve<'a> {
    let label = (!points.0.is_empty()).then(|| name.to_owned());
    Curve { x: &points.0, y: &points.1, pen: Pen::dots(colour), label }
}

/// Both axes hold the origin, and the abscissas a part of the unstable half.
fn axes(re: &[f64], im: &[f64]) -> (Axis, Axis) {
    let fit = Fit { padding: 0.06, natural: 0.0, ticks: 9.0 };
    let with_origin = |values: &[f64]| Axis::fit(values.iter().copied().chain([0.0]), fit);
    let (x, y) = (with_origin(re), with_origin(im));
    (Axis::new(x.low, x.high.max(-UNSTABLE_PART * x.low), 8.0), y)
}
