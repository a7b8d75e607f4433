//! `stickslip/figure`.

use super::{ModelParameters, Software};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// All that a figure shows, in the order in which it is drawn. Lengths in σ, times in Γ/k, heights in
/// kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FigureDocument {
    /// "stickslip/figure"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// Of its files.
    pub(crate) name: String,
    /// Above all panels.
    pub(crate) title: String,
    /// What was drawn.
    pub(crate) parameters: FigureParameters,
    /// What differs from the paper's figure, and why.
    pub(crate) remarks: Vec<String>,
    /// From top to bottom.
    pub(crate) panels: Vec<PanelDocument>,
}

impl FigureDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/figure";
}

/// What a figure was computed from.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FigureParameters {
    /// The model of each panel; where α or r is varied, that of the first point.
    pub(crate) models: Vec<ModelParameters>,
}

/// Axes with curves, or with a map.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelDocument {
    /// Above the axes; may be empty.
    pub(crate) heading: String,
    /// Of the abscissas, with their unit if they have one.
    pub(crate) x_label: String,
    /// Of the ordinates, with their units if they have any.
    pub(crate) y_label: String,
    /// In the order in which they are drawn.
    pub(crate) curves: Vec<CurveDocument>,
    /// Fills the axes, if there is one.
    pub(crate) map: Option<MapDocument>,
    /// First and last y shown, in the unit of `y_label`; null where they are fitted to the curves.
    pub(crate) y_range: Option<[f64; 2]>,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum StyleName {
    Line,
    Dashed,
    Dotted,
    Dots,
    Triangles,
    /// Small, many of them.
    Points,
    /// A line with all above it shaded.
    Boundary,
}

/// Points of equal number in x and y.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CurveDocument {
    /// In the legend; null if it has none.
    pub(crate) name: Option<String>,
    /// How it is drawn.
    pub(crate) style: StyleName,
    /// Abscissas, in the unit of `x_label`.
    pub(crate) x: Vec<f64>,
    /// Ordinates, in the unit of `y_label`; null where there is no value.
    pub(crate) y: Vec<Option<f64>>,
}

/// The colours of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ColoursName {
    /// Black is low.
    Grey,
    /// Blue is low, yellow is high.
    Cividis,
}

/// z over evenly spaced x and y.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MapDocument {
    /// Positions of the columns, in the unit of `x_label`.
    pub(crate) x: Vec<f64>,
    /// Positions of the rows, in the unit of `y_label`.
    pub(crate) y: Vec<f64>,
    /// Values, in the unit of `z_label`: a row for each y.
    pub(crate) z: Vec<Vec<f64>>,
    /// Of the values, with their unit.
    pub(crate) z_label: String,
    /// How values are coloured.
    pub(crate) colours: ColoursName,
}
