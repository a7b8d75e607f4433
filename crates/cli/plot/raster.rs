//! SVG to PNG, by resvg.

use super::error::PlotError;
use super::font;
use super::picture::png_file;
use resvg::tiny_skia::{FilterQuality, Pixmap, PixmapPaint, Transform};
use resvg::usvg::{Group, Image, ImageKind, Node, Options, Tree};

/// Pixels for each unit of the SVG.
const SCALE: f32 = 2.0;

/// Draws `svg` with the font that we carry, whatever fonts the system has.
pub(super) fn raster(svg: &str) -> Result<Vec<u8>, PlotError> {
    let mut options = Options::default();
    options.fontdb_mut().load_font_data(font::dejavu_sans());
    let tree = Tree::from_str(svg, &options)?;
    let size = tree.size().to_int_size();
    let (width, height) = (SCALE as u32 * size.width(), SCALE as u32 * size.height());
    let mut picture = Pixmap::new(width, height).ok_or(PlotError::Size(width, height))?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut picture.as_mut());
    draw_images(tree.root(), &mut picture);
    let size = (picture.width() as usize, picture.height() as usize);
    png_file(size, png::ColorType::Rgba, &picture.take_demultiplied())
}

/// Draws the pictures within the SVG. resvg would do it with decoders of four formats; ours is PNG, and
/// lies upon all else.
fn draw_images(group: &Group, picture: &mut Pixmap) {
    for node in group.children() {
        match node {
            Node::Group(group) => draw_images(group, picture),
            Node::Image(image) => draw_image(image, picture),
            _ => {}
        }
    }
}

fn draw_image(image: &Image, picture: &mut Pixmap) {
    let ImageKind::PNG(bytes) = image.kind() else { return };
    let Ok(pixels) = Pixmap::decode_png(bytes) else { return };
    let paint = PixmapPaint { quality: FilterQuality::Bilinear, ..PixmapPaint::default() };
    let place = Transform::from_scale(SCALE, SCALE).pre_concat(image.abs_transform());
    picture.draw_pixmap(0, 0, pixels.as_ref(), &paint, place, None);
}
