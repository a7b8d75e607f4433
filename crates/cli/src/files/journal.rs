//! A growing file with a checksum: to resume, it is truncated to the mark in a checkpoint. [`Rows`] are a journal of numbers:
//! a first line that describes them, then their bits in little-endian order.

use super::beside;
use super::replace::Permissions;
use crc32fast::Hasher;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};
use stickslip::Mark;

/// A growing file, locked.
#[derive(Debug)]
pub(crate) struct Journal {
    file: BufWriter<File>,
    bytes: u64,
    hasher: Hasher,
}

impl Journal {
    /// A new journal, which will begin with `magic`; an old one is replaced.
    pub(super) fn create(path: &Path, magic: &[u8], permissions: &Permissions) -> io::Result<Self> {
        let file = beside::create(path, magic, permissions)?;
        Ok(Self { file: BufWriter::new(file), bytes: 0, hasher: Hasher::new() })
    }

    /// The journal at `path`, truncated to the mark.
    pub(super) fn resume(path: &Path, magic: &[u8], mark: Mark) -> io::Result<Self> {
        let mut file = beside::ours(path, magic)?.ok_or(io::ErrorKind::NotFound)?;
        let hasher = verified(&file, mark)?;
        if beside::names(&file)? > 1 {
            // It is locked again under the name alone.
            file.unlock()?;
            return Self::copy(&file, path, magic, mark);
        }
        file.set_len(mark.bytes)?;
        file.seek(io::SeekFrom::End(0))?;
        Ok(Self { file: BufWriter::new(file), bytes: mark.bytes, hasher })
    }

    /// A new journal with the beginning of another file, up to the mark.
    pub(super) fn copy(from: &File, path: &Path, magic: &[u8], mark: Mark) -> io::Result<Self> {
        verified(from, mark)?;
        let permissions = Permissions(from.metadata().ok());
        // The other may be the one that is replaced.
        let from = from.try_clone()?;
        let mut journal = Self::create(path, magic, &permissions)?;
        (&from).rewind()?;
        io::copy(&mut from.take(mark.bytes), &mut journal)?;
        Ok(journal)
    }

    /// Writes everything to the disk.
    pub(crate) fn sync(&mut self) -> io::Result<Mark> {
        self.file.flush()?;
        self.file.get_ref().sync_data()?;
        Ok(Mark { bytes: self.bytes, crc32: self.hasher.clone().finalize() })
    }
}

/// Whether the beginning of a file agrees with the mark.
fn verified(mut file: &File, mark: Mark) -> io::Result<Hasher> {
    file.rewind()?;
    let mut hasher = Hasher::new();
    let mut beginning = BufReader::new(file).take(mark.bytes);
    let bytes = io::copy(&mut beginning, &mut Hashing(&mut hasher))?;
    if (Mark { bytes, crc32: hasher.clone().finalize() }) == mark {
        return Ok(hasher);
    }
    let message = "its beginning differs from that at the checkpoint";
    Err(io::Error::new(io::ErrorKind::InvalidData, message))
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

/// A writer that computes the checksum of its input and discards it.
pub(crate) struct Hashing<'a>(pub(crate) &'a mut Hasher);

impl Write for Hashing<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Beginning of a journal of rows.
const ROWS: &[u8] = b"stickslip/journal ";
/// Length of the first line in bytes, a multiple of the length of rows of 7 and of 16 numbers.
const HEAD: usize = 896;

/// A journal of rows.
#[derive(Debug)]
pub(crate) struct Rows(Journal);

impl Rows {
    /// A new journal with the permissions of the file that it belongs to; an old one is replaced.
    pub(crate) fn create(path: &Path, owner: &Path, numbers: usize) -> io::Result<Self> {
        let mut journal = Journal::create(path, ROWS, &Permissions::of(owner))?;
        journal.write_all(&head(numbers))?;
        Ok(Self(journal))
    }

    /// Resumes a journal of rows of this length, truncated to the mark, and returns their numbers.
    pub(crate) fn resume(path: &Path, mark: Mark, numbers: usize) -> io::Result<(Self, Vec<f64>)> {
        let journal = Journal::resume(path, ROWS, mark)?;
        let damaged = || io::Error::new(io::ErrorKind::InvalidData, "it does not hold such rows");
        let mut bytes = vec![];
        let file = File::open(path)?;
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
    let mut line = ROWS.to_vec();
    line.extend(
        format!("1: rows of {numbers} numbers of 8 bytes, least significant first;").bytes(),
    );
    line.extend(b" a checkpoint says how many count");
    line.resize(HEAD - 1, b' ');
    line.push(b'\n');
    line
}

pub(crate) fn journal_of(checkpoint: &Path) -> PathBuf {
    beside::with(checkpoint, ".journal")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const MAGIC: &[u8] = b"journal ";

    fn written(path: &Path) -> (Mark, Mark) {
        let mut journal = Journal::create(path, MAGIC, &Permissions::default()).unwrap();
        journal.write_all(b"journal of a run").unwrap();
        let mark = journal.sync().unwrap();
        journal.write_all(b" that went on").unwrap();
        (mark, journal.sync().unwrap())
    }

    #[test]
    fn a_journal_is_cut_back_to_its_mark_and_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("journal");
        let (mark, _) = written(&path);
        let mut journal = Journal::resume(&path, MAGIC, mark).unwrap();
        journal.write_all(b", resumed").unwrap();
        let longer = journal.sync().unwrap();
        drop(journal);
        assert_eq!(fs::read(&path).unwrap(), b"journal of a run, resumed");
        let other = Mark { crc32: mark.crc32 ^ 1, ..mark };
        assert!(Journal::resume(&path, MAGIC, other).is_err());
        assert!(Journal::resume(&path, MAGIC, Mark { bytes: 33, ..longer }).is_err());
        Journal::resume(&path, MAGIC, longer).unwrap();
    }

    #[test]
    fn its_beginning_may_come_from_another_file() {
        let folder = tempfile::tempdir().unwrap();
        let [whole, part] = ["whole", "part"].map(|name| folder.path().join(name));
        let (mark, _) = written(&whole);
        Journal::copy(&File::open(&whole).unwrap(), &part, MAGIC, mark).unwrap().sync().unwrap();
        assert_eq!(fs::read(&part).unwrap(), b"journal of a run");
        assert_eq!(fs::read(&whole).unwrap(), b"journal of a run that went on");
    }

    #[cfg(unix)]
    #[test]
    fn a_second_name_of_a_journal_keeps_what_it_has() {
        let folder = tempfile::tempdir().unwrap();
        let [path, backup] = ["journal", "backup"].map(|name| folder.path().join(name));
        let (mark, _) = written(&path);
        fs::hard_link(&path, &backup).unwrap();
        let mut journal = Journal::resume(&path, MAGIC, mark).unwrap();
        journal.write_all(b"!").unwrap();
        journal.sync().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"journal of a run!");
        assert_eq!(fs::read(&backup).unwrap(), b"journal of a run that went on");
    }

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
