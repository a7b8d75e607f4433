//! Texts as outlines, in the font DejaVu Sans: one letter after the other by its advance and its kerning.

use crate::drawing::{Anchor, Path, Step, Text};
use crate::text::{Level, SMALL, offset, spans};
use crate::thin::Point;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// The font.
pub(crate) struct Letters {
    face: Face<'static>,
}

impl Letters {
    pub(crate) fn new() -> Self {
        let face = Face::parse(dejavu::sans::regular(), 0).expect("the font is part of the build");
        Self { face }
    }

    /// The outlines of a text, in its place.
    pub(crate) fn outline(&self, text: &Text) -> Path {
        let mut glyphs = vec![];
        let mut pen = 0.0;
        for span in spans(&text.label) {
            let size = if span.level == Level::Line { text.size } else { SMALL * text.size };
            let scale = size / f64::from(self.face.units_per_em());
            let mut last = None;
            for letter in span.text.chars().filter(|letter| !letter.is_control()) {
                // A character that the font lacks is the box of glyph 0.
                let glyph = self.face.glyph_index(letter).unwrap_or(GlyphId(0));
                pen += scale * last.map_or(0.0, |last| self.kerning(last, glyph));
                glyphs.push((glyph, scale, (pen, offset(span.level, text.size))));
                pen += scale * f64::from(self.face.glyph_hor_advance(glyph).unwrap_or(0));
                last = Some(glyph);
            }
        }
        let start = match text.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * pen,
            Anchor::End => -pen,
        };
        let mut path = Path::default();
        for (glyph, scale, (x, y)) in glyphs {
            let mut outline =
                Outline { text, from: (start + x, y), scale, last: (0.0, 0.0), path: &mut path };
            self.face.outline_glyph(glyph, &mut outline);
        }
        path
    }

    /// Shift of a glyph towards the one before it, in units of the font.
    fn kerning(&self, before: GlyphId, glyph: GlyphId) -> f64 {
        let tables = self.face.tables().kern.into_iter().flat_map(|kern| kern.subtables);
        let horizontal = tables.filter(|table| table.horizontal && !table.variable);
        let shifts = horizontal.filter_map(|table| table.glyphs_kerning(before, glyph));
        shifts.map(f64::from).sum()
    }
}

/// Converts the outline of a glyph, in units of the font that count upwards, to its place in the drawing.
struct Outline<'a> {
    text: &'a Text,
    /// The origin of the glyph on the line of the text.
    from: Point,
    scale: f64,
    last: Point,
    path: &'a mut Path,
}

impl Outline<'_> {
    fn place(&self, x: f32, y: f32) -> Point {
        let (along, down) =
            (self.from.0 + self.scale * f64::from(x), self.from.1 - self.scale * f64::from(y));
        if self.text.upright {
            (self.text.x + down, self.text.y - along)
        } else {
            (self.text.x + along, self.text.y + down)
        }
    }

    fn curve(&mut self, from: Point, toward: Point, to: Point) {
        self.path.0.push(Step::Curve(from, toward, to));
        self.last = to;
    }
}

impl OutlineBuilder for Outline<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.last = self.place(x, y);
        self.path.0.push(Step::Move(self.last));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.last = self.place(x, y);
        self.path.0.push(Step::Line(self.last));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (handle, to) = (self.place(x1, y1), self.place(x, y));
        // The same arc as a cubic one.
        let toward =
            |a: Point| (a.0 + (handle.0 - a.0) * 2.0 / 3.0, a.1 + (handle.1 - a.1) * 2.0 / 3.0);
        self.curve(toward(self.last), toward(to), to);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.curve(self.place(x1, y1), self.place(x2, y2), self.place(x, y));
    }

    fn close(&mut self) {
        self.path.0.push(Step::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(label: &str, anchor: Anchor, upright: bool) -> Text {
        Text { x: 100.0, y: 50.0, label: label.into(), size: 10.0, anchor, upright }
    }

    /// Left, right, top and bottom ends of all points.
    fn ends(path: &Path) -> [f64; 4] {
        let mut ends = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        for step in &path.0 {
            if let Step::Move((x, y)) | Step::Line((x, y)) | Step::Curve(_, _, (x, y)) = *step {
                ends = [ends[0].min(x), ends[1].max(x), ends[2].min(y), ends[3].max(y)];
            }
        }
        ends
    }

    /// Widths and heights of DejaVu Sans: an H is 0.752 em wide and 0.729 em high.
    #[test]
    fn letters_have_the_size_of_the_font_and_the_place_of_the_text() {
        let letters = Letters::new();
        let [left, right, top, bottom] = ends(&letters.outline(&text("H", Anchor::Middle, false)));
        assert!((0.5 * (left + right) - 100.0).abs() < 0.05 && (right - left) < 7.52);
        assert!(
            (bottom - 50.0).abs() < 1e-9 && (bottom - top - 7.29).abs() < 0.01,
            "{top} {bottom}"
        );
        let [left, right, _, _] = ends(&letters.outline(&text("HHH", Anchor::End, false)));
        assert!(
            (100.0 - right - 0.98).abs() < 0.05 && (100.0 - left - 21.58).abs() < 0.05,
            "{left} {right}"
        );
        // Upwards, an H stands on the left side of the text's line.
        let [left, right, top, bottom] = ends(&letters.outline(&text("HHH", Anchor::Start, true)));
        assert!((left - 92.71).abs() < 0.01 && (right - 100.0).abs() < 1e-9);
        assert!(top > 50.0 - 22.56 && bottom < 50.0);
    }

    #[test]
    fn a_subscript_is_smaller_and_lower_and_what_the_font_lacks_is_a_box() {
        let letters = Letters::new();
        let [.., bottom] = ends(&letters.outline(&text("α_H", Anchor::Start, false)));
        assert!((bottom - 52.2).abs() < 1e-9, "{bottom}");
        let [left, right, ..] = ends(&letters.outline(&text("龍", Anchor::Start, false)));
        assert!(right - left > 3.0);
        assert_eq!(letters.outline(&text(" \u{7}", Anchor::Start, false)), Path::default());
    }
}
