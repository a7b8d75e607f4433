//! From the SVG of a figure to the bytes of its file.

use super::error::PlotError;
use super::format::PlotFormat;

/// The bytes of a file that shows `svg`.
pub(crate) fn encode(svg: &str, format: PlotFormat) -> Result<Vec<u8>, PlotError> {
    match format {
        PlotFormat::Svg => Ok(svg.as_bytes().to_vec()),
        #[cfg(feature = "png")]
        PlotFormat::Png => super::raster::raster(svg),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"30\" height=\"20\"></svg>";

    #[test]
    fn svg_is_stored_as_it_is() {
        assert_eq!(encode(SVG, PlotFormat::Svg).unwrap(), SVG.as_bytes());
    }

    #[cfg(feature = "png")]
    #[test]
    fn png_has_its_signature_and_twice_the_size() {
        let bytes = encode(SVG, PlotFormat::Png).unwrap();
        assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
        assert_eq!(bytes[16..24], [0, 0, 0, 60, 0, 0, 0, 40]);
    }
}
