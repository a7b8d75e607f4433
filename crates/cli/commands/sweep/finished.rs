//! The points that are finished, kept in a file beside the output as they come: a line for the grid, then a
//! line a point, each with its checksum. A kill at any moment costs the points under way and at most the line
//! being written; damage costs the lines that it touches.

use crate::arithmetic::{arithmetic, foreign};
use crate::failure::Failure;
use crate::files::beside;
use crate::files::place::IN_USE;
use crate::message::remark;
use serde::Serialize;
use std::collections::HashSet;
use std::fs::File;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use stickslip_documents::{Software, SweepParameters, SweepPoint};

/// What has been finished so far, and where it is kept, if it is.
#[derive(Debug)]
pub(super) struct Finished {
    points: Vec<SweepPoint>,
    kept: Option<Kept>,
}

#[derive(Debug)]
struct Kept {
    path: PathBuf,
    file: File,
    /// Somebody has removed it, or its folder.
    is_gone: bool,
}

/// How the first line begins.
const MAGIC: &[u8] = b"{\"software\":{\"name\":\"stickslip\"";

/// The first line: points of another grid, or another version, are not ours to go on from.
#[derive(Debug, Serialize)]
struct Head<'a> {
    software: Software,
    /// Nor those of a machine that rounds otherwise.
    arithmetic: String,
    parameters: &'a SweepParameters,
}

/// The file in which the points of a sweep are kept that goes to `output`.
pub(super) fn partial_of(output: &Path) -> PathBuf {
    beside::with(output, ".partial")
}

impl Finished {
    /// Nothing yet, and nothing kept.
    pub(super) fn in_memory() -> Self {
        Self { points: vec![], kept: None }
    }

    /// What an interrupted sweep over the same grid left beside `output`, or nothing.
    pub(super) fn beside(output: &Path, parameters: &SweepParameters) -> Result<Self, Failure> {
        let path = partial_of(output);
        let opened = open(
            &path,
            output,
            &Head { software: Software::this(), arithmetic: arithmetic(), parameters },
        );
        let (file, points) = opened.map_err(|error| {
            let message = match error.kind() {
                ErrorKind::WouldBlock => IN_USE.into(),
                ErrorKind::AlreadyExists => error.to_string(),
                _ => {
                    let advice = "remove it, or choose another --output";
                    format!("{} {error}; {advice}", path.display())
                }
            };
            Failure::input(format!("--output {}", output.display()), message)
        })?;
        Ok(Self { points, kept: Some(Kept { path, file, is_gone: false }) })
    }

    pub(super) fn points(&self) -> &[SweepPoint] {
        &self.points
    }

    /// Adds a point, and keeps it before anything else is done.
    pub(super) fn add(&mut self, point: SweepPoint) -> io::Result<()> {
        if let Some(kept) = &mut self.kept {
            kept.file.write_all(&line_of(&point)?)?;
            kept.look_after();
        }
        self.points.push(point);
        Ok(())
    }

    /// Where the points are kept.
    pub(super) fn path(&self) -> Option<&Path> {
        self.kept.as_ref().filter(|kept| !kept.is_gone).map(|kept| kept.path.as_path())
    }

    /// The points by rising index.
    pub(super) fn in_order(&self) -> Vec<SweepPoint> {
        let mut points = self.points.clone();
        points.sort_by_key(|point| point.index);
        points
    }

    /// The file is not needed any more.
    pub(super) fn remove(self) {
        if let Some(kept) = self.kept.filter(|kept| !kept.is_gone) {
            std::fs::remove_file(kept.path).ok();
        }
    }
}

impl Kept {
    /// Says so, once, when the file has lost its name.
    fn look_after(&mut self) {
        if !self.is_gone && is_removed(&self.file) {
            self.is_gone = true;
            let path = self.path.display();
            let fate = "the points are in memory alone: an interrupt loses them; at the end they are written to \
                        --output or, where that cannot be, to a temporary file";
            remark(format_args!("stickslip: {path} was removed; {fate}"));
        }
    }
}

#[cfg(unix)]
fn is_removed(file: &File) -> bool {
    use std::os::unix::fs::MetadataExt;
    file.metadata().is_ok_and(|data| data.nlink() == 0)
}

#[cfg(not(unix))]
fn is_removed(_: &File) -> bool {
    false
}

/// A point with the CRC-32 of its text.
fn line_of(point: &SweepPoint) -> io::Result<Vec<u8>> {
    let point = serde_json::to_string(point)?;
    let sum = crc32fast::hash(point.as_bytes());
    Ok(format!("{{\"crc32\":{sum},\"point\":{point}}}\n").into_bytes())
}

/// What [`line_of`] wrote; `None` of anything else.
fn point_of(line: &[u8]) -> Option<SweepPoint> {
    let line = str::from_utf8(line).ok()?;
    let (sum, point) = line.strip_prefix("{\"crc32\":")?.split_once(",\"point\":")?;
    let point = point.strip_suffix("}\n")?;
    let is_whole = sum.parse() == Ok(crc32fast::hash(point.as_bytes()));
    is_whole.then(|| serde_json::from_str(point).ok())?
}

fn open(path: &Path, output: &Path, head: &Head) -> io::Result<(File, Vec<SweepPoint>)> {
    let mut first = serde_json::to_vec(head)?;
    first.push(b'\n');
    let mut text = vec![];
    if let Some(mut file) = beside::ours(path, MAGIC)? {
        file.read_to_end(&mut text)?;
        if text.starts_with(&first) && !beside::has_other_names(&file)? {
            let (length, points) = read(path, &text, first.len(), head.parameters);
            // What a kill left of the last line goes.
            file.set_len(length as u64)?;
            file.seek(SeekFrom::End(0))?;
            return Ok((file, points));
        }
        // A kill may have left a part of the first line.
        if !text.starts_with(&first) && !first.starts_with(&text) {
            return Err(io::Error::other(other(&text)));
        }
    }
    let mut file = beside::create_like(path, MAGIC, output)?;
    let is_taken_over = text.starts_with(&first);
    let (length, points) = match is_taken_over {
        true => read(path, &text, first.len(), head.parameters),
        false => (0, vec![]),
    };
    file.write_all(if is_taken_over { &text[..length] } else { &first })?;
    Ok((file, points))
}

/// Why points are not ours to go on from.
fn other(text: &[u8]) -> String {
    let first = text.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let made = serde_json::from_slice::<serde_json::Value>(first).ok();
    let made = made.as_ref().and_then(|head| head["arithmetic"].as_str());
    match made {
        Some(made) if made != arithmetic() => foreign(Some(made)),
        _ => "holds the points of another sweep".into(),
    }
}

/// The whole lines after the first: their length with that, and the points of this grid that they hold.
fn read(
    path: &Path,
    text: &[u8],
    first: usize,
    parameters: &SweepParameters,
) -> (usize, Vec<SweepPoint>) {
    let (mut length, mut damaged, mut points) = (first, 0, vec![]);
    let mut seen = HashSet::new();
    let lines = text[first..].split_inclusive(|byte| *byte == b'\n');
    for line in lines.filter(|line| line.ends_with(b"\n")) {
        length += line.len();
        match point_of(line) {
            Some(point) if parameters.has(point.index) && seen.insert(point.index) => {
                points.push(point);
            }
            _ => damaged += 1,
        }
    }
    if damaged > 0 {
        let path = path.display();
        remark(format_args!(
            "stickslip: {damaged} lines of {path} are damaged: their points are computed again"
        ));
    }
    (length, points)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(index: usize) -> SweepPoint {
        SweepPoint {
            critical_alpha: Some(1.069_036_174_947_265),
            period: Some(7.25),
            ..SweepPoint::at(index, None, 1.0, Some(1.2))
        }
    }

    /// Every bit of a line is covered.
    #[test]
    fn no_flipped_bit_of_a_line_passes() {
        let line = line_of(&point(3)).unwrap();
        assert_eq!(point_of(&line), Some(point(3)));
        for at in 0..line.len() {
            for bit in 0..8 {
                let mut flipped = line.clone();
                flipped[at] ^= 1 << bit;
                assert_eq!(point_of(&flipped), None, "byte {at}, bit {bit}");
            }
        }
    }
}
