//! SVG, element by element.

use crate::style::INK;
use crate::text::{Level, SMALL, spans};
use std::fmt::Write;

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
#[derive(Debug, Clone, Copy)]
pub(crate) struct Text<'a> {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) label: &'a str,
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    /// Whether the text runs upwards, rotated about its position.
    pub(crate) upright: bool,
}

/// How a path is filled and drawn.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Paint<'a> {
    pub(crate) fill: Option<&'a str>,
    pub(crate) fill_opacity: Option<f64>,
    pub(crate) stroke: Option<&'a str>,
    pub(crate) width: f64,
    pub(crate) dashes: &'a str,
    /// Whether edges are aligned with pixels, so that adjacent areas have no gap.
    pub(crate) crisp: bool,
}

impl<'a> Paint<'a> {
    pub(crate) fn stroke(colour: &'a str, width: f64) -> Self {
        Self { stroke: Some(colour), width, ..Self::default() }
    }

    pub(crate) fn fill(colour: &'a str) -> Self {
        Self { fill: Some(colour), ..Self::default() }
    }
}

/// The elements of a document.
#[derive(Debug, Default)]
pub(crate) struct Svg {
    body: String,
    clips: usize,
}

/// A number with at most two decimals, a hundredth of a unit.
pub(crate) fn number(value: f64) -> String {
    let value = (value.clamp(-1e6, 1e6) * 100.0).round() / 100.0;
    // No minus before 0.
    format!("{}", value + 0.0)
}

/// The points of a path in SVG's short form.
pub(crate) fn polyline(points: &[(f64, f64)]) -> String {
    let mut path = String::with_capacity(12 * points.len());
    for (i, (x, y)) in points.iter().enumerate() {
        let _ = write!(path, "{}{} {}", if i == 0 { "M" } else { "L" }, number(*x), number(*y));
    }
    path
}

impl Svg {
    /// The document; `width` and `height` are in units, `size` is written as its size for the viewer.
    pub(crate) fn finish(self, (width, height): (f64, f64), size: (String, String)) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" \
             font-family=\"DejaVu Sans, Verdana, Arial, Helvetica, sans-serif\" fill=\"{INK}\">\n{}</svg>\n",
            number(width),
            number(height),
            size.0,
            size.1,
            self.body
        )
    }

    /// Begins a group that is clipped to the rectangle.
    pub(crate) fn open_clip(&mut self, within: Rect) {
        self.clips += 1;
        let id = format!("clip{}", self.clips);
        let (x, y) = (number(within.left), number(within.top));
        let (width, height) = (number(within.width()), number(within.height()));
        self.line(&format!(
            "<clipPath id=\"{id}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/></clipPath>\
             <g clip-path=\"url(#{id})\">"
        ));
    }

    pub(crate) fn close(&mut self) {
        self.line("</g>");
    }

    pub(crate) fn path(&mut self, path: &str, paint: Paint) {
        if !path.is_empty() {
            self.line(&format!("<path d=\"{path}\"{}/>", attributes(paint)));
        }
    }

    pub(crate) fn rect(&mut self, at: Rect, paint: Paint) {
        let (x, y) = (number(at.left), number(at.top));
        let (width, height) = (number(at.width()), number(at.height()));
        let paint = attributes(paint);
        self.line(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{paint}/>"
        ));
    }

    pub(crate) fn segment(&mut self, from: (f64, f64), to: (f64, f64), paint: Paint) {
        self.path(&polyline(&[from, to]), paint);
    }

    /// Draws an image, a data URL, stretched over the rectangle.
    pub(crate) fn image(&mut self, at: Rect, url: &str) {
        let (x, y) = (number(at.left), number(at.top));
        let (width, height) = (number(at.width()), number(at.height()));
        self.line(&format!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             preserveAspectRatio=\"none\" href=\"{url}\"/>"
        ));
    }

    pub(crate) fn text(&mut self, text: Text) {
        let anchor = match text.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let (x, y, size) = (number(text.x), number(text.y), number(text.size));
        let turn = if text.upright {
            format!(" transform=\"rotate(-90 {x} {y})\"")
        } else {
            String::new()
        };
        let label = marked_up(text.label, text.size);
        self.line(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{anchor}{turn}>{label}</text>"
        ));
    }

    fn line(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }
}

fn attributes(paint: Paint) -> String {
    let mut text = format!(" fill=\"{}\"", paint.fill.unwrap_or("none"));
    if let Some(opacity) = paint.fill_opacity {
        let _ = write!(text, " fill-opacity=\"{opacity}\"");
    }
    if let Some(stroke) = paint.stroke {
        let _ = write!(text, " stroke=\"{stroke}\" stroke-width=\"{}\"", number(paint.width));
        text.push_str(" stroke-linejoin=\"round\"");
        if !paint.dashes.is_empty() {
            let _ = write!(text, " stroke-dasharray=\"{}\"", paint.dashes);
        }
    }
    if paint.crisp {
        text.push_str(" shape-rendering=\"crispEdges\"");
    }
    text
}

/// The spans of a label; subscripts and superscripts are smaller and shifted.
fn marked_up(label: &str, size: f64) -> String {
    let small = number(SMALL * size);
    let mut text = String::new();
    let mut level = Level::Line;
    for span in spans(label) {
        let shift = offset(span.level, size) - offset(level, size);
        level = span.level;
        let content = escaped(&span.text);
        match (span.level, shift.abs() > 1e-9) {
            (Level::Line, false) => text.push_str(&content),
            (Level::Line, true) => {
                let _ = write!(text, "<tspan dy=\"{}\">{content}</tspan>", number(shift));
            }
            _ => {
                let dy = number(shift);
                let _ = write!(text, "<tspan dy=\"{dy}\" font-size=\"{small}\">{content}</tspan>");
            }
        }
    }
    text
}

/// Downward shift of a level from the base line.
fn offset(level: Level, size: f64) -> f64 {
    match level {
        Level::Line => 0.0,
        Level::Below => 0.22 * size,
        Level::Above => -0.34 * size,
    }
}

/// A text with XML's special characters escaped and invalid ones removed.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            c if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' => {}
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_escaped_and_their_subscripts_moved() {
        let mut svg = Svg::default();
        let (x, y, size, anchor, upright) = (1.0, 2.0, 10.0, Anchor::Middle, false);
        svg.text(Text { x, y, label: "a < \u{7}b & α_c = 1", size, anchor, upright });
        let document = svg.finish((10.0, 20.0), ("10".into(), "20".into()));
        let text = "a &lt; b &amp; α<tspan dy=\"2.2\" font-size=\"7.2\">c</tspan><tspan dy=\"-2.2\"> = 1</tspan>";
        assert!(document.contains(text), "{document}");
        assert!(document.contains("viewBox=\"0 0 10 20\""));
    }

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        for (value, text) in [(1.0, "1"), (-0.001, "0"), (12.3456, "12.35"), (f64::MAX, "1000000")]
        {
            assert_eq!(number(value), text);
        }
    }
}
