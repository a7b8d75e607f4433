//! The figure of criticality along the stability boundary.

use super::axis::{Axis, Fit};
use super::curve::{Curve, Pen};
use super::panel::{Note, Panel};
use super::sheet::sheet;
use super::style::TALL;

/// `excess` = d ln α/d(a²) over r, or over log₁₀ r: the small oscillation exists above the boundary
/// where it is positive, below where it is negative. An SVG document.
pub(crate) fn onset(title: &str, r: &[f64], excess: &[f64], logarithmic: bool) -> String {
    let x: Vec<f64> = r.iter().map(|r| if logarithmic { r.log10() } else { *r }).collect();
    let fit = Fit { padding: 0.0, natural: 0.0, ticks: 9.0 };
    let x_axis = Axis::fit(x.iter().copied(), fit);
    // Room below zero for the name of what would be there.
    let highest = excess.iter().copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
    let with_zero = excess.iter().copied().chain([0.0, -0.2 * highest]);
    let y_axis = Axis::fit(with_zero, Fit { padding: 0.06, natural: 0.0, ticks: 8.0 });
    let (ends, zero) = ([x_axis.low, x_axis.high], [0.0; 2]);
    let middle = 0.5 * (x_axis.low + x_axis.high);
    let curves = vec![
        Curve { x: &ends, y: &zero, pen: Pen::REFERENCE, label: None },
        Curve { x: &x, y: excess, pen: Pen::MAIN, label: None },
    ];
    let note = |text, y| Note { text, x: middle, y };
    let notes =
        vec![note("supercritical", 0.1 * y_axis.high), note("subcritical", 0.5 * y_axis.low)];
    let panel = Panel {
        heading: "",
        x: x_axis,
        y: y_axis,
        x_label: if logarithmic { "log₁₀ r,  r = Γv₀/(kσ)" } else { "r = Γv₀/(kσ)" },
        y_label: "d ln α/d(a²) (σ⁻²)",
        height: TALL,
        curves,
        shades: Vec::new(),
        notes,
        map: None,
    };
    sheet(title, &[panel])
}
