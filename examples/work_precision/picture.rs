//! The diagram as a picture: a panel a case, time over the error reached, both logarithmic.

use super::{Curve, case::CASES};
use kuva::prelude::*;

const COLOURS: [(&str, &str); 3] =
    [("modes", "#0072b2"), ("fft", "#d55e00"), ("explicit", "#555555")];

/// An SVG document.
pub(super) fn draw(curves: &[Curve]) -> String {
    let mut plots = vec![];
    let mut layouts = vec![];
    for case in &CASES {
        let here = curves.iter().filter(|c| c.case == case.name && !c.points.is_empty());
        let lines: Vec<Plot> = here.map(line).collect();
        layouts.push(
            Layout::auto_from_plots(&lines)
                .with_title(format!("{} (α = {:.3}, r = {})", case.name, case.alpha, case.r))
                .with_x_label("log₁₀ largest error of l (σ)")
                .with_y_label("log₁₀ time (ms)"),
        );
        plots.push(lines);
    }
    let figure = Figure::new(2, 3)
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(420.0, 320.0)
        .with_shared_legend();
    kuva::backend::svg::SvgBackend::new().render_scene(&figure.render())
}

fn line(curve: &Curve) -> Plot {
    let colour = COLOURS.iter().find(|(name, _)| *name == curve.method).map_or("black", |c| c.1);
    let points = curve.points.iter().map(|p| (p.error.log10(), (1e3 * p.seconds).log10()));
    let line = LinePlot::new().with_data(points).with_color(colour).with_legend(curve.method);
    Plot::Line(line.with_stroke_width(2.0))
}
