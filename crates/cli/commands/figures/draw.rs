//! From the document of a figure to its picture.

use crate::failure::Failure;
use crate::plot::{self, Colours, DrawnCurve, DrawnPanel, Map, Style};
use stickslip_documents::{
    ColoursName, CurveDocument, FigureDocument, MapDocument, PanelDocument, StyleName,
};

/// The figure as SVG.
pub(super) fn draw(document: &FigureDocument) -> Result<String, Failure> {
    // Null as NaN, which is not drawn.
    let number = |y: &Option<f64>| y.unwrap_or(f64::NAN);
    let ordinates: Vec<Vec<Vec<f64>>> = document
        .panels
        .iter()
        .map(|panel| panel.curves.iter().map(|c| c.y.iter().map(number).collect()).collect())
        .collect();
    let panels: Vec<DrawnPanel> =
        document.panels.iter().zip(&ordinates).map(|(panel, y)| drawn(panel, y)).collect();
    plot::drawing(&document.title, &panels)
        .map_err(|error| Failure::Run(format!("cannot draw {}: {error}", document.name)))
}

fn drawn<'a>(panel: &'a PanelDocument, ordinates: &'a [Vec<f64>]) -> DrawnPanel<'a> {
    let curve = |(curve, y): (&'a CurveDocument, &'a Vec<f64>)| DrawnCurve {
        name: curve.name.as_deref(),
        style: style(curve.style),
        x: &curve.x,
        y,
    };
    let map = |map: &'a MapDocument| Map {
        x: &map.x,
        y: &map.y,
        z: &map.z,
        labels: (&panel.x_label, &panel.y_label, &map.z_label),
        name: &panel.heading,
        colours: match map.colours {
            ColoursName::Grey => Colours::Grey,
            ColoursName::Cividis => Colours::Cividis,
        },
    };
    DrawnPanel {
        heading: &panel.heading,
        labels: (&panel.x_label, &panel.y_label),
        curves: panel.curves.iter().zip(ordinates).map(curve).collect(),
        map: panel.map.as_ref().map(map),
        y_range: panel.y_range.map(|[low, high]| (low, high)),
    }
}

fn style(name: StyleName) -> Style {
    match name {
        StyleName::Line => Style::Line,
        StyleName::Dashed => Style::Dashed,
        StyleName::Dotted => Style::Dotted,
        StyleName::Dots => Style::Dots,
        StyleName::Triangles => Style::Triangles,
        StyleName::Points => Style::Points,
        StyleName::Boundary => Style::Boundary,
    }
}
