//! `stickslip/figure`: figures as data.

use crate::documents::table::Tabular;
use crate::schema::JsonSchema;
use crate::{FORMAT_VERSION, ModelParameters, Software};
use serde::{Deserialize, Serialize};

/// The content of a figure, in drawing order. Lengths in σ, times in Γ/k, heights in kσ²/a.
///
/// In texts `_` makes the next character, or the content of braces, a subscript, and `^` a superscript; `\_` and `\^`
/// are the characters themselves.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureDocument {
    /// "stickslip/figure"
    pub format: String,
    /// Version of the format; 1.
    pub format_version: u32,
    /// The program that wrote the document.
    pub software: Software,
    /// Name of the figure's files, without extension.
    pub name: String,
    /// Title above all panels.
    pub title: String,
    /// The models from which the figure was computed.
    pub parameters: FigureParameters,
    /// Differences from the paper's figure, and their reasons.
    pub remarks: Vec<String>,
    /// Panels, from left to right and from top to bottom.
    pub panels: Vec<PanelDocument>,
    /// Number of panels of span 1 in a row; 1 by default.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub columns: usize,
}

impl FigureDocument {
    /// "stickslip/figure"
    pub const FORMAT: &'static str = "stickslip/figure";

    /// A figure of these panels, below each other.
    pub fn new(
        name: &str,
        title: &str,
        models: Vec<ModelParameters>,
        panels: Vec<PanelDocument>,
    ) -> Self {
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            name: name.into(),
            title: title.into(),
            parameters: FigureParameters { models },
            remarks: vec![],
            panels,
            columns: 1,
        }
    }

    /// The r of all models; `None` if they differ in r, or if r is on an axis.
    pub fn one_r(&self) -> Option<f64> {
        let is_axis = |label: &str| label == "r" || label.starts_with("r = ");
        let mut labels = self.panels.iter().flat_map(|panel| [&panel.x_label, &panel.y_label]);
        let mut models = self.parameters.models.iter().map(|model| model.r);
        let first = models.next().filter(|_| !labels.any(|label| is_axis(label)))?;
        models.all(|r| r.to_bits() == first.to_bits()).then_some(first)
    }
}

/// Not a table: each curve has its own numbers.
impl Tabular for FigureDocument {}

/// The models from which a figure was computed.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureParameters {
    /// The model of each panel; if α or r varies, that of the first point.
    pub models: Vec<ModelParameters>,
}

/// Axes with curves, a map or cells.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PanelDocument {
    /// Heading above the axes; may be empty.
    pub heading: String,
    /// Label of the abscissas, with their unit if they have one.
    pub x_label: String,
    /// Label of the ordinates, with their unit if they have one.
    pub y_label: String,
    /// Curves, in drawing order.
    pub curves: Vec<CurveDocument>,
    /// A map that fills the axes, if there is one.
    pub map: Option<MapDocument>,
    /// First and last y shown, in the unit of `y_label`; null to fit the curves.
    pub y_range: Option<[f64; 2]>,
    /// First and last x shown, in the unit of `x_label`; by default fitted to the curves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_range: Option<[f64; 2]>,
    /// Scale of the abscissas; linear by default.
    #[serde(default, skip_serializing_if = "ScaleName::is_linear")]
    pub x_scale: ScaleName,
    /// Scale of the ordinates; linear by default.
    #[serde(default, skip_serializing_if = "ScaleName::is_linear")]
    pub y_scale: ScaleName,
    /// Categories over a grid, drawn as coloured cells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cells: Option<CellsDocument>,
    /// Texts within the axes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<NoteDocument>,
    /// Intervals of the abscissas, in the unit of `x_label`, with a shaded background.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shades: Vec<[f64; 2]>,
    /// Typical size of the ordinates, in the unit of `y_label`: a variation a million times smaller counts as
    /// round-off and is not magnified. Unknown by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub natural: Option<f64>,
    /// Number of columns that the panel takes; 1 by default.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub span: usize,
}

impl PanelDocument {
    /// A panel with empty axes.
    pub fn new(heading: &str, (x_label, y_label): (&str, &str)) -> Self {
        Self {
            heading: heading.into(),
            x_label: x_label.into(),
            y_label: y_label.into(),
            span: 1,
            ..Self::default()
        }
    }

    /// A panel of curves without a heading.
    pub fn of_curves(labels: (&str, &str), curves: Vec<CurveDocument>) -> Self {
        Self { curves, ..Self::new("", labels) }
    }
}

/// The scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ScaleName {
    /// Linear.
    #[default]
    Linear,
    /// Logarithmic.
    Logarithmic,
}

impl ScaleName {
    fn is_linear(&self) -> bool {
        *self == Self::Linear
    }
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StyleName {
    /// Solid line, for the main result.
    Line,
    /// Thin black line.
    Thin,
    /// Dashed line, for comparison.
    Dashed,
    /// Dotted line, for an earlier state.
    Dotted,
    /// An area between `low` and `y`.
    Band,
    /// Discs.
    Dots,
    /// Smaller discs.
    SmallDots,
    /// Points, for large data sets.
    Points,
    /// Triangles.
    Triangles,
    /// Smaller triangles.
    SmallTriangles,
    /// Outlines of discs, which do not cover other curves.
    OpenDots,
    /// Outlines of triangles.
    OpenTriangles,
    /// Outlines of squares.
    OpenSquares,
    /// Outlines of squares that stand on a corner.
    OpenDiamonds,
    /// A line, with the area above it shaded.
    Boundary,
}

/// Colours that colour-blind readers can distinguish.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ColourName {
    /// #0072B2
    Blue,
    /// #D55E00
    Vermillion,
    /// #009E73
    Green,
    /// #CC79A7
    Purple,
    /// #E69F00
    Orange,
    /// #56B4E9
    Sky,
    /// #000000
    Black,
    /// #7F7F7F
    Grey,
    /// #D9D9D9
    Silver,
}

/// A curve: equally many values of x and y.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurveDocument {
    /// Name in the legend; null if it is not listed.
    pub name: Option<String>,
    /// Style of the curve.
    pub style: StyleName,
    /// Abscissas, in the unit of `x_label`.
    pub x: Vec<f64>,
    /// Ordinates, in the unit of `y_label`; null marks a gap.
    pub y: Vec<Option<f64>>,
    /// Lower ordinates of a band.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub low: Option<Vec<Option<f64>>>,
    /// Colour of the curve; by default that of its style.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<ColourName>,
    /// Whether the points are joined by a smooth line instead of straight segments.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub smooth: bool,
}

impl CurveDocument {
    /// A curve in the colour of its style; an empty name keeps it out of the legend.
    pub fn new(style: StyleName, name: &str, x: &[f64], y: &[f64]) -> Self {
        Self::with_gaps(style, name, x, finite(y))
    }

    /// The same, with gaps at missing ordinates.
    pub fn with_gaps(style: StyleName, name: &str, x: &[f64], y: Vec<Option<f64>>) -> Self {
        Self {
            name: (!name.is_empty()).then(|| name.into()),
            style,
            x: x.to_vec(),
            y,
            low: None,
            colour: None,
            smooth: false,
        }
    }

    /// The area between two curves.
    pub fn band(name: &str, x: &[f64], low: &[f64], high: &[f64]) -> Self {
        Self { low: Some(finite(low)), ..Self::new(StyleName::Band, name, x, high) }
    }

    /// The curve in this colour.
    #[must_use]
    pub fn coloured(self, colour: ColourName) -> Self {
        Self { colour: Some(colour), ..self }
    }
}

/// The colour scale of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ColoursName {
    /// Black for low values.
    Grey,
    /// Blue for low values, yellow for high ones.
    Cividis,
    /// White for 0, blue below and red above.
    BlueRed,
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
    /// Label of the values, with their unit.
    pub z_label: String,
    /// Colour scale.
    pub colours: ColoursName,
    /// Values of the first and the last colour; by default fitted to z.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z_range: Option<[f64; 2]>,
}

/// Categories at every point of a grid.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CellsDocument {
    /// Positions of the columns, ascending, in the unit of `x_label`.
    pub x: Vec<f64>,
    /// Positions of the rows, ascending, in the unit of `y_label`.
    pub y: Vec<f64>,
    /// Index into `names` and `colours`: a row for each y; null for unknown.
    pub kinds: Vec<Vec<Option<usize>>>,
    /// Names of the categories, in the legend.
    pub names: Vec<String>,
    /// A colour for each category.
    pub colours: Vec<ColourName>,
}

/// A text at a position in a panel.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NoteDocument {
    /// The text.
    pub text: String,
    /// x of the middle of the text, in the unit of `x_label`.
    pub x: f64,
    /// y of the middle of the text, in the unit of `y_label`.
    pub y: f64,
    /// An arrow that points to something outside the axes; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrow: Option<ArrowName>,
}

impl NoteDocument {
    /// A text without an arrow.
    pub fn new(text: &str, (x, y): (f64, f64)) -> Self {
        Self { text: text.into(), x, y, arrow: None }
    }
}

/// Direction of an arrow at the edge of the axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ArrowName {
    /// Down, at the lower edge.
    Down,
    /// Up, at the upper edge.
    Up,
}

/// The values, with gaps where they are not finite.
fn finite(values: &[f64]) -> Vec<Option<f64>> {
    values.iter().map(|value| value.is_finite().then_some(*value)).collect()
}

fn one() -> usize {
    1
}

fn is_one(number: &usize) -> bool {
    *number == 1
}
