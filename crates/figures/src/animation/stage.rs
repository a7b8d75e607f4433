//! The drawing of a scene: a background with everything that stays, and the moving parts on top of it.

use super::film::Film;
use crate::curve::{Frame, shape};
use crate::drawing::{Anchor, Drawing, Paint, Path, Rect, Step, Text, polygon, polyline};
use crate::error::FigureError;
use crate::map::Map;
use crate::raster::{Painter, blank, without_alpha};
use crate::scene::{Moment, Scene};
use crate::sheet::Sheet;
use crate::size::Size;
use crate::style::{Colour, INK, LABEL_SIZE, PAPER, Shape};
use crate::text::width;
use crate::thin::Point;
use stickslip::{FigureDocument, PanelDocument};
use tiny_skia::Pixmap;

/// Largest number of pixels of a frame.
const MOST: f64 = 4e6;
/// Colours of the polymer, the tip, and of spring and support.
const GROUND: Colour = [0xf3, 0xe3, 0xc3];
const TIP: Colour = [0x4d; 3];
const SPRING: Colour = [0xd5, 0x5e, 0x00];
/// Distance of the spring from the upper edge of the axes, in units.
const SPRING_DEPTH: f64 = 46.0;
/// Half-width and height of the tip's cone.
const CONE: (f64, f64) = (9.0, 34.0);
/// Windings of the spring, and half their height.
const WINDINGS: u32 = 6;
const WINDING: f64 = 6.0;
/// Half-width and half-height of the support.
const SUPPORT: (f64, f64) = (5.0, 15.0);

/// The background, and the axes on it.
pub(super) struct Stage<'a> {
    background: Pixmap,
    sheet: Sheet<'a>,
    painter: Painter,
    /// Decimals of the time.
    decimals: usize,
}

impl<'a> Stage<'a> {
    pub(super) fn of(
        still: &'a FigureDocument,
        times: [f64; 2],
        film: &Film,
    ) -> Result<Self, FigureError> {
        let size = Size::new(Some(film.width()), None)?;
        let sheet = Sheet::of(still, size.units());
        let density = size.pixels().0;
        let mut background = blank(sheet.size, density, MOST)?;
        let painter = Painter::new(density);
        painter.paint(&sheet.drawing(false), &mut background);
        let step = (film.times(times).get(2).map_or(times[1], |f| f.0) - times[0]).abs();
        let decimals = (-step.log10()).ceil().clamp(0.0, 12.0) as usize;
        Ok(Self { background, sheet, painter, decimals })
    }

    /// Width and height, in pixels.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.background.width() as usize, self.background.height() as usize)
    }

    /// Red, green and blue of every pixel at this time.
    pub(super) fn draw(&self, scene: &mut dyn Scene, t: f64) -> Result<Vec<u8>, FigureError> {
        let moment = scene.moment(t)?;
        let mut drawing = Drawing::default();
        for (i, (panel, frame)) in moment.panels.iter().zip(self.sheet.frames()).enumerate() {
            self.panel(panel, frame, (i == 0).then_some(&moment), &mut drawing);
        }
        let mut picture = self.background.clone();
        self.painter.paint(&drawing, &mut picture);
        Ok(without_alpha(picture))
    }

    /// Draws the content of a panel; in the first one also the tip and the time.
    fn panel(
        &self,
        panel: &PanelDocument,
        frame: Frame,
        first: Option<&Moment>,
        drawing: &mut Drawing,
    ) {
        let at = frame.at;
        if let Some(map) = &panel.map {
            Map::new(map, panel.x_range, panel.y_range).draw(at, drawing);
        }
        drawing.clip(at);
        if first.is_some() && panel.map.is_none() {
            self.ground(panel, frame, drawing);
        }
        panel.curves.iter().for_each(|curve| frame.draw(curve, panel.curves.len(), drawing));
        if let Some(moment) = first {
            match panel.map {
                Some(_) => seen_from_above(moment, frame, drawing),
                None => seen_from_the_side(moment, frame, drawing),
            }
        }
        drawing.unclip();
        drawing.rect(at, Paint::stroke(INK, 1.2));
        if let Some(moment) = first {
            self.time(moment, at, drawing);
        }
    }

    /// Fills the polymer below the surface.
    fn ground(&self, panel: &PanelDocument, frame: Frame, drawing: &mut Drawing) {
        let Some(surface) = panel.curves.first() else { return };
        let points = surface.x.iter().zip(&surface.y);
        let mut area: Vec<(f64, f64)> =
            points.filter_map(|(x, u)| frame.place((*x, (*u)?))).collect();
        let (Some(first), Some(last)) = (area.first().copied(), area.last().copied()) else {
            return;
        };
        area.extend([(last.0, frame.at.bottom), (first.0, frame.at.bottom)]);
        drawing.path(polygon(&area), Paint::fill(GROUND));
    }

    /// Writes the time at the upper right corner of the axes, on a light ground.
    fn time(&self, moment: &Moment, at: Rect, drawing: &mut Drawing) {
        let time = format!("t = {:.*} {}", self.decimals, moment.t, moment.unit).replace('-', "−");
        let label = match moment.note.as_str() {
            "" => time,
            note => format!("{note}, {time}"),
        };
        let (size, x, y) = (LABEL_SIZE, at.right - 10.0, at.top + 8.0 + 0.8 * LABEL_SIZE);
        let left = x - width(&label, size) - 4.0;
        let ground = Rect { left, right: x + 4.0, top: at.top + 4.0, bottom: y + 0.4 * size };
        drawing.rect(ground, Paint::translucent(PAPER, 0.8));
        drawing.text(Text { x, y, label, size, anchor: Anchor::End, upright: false });
    }
}

/// Tip, spring and support along the surface.
fn seen_from_the_side(moment: &Moment, frame: Frame, drawing: &mut Drawing) {
    let Some((x, y)) = frame.place(moment.tip) else { return };
    let level = frame.at.top + SPRING_DEPTH;
    let (half, height) = CONE;
    let shoulder = y - height;
    if let Some((end, _)) = moment.support.and_then(|at| frame.place(at)) {
        drawing.segment((x, shoulder + 1.0), (x, level), Paint::stroke(TIP, 3.0));
        drawing.path(polyline(&spring((x, level), end)), Paint::stroke(SPRING, 1.8));
        let (left, right) = (end - SUPPORT.0, end + SUPPORT.0);
        let block = Rect { left, right, top: level - SUPPORT.1, bottom: level + SUPPORT.1 };
        drawing.rect(block, Paint::fill(TIP));
    }
    // The apex is a parabola between two points of the flanks, with its handle below the surface.
    let (flanks, handle) = ([(x - 2.0, y - 4.0), (x + 2.0, y - 4.0)], (x, y + 3.0));
    let toward =
        |a: Point| (a.0 + (handle.0 - a.0) * 2.0 / 3.0, a.1 + (handle.1 - a.1) * 2.0 / 3.0);
    let cone = vec![
        Step::Move((x - half, shoulder)),
        Step::Line(flanks[0]),
        Step::Curve(toward(flanks[0]), toward(flanks[1]), flanks[1]),
        Step::Line((x + half, shoulder)),
        Step::Close,
    ];
    drawing.path(Path(cone), Paint::fill(TIP));
}

/// The zigzag of a spring.
fn spring((from, y): (f64, f64), to: f64) -> Vec<(f64, f64)> {
    let straight = 0.12 * (to - from);
    let (begin, end) = (from + straight, to - straight);
    let count = 2 * WINDINGS;
    let corner = |i: u32| {
        let x = begin + (end - begin) * (f64::from(i) + 0.5) / f64::from(count);
        (x, if i.is_multiple_of(2) { y - WINDING } else { y + WINDING })
    };
    let corners = (0..count).map(corner);
    [(from, y), (begin, y)].into_iter().chain(corners).chain([(end, y), (to, y)]).collect()
}

/// Tip and support over a map.
fn seen_from_above(moment: &Moment, frame: Frame, drawing: &mut Drawing) {
    let Some((x, y)) = frame.place(moment.tip) else { return };
    if let Some((end, level)) = moment.support.and_then(|at| frame.place(at)) {
        drawing.segment((x, y), (end, level), Paint::stroke(PAPER, 4.5));
        drawing.segment((x, y), (end, level), Paint::stroke(SPRING, 2.2));
        let (left, right, top, bottom) = (end - 2.5, end + 2.5, level - 7.0, level + 7.0);
        let block = Paint { stroke: Some(PAPER), width: 1.0, ..Paint::fill(TIP) };
        drawing.rect(Rect { left, right, top, bottom }, block);
    }
    let disc = shape((x, y), Shape::Disc, 5.0);
    drawing.path(disc, Paint { stroke: Some(PAPER), width: 1.4, ..Paint::fill(TIP) });
}
