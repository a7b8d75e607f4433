//! The figure of any curves.

use super::curve::{Curve, Pen};
use super::panel::Panel;
use super::sheet::sheet;
use super::style::TALL;

/// Name (empty: not in the legend), abscissas, ordinates.
pub(crate) type Series<'a> = (String, &'a [f64], &'a [f64]);

/// One panel with a curve for every series. An SVG document.
///
/// Long series are thinned as far as their abscissas go on in one direction; one that winds, such
/// as a limit cycle passed many times, is better cut to a few turns.
pub(crate) fn lines(title: &str, x_label: &str, y_label: &str, series: &[Series]) -> String {
    sheet(title, &[Panel::fitted((x_label, y_label), numbered(series), TALL, 0.0)])
}

/// Every series with the pen of its number.
pub(super) fn numbered<'a>(series: &[Series<'a>]) -> Vec<Curve<'a>> {
    let curve = |(i, (label, x, y)): (usize, &Series<'a>)| {
        let label = (!label.is_empty()).then(|| label.clone());
        Curve { x, y, pen: Pen::numbered(i), label }
    };
    series.iter().enumerate().map(curve).collect()
}
