//! Colours, pens and sizes.
//!
//! One unit is half a point, 1/144 inch: letters of 8 points are 16 units high.

use stickslip::{ColourName, StyleName};

/// Font sizes of tick labels, axis labels, legends and titles.
pub(crate) const TICK_SIZE: f64 = 14.0;
pub(crate) const LABEL_SIZE: f64 = 16.0;
pub(crate) const LEGEND_SIZE: f64 = 14.0;
pub(crate) const TITLE_SIZE: f64 = 18.0;

pub(crate) const INK: &str = "#000000";
pub(crate) const GRID: &str = "#E8E8E8";

/// Opacity of a filled area.
pub(crate) const SHADE_OPACITY: f64 = 0.16;
pub(crate) const BAND_OPACITY: f64 = 0.30;

/// The colours of Okabe and Ito, which colour-blind readers can distinguish, and greys.
pub(crate) fn colour(name: ColourName) -> &'static str {
    match name {
        ColourName::Blue => "#0072B2",
        ColourName::Vermillion => "#D55E00",
        ColourName::Green => "#009E73",
        ColourName::Purple => "#CC79A7",
        ColourName::Orange => "#E69F00",
        ColourName::Sky => "#56B4E9",
        ColourName::Black => INK,
        ColourName::Grey => "#7F7F7F",
        ColourName::Silver => "#D9D9D9",
    }
}

/// Shape of a mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    Disc,
    Triangle,
    Square,
    Diamond,
    /// A triangle upside down.
    Down,
}

/// How points are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Mark {
    /// Width, and the dashes in SVG notation; empty for a solid line.
    Line { width: f64, dashes: &'static str },
    /// An area between two curves.
    Band,
    /// Filled, or an outline.
    Point { shape: Shape, radius: f64, filled: bool },
}

/// A colour and a mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pen {
    pub(crate) colour: &'static str,
    pub(crate) mark: Mark,
}

impl Pen {
    pub(crate) fn of(style: StyleName, asked: Option<ColourName>) -> Self {
        use ColourName::{Black, Blue, Vermillion};
        let line = |width, dashes| Mark::Line { width, dashes };
        let point = |shape, radius, filled| Mark::Point { shape, radius, filled };
        let (own, mark) = match style {
            StyleName::Line | StyleName::Boundary => (Blue, line(1.6, "")),
            StyleName::Thin => (Black, line(1.0, "")),
            StyleName::Dashed => (Vermillion, line(1.8, "9 5")),
            StyleName::Dotted => (Black, line(1.4, "2 4")),
            StyleName::Band => (Blue, Mark::Band),
            StyleName::Dots => (Blue, point(Shape::Disc, 5.0, true)),
            StyleName::SmallDots => (Blue, point(Shape::Disc, 3.0, true)),
            StyleName::Points => (Black, point(Shape::Disc, 2.4, true)),
            StyleName::Triangles => (Vermillion, point(Shape::Triangle, 6.0, true)),
            StyleName::SmallTriangles => (Vermillion, point(Shape::Triangle, 4.5, true)),
            StyleName::OpenDots => (Black, point(Shape::Disc, 5.0, false)),
            StyleName::OpenTriangles => (Black, point(Shape::Triangle, 6.5, false)),
            StyleName::OpenSquares => (Black, point(Shape::Square, 6.0, false)),
            StyleName::OpenDiamonds => (Black, point(Shape::Diamond, 6.5, false)),
        };
        Self { colour: colour(asked.unwrap_or(own)), mark }
    }

    pub(crate) fn is_line(self) -> bool {
        matches!(self.mark, Mark::Line { .. } | Mark::Band)
    }
}
