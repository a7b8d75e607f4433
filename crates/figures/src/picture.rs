//! Images of height maps, and PNG files.

use crate::error::{FigureError, unpacked};
use crate::style::Colour;

/// Largest number of columns and rows; more are averaged.
const MOST: (usize, usize) = (1700, 840);

/// An image.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picture {
    /// Numbers of columns and rows.
    pub(crate) size: (usize, usize),
    /// Red, green and blue of each pixel, row by row from the top.
    pub(crate) pixels: Vec<u8>,
}

impl Picture {
    /// An image of rows in upward order, coloured by `colour`.
    pub(crate) fn of(rows: &[&[f64]], colour: impl Fn(f64) -> Colour) -> Self {
        let rows = averaged(rows);
        let size = (rows.first().map_or(0, Vec::len), rows.len());
        Self { size, pixels: rows.iter().rev().flatten().flat_map(|z| colour(*z)).collect() }
    }

    pub(crate) fn png(&self) -> Result<Vec<u8>, FigureError> {
        png_file(self.size, png::ColorType::Rgb, &self.pixels, None)
    }
}

/// A PNG file with these numbers of columns and rows, and its resolution in pixels per inch. Fast compression: the
/// file is up to twice as large, in half the time.
pub(crate) fn png_file(
    (width, height): (usize, usize),
    colours: png::ColorType,
    pixels: &[u8],
    dots_per_inch: Option<f64>,
) -> Result<Vec<u8>, FigureError> {
    let mut bytes = vec![];
    let mut encoder = png::Encoder::new(&mut bytes, side(width), side(height));
    encoder.set_color(colours);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    if let Some(dots) = dots_per_inch {
        // PNG counts by the metre.
        let per_metre = (dots / 0.0254).round().clamp(1.0, f64::from(u32::MAX)) as u32;
        let (xppu, yppu, unit) = (per_metre, per_metre, png::Unit::Meter);
        encoder.set_pixel_dims(Some(png::PixelDimensions { xppu, yppu, unit }));
    }
    let mut writer = encoder.write_header().map_err(unpacked)?;
    writer.write_image_data(pixels).map_err(unpacked)?;
    writer.finish().map_err(unpacked)?;
    Ok(bytes)
}

/// A length in pixels, as files have it.
pub(crate) fn side(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}

/// Averages over blocks of rows and columns, with at most [`MOST`] blocks.
fn averaged(rows: &[&[f64]]) -> Vec<Vec<f64>> {
    let width = rows.first().map_or(0, |row| row.len());
    let (by_x, by_y) = (width.div_ceil(MOST.0).max(1), rows.len().div_ceil(MOST.1).max(1));
    let block = |rows: &[&[f64]], from: usize| -> f64 {
        let to = (from + by_x).min(width);
        let cells = rows.iter().flat_map(|row| &row[from..to]);
        cells.sum::<f64>() / (rows.len() * (to - from)) as f64
    };
    let row = |rows: &[&[f64]]| (0..width).step_by(by_x).map(|from| block(rows, from)).collect();
    rows.chunks(by_y).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_maps_are_averaged_and_small_ones_are_not() {
        let ramp: Vec<f64> = (0..4000).map(f64::from).collect();
        let small = averaged(&[&ramp[..10]]);
        assert_eq!((small.len(), small[0].len()), (1, 10));
        let large = averaged(&[&ramp, &ramp]);
        assert_eq!((large.len(), large[0].len()), (2, 1334));
        assert!((large[0][0] - 1.0).abs() < 1e-12 && (large[1][1333] - 3999.0).abs() < 1e-12);
    }

    #[test]
    fn rows_of_a_map_ascend_and_those_of_its_picture_descend() {
        let picture = Picture::of(&[&[0.0, 1.0], &[2.0, 3.0]], |z| [z as u8; 3]);
        assert_eq!((picture.size, &picture.pixels[..4]), ((2, 2), &[2, 2, 2, 3][..]));
        assert!(picture.png().unwrap().starts_with(b"\x89PNG"));
    }
}
