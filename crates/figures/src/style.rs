//! Colours, pens and sizes.
//!
//! One unit is half a point, 1/144 inch: letters of 8 points are 16 units high.

use stickslip::{ColourName, StyleName};

/// Font sizes of tick labels, axis labels, legends and titles.
pub(crate) const TICK_SIZE: f64 = 14.0;
pub(crate) const LABEL_SIZE: f64 = 16.0;
pub(crate) const LEGEND_SIZE: f64 = 14.0;
pub(crate) const TITLE_SIZE: f64 = 18.0;

/// Red, green and blue.
pub(crate) type Colour = [u8; 3];

pub(crate) const INK: Colour = [0; 3];
pub(crate) const PAPER: Colour = [0xff; 3];
pub(crate) const GRID: Colour = [0xe8; 3];

/// Opacity of a filled area.
pub(crate) const SHADE_OPACITY: f64 = 0.16;
pub(crate) const BAND_OPACITY: f64 = 0.30;

/// The colours of Okabe and Ito, which colour-blind readers can distinguish, and greys.
pub(crate) fn colour(name: ColourName) -> Colour {
    match name {
        ColourName::Blue => [0x00, 0x72, 0xb2],
        ColourName::Vermillion => [0xd5, 0x5e, 0x00],
        ColourName::Green => [0x00, 0x9e, 0x73],
        ColourName::Purple => [0xcc, 0x79, 0xa7],
        ColourName::Orange => [0xe6, 0x9f, 0x00],
        ColourName::Sky => [0x56, 0xb4, 0xe9],
        ColourName::Black => INK,
        ColourName::Grey => [0x7f, 0x7f, 0x7f],
        ColourName::Silver => [0xd9, 0xd9, 0xd9],
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
    /// Width, and the lengths of dashes and gaps; none for a solid line.
    Line { width: f64, dashes: &'static [f64] },
    /// An area between two curves.
    Band,
    /// Filled, or an outline.
    Point { shape: Shape, radius: f64, filled: bool },
}

/// A colour and a mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pen {
    pub(crate) colour: Colour,
    pub(crate) mark: Mark,
}

impl Pen {
    pub(crate) fn of(style: StyleName, asked: Option<ColourName>) -> Self {
        use ColourName::{Black, Blue, Vermillion};
        let line = |width, dashes| Mark::Line { width, dashes };
        let point = |shape, radius, filled| Mark::Point { shape, radius, filled };
        let (own, mark) = match style {
            StyleName::Line | StyleName::Boundary => (Blue, line(1.6, &[])),
            StyleName::Thin => (Black, line(1.0, &[])),
            StyleName::Dashed => (Vermillion, line(1.8, &[9.0, 5.0])),
            StyleName::Dotted => (Black, line(1.4, &[2.0, 4.0])),
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
