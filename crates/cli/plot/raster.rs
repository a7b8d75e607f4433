//! SVG to PNG, by resvg.

use super::error::PlotError;
use super::font;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

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
    picture.encode_png().map_err(|e| PlotError::Png(e.to_string()))
}
