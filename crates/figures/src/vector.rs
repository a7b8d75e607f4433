//! Parsing of an SVG, with its texts set in the built-in font, independent of the fonts of the system.

use crate::error::FigureError;
use resvg::usvg::{Options, Tree};

/// The document as shapes.
pub(crate) fn tree(svg: &str) -> Result<Tree, FigureError> {
    tree_with(svg, &options())
}

/// The built-in font: read once for many documents.
pub(crate) fn options() -> Options<'static> {
    let mut options = Options { font_family: "DejaVu Sans".into(), ..Options::default() };
    options.fontdb_mut().load_font_data(dejavu::sans::regular().to_vec());
    options
}

/// The document as shapes, with the font of `options`.
pub(crate) fn tree_with(svg: &str, options: &Options) -> Result<Tree, FigureError> {
    Tree::from_str(svg, options).map_err(|error| FigureError::Svg(error.to_string()))
}
