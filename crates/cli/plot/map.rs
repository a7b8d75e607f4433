//! Height maps: one colour for each height, a bar that says which, the picture within the SVG.

use super::axis::{Axis, Fit};
use super::curve::{Curve, Pen};
use super::error::PlotError;
use super::panel::Panel;
use super::picture::Picture;
use super::sheet::sheet;
use super::style::{BLACK, LABEL_SIZE, TICK_SIZE, WIDTH, text_width};
use kuva::plot::ColorMap;
use kuva::render::render::{Primitive, Scene, TextAnchor};

/// Colours by height. Both are told apart by the colour-blind and in print.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Colours {
    /// From blue over grey to yellow, evenly in lightness.
    Cividis,
    /// From black to white: the paper's.
    Grey,
}

/// z at evenly spaced x (columns) and y (rows).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Map<'a> {
    pub(crate) x: &'a [f64],
    pub(crate) y: &'a [f64],
    pub(crate) z: &'a [Vec<f64>],
    /// Of x, y and z.
    pub(crate) labels: (&'a str, &'a str, &'a str),
    /// Above the map.
    pub(crate) name: &'a str,
    pub(crate) colours: Colours,
}

/// A map of a panel, and the scale of its heights.
pub(super) struct Drawn<'a> {
    picture: Picture,
    label: &'a str,
    axis: Axis,
    colours: Colours,
}

/// A map takes this much at least, and this at most.
const HEIGHTS: (f64, f64) = (220.0, 420.0);
const BAR_GAP: f64 = 16.0;
const BAR: f64 = 18.0;
const BAR_STEPS: usize = 128;

/// Maps one below the other, with one scale of colours for all. An SVG document.
pub(crate) fn maps(title: &str, maps: &[Map]) -> Result<String, PlotError> {
    let axis = scale(maps.iter().flat_map(|map| map.z.iter().flatten().copied()));
    let panels: Result<Vec<Panel>, PlotError> =
        maps.iter().map(|map| map.panel_on(axis.clone())).collect();
    Ok(sheet(title, &panels?))
}

/// From the lowest to the highest.
fn scale(heights: impl IntoIterator<Item = f64>) -> Axis {
    Axis::fit(heights, Fit { padding: 0.0, natural: 0.0, ticks: 5.0 })
}

impl<'a> Map<'a> {
    /// A panel filled by the map.
    pub(super) fn panel(&self) -> Result<Panel<'a>, PlotError> {
        self.panel_on(scale(self.z.iter().flatten().copied()))
    }

    /// The same with colours on this scale.
    fn panel_on(&self, axis: Axis) -> Result<Panel<'a>, PlotError> {
        let (x, y) = (edges(self.x), edges(self.y));
        let aspect = (y.1 - y.0) / (x.1 - x.0);
        let height = (0.75 * WIDTH * aspect).clamp(HEIGHTS.0, HEIGHTS.1);
        let colours = self.colours;
        let colour = |z: f64| colours.at((z - axis.low) / (axis.high - axis.low));
        let picture = Picture::of(self.z, colour)?;
        let map = Drawn { picture, label: self.labels.2, axis, colours };
        // kuva draws no ticks where there is no curve; the picture covers this one.
        let (corner_x, corner_y) = (self.x.get(..1), self.y.get(..1));
        let (corner_x, corner_y) = (corner_x.unwrap_or(&[]), corner_y.unwrap_or(&[]));
        let hidden = Curve { x: corner_x, y: corner_y, pen: Pen::dots(BLACK), label: None };
        Ok(Panel {
            heading: self.name,
            x: Axis::new(x.0, x.1, 9.0),
            y: Axis::new(y.0, y.1, (height / 65.0).min(5.0)),
            x_label: self.labels.0,
            y_label: self.labels.1,
            height,
            curves: vec![hidden],
            shades: vec![],
            notes: vec![],
            map: Some(map),
        })
    }
}

/// Half a pixel beyond the first and the last centre.
fn edges(centres: &[f64]) -> (f64, f64) {
    let (first, last) = (centres.first().copied(), centres.last().copied());
    let (first, last) = (first.unwrap_or(0.0), last.unwrap_or(0.0));
    let intervals = centres.len().max(2) - 1;
    let half = 0.5 * (last - first) / intervals as f64;
    let half = if half > 0.0 { half } else { 0.5 };
    (first - half, last + half)
}

impl Colours {
    /// The colour at a part of the scale.
    pub(super) fn at(self, part: f64) -> [u8; 3] {
        let part = part.clamp(0.0, 1.0);
        let grey = (255.0 * part).round() as u8;
        match self {
            Self::Grey => [grey; 3],
            Self::Cividis => {
                let (r, g, b) = ColorMap::Cividis.map_rgb(part).unwrap_or((grey, grey, grey));
                [r, g, b]
            }
        }
    }
}

impl Drawn<'_> {
    /// Room right of the axes for the bar, its numbers and its label.
    pub(super) fn margin_right(&self) -> f64 {
        let labels = self.axis.labels();
        let widest = labels.iter().map(|l| text_width(l, TICK_SIZE)).fold(0.0, f64::max);
        BAR_GAP + BAR + 10.0 + widest + 2.0 * f64::from(LABEL_SIZE)
    }

    /// The picture as SVG, within the sheet.
    pub(super) fn image(&self, (left, right): (f64, f64), (top, bottom): (f64, f64)) -> String {
        let (width, height) = (right - left, bottom - top);
        let place = format!("x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"");
        format!(
            "<image {place} preserveAspectRatio=\"none\" href=\"{}\"/>\
             <rect {place} fill=\"none\" stroke=\"black\"/>",
            self.picture.url()
        )
    }

    /// The bar and its numbers, right of the axes.
    pub(super) fn draw_bar(&self, right: f64, (top, bottom): (f64, f64), scene: &mut Scene) {
        let text = |x, y, content: &str, size, anchor, rotate| Primitive::Text {
            x,
            y,
            content: content.to_owned(),
            size,
            anchor,
            rotate,
            bold: false,
            color: None,
        };
        let bar = right + BAR_GAP;
        let step = (bottom - top) / BAR_STEPS as f64;
        for i in 0..BAR_STEPS {
            let [r, g, b] = self.colours.at((i as f64 + 0.5) / BAR_STEPS as f64);
            scene.add(Primitive::Rect {
                x: bar,
                y: bottom - step * (i + 1) as f64,
                width: BAR,
                // The next one covers what is more: no seam is left.
                height: if i == 0 { step } else { step + 0.5 },
                fill: format!("#{r:02x}{g:02x}{b:02x}").into(),
                stroke: None,
                stroke_width: None,
                opacity: None,
            });
        }
        let span = self.axis.high - self.axis.low;
        let size = f64::from(TICK_SIZE);
        for (value, label) in self.axis.ticks() {
            let y = bottom - (bottom - top) * (value - self.axis.low) / span;
            scene.add(Primitive::Line {
                x1: bar + BAR,
                y1: y,
                x2: bar + BAR + 5.0,
                y2: y,
                stroke: "black".into(),
                stroke_width: 1.0,
                stroke_dasharray: None,
            });
            let (x, y) = (bar + BAR + 9.0, y + 0.35 * size);
            scene.add(text(x, y, &label, TICK_SIZE, TextAnchor::Start, None));
        }
        let x = WIDTH - 0.5 * f64::from(LABEL_SIZE);
        let middle = 0.5 * (top + bottom);
        scene.add(text(x, middle, self.label, LABEL_SIZE, TextAnchor::Middle, Some(-90.0)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_in_one_figure_have_one_scale() {
        let (low, high) = ([vec![0.0, 1.0], vec![0.5, 0.2]], [vec![0.0, 8.0], vec![4.0, 2.0]]);
        let map = |z| Map {
            x: &[0.0, 1.0],
            y: &[0.0, 1.0],
            z,
            labels: ("x", "y", "z"),
            name: "",
            colours: Colours::Grey,
        };
        let svg = maps("test", &[map(&low), map(&high)]).unwrap();
        assert_eq!(svg.matches(">8</text>").count(), 2, "the highest of both, at either bar");
    }
}
