//! `stickslip/figure`.

use crate::{ModelParameters, Software};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// All that a figure shows, in the order in which it is drawn. Lengths in σ, times in Γ/k, heights in
/// kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureDocument {
    /// "stickslip/figure"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// Of its files.
    pub name: String,
    /// Above all panels.
    pub title: String,
    /// What was drawn.
    pub parameters: FigureParameters,
    /// What differs from the paper's figure, and why.
    pub remarks: Vec<String>,
    /// From top to bottom.
    pub panels: Vec<PanelDocument>,
}

impl FigureDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/figure";
}

/// What a figure was computed from.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureParameters {
    /// The model of each panel; where α or r is varied, that of the first point.
    pub models: Vec<ModelParameters>,
}

/// Axes with curves, or with a map.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PanelDocument {
    /// Above the axes; may be empty.
    pub heading: String,
    /// Of the abscissas, with their unit if they have one.
    pub x_label: String,
    /// Of the ordinates, with their units if they have any.
    pub y_label: String,
    /// In the order in which they are drawn.
    pub curves: Vec<CurveDocument>,
    /// Fills the axes, if there is one.
    pub map: Option<MapDocument>,
    /// First and last y shown, in the unit of `y_label`; null where they are fitted to the curves.
    pub y_range: Option<[f64; 2]>,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StyleName {
    /// Solid.
    Line,
    /// Dashes.
    Dashed,
    /// Fine dots along a line.
    Dotted,
    /// A dot at each point.
    Dots,
    /// A triangle at each point.
    Triangles,
    /// Small, many of them.
    Points,
    /// A line with all above it shaded.
    Boundary,
}

/// Points of equal number in x and y.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurveDocument {
    /// In the legend; null if it has none.
    pub name: Option<String>,
    /// How it is drawn.
    pub style: StyleName,
    /// Abscissas, in the unit of `x_label`.
    pub x: Vec<f64>,
    /// Ordinates, in the unit of `y_label`; null where there is no value.
    pub y: Vec<Option<f64>>,
}

/// The colours of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ColoursName {
    /// Black is low.
    Grey,
    /// Blue is low, yellow is high.
    Cividis,
}

/// z over evenly spaced x and y.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapDocument {
    /// Positions of the columns, in the unit of `x_label`.
    pub x: Vec<f64>,
    /// Positions of the rows, in the unit of `y_label`.
    pub y: Vec<f64>,
    /// Values, in the unit of `z_label`: a row for each y.
    pub z: Vec<Vec<f64>>,
    /// Of the values, with their unit.
    pub z_label: String,
    /// How values are coloured.
    pub colours: ColoursName,
}
