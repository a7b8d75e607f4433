//! Parsing of an SVG, with its texts set in the built-in font, independent of the fonts of the system.

use crate::error::FigureError;
use resvg::usvg::{Options, Tree};

/// The document as shapes.
pub(crate) fn tree(svg: &str) -> Result<Tree, FigureError> {
    let mut options = Options { font_family: "DejaVu Sans".into(), ..Options::default() };
    options.fontdb_mut().load_font_data(dejavu::sans::regular().to_vec());
    Tree::from_str(svg, &options).map_err(|error| FigureError::Svg(error.to_string()))
}
