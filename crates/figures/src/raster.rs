//! SVG to PNG, by resvg.

use crate::error::FigureError;
use crate::picture::png_file;
use crate::size::Size;
use crate::vector::tree;
use resvg::tiny_skia::{Color, FilterQuality, Pixmap, PixmapPaint, Transform};
use resvg::usvg::{Group, Image, ImageKind, Node};

/// Largest number of pixels: compression of more takes above 240 MB. A page of A4 has 22 million at 480 per inch.
const MOST: f64 = 3.2e7;

/// Draws `svg`, which has no background, on white.
pub(crate) fn raster(svg: &str, size: &Size) -> Result<Vec<u8>, FigureError> {
    let tree = tree(svg)?;
    let (density, dots_per_inch) = size.pixels();
    let side = |length: f32| (f64::from(length) * density).round().max(1.0);
    let (width, height) = (side(tree.size().width()), side(tree.size().height()));
    let too_many = || FigureError::Pixels(width as u64, height as u64);
    if width * height > MOST {
        return Err(too_many());
    }
    let mut picture = Pixmap::new(width as u32, height as u32).ok_or_else(too_many)?;
    picture.fill(Color::WHITE);
    let scale = Transform::from_scale(density as f32, density as f32);
    draw_images(tree.root(), scale, &mut picture);
    resvg::render(&tree, scale, &mut picture.as_mut());
    let size = (picture.width() as usize, picture.height() as usize);
    png_file(size, png::ColorType::Rgb, &without_alpha(picture), Some(dots_per_inch))
}

/// Red, green and blue of an opaque picture, in the same storage.
pub(crate) fn without_alpha(picture: Pixmap) -> Vec<u8> {
    let pixels = picture.width() as usize * picture.height() as usize;
    let mut kept = picture.take();
    // Of a slice, by index: there may be millions, and the tests have this as it stands, unoptimised.
    let bytes = &mut kept[..];
    for i in 0..pixels {
        bytes[3 * i] = bytes[4 * i];
        bytes[3 * i + 1] = bytes[4 * i + 1];
        bytes[3 * i + 2] = bytes[4 * i + 2];
    }
    kept.truncate(3 * pixels);
    kept
}

/// Draws the images within the SVG, which are below everything else. resvg would need decoders of four formats; only
/// PNG occurs here.
pub(crate) fn draw_images(group: &Group, scale: Transform, picture: &mut Pixmap) {
    for node in group.children() {
        match node {
            Node::Group(group) => draw_images(group, scale, picture),
            Node::Image(image) => draw_image(image, scale, picture),
            _ => {}
        }
    }
}

fn draw_image(image: &Image, scale: Transform, picture: &mut Pixmap) {
    let ImageKind::PNG(bytes) = image.kind() else { return };
    let Ok(pixels) = Pixmap::decode_png(bytes) else { return };
    let paint = PixmapPaint { quality: FilterQuality::Bilinear, ..PixmapPaint::default() };
    let place = scale.pre_concat(image.abs_transform());
    picture.draw_pixmap(0, 0, pixels.as_ref(), &paint, place, None);
}
