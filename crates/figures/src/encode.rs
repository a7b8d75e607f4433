//! Conversion of a figure to the bytes of a file.

use crate::drawing::{Drawing, Paint, Rect};
use crate::error::FigureError;
use crate::format::FigureFormat;
use crate::sheet::Sheet;
use crate::size::Size;
use crate::style::PAPER;
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
            let mut drawing = Drawing::default();
            sheet.draw(&mut drawing);
            crate::raster::raster(&drawing, sheet.size, size)
        }
        #[cfg(feature = "pdf")]
        FigureFormat::Pdf => {
            let sheet = Sheet::of(figure, size.units());
            let mut drawing = Drawing::default();
            sheet.draw(&mut drawing);
            Ok(crate::pdf::pdf(&drawing, sheet.size))
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
    let (right, bottom) = sheet.size;
    let mut drawing = Drawing::default();
    // The other formats have a ground of their own.
    drawing.rect(Rect { left: 0.0, top: 0.0, right, bottom }, Paint::fill(PAPER));
    sheet.draw(&mut drawing);
    crate::svg::document(&drawing, sheet.size, &size.written(bottom))
}
