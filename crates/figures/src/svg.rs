//! A drawing as SVG, element by element. Texts stay texts; the viewer supplies the font.

use crate::colours::hex;
use crate::drawing::{Anchor, Drawing, Element, Paint, Path, Rect, Step, Text};
use crate::error::FigureError;
use crate::style::INK;
use crate::text::Level;
use crate::text::{SMALL, offset, spans};
use crate::thin::Point;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;

/// The document; `width` and `height` are in units, `size` is written as its size for the viewer.
pub(crate) fn document(
    drawing: &Drawing,
    (width, height): (f64, f64),
    size: &(String, String),
) -> Result<String, FigureError> {
    let mut svg = Svg { text: String::new(), clips: 0 };
    let _ = writeln!(
        svg.text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" \
         font-family=\"DejaVu Sans, Verdana, Arial, Helvetica, sans-serif\" fill=\"{}\">",
        number(width),
        number(height),
        size.0,
        size.1,
        hex(INK),
    );
    for element in &drawing.elements {
        svg.element(element)?;
        svg.text.push('\n');
    }
    svg.text.push_str("</svg>\n");
    Ok(svg.text)
}

/// A number with at most two decimals, a hundredth of a unit.
pub(crate) fn number(value: f64) -> String {
    let mut text = String::new();
    push(value, &mut text);
    text
}

/// Appends a number with at most two decimals. Integers are fast: web pages draw thousands of points while a slider moves.
fn push(value: f64, text: &mut String) {
    let hundredths = (value.clamp(-1e6, 1e6) * 100.0).round() as i64;
    if hundredths < 0 {
        text.push('-');
    }
    let (whole, rest) = (hundredths.unsigned_abs() / 100, hundredths.unsigned_abs() % 100);
    let _ = match (rest, rest % 10) {
        (0, _) => write!(text, "{whole}"),
        (_, 0) => write!(text, "{whole}.{}", rest / 10),
        _ => write!(text, "{whole}.{rest:02}"),
    };
}

struct Svg {
    text: String,
    clips: usize,
}

impl Svg {
    fn element(&mut self, element: &Element) -> Result<(), FigureError> {
        match element {
            Element::Path(path, paint) => {
                self.text.push_str("<path d=\"");
                self.path(path);
                self.text.push('"');
                self.paint(paint);
            }
            Element::Rect(at, paint) => {
                self.text.push_str("<rect");
                self.place(*at);
                self.paint(paint);
            }
            Element::Image(at, picture) => {
                let url = STANDARD.encode(picture.png()?);
                self.text.push_str("<image");
                self.place(*at);
                let _ = write!(
                    self.text,
                    " preserveAspectRatio=\"none\" href=\"data:image/png;base64,{url}\"/>"
                );
            }
            Element::Text(text) => self.label(text),
            Element::Clip(within) => {
                self.clips += 1;
                let _ = write!(self.text, "<clipPath id=\"clip{}\"><rect", self.clips);
                self.place(*within);
                let _ =
                    write!(self.text, "/></clipPath><g clip-path=\"url(#clip{})\">", self.clips);
            }
            Element::Unclip => self.text.push_str("</g>"),
        }
        Ok(())
    }

    fn place(&mut self, at: Rect) {
        let values =
            [("x", at.left), ("y", at.top), ("width", at.width()), ("height", at.height())];
        for (name, value) in values {
            let _ = write!(self.text, " {name}=\"");
            push(value, &mut self.text);
            self.text.push('"');
        }
    }

    /// A letter and numbers with spaces between them.
    fn step(&mut self, letter: char, points: &[Point]) {
        self.text.push(letter);
        for (i, (x, y)) in points.iter().enumerate() {
            if i > 0 {
                self.text.push(' ');
            }
            push(*x, &mut self.text);
            self.text.push(' ');
            push(*y, &mut self.text);
        }
    }

    fn path(&mut self, path: &Path) {
        for step in &path.0 {
            match *step {
                Step::Move(to) => self.step('M', &[to]),
                Step::Line(to) => self.step('L', &[to]),
                Step::Curve(from, toward, to) => self.step('C', &[from, toward, to]),
                Step::Rect(Rect { left, top, right, bottom }) => {
                    let [left, right, top, bottom] = [left, right, top, bottom].map(number);
                    let _ = write!(self.text, "M{left} {bottom}H{right}V{top}H{left}Z");
                }
                Step::Disc((x, y), radius) => {
                    let (r, across) = (number(radius), number(2.0 * radius));
                    let (left, y) = (number(x - radius), number(y));
                    let _ = write!(
                        self.text,
                        "M{left} {y}a{r} {r} 0 1 0 {across} 0a{r} {r} 0 1 0 -{across} 0Z"
                    );
                }
                Step::Close => self.text.push('Z'),
            }
        }
    }

    /// The attributes of a shape, and the end of its element.
    fn paint(&mut self, paint: &Paint) {
        let text = &mut self.text;
        let fill = paint.fill.map_or("none".into(), hex);
        let _ = write!(text, " fill=\"{fill}\"");
        if let Some(opacity) = paint.fill_opacity {
            let _ = write!(text, " fill-opacity=\"{opacity}\"");
        }
        if let Some(stroke) = paint.stroke {
            let (colour, width) = (hex(stroke), number(paint.width));
            let _ = write!(
                text,
                " stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\""
            );
            if !paint.dashes.is_empty() {
                let dashes: Vec<String> = paint.dashes.iter().copied().map(number).collect();
                let _ = write!(text, " stroke-dasharray=\"{}\"", dashes.join(" "));
            }
        }
        if paint.crisp {
            text.push_str(" shape-rendering=\"crispEdges\"");
        }
        text.push_str("/>");
    }

    fn label(&mut self, text: &Text) {
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
        let label = marked_up(&text.label, text.size);
        let _ = write!(
            self.text,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{anchor}{turn}>{label}</text>"
        );
    }
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
        let mut drawing = Drawing::default();
        let label = "a < \u{7}b & α_c = 1".to_owned();
        let (x, y, size, anchor, upright) = (1.0, 2.0, 10.0, Anchor::Middle, false);
        drawing.text(Text { x, y, label, size, anchor, upright });
        let document = document(&drawing, (10.0, 20.0), &("10".into(), "20".into())).unwrap();
        let text = "a &lt; b &amp; α<tspan dy=\"2.2\" font-size=\"7.2\">c</tspan><tspan dy=\"-2.2\"> = 1</tspan>";
        assert!(document.contains(text), "{document}");
        assert!(document.contains("viewBox=\"0 0 10 20\""));
    }

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        let numbers = [
            (1.0, "1"),
            (-0.001, "0"),
            (12.3456, "12.35"),
            (-0.3, "-0.3"),
            (7.05, "7.05"),
            (f64::MAX, "1000000"),
        ];
        for (value, text) in numbers {
            assert_eq!(number(value), text);
        }
    }
}
