//! Text files from users or from a host, with a size limit.

use crate::failure::Failure;
use crate::session::Session;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use stickslip_tables::{Image, Table, decoded, parse_gsf};

/// Largest size of a measured series: more than a million rows.
pub(crate) const LARGEST_TABLE: u64 = 64 << 20;

/// Largest image: 4,096 × 4,096 pixels with the header.
const LARGEST_IMAGE: u64 = (4 << 24) + (1 << 16);

/// The result of parsing the table in a file, or the columns that a host supplies.
pub(crate) fn read_table<T>(
    session: &Session,
    option: &str,
    path: &Path,
    parse: impl FnOnce(&Table) -> Result<T, String>,
) -> Result<T, Failure> {
    let table = match session.columns(path) {
        Some(columns) => Table::Columns(columns),
        None => Table::Text(read_text(session, option, path, LARGEST_TABLE)?),
    };
    parse(&table).map_err(|message| Failure::file(option, path, message))
}

/// The image in a .gsf file.
pub(crate) fn read_gsf(session: &Session, option: &str, path: &Path) -> Result<Image, Failure> {
    let bytes = read_bytes(session, option, path, LARGEST_IMAGE)?;
    parse_gsf(&bytes).map_err(|message| Failure::file(option, path, message))
}

/// The text of a file (`-`: standard input) in any usual encoding; an error if it is larger than `most` bytes.
pub(crate) fn read_text(
    session: &Session,
    option: &str,
    path: &Path,
    most: u64,
) -> Result<String, Failure> {
    let bytes = read_bytes(session, option, path, most)?;
    refuse_binary(path, &bytes)
        .and_then(|()| decoded(bytes))
        .map_err(|message| Failure::file(option, path, message))
}

/// The bytes of a file, with the same limit.
fn read_bytes(session: &Session, option: &str, path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    let bytes = if let Some(bytes) = session.bytes(path) {
        bytes_of(&*bytes, most)
    } else if path == Path::new("-") {
        bytes_of(io::stdin().lock(), most)
    } else {
        File::open(path).map_err(unreadable).and_then(|file| bytes_of(file, most))
    };
    bytes.map_err(|message| Failure::file(option, path, message))
}

fn bytes_of(reader: impl Read, most: u64) -> Result<Vec<u8>, String> {
    let mut bytes = vec![];
    match reader.take(most + 1).read_to_end(&mut bytes) {
        Err(error) => Err(unreadable(error)),
        Ok(_) if bytes.len() as u64 > most => {
            Err(format!("larger than {} MB, the most that is read", most >> 20))
        }
        Ok(_) => Ok(bytes),
    }
}

#[expect(clippy::needless_pass_by_value, reason = "what map_err hands over")]
pub(super) fn unreadable(error: io::Error) -> String {
    format!("cannot be read: {error}")
}

/// First bytes, and the format.
const FORMATS: [(&[u8], &str); 8] = [
    (b"GWYP", "Gwyddion"),
    (b"GWYO", "Gwyddion"),
    (b"Gwyddion Simple Field", "Gwyddion Simple Field"),
    (b"\\*File list", "Nanoscope"),
    (b"\\*Force file list", "Nanoscope"),
    (b":NANONIS_VERSION:", "Nanonis"),
    (b"II*\0", "JPK or another TIFF"),
    (b"MM\0*", "JPK or another TIFF"),
];

/// The reason why a file of an instrument cannot be read as a table, with the remedy.
fn refuse_binary(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let is_igor = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("ibw"))
        && bytes.get(..2).is_some_and(|version| matches!(version, [2 | 5, 0] | [0, 2 | 5]));
    let known = FORMATS.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, name)| *name);
    let Some(format) = known.or(is_igor.then_some("Igor")) else { return Ok(()) };
    Err(format!(
        "an image ({format}), not a table: `python -m stickslip convert {0} -o image.gsf` writes a channel for `tip` \
         and `fit --image`, with `--line N -o line.csv` one of its lines for `fit --ripple`; `python -m stickslip convert {0}` lists the channels \
         (pip install \"stickslip[instruments]\")",
        path.display()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file one byte too long is rejected, one of exactly the limit is read; the reader never requests more.
    #[test]
    fn no_more_is_read_than_the_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        std::fs::write(&path, "0,1\n2,3\n").unwrap();
        assert_eq!(read_text(&Session::default(), "--force-file", &path, 8).unwrap(), "0,1\n2,3\n");
        let refused = read_text(&Session::default(), "--force-file", &path, 7).unwrap_err();
        assert!(refused.to_string().contains("larger than"), "{refused}");
    }

    /// Reading such a device would not end.
    #[cfg(unix)]
    #[test]
    fn a_device_without_end_is_refused() {
        let endless =
            read_text(&Session::default(), "--force-file", Path::new("/dev/zero"), 1 << 20)
                .unwrap_err();
        assert!(endless.to_string().contains("larger than"), "{endless}");
    }

    #[test]
    fn images_are_known_by_their_first_bytes() {
        for (name, bytes) in [
            ("a.gwy", &b"GWYPGwyContainer\0"[..]),
            ("a.001", b"\\*File list\r\n"),
            ("a.ibw", &[5, 0, 1, 2]),
            ("a.jpk", b"II*\0\x08\0\0\0"),
        ] {
            let said = refuse_binary(Path::new(name), bytes).unwrap_err();
            assert!(said.contains(&format!("python -m stickslip convert {name} ")), "{said}");
        }
        for text in ["x,u\n0,1\n", "\u{5}\0", "II 1\n"] {
            assert_eq!(refuse_binary(Path::new("a.csv"), text.as_bytes()), Ok(()));
        }
    }
}
