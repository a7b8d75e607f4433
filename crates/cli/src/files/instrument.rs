//! Binary files of instruments, recognised by their first bytes: the Python package reads them.

use std::path::Path;

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
pub(super) fn judge(path: &Path, bytes: &[u8]) -> Result<(), String> {
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

    #[test]
    fn images_are_known_by_their_first_bytes() {
        for (name, bytes) in [
            ("a.gwy", &b"GWYPGwyContainer\0"[..]),
            ("a.001", b"\\*File list\r\n"),
            ("a.ibw", &[5, 0, 1, 2]),
            ("a.jpk", b"II*\0\x08\0\0\0"),
        ] {
            let said = judge(Path::new(name), bytes).unwrap_err();
            assert!(said.contains(&format!("python -m stickslip convert {name} ")), "{said}");
        }
        for text in ["x,u\n0,1\n", "\u{5}\0", "II 1\n"] {
            assert_eq!(judge(Path::new("a.csv"), text.as_bytes()), Ok(()));
        }
    }
}
