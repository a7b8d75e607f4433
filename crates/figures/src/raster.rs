//! A drawing as pixels, painted by tiny-skia.

use crate::drawing::{Drawing, Element, Paint, Path, Rect, Step};
use crate::error::FigureError;
use crate::letters::Letters;
use crate::picture::{Picture, png_file};
use crate::size::Size;
use crate::style::{Colour, INK};
use tiny_skia::{
    Color, FillRule, FilterQuality, IntSize, LineJoin, Mask, PathBuilder, Pixmap, PixmapPaint,
    Stroke, StrokeDash, Transform,
};

/// Largest number of pixels: compression of more takes above 240 MB. A page of A4 has 22 million at 480 per inch.
const MOST: f64 = 3.2e7;

/// Paints a drawing of this width and height, in units, on white.
pub(crate) fn raster(
    drawing: &Drawing,
    units: (f64, f64),
    size: &Size,
) -> Result<Vec<u8>, FigureError> {
    let (density, dots_per_inch) = size.pixels();
    let mut picture = blank(units, density, MOST)?;
    Painter::new(density).paint(drawing, &mut picture);
    let size = (picture.width() as usize, picture.height() as usize);
    png_file(size, png::ColorType::Rgb, &without_alpha(picture), Some(dots_per_inch))
}

/// A white picture of this width and height, with `density` pixels per unit and at most `most` pixels.
pub(crate) fn blank(
    (width, height): (f64, f64),
    density: f64,
    most: f64,
) -> Result<Pixmap, FigureError> {
    let [width, height] = [width, height].map(|side| (side * density).round().max(1.0));
    let too_many = || FigureError::Pixels(width as u64, height as u64);
    if width * height > most {
        return Err(too_many());
    }
    let mut picture = Pixmap::new(width as u32, height as u32).ok_or_else(too_many)?;
    picture.fill(Color::WHITE);
    Ok(picture)
}

/// Red, green and blue of an opaque picture, in the same storage.
pub(crate) fn without_alpha(picture: Pixmap) -> Vec<u8> {
    let pixels = picture.width() as usize * picture.height() as usize;
    let mut kept = picture.take();
    // Of a slice, by index: there may be millions, and tests run without optimisation.
    let bytes = &mut kept[..];
    for i in 0..pixels {
        bytes[3 * i] = bytes[4 * i];
        bytes[3 * i + 1] = bytes[4 * i + 1];
        bytes[3 * i + 2] = bytes[4 * i + 2];
    }
    kept.truncate(3 * pixels);
    kept
}

/// Paints drawings with this font and at this scale.
pub(crate) struct Painter {
    letters: Letters,
    scale: Transform,
}

impl Painter {
    /// A painter with this many pixels per unit.
    pub(crate) fn new(density: f64) -> Self {
        let scale = Transform::from_scale(density as f32, density as f32);
        Self { letters: Letters::new(), scale }
    }

    pub(crate) fn paint(&self, drawing: &Drawing, picture: &mut Pixmap) {
        let mut clip = None;
        for element in &drawing.elements {
            match element {
                Element::Path(path, paint) => self.path(path, paint, clip.as_ref(), picture),
                Element::Rect(at, paint) => {
                    self.path(&Path(vec![Step::Rect(*at)]), paint, clip.as_ref(), picture);
                }
                Element::Text(text) => {
                    let outline = self.letters.outline(text);
                    self.path(&outline, &Paint::fill(INK), clip.as_ref(), picture);
                }
                Element::Image(at, image) => self.image(*at, image, clip.as_ref(), picture),
                Element::Clip(within) => clip = self.mask(*within, picture),
                Element::Unclip => clip = None,
            }
        }
    }

    fn mask(&self, within: Rect, picture: &Pixmap) -> Option<Mask> {
        let mut mask = Mask::new(picture.width(), picture.height())?;
        let outline = outline(&Path(vec![Step::Rect(within)]))?;
        mask.fill_path(&outline, FillRule::Winding, true, self.scale);
        Some(mask)
    }

    fn path(&self, path: &Path, paint: &Paint, clip: Option<&Mask>, picture: &mut Pixmap) {
        let Some(outline) = outline(path) else { return };
        if let Some(fill) = paint.fill {
            let colour = colour(fill, paint.fill_opacity.unwrap_or(1.0), !paint.crisp);
            picture.fill_path(&outline, &colour, FillRule::Winding, self.scale, clip);
        }
        if let Some(stroke) = paint.stroke {
            let dashes = paint.dashes.iter().map(|length| *length as f32).collect();
            let pen = Stroke {
                width: paint.width as f32,
                line_join: LineJoin::Round,
                dash: StrokeDash::new(dashes, 0.0),
                ..Stroke::default()
            };
            let colour = colour(stroke, 1.0, !paint.crisp);
            picture.stroke_path(&outline, &colour, &pen, self.scale, clip);
        }
    }

    fn image(&self, at: Rect, image: &Picture, clip: Option<&Mask>, picture: &mut Pixmap) {
        let (width, height) = image.size;
        let bytes =
            image.pixels.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], u8::MAX]).collect();
        let Some(size) = IntSize::from_wh(width as u32, height as u32) else { return };
        let Some(pixels) = Pixmap::from_vec(bytes, size) else { return };
        let (across, down) = (at.width() / width as f64, at.height() / height as f64);
        let [sx, sy, x, y] = [across, down, at.left, at.top].map(|value| value as f32);
        let place = self.scale.pre_concat(Transform::from_row(sx, 0.0, 0.0, sy, x, y));
        let paint = PixmapPaint { quality: FilterQuality::Bilinear, ..PixmapPaint::default() };
        picture.draw_pixmap(0, 0, pixels.as_ref(), &paint, place, clip);
    }
}

fn colour([red, green, blue]: Colour, opacity: f64, smooth: bool) -> tiny_skia::Paint<'static> {
    let mut paint = tiny_skia::Paint { anti_alias: smooth, ..tiny_skia::Paint::default() };
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint
}

fn outline(path: &Path) -> Option<tiny_skia::Path> {
    let mut built = PathBuilder::new();
    for step in &path.0 {
        match *step {
            Step::Move((x, y)) => built.move_to(x as f32, y as f32),
            Step::Line((x, y)) => built.line_to(x as f32, y as f32),
            Step::Curve(a, b, to) => {
                let [a, b, to] = [a, b, to].map(|(x, y)| (x as f32, y as f32));
                built.cubic_to(a.0, a.1, b.0, b.1, to.0, to.1);
            }
            Step::Rect(Rect { left, top, right, bottom }) => {
                let [left, top, right, bottom] = [left, top, right, bottom].map(|v| v as f32);
                built.move_to(left, bottom);
                for (x, y) in [(right, bottom), (right, top), (left, top)] {
                    built.line_to(x, y);
                }
                built.close();
            }
            Step::Disc((x, y), radius) => built.push_circle(x as f32, y as f32, radius as f32),
            Step::Close => built.close(),
        }
    }
    built.finish()
}
