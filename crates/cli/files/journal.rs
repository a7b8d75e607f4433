//! A file that only grows, and knows what it holds: whoever takes it up again cuts it back to where a
//! checkpoint says, and goes on.

use crc32fast::Hasher;
use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;
use stickslip_documents::Mark;

/// A growing file.
#[derive(Debug)]
pub(crate) struct Journal {
    file: BufWriter<File>,
    bytes: u64,
    hasher: Hasher,
}

impl Journal {
    /// A new one, in place of whatever has that name.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        Ok(Self { file: BufWriter::new(File::create(path)?), bytes: 0, hasher: Hasher::new() })
    }

    /// The one at `path`, cut back to the mark.
    ///
    /// # Errors
    /// It cannot be read and written, or does not begin with what the mark says.
    pub(crate) fn resume(path: &Path, mark: Mark) -> io::Result<Self> {
        let mut file = OpenOptions::new().read(true).write(true).open(path)?;
        let mut hasher = Hasher::new();
        let mut beginning = BufReader::new(&file).take(mark.bytes);
        let bytes = io::copy(&mut beginning, &mut Hashing(&mut hasher))?;
        if (Mark { bytes, crc32: hasher.clone().finalize() }) != mark {
            let message = "it does not begin with what was there at the checkpoint";
            return Err(io::Error::new(io::ErrorKind::InvalidData, message));
        }
        file.set_len(mark.bytes)?;
        file.seek(io::SeekFrom::End(0))?;
        Ok(Self { file: BufWriter::new(file), bytes, hasher })
    }

    /// Puts all that was written on the disk.
    pub(crate) fn sync(&mut self) -> io::Result<Mark> {
        self.file.flush()?;
        self.file.get_ref().sync_data()?;
        Ok(Mark { bytes: self.bytes, crc32: self.hasher.clone().finalize() })
    }
}

impl Write for Journal {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.hasher.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

struct Hashing<'a>(&'a mut Hasher);

impl Write for Hashing<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Rows of N numbers, their bits in little-endian order, from the beginning of a file.
pub(crate) fn rows<const N: usize>(path: &Path) -> io::Result<Vec<[f64; N]>> {
    let mut bytes = vec![];
    File::open(path)?.read_to_end(&mut bytes)?;
    let (words, _) = bytes.as_chunks::<8>();
    let (rows, _) = words.as_chunks::<N>();
    Ok(rows.iter().map(|row| row.map(f64::from_le_bytes)).collect())
}

/// One such row.
pub(crate) fn write_row<const N: usize>(out: &mut impl Write, row: [f64; N]) -> io::Result<()> {
    out.write_all(row.map(f64::to_le_bytes).as_flattened())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_journal_is_cut_back_to_its_mark_and_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("journal");
        let mut journal = Journal::create(&path).unwrap();
        write_row(&mut journal, [1.0, -0.0]).unwrap();
        let mark = journal.sync().unwrap();
        write_row(&mut journal, [2.0, 3.0]).unwrap();
        journal.sync().unwrap();
        let mut journal = Journal::resume(&path, mark).unwrap();
        write_row(&mut journal, [4.0, f64::INFINITY]).unwrap();
        let longer = journal.sync().unwrap();
        let bits = |row: &[f64; 2]| row.map(f64::to_bits);
        let found: Vec<_> = rows(&path).unwrap().iter().map(bits).collect();
        assert_eq!(found, [bits(&[1.0, -0.0]), bits(&[4.0, f64::INFINITY])]);
        let other = Mark { crc32: mark.crc32 ^ 1, ..mark };
        assert!(Journal::resume(&path, other).is_err());
        assert!(Journal::resume(&path, Mark { bytes: 33, ..longer }).is_err());
        Journal::resume(&path, longer).unwrap();
    }
}
