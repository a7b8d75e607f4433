//! The drawing of a scene: a background with everything that stays, and what moves on top of it.

use super::film::Film;
use crate::colours::hex;
use crate::curve::Frame;
use crate::error::FigureError;
use crate::map::Map;
use crate::raster::{draw_images, without_alpha};
use crate::scene::{Moment, Scene};
use crate::sheet::Sheet;
use crate::size::Size;
use crate::style::{INK, LABEL_SIZE};
use crate::svg::{Anchor, Paint, Rect, Svg, Text, number, polyline};
use crate::text::width;
use crate::vector::{options, tree_with};
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::Options;
use stickslip::{FigureDocument, PanelDocument};

/// Largest number of pixels of a frame.
const MOST: f64 = 4e6;
/// Colours of the polymer, the tip, and of spring and support.
const GROUND: [u8; 3] = [0xF3, 0xE3, 0xC3];
const TIP: &str = "#4D4D4D";
const SPRING: &str = "#D55E00";
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
    scale: Transform,
    options: Options<'static>,
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
        let options = options();
        let sheet = Sheet::of(still, size.units());
        let mut svg = Svg::default();
        sheet.draw(&mut svg)?;
        let (units, density) = (sheet.size, size.pixels().0);
        let (width, height) = ((units.0 * density).round(), (units.1 * density).round());
        if width * height > MOST {
            return Err(FigureError::Pixels(width as u64, height as u64));
        }
        let too_many = || FigureError::Pixels(width as u64, height as u64);
        let mut background = Pixmap::new(width as u32, height as u32).ok_or_else(too_many)?;
        background.fill(Color::WHITE);
        let scale = Transform::from_scale(density as f32, density as f32);
        // Without its images, which every moment has anew.
        let tree = tree_with(&finished(svg, units), &options)?;
        resvg::render(&tree, scale, &mut background.as_mut());
        let step = (film.times(times).get(2).map_or(times[1], |f| f.0) - times[0]).abs();
        let decimals = (-step.log10()).ceil().clamp(0.0, 12.0) as usize;
        Ok(Self { background, sheet, scale, options, decimals })
    }

    /// Width and height, in pixels.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.background.width() as usize, self.background.height() as usize)
    }

    /// Red, green and blue of every pixel at this time.
    pub(super) fn draw(&self, scene: &mut dyn Scene, t: f64) -> Result<Vec<u8>, FigureError> {
        let moment = scene.moment(t)?;
        let mut svg = Svg::default();
        for (i, (panel, frame)) in moment.panels.iter().zip(self.sheet.frames()).enumerate() {
            self.panel(panel, frame, (i == 0).then_some(&moment), &mut svg)?;
        }
        let tree = tree_with(&finished(svg, self.sheet.size), &self.options)?;
        let mut picture = self.background.clone();
        draw_images(tree.root(), self.scale, &mut picture);
        resvg::render(&tree, self.scale, &mut picture.as_mut());
        Ok(without_alpha(picture))
    }

    /// Draws the content of a panel; in the first one also the tip and the time.
    fn panel(
        &self,
        panel: &PanelDocument,
        frame: Frame,
        first: Option<&Moment>,
        svg: &mut Svg,
    ) -> Result<(), FigureError> {
        let at = frame.at;
        if let Some(map) = &panel.map {
            Map::new(map, panel.x_range, panel.y_range).draw(at, svg)?;
        }
        svg.open_clip(at);
        if first.is_some() && panel.map.is_none() {
            self.ground(panel, frame, svg);
        }
        panel.curves.iter().for_each(|curve| frame.draw(curve, panel.curves.len(), svg));
        if let Some(moment) = first {
            match panel.map {
                Some(_) => seen_from_above(moment, frame, svg),
                None => seen_from_the_side(moment, frame, svg),
            }
        }
        svg.close();
        svg.rect(at, Paint::stroke(INK, 1.2));
        if let Some(moment) = first {
            self.time(moment, at, svg);
        }
        Ok(())
    }

    /// Fills the polymer below the surface.
    fn ground(&self, panel: &PanelDocument, frame: Frame, svg: &mut Svg) {
        let Some(surface) = panel.curves.first() else { return };
        let points = surface.x.iter().zip(&surface.y);
        let mut area: Vec<(f64, f64)> =
            points.filter_map(|(x, u)| frame.place((*x, (*u)?))).collect();
        let (Some(first), Some(last)) = (area.first().copied(), area.last().copied()) else {
            return;
        };
        area.extend([(last.0, frame.at.bottom), (first.0, frame.at.bottom)]);
        svg.path(&(polyline(&area) + "Z"), Paint::fill(&hex(GROUND)));
    }

    /// Writes the time at the upper right corner of the axes, on a light ground.
    fn time(&self, moment: &Moment, at: Rect, svg: &mut Svg) {
        let time = format!("t = {:.*} {}", self.decimals, moment.t, moment.unit).replace('-', "−");
        let label = match moment.note.as_str() {
            "" => time,
            note => format!("{note}, {time}"),
        };
        let (size, x, y) = (LABEL_SIZE, at.right - 10.0, at.top + 8.0 + 0.8 * LABEL_SIZE);
        let left = x - width(&label, size) - 4.0;
        let ground = Rect { left, right: x + 4.0, top: at.top + 4.0, bottom: y + 0.4 * size };
        svg.rect(ground, Paint { fill_opacity: Some(0.8), ..Paint::fill("#ffffff") });
        svg.text(Text { x, y, label: &label, size, anchor: Anchor::End, upright: false });
    }
}

fn finished(svg: Svg, (width, height): (f64, f64)) -> String {
    svg.finish((width, height), (number(width), number(height)))
}

/// Tip, spring and support along the surface.
fn seen_from_the_side(moment: &Moment, frame: Frame, svg: &mut Svg) {
    let Some((x, y)) = frame.place(moment.tip) else { return };
    let level = frame.at.top + SPRING_DEPTH;
    let (half, height) = CONE;
    let shoulder = y - height;
    if let Some((end, _)) = moment.support.and_then(|at| frame.place((at, moment.tip.1))) {
        svg.segment((x, shoulder + 1.0), (x, level), Paint::stroke(TIP, 3.0));
        svg.path(&polyline(&spring((x, level), end)), Paint::stroke(SPRING, 1.8));
        let (left, right) = (end - SUPPORT.0, end + SUPPORT.0);
        let block = Rect { left, right, top: level - SUPPORT.1, bottom: level + SUPPORT.1 };
        svg.rect(block, Paint::fill(TIP));
    }
    let n = number;
    let cone = format!(
        "M{} {s}L{} {}Q{} {} {} {}L{} {s}Z",
        n(x - half),
        n(x - 2.0),
        n(y - 4.0),
        n(x),
        n(y + 3.0),
        n(x + 2.0),
        n(y - 4.0),
        n(x + half),
        s = n(shoulder),
    );
    svg.path(&cone, Paint::fill(TIP));
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
fn seen_from_above(moment: &Moment, frame: Frame, svg: &mut Svg) {
    let Some((x, y)) = frame.place(moment.tip) else { return };
    if let Some((end, _)) = moment.support.and_then(|at| frame.place((at, moment.tip.1))) {
        svg.segment((x, y), (end, y), Paint::stroke("#ffffff", 4.5));
        svg.segment((x, y), (end, y), Paint::stroke(SPRING, 2.2));
        let (left, right, top, bottom) = (end - 2.5, end + 2.5, y - 7.0, y + 7.0);
        let block = Paint { stroke: Some("#ffffff"), width: 1.0, ..Paint::fill(TIP) };
        svg.rect(Rect { left, right, top, bottom }, block);
    }
    let disc = crate::curve::shape((x, y), crate::style::Shape::Disc, 5.0);
    svg.path(&disc, Paint { stroke: Some("#ffffff"), width: 1.4, ..Paint::fill(TIP) });
}
