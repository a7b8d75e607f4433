//! `stickslip/figure`: figures as data, from which they are drawn.

use crate::documents::table::{Named, Tabular};
use crate::{FORMAT_VERSION, ModelParameters, Software};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// All that a figure shows, in the order in which it is drawn. Lengths in σ, times in Γ/k, heights in
/// kσ²/a.
///
/// In texts `_` sets the next character, or what stands in braces, below the line and `^` above it; `\_` and
/// `\^` are the characters themselves.
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
    /// From left to right and from top to bottom.
    pub panels: Vec<PanelDocument>,
    /// How many panels of span 1 make a row; 1 where it is left out.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub columns: usize,
}

impl FigureDocument {
    /// "stickslip/figure"
    pub const FORMAT: &'static str = "stickslip/figure";

    /// A figure without panels.
    pub fn new(name: &str, title: &str, models: Vec<ModelParameters>) -> Self {
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            name: name.into(),
            title: title.into(),
            parameters: FigureParameters { models },
            remarks: vec![],
            panels: vec![],
            columns: 1,
        }
    }

    /// r, where it is the same in all that is drawn.
    pub fn one_r(&self) -> Option<f64> {
        let is_axis = |label: &str| label == "r" || label.starts_with("r = ");
        let mut labels = self.panels.iter().flat_map(|panel| [&panel.x_label, &panel.y_label]);
        let mut models = self.parameters.models.iter().map(|model| model.r);
        let first = models.next().filter(|_| !labels.any(|label| is_axis(label)))?;
        models.all(|r| r.to_bits() == first.to_bits()).then_some(first)
    }
}

impl Tabular for FigureDocument {
    /// None: what is drawn has its numbers curve by curve.
    fn columns(&self) -> Vec<Named<'_>> {
        vec![]
    }
}

/// What a figure was computed from.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureParameters {
    /// The model of each panel; where α or r is varied, that of the first point.
    pub models: Vec<ModelParameters>,
}

/// Axes with curves, a map or cells.
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
    /// First and last x shown, in the unit of `x_label`; fitted to the curves where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_range: Option<[f64; 2]>,
    /// Of the abscissas; linear where it is left out.
    #[serde(default, skip_serializing_if = "ScaleName::is_linear")]
    pub x_scale: ScaleName,
    /// Of the ordinates; linear where it is left out.
    #[serde(default, skip_serializing_if = "ScaleName::is_linear")]
    pub y_scale: ScaleName,
    /// Kinds over a grid, drawn as coloured cells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cells: Option<CellsDocument>,
    /// Texts within the axes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<NoteDocument>,
    /// Stretches of the abscissas, in the unit of `x_label`, with a light ground.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shades: Vec<[f64; 2]>,
    /// Size that the ordinates have by nature, in the unit of `y_label`: a variation a million times smaller is
    /// taken for round-off and not magnified. Unknown where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub natural: Option<f64>,
    /// How many columns it takes; 1 where it is left out.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub span: usize,
}

impl PanelDocument {
    /// Axes without curves.
    pub fn new(heading: &str, (x_label, y_label): (&str, &str)) -> Self {
        Self {
            heading: heading.into(),
            x_label: x_label.into(),
            y_label: y_label.into(),
            curves: vec![],
            map: None,
            y_range: None,
            x_range: None,
            x_scale: ScaleName::Linear,
            y_scale: ScaleName::Linear,
            cells: None,
            notes: vec![],
            shades: vec![],
            natural: None,
            span: 1,
        }
    }
}

/// How values lie along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ScaleName {
    /// By their differences.
    #[default]
    Linear,
    /// By their ratios.
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
    /// What the panel is about.
    Line,
    /// Thin, black.
    Thin,
    /// To compare with.
    Dashed,
    /// What was before.
    Dotted,
    /// An area between `low` and `y`.
    Band,
    /// Discs.
    Dots,
    /// Smaller ones.
    SmallDots,
    /// Small, many of them.
    Points,
    /// Triangles.
    Triangles,
    /// Smaller ones.
    SmallTriangles,
    /// Outlines of discs, which hide nothing.
    OpenDots,
    /// Outlines of triangles.
    OpenTriangles,
    /// Outlines of squares.
    OpenSquares,
    /// Outlines of squares on a corner.
    OpenDiamonds,
    /// A line with all above it shaded.
    Boundary,
}

/// Colours that the colour-blind can tell apart.
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
    /// Lower ordinates of a band.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub low: Option<Vec<Option<f64>>>,
    /// That of its style where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<ColourName>,
    /// Whether a smooth line is drawn through the points rather than straight ones between them.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub smooth: bool,
}

impl CurveDocument {
    /// A curve in the colour of its style; without a name it is not in the legend.
    pub fn new(style: StyleName, name: &str, x: &[f64], y: &[f64]) -> Self {
        Self {
            name: (!name.is_empty()).then(|| name.into()),
            style,
            x: x.to_vec(),
            y: y.iter().map(|y| y.is_finite().then_some(*y)).collect(),
            low: None,
            colour: None,
            smooth: false,
        }
    }
}

/// The colours of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ColoursName {
    /// Black is low.
    Grey,
    /// Blue is low, yellow is high.
    Cividis,
    /// 0 is white, blue below and red above.
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
    /// Of the values, with their unit.
    pub z_label: String,
    /// How values are coloured.
    pub colours: ColoursName,
    /// Values of the first and the last colour; fitted to z where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z_range: Option<[f64; 2]>,
}

/// One of a few kinds at every point of a grid.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CellsDocument {
    /// Positions of the columns, ascending, in the unit of `x_label`.
    pub x: Vec<f64>,
    /// Positions of the rows, ascending, in the unit of `y_label`.
    pub y: Vec<f64>,
    /// Place in `names` and `colours`: a row for each y; null where nothing is known.
    pub kinds: Vec<Vec<Option<usize>>>,
    /// Of the kinds, in the legend.
    pub names: Vec<String>,
    /// A colour for each kind.
    pub colours: Vec<ColourName>,
}

/// A text at a place of a panel.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NoteDocument {
    /// What it says.
    pub text: String,
    /// Its middle, in the unit of `x_label`.
    pub x: f64,
    /// Its middle, in the unit of `y_label`.
    pub y: f64,
    /// Points to what lies beyond the axes; none where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arrow: Option<ArrowName>,
}

impl NoteDocument {
    /// A text alone.
    pub fn new(text: &str, (x, y): (f64, f64)) -> Self {
        Self { text: text.into(), x, y, arrow: None }
    }
}

/// Where an arrow at the edge of the axes points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ArrowName {
    /// At the lower edge.
    Down,
    /// At the upper edge.
    Up,
}

fn one() -> usize {
    1
}

fn is_one(number: &usize) -> bool {
    *number == 1
}
