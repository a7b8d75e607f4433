//! Conversion of a figure to the bytes of a file.

use crate::error::FigureError;
use crate::format::FigureFormat;
use crate::sheet::Sheet;
use crate::size::Size;
use stickslip::FigureDocument;

/// Draws a figure. Equal figures give equal bytes.
///
/// # Errors
///
/// The picture is too large.
pub fn draw(
    figure: &FigureDocument,
    format: FigureFormat,
    size: &Size,
) -> Result<Vec<u8>, FigureError> {
    match format {
        FigureFormat::Svg => Ok(svg(figure, size)?.into_bytes()),
        #[cfg(feature = "png")]
        FigureFormat::Png => {
            let sheet = Sheet::of(figure, size.units());
            crate::raster::raster(&sheet.drawing(false), sheet.size, size)
        }
        #[cfg(feature = "pdf")]
        FigureFormat::Pdf => {
            let sheet = Sheet::of(figure, size.units());
            Ok(crate::pdf::pdf(&sheet.drawing(false), sheet.size))
        }
    }
}

/// Draws a figure as an SVG document.
///
/// # Errors
///
/// The image of a map cannot be compressed.
pub fn svg(figure: &FigureDocument, size: &Size) -> Result<String, FigureError> {
    let sheet = Sheet::of(figure, size.units());
    // The other formats have a ground of their own.
    crate::svg::document(&sheet.drawing(true), sheet.size, &size.written(sheet.size.1))
}
