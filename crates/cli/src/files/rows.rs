//! Rows of numbers in a growing file beside a checkpoint: a first line that describes them, then their bits in
//! little-endian order.

use super::beside;
use super::journal::Journal;
use super::replace::Permissions;
use std::io::{self, Read, Write};
use std::path::Path;
use stickslip::Mark;

/// Beginning of a journal of rows.
const MAGIC: &[u8] = b"stickslip/journal ";
/// Length of the first line in bytes, a multiple of the length of rows of 7 and of 16 numbers.
const HEAD: usize = 896;

/// A journal of rows.
#[derive(Debug)]
pub(crate) struct Rows(Journal);

impl Rows {
    /// A new journal with the permissions of the file that it belongs to; an old one is replaced.
    pub(crate) fn create(path: &Path, owner: &Path, numbers: usize) -> io::Result<Self> {
        let mut journal = Journal::create(path, MAGIC, &Permissions::of(owner))?;
        journal.write_all(&head(numbers))?;
        Ok(Self(journal))
    }

    /// Resumes a journal of rows of this length, truncated to the mark, and returns their numbers.
    pub(crate) fn resume(path: &Path, mark: Mark, numbers: usize) -> io::Result<(Self, Vec<f64>)> {
        let journal = Journal::resume(path, MAGIC, mark)?;
        let damaged = || io::Error::new(io::ErrorKind::InvalidData, "it does not hold such rows");
        let mut bytes = vec![];
        let file = std::fs::File::open(path)?;
        file.take(mark.bytes).read_to_end(&mut bytes)?;
        let rows = bytes.strip_prefix(&*head(numbers)).ok_or_else(damaged)?;
        let (words, rest) = rows.as_chunks::<8>();
        if !(rest.is_empty() && words.len().is_multiple_of(numbers)) {
            return Err(damaged());
        }
        Ok((Self(journal), words.iter().map(|word| f64::from_le_bytes(*word)).collect()))
    }

    pub(crate) fn write(&mut self, row: &[f64]) -> io::Result<()> {
        let bytes: Vec<[u8; 8]> = row.iter().map(|number| number.to_le_bytes()).collect();
        self.0.write_all(bytes.as_flattened())
    }

    /// Writes all rows to the disk.
    pub(crate) fn sync(&mut self) -> io::Result<Mark> {
        self.0.sync()
    }
}

/// The first line.
fn head(numbers: usize) -> Vec<u8> {
    let mut line = MAGIC.to_vec();
    line.extend(
        format!("1: rows of {numbers} numbers of 8 bytes, least significant first;").bytes(),
    );
    line.extend(b" a checkpoint says how many count");
    line.resize(HEAD - 1, b' ');
    line.push(b'\n');
    line
}

pub(crate) fn journal_of(checkpoint: &Path) -> std::path::PathBuf {
    beside::with(checkpoint, ".journal")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("journal");
        let mut rows = Rows::create(&path, &path, 2).unwrap();
        rows.write(&[1.0, -0.0]).unwrap();
        let mark = rows.sync().unwrap();
        rows.write(&[2.0, f64::INFINITY]).unwrap();
        rows.sync().unwrap();
        drop(rows);
        assert!(Rows::resume(&path, mark, 4).is_err());
        let (_, found) = Rows::resume(&path, mark, 2).unwrap();
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&found), bits(&[1.0, -0.0]));
    }
}
