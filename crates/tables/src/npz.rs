//! NumPy archives: a ZIP file without compression that has an array in each of its files, as `numpy.load` reads it.

use crc32fast::Hasher;
use std::borrow::Cow;
use std::io::{self, ErrorKind, Write};

/// The first second that a ZIP file can name, 1980-01-01: archives do not depend on when they are written.
const TIME_AND_DATE: [u8; 4] = [0, 0, 0x21, 0];
/// Version of ZIP that a reader needs.
const NEEDS: u16 = 20;

/// An array in row-major order, with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedArray<'a> {
    /// Name under which `numpy.load` finds it.
    pub name: Cow<'a, str>,
    /// Lengths of the axes.
    pub shape: Vec<usize>,
    /// Values; their number is the product of the lengths in `shape`.
    pub values: Cow<'a, [f64]>,
}

/// Writes the arrays one after the other, each under its name.
///
/// # Errors
///
/// The error of writing, or of an archive above 4 GiB.
pub fn write_npz<'a>(
    arrays: &mut dyn Iterator<Item = NamedArray<'a>>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (mut index, mut at, mut number) = (vec![], 0_u32, 0_u16);
    for array in arrays {
        let name = format!("{}.npy", array.name);
        let header = header(&array.shape);
        let length = within(header.len() as u64 + 8 * array.values.len() as u64)?;
        let is_utf8 = if name.is_ascii() { 0 } else { 8 };
        let mut entry = [&NEEDS.to_le_bytes()[..], &[0, is_utf8, 0, 0], &TIME_AND_DATE].concat();
        entry.extend(checksum(&header, &array.values).to_le_bytes());
        entry.extend([length, length].map(u32::to_le_bytes).as_flattened());
        entry.extend([name.len() as u16, 0].map(u16::to_le_bytes).as_flattened());

        out.write_all(b"PK\x03\x04")?;
        out.write_all(&entry)?;
        out.write_all(name.as_bytes())?;
        out.write_all(&header)?;
        pieces(&array.values).try_for_each(|piece| out.write_all(&piece))?;

        index.extend(b"PK\x01\x02");
        index.extend(NEEDS.to_le_bytes());
        index.extend(&entry);
        index.extend([0; 10]); // no comment, first disk, no attributes
        index.extend(at.to_le_bytes());
        index.extend(name.as_bytes());
        at =
            within(u64::from(at) + 4 + entry.len() as u64 + name.len() as u64 + u64::from(length))?;
        number += 1;
    }
    let size = within(index.len() as u64)?;
    out.write_all(&index)?;
    out.write_all(b"PK\x05\x06\0\0\0\0")?;
    out.write_all([number, number].map(u16::to_le_bytes).as_flattened())?;
    out.write_all([size, at].map(u32::to_le_bytes).as_flattened())?;
    out.write_all(&[0; 2])
}

/// The header of a .npy file of 64-bit numbers, by rows.
fn header(shape: &[usize]) -> Vec<u8> {
    let lengths: String = shape.iter().map(|length| format!("{length}, ")).collect();
    let mut text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({lengths}), }}");
    // Ten bytes stand before it; values begin at a multiple of 64.
    while (10 + text.len() + 1) % 64 != 0 {
        text.push(' ');
    }
    text.push('\n');
    [b"\x93NUMPY\x01\x00", &(text.len() as u16).to_le_bytes()[..], text.as_bytes()].concat()
}

fn checksum(header: &[u8], values: &[f64]) -> u32 {
    let mut hasher = Hasher::new();
    hasher.update(header);
    pieces(values).for_each(|piece| hasher.update(&piece));
    hasher.finalize()
}

/// The values as bytes, some at a time.
fn pieces(values: &[f64]) -> impl Iterator<Item = Vec<u8>> {
    let bytes = |piece: &[f64]| piece.iter().map(|value| value.to_le_bytes()).collect::<Vec<_>>();
    values.chunks(1 << 12).map(move |piece| bytes(piece).into_flattened())
}

/// A length or a place in the archive, as the 32-bit number that ZIP has for it.
fn within(length: u64) -> io::Result<u32> {
    let too_long =
        |_| io::Error::new(ErrorKind::FileTooLarge, "an .npz archive holds at most 4 GiB");
    u32::try_from(length).map_err(too_long)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::ArrayD;
    use ndarray_npy::NpzReader;
    use std::io::Cursor;

    /// Read back by a crate that shares no code with this.
    #[test]
    fn arrays_are_read_back_to_the_last_bit() {
        let array = |name: &'static str, shape: &[usize], values: Vec<f64>| NamedArray {
            name: name.into(),
            shape: shape.into(),
            values: values.into(),
        };
        let arrays = [
            array("t", &[3], vec![0.1, -0.0, f64::MIN_POSITIVE]),
            array("u", &[2, 3], (0..6).map(|i| f64::from(i) / 7.0).collect()),
            array("empty", &[0], vec![]),
            array("number", &[], vec![std::f64::consts::PI]),
            array("long", &[70_000], (0..70_000).map(f64::from).collect()),
        ];
        let mut bytes = vec![];
        write_npz(&mut arrays.clone().into_iter(), &mut bytes).unwrap();
        let mut read = NpzReader::new(Cursor::new(bytes)).unwrap();
        assert_eq!(read.names().unwrap(), ["t", "u", "empty", "number", "long"]);
        for wanted in &arrays {
            let name = &*wanted.name;
            let found: ArrayD<f64> = read.by_name(name).unwrap();
            assert_eq!(found.shape(), wanted.shape, "{name}");
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(found.as_slice().unwrap()), bits(&wanted.values), "{name}");
        }
    }

    #[test]
    fn what_zip_cannot_hold_is_refused() {
        assert_eq!(within(u64::from(u32::MAX)).unwrap(), u32::MAX);
        assert_eq!(within(1 << 32).unwrap_err().kind(), ErrorKind::FileTooLarge);
    }
}
