//! Gwyddion Simple Field: an image with its size and units, read by Gwyddion and other programs of
//! scanning probe microscopy. A text header, zeros up to a multiple of four bytes, and the pixels, row by
//! row, as little-endian single-precision numbers.
//! <http://gwyddion.net/documentation/user-guide-en/gsf.html>

use crate::decode::{decoded, lines};
use std::fmt::Write;
use stickslip_units::Unit;

/// Title, size, place and unit of an evenly spaced image.
pub struct Frame<'a> {
    /// Title, without `=`, at which some readers would split it.
    pub title: &'a str,
    /// Numbers of columns and rows.
    pub counts: [usize; 2],
    /// x and y of the centre of the first pixel.
    pub first: [f64; 2],
    /// Distances of the pixels in x and y.
    pub spacing: [f64; 2],
    /// Unit of lengths and of heights; empty for pure numbers.
    pub unit: &'a str,
}

/// The bytes before the pixels.
#[must_use]
pub fn header(frame: &Frame) -> Vec<u8> {
    let mut header = String::from("Gwyddion Simple Field 1.0\n");
    let mut line = |name: &str, value: &dyn std::fmt::Display| {
        // Writing to a String cannot fail.
        let _ = writeln!(header, "{name} = {value}");
    };
    line("XRes", &frame.counts[0]);
    line("YRes", &frame.counts[1]);
    for (axis, i) in [("X", 0), ("Y", 1)] {
        let spacing = frame.spacing[i];
        line(&format!("{axis}Real"), &format!("{:e}", spacing * frame.counts[i] as f64));
        // Of the image's edge, half a pixel before the first center.
        line(&format!("{axis}Offset"), &format!("{:e}", frame.first[i] - 0.5 * spacing));
    }
    if !frame.unit.is_empty() {
        line("XYUnits", &frame.unit);
        line("ZUnits", &frame.unit);
    }
    line("Title", &frame.title);
    let mut bytes = header.into_bytes();
    // One to four of them.
    bytes.resize((bytes.len() / 4 + 1) * 4, 0);
    bytes
}

/// The bytes of these pixels, heights times a factor.
#[must_use]
pub fn pixels(heights: &[f64], factor: f64) -> Vec<u8> {
    let bytes = heights.iter().map(|u| ((factor * u) as f32).to_le_bytes());
    bytes.collect::<Vec<_>>().into_flattened()
}

/// The bytes of the file with these rows of equal length, heights times a factor.
#[must_use]
pub fn gsf(frame: &Frame, rows: &[Vec<f64>], factor: f64) -> Vec<u8> {
    let mut bytes = header(frame);
    rows.iter().for_each(|row| bytes.extend(pixels(row, factor)));
    bytes
}

/// An image that was read; positions are in nm if they have a unit of length.
#[derive(Debug)]
pub struct Image {
    /// Centres of the columns.
    pub x: Vec<f64>,
    /// Centres of the rows.
    pub y: Vec<f64>,
    /// Heights, a row for each y.
    pub rows: Vec<Vec<f64>>,
    /// Whether positions are in nm.
    pub in_nanometres: bool,
    /// Unit of the heights: nm for lengths, nN for forces.
    pub z_unit: Option<String>,
}

/// The image in the bytes of a file.
///
/// # Errors
///
/// The reason why they are no such image.
pub fn parse_gsf(bytes: &[u8]) -> Result<Image, String> {
    const MAGIC: &[u8] = b"Gwyddion Simple Field 1.0\n";
    let end = bytes.iter().position(|byte| *byte == 0).filter(|_| bytes.starts_with(MAGIC));
    let end =
        end.ok_or(
            "no Gwyddion Simple Field: its first line or the end of its header is missing; `python -m stickslip convert FILE -o \
             image.gsf` writes one from files of instruments",
        )?;
    let header = decoded(bytes[..end].to_vec())?;
    let field = |name: &str| {
        let fields = lines(&header).filter_map(|line| line.split_once('='));
        fields.filter(|(key, _)| key.trim() == name).map(|(_, value)| value.trim()).last()
    };
    let count = |name: &str| {
        let count = field(name).and_then(|text| text.parse::<usize>().ok());
        count.filter(|n| (1..=1 << 16).contains(n)).ok_or(format!("{name} is missing, or no count"))
    };
    let number = |name: &str, otherwise: f64| match field(name) {
        Some(text) => text.parse().map_err(|_| format!("{name} is no number: {text}")),
        None => Ok(otherwise),
    };
    let (columns, rows) = (count("XRes")?, count("YRes")?);
    let data = &bytes[((end / 4 + 1) * 4).min(bytes.len())..];
    if data.len() != 4 * columns * rows {
        return Err(format!("{} bytes of pixels for {columns} × {rows} of four", data.len()));
    }
    let nano = |one: f64| 1e9 * one;
    let scale = match field("XYUnits") {
        None | Some("") => None,
        Some(unit) => Some(Unit::Length.one(unit).map(nano).ok_or_else(|| {
            format!("XYUnits = {unit} is not a unit of length: it must be m, um or nm")
        })?),
    };
    let in_nanometres = scale.is_some();
    let scale = scale.unwrap_or(1.0);
    let z_unit = field("ZUnits").filter(|unit| !unit.is_empty());
    let z_in = |of: Unit, name| Some((nano(of.one(z_unit?)?), Some(name)));
    let (height, z_unit) =
        z_in(Unit::Length, "nm").or_else(|| z_in(Unit::Force, "nN")).unwrap_or((1.0, z_unit));
    let centres = |name: &str, count: usize| -> Result<Vec<f64>, String> {
        let spacing = number(&format!("{name}Real"), 1.0)? / count as f64;
        let offset = number(&format!("{name}Offset"), 0.0)?;
        Ok((0..count).map(|i| scale * (offset + spacing * (i as f64 + 0.5))).collect())
    };
    let (words, _) = data.as_chunks::<4>();
    let heights: Vec<f64> =
        words.iter().map(|word| height * f64::from(f32::from_le_bytes(*word))).collect();
    Ok(Image {
        x: centres("X", columns)?,
        y: centres("Y", rows)?,
        rows: heights.chunks(columns).map(<[f64]>::to_vec).collect(),
        in_nanometres,
        z_unit: z_unit.map(str::to_owned),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let rows = [vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.5]];
        let frame = Frame {
            title: "t",
            counts: [3, 2],
            first: [10e-9, -1e-9],
            spacing: [0.5e-9, 2e-9],
            unit: "m",
        };
        let bytes = gsf(&frame, &rows, 1e-9);
        let read = parse_gsf(&bytes).unwrap();
        let close = |found: &[f64], wanted: &[f64]| {
            found.len() == wanted.len()
                && found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6)
        };
        assert!(close(&read.x, &[10.0, 10.5, 11.0]) && close(&read.y, &[-1.0, 1.0]), "{read:?}");
        assert!(read.in_nanometres && close(&read.rows[1], &rows[1]), "{read:?}");
        for cut in [0, 20, 30, bytes.len() - 1] {
            assert!(parse_gsf(&bytes[..cut]).is_err(), "{cut}");
        }
    }

    #[test]
    fn the_header_is_padded_with_one_to_four_zeros_to_a_multiple_of_four() {
        for title in ["", "a", "ab", "abc"] {
            let rows = [vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]];
            let frame = Frame {
                title,
                counts: [3, 2],
                first: [10.0, -1.0],
                spacing: [0.5, 2.0],
                unit: "m",
            };
            let bytes = gsf(&frame, &rows, 2.0);
            let zeros = bytes.iter().position(|b| *b == 0).unwrap();
            let data = bytes.len() - 24;
            assert!(data.is_multiple_of(4) && (1..=4).contains(&(data - zeros)), "{title}");
            assert!(bytes[zeros..data].iter().all(|b| *b == 0));
            assert_eq!(bytes[data..data + 4], 2.0_f32.to_le_bytes());
            let header = String::from_utf8(bytes[..zeros].to_vec()).unwrap();
            for line in
                ["XRes = 3", "YReal = 4e0", "XOffset = 9.75e0", "YOffset = -2e0", "ZUnits = m"]
            {
                assert!(header.lines().any(|l| l == line), "{line}:\n{header}");
            }
        }
    }
}
