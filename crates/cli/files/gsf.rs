//! Gwyddion Simple Field: an image with its size and units, read by Gwyddion and other programs of
//! scanning probe microscopy. A text header, zeros up to a multiple of four bytes, and the pixels, row by
//! row, as little-endian single-precision numbers.
//! <http://gwyddion.net/documentation/user-guide-en/gsf.html>

use std::fmt::Write;

/// An evenly spaced image.
pub(crate) struct Field<'a> {
    /// Without `=`, at which some readers would split it.
    pub(crate) title: &'a str,
    /// x and y of the first pixel's center.
    pub(crate) first: [f64; 2],
    /// Distances of the pixels in x and y.
    pub(crate) spacing: [f64; 2],
    /// Unit of lengths and of heights; empty for pure numbers.
    pub(crate) unit: &'a str,
    /// Rows of equal length.
    pub(crate) rows: &'a [Vec<f64>],
    /// Heights are multiplied by this.
    pub(crate) factor: f64,
}

/// The bytes of the file.
pub(crate) fn gsf(field: &Field) -> Vec<u8> {
    let counts = [field.rows.first().map_or(0, Vec::len), field.rows.len()];
    let mut header = String::from("Gwyddion Simple Field 1.0\n");
    let mut line = |name: &str, value: &dyn std::fmt::Display| {
        // Writing to a String cannot fail.
        let _ = writeln!(header, "{name} = {value}");
    };
    line("XRes", &counts[0]);
    line("YRes", &counts[1]);
    for (axis, i) in [("X", 0), ("Y", 1)] {
        let spacing = field.spacing[i];
        line(&format!("{axis}Real"), &format!("{:e}", spacing * counts[i] as f64));
        // Of the image's edge, half a pixel before the first center.
        line(&format!("{axis}Offset"), &format!("{:e}", field.first[i] - 0.5 * spacing));
    }
    if !field.unit.is_empty() {
        line("XYUnits", &field.unit);
        line("ZUnits", &field.unit);
    }
    line("Title", &field.title);
    let mut bytes = header.into_bytes();
    // One to four of them.
    bytes.resize((bytes.len() / 4 + 1) * 4, 0);
    let pixels = field.rows.iter().flatten();
    bytes.extend(pixels.flat_map(|u| ((field.factor * u) as f32).to_le_bytes()));
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_is_padded_with_one_to_four_zeros_to_a_multiple_of_four() {
        for title in ["", "a", "ab", "abc"] {
            let rows = [vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]];
            let field = Field {
                title,
                first: [10.0, -1.0],
                spacing: [0.5, 2.0],
                unit: "m",
                rows: &rows,
                factor: 2.0,
            };
            let bytes = gsf(&field);
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
