//! The pixels of a height map as a PNG within an SVG.

use super::error::PlotError;

/// More columns or rows than these do not show: they are averaged.
const MOST: (usize, usize) = (1700, 840);
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// A PNG file.
pub(super) struct Picture(Vec<u8>);

impl Picture {
    /// Of rows from below, coloured by `colour`.
    pub(super) fn of(
        rows: &[Vec<f64>],
        colour: impl Fn(f64) -> [u8; 3],
    ) -> Result<Self, PlotError> {
        let rows = averaged(rows);
        let (width, height) = (rows.first().map_or(0, Vec::len), rows.len());
        let pixels: Vec<u8> = rows.iter().rev().flatten().flat_map(|z| colour(*z)).collect();
        Ok(Self(png_file((width, height), png::ColorType::Rgb, &pixels)?))
    }

    /// As a data URL.
    pub(super) fn url(&self) -> String {
        let mut url = String::from("data:image/png;base64,");
        for group in self.0.chunks(3) {
            let bits = group.iter().fold(0_u32, |bits, byte| bits << 8 | u32::from(*byte));
            let bits = bits << (8 * (3 - group.len()));
            for i in 0..4 {
                let letter = LETTERS[(bits >> (18 - 6 * i)) as usize & 63];
                url.push(if i <= group.len() { char::from(letter) } else { '=' });
            }
        }
        url
    }
}

/// A PNG file of so many columns and rows. Compressed fast: a picture is up to twice as large, and takes half the time.
pub(super) fn png_file(
    (width, height): (usize, usize),
    colours: png::ColorType,
    pixels: &[u8],
) -> Result<Vec<u8>, PlotError> {
    let failed = |error: png::EncodingError| PlotError::Png(error.to_string());
    let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let mut bytes = vec![];
    let mut encoder = png::Encoder::new(&mut bytes, side(width), side(height));
    encoder.set_color(colours);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(pixels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Blocks of rows and columns averaged, so many that no more than [`MOST`] are left.
fn averaged(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let width = rows.first().map_or(0, Vec::len);
    let (by_x, by_y) = (width.div_ceil(MOST.0).max(1), rows.len().div_ceil(MOST.1).max(1));
    let block = |rows: &[Vec<f64>], from: usize| -> f64 {
        let to = (from + by_x).min(width);
        let cells = rows.iter().flat_map(|row| &row[from..to]);
        cells.sum::<f64>() / (rows.len() * (to - from)) as f64
    };
    let row = |rows: &[Vec<f64>]| (0..width).step_by(by_x).map(|from| block(rows, from)).collect();
    rows.chunks(by_y).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_url_is_base64_with_padding() {
        for (bytes, text) in [("slip", "c2xpcA=="), ("stick", "c3RpY2s="), ("AFM", "QUZN")] {
            let url = Picture(bytes.into()).url();
            assert_eq!(url.split_once(',').unwrap().1, text);
        }
    }

    #[test]
    fn large_maps_are_averaged_and_small_ones_are_not() {
        let ramp: Vec<f64> = (0..4000).map(f64::from).collect();
        let small = averaged(&[ramp[..10].to_vec()]);
        assert_eq!((small.len(), small[0].len()), (1, 10));
        let large = averaged(&[ramp.clone(), ramp]);
        assert_eq!((large.len(), large[0].len()), (2, 1334));
        assert!((large[0][0] - 1.0).abs() < 1e-12 && (large[1][1333] - 3999.0).abs() < 1e-12);
    }
}
