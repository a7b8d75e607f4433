//! Conversion of a figure to the bytes of a file.

use crate::error::FigureError;
use crate::format::FigureFormat;
use crate::sheet::sheet;
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
        FigureFormat::Png => crate::raster::raster(&sheet(figure, size, false)?, size),
        #[cfg(feature = "pdf")]
        FigureFormat::Pdf => crate::pdf::pdf(&sheet(figure, size, false)?),
    }
}

/// Draws a figure as an SVG document.
///
/// # Errors
///
/// The image of a map cannot be compressed.
pub fn svg(figure: &FigureDocument, size: &Size) -> Result<String, FigureError> {
    sheet(figure, size, true)
}
