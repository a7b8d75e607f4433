//! A drawing: shapes, texts and images in the order in which they cover each other, in units. `svg` writes it as text,
//! `raster` paints it, `pdf` writes it as a page.

use crate::picture::Picture;
use crate::style::Colour;
use crate::thin::Point;

/// Horizontal alignment of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A rectangle, in units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Rect {
    pub(crate) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(crate) fn height(&self) -> f64 {
        self.bottom - self.top
    }
}

/// A text with its attributes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Text {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) label: String,
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    /// Whether the text runs upwards, rotated about its position.
    pub(crate) upright: bool,
}

/// How a path is filled and drawn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Paint {
    pub(crate) fill: Option<Colour>,
    pub(crate) fill_opacity: Option<f64>,
    pub(crate) stroke: Option<Colour>,
    pub(crate) width: f64,
    /// Lengths of dashes and gaps; empty for a solid line.
    pub(crate) dashes: &'static [f64],
    /// Whether edges are aligned with pixels, so that adjacent areas have no gap.
    pub(crate) crisp: bool,
}

impl Paint {
    pub(crate) fn stroke(colour: Colour, width: f64) -> Self {
        Self { stroke: Some(colour), width, ..Self::default() }
    }

    pub(crate) fn fill(colour: Colour) -> Self {
        Self { fill: Some(colour), ..Self::default() }
    }

    pub(crate) fn translucent(colour: Colour, opacity: f64) -> Self {
        Self { fill_opacity: Some(opacity), ..Self::fill(colour) }
    }
}

/// A step of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Step {
    Move(Point),
    Line(Point),
    /// A cubic Bézier arc: both handles, and the end.
    Curve(Point, Point, Point),
    /// A closed rectangle and a closed circle, which need no move.
    Rect(Rect),
    Disc(Point, f64),
    Close,
}

/// An outline of one or several parts.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Path(pub(crate) Vec<Step>);

/// An open line through the points.
pub(crate) fn polyline(points: &[Point]) -> Path {
    let step =
        |(i, point): (usize, &Point)| if i == 0 { Step::Move(*point) } else { Step::Line(*point) };
    Path(points.iter().enumerate().map(step).collect())
}

/// An area with these corners.
pub(crate) fn polygon(corners: &[Point]) -> Path {
    let mut path = polyline(corners);
    path.0.push(Step::Close);
    path
}

/// An element of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Element {
    Path(Path, Paint),
    Rect(Rect, Paint),
    Text(Text),
    /// An image, stretched over the rectangle.
    Image(Rect, Picture),
    /// Until the next `Unclip`, elements show within the rectangle alone.
    Clip(Rect),
    Unclip,
}

/// Elements, each above those before it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drawing {
    pub(crate) elements: Vec<Element>,
}

impl Drawing {
    pub(crate) fn clip(&mut self, within: Rect) {
        self.elements.push(Element::Clip(within));
    }

    pub(crate) fn unclip(&mut self) {
        self.elements.push(Element::Unclip);
    }

    pub(crate) fn path(&mut self, path: Path, paint: Paint) {
        if !path.0.is_empty() {
            self.elements.push(Element::Path(path, paint));
        }
    }

    pub(crate) fn rect(&mut self, at: Rect, paint: Paint) {
        self.elements.push(Element::Rect(at, paint));
    }

    pub(crate) fn segment(&mut self, from: Point, to: Point, paint: Paint) {
        self.path(polyline(&[from, to]), paint);
    }

    pub(crate) fn image(&mut self, at: Rect, picture: Picture) {
        self.elements.push(Element::Image(at, picture));
    }

    pub(crate) fn text(&mut self, text: Text) {
        self.elements.push(Element::Text(text));
    }
}
