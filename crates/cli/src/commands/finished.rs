//! Finished parts of long work, appended to a file beside the output: a line for the request, then a line for each
//! part, each with its checksum. A kill at any time loses the unfinished parts and at most the line being written;
//! damage loses the affected lines.

use crate::arithmetic::{arithmetic, foreign};
use crate::failure::Failure;
use crate::files::beside;
use crate::files::place::taken;
use crate::interrupt::Interrupt;
use crate::session::Session;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::fs::File;
use std::io::{self, BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip::{KeptLine, Software, SweepPoint, SweepPoints};
use stickslip_tip::sorting::sort_by_number;

/// A part of long work.
pub(crate) trait Part: Clone {
    /// Name of a part in lower case.
    const NAME: &'static str = "point";
    /// Past participle of the work on a part.
    const DONE: &'static str = "computed";
    /// Name of the whole.
    const WHOLE: &'static str = "sweep";
    /// A list of parts.
    type All: Parts<Self>;

    /// Index of the part.
    fn index(&self) -> usize;

    /// The part as JSON on one line.
    fn text(&self) -> io::Result<String>;

    /// The part with this text; `None` if it is that of no part.
    fn of_text(text: &str) -> Option<Self>;
}

/// A list of parts, in the order in which they were finished until it is sorted.
pub(crate) trait Parts<P>: Default + Extend<P> + Send {
    fn count(&self) -> usize;
    fn indices(&self) -> impl Iterator<Item = usize>;
    fn each(&self) -> impl Iterator<Item = P>;
    /// Sorts the parts by their index.
    fn order(&mut self);
}

impl<P: Part + Send> Parts<P> for Vec<P> {
    fn count(&self) -> usize {
        self.len()
    }

    fn indices(&self) -> impl Iterator<Item = usize> {
        self.iter().map(P::index)
    }

    fn each(&self) -> impl Iterator<Item = P> {
        self.iter().cloned()
    }

    fn order(&mut self) {
        sort_by_number(self, |point| P::index(point) as f64);
    }
}

impl Parts<SweepPoint> for SweepPoints {
    fn count(&self) -> usize {
        self.len()
    }

    fn indices(&self) -> impl Iterator<Item = usize> {
        self.indices()
    }

    fn each(&self) -> impl Iterator<Item = SweepPoint> {
        self.iter()
    }

    fn order(&mut self) {
        self.sort();
    }
}

impl Part for SweepPoint {
    type All = SweepPoints;

    fn index(&self) -> usize {
        self.index
    }

    fn text(&self) -> io::Result<String> {
        Ok(quoted(&self.to_text()))
    }

    fn of_text(text: &str) -> Option<Self> {
        Self::from_text(unquoted(text)?)
    }
}

impl Part for KeptLine {
    const NAME: &'static str = "line";
    const DONE: &'static str = "scanned";
    const WHOLE: &'static str = "raster";
    type All = Vec<Self>;

    fn index(&self) -> usize {
        self.index
    }

    fn text(&self) -> io::Result<String> {
        Ok(quoted(&self.to_text()))
    }

    fn of_text(text: &str) -> Option<Self> {
        Self::from_text(unquoted(text)?)
    }
}

/// Base64 as a string of JSON: nothing in it needs an escape.
fn quoted(text: &str) -> String {
    ["\"", text, "\""].concat()
}

/// The text that was [`quoted`].
fn unquoted(string: &str) -> Option<&str> {
    string.strip_prefix('"')?.strip_suffix('"')
}

/// The parts finished so far, and the file in which they are saved, if any.
#[derive(Debug)]
pub(super) struct Finished<P: Part> {
    parts: P::All,
    kept: Option<Kept>,
}

#[derive(Debug)]
struct Kept {
    session: Session,
    path: PathBuf,
    file: File,
    /// Whether the file or its folder was removed.
    is_gone: bool,
}

/// Beginning of the first line.
const MAGIC: &[u8] = b"{\"software\":{\"name\":\"stickslip\"";

/// The first line. Parts of another request or another version cannot be resumed.
#[derive(Debug, Serialize)]
struct Head<'a, Q> {
    software: Software,
    /// Arithmetic of the machine; parts from other arithmetic cannot be resumed.
    arithmetic: &'static str,
    parameters: &'a Q,
}

impl<P: Part> Finished<P> {
    /// The parts that an interrupted command with the same parameters saved beside `output`, if any; `has` selects
    /// the indices of its parts. Beside a stream, `None`, there is no file.
    pub(super) fn beside(
        session: &Session,
        output: Option<&Path>,
        parameters: &impl Serialize,
        has: impl Fn(usize) -> bool,
    ) -> Result<Self, Failure> {
        let Some(output) = output else {
            return Ok(Self { parts: P::All::default(), kept: None });
        };
        let path = beside::with(output, ".partial");
        let head = Head { software: Software::this(), arithmetic: arithmetic(), parameters };
        let opened = open::<P>(session, &path, output, &head, has);
        let (file, parts) = opened.map_err(|error| {
            if matches!(error.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded) {
                return Failure::writing(&path, error);
            }
            taken("--output", output, &error).unwrap_or_else(|| {
                let advice = "remove it, or choose another --output";
                let message = format!("{} {error}; {advice}", path.display());
                Failure::file("--output", output, message)
            })
        })?;
        let kept = Some(Kept { session: session.clone(), path, file, is_gone: false });
        Ok(Self { parts, kept })
    }

    pub(super) fn parts(&self) -> &P::All {
        &self.parts
    }

    /// Adds a part, and saves it first.
    pub(super) fn add(&mut self, part: P) -> io::Result<()> {
        if self.kept.is_some() {
            self.keep(&line_of(&part)?)?;
        }
        self.parts.extend([part]);
        Ok(())
    }

    /// Saves the [`line_of`] a part in the file, without adding the part. Warns, once, if the file was removed or
    /// renamed.
    pub(super) fn keep(&mut self, line: &[u8]) -> io::Result<()> {
        let Some(Kept { session, path, file, is_gone }) = &mut self.kept else { return Ok(()) };
        file.write_all(line)?;
        if !*is_gone && beside::names(file).is_ok_and(|names| names == 0) {
            *is_gone = true;
            let (path, name) = (path.display(), P::NAME);
            let fate = "are in memory only: an interrupt loses them; at the end they are written to --output or, if \
            that fails, to a temporary file";
            session.remark(format_args!("stickslip: {path} was removed; the {name}s {fate}"));
        }
        Ok(())
    }

    /// Reports that the first `done` of `count` parts are in the file.
    pub(super) fn announce(&self, session: &Session, done: usize, count: usize) {
        if let (Some(path), true) = (self.path(), done > 0) {
            let path = path.display();
            session.remark(format_args!("stickslip: {done} of {count} {}s are in {path}", P::NAME));
        }
    }

    /// Lets a signal end the program at any time: finished parts are in the file, or are not kept at all.
    pub(super) fn need_not_end(
        &self,
        interrupt: &Interrupt,
        done: &Arc<AtomicUsize>,
        count: usize,
    ) {
        let (done, path) = (Arc::clone(done), self.path().map(Path::to_owned));
        interrupt.or_else(move |signal| {
            unfinished::<P>((done.load(Ordering::Relaxed), count), path.as_deref(), signal)
        });
    }

    /// The error of work that a signal ended.
    pub(super) fn unfinished(&self, done: usize, count: usize, signal: u8) -> Failure {
        unfinished::<P>((done, count), self.path(), signal)
    }

    /// The error of a part that could not be saved.
    pub(super) fn unkept(&self, error: io::Error) -> Failure {
        Failure::writing(self.path().unwrap_or(Path::new("memory")), error)
    }

    /// The file in which the parts are saved.
    pub(super) fn path(&self) -> Option<&Path> {
        self.kept.as_ref().filter(|kept| !kept.is_gone).map(|kept| kept.path.as_path())
    }

    /// The parts by rising index. They leave this list, but not the file.
    pub(super) fn take_in_order(&mut self) -> P::All {
        let mut parts = std::mem::take(&mut self.parts);
        parts.order();
        parts
    }

    /// Removes the file when it is no longer needed.
    pub(super) fn remove(self) {
        if let Some(kept) = self.kept.filter(|kept| !kept.is_gone) {
            std::fs::remove_file(kept.path).ok();
        }
    }
}

fn unfinished<P: Part>((done, count): (usize, usize), path: Option<&Path>, signal: u8) -> Failure {
    let parts = format!("{done} of {count} {}s", P::NAME);
    let message = match path.map(Path::display) {
        Some(path) => format!("{parts} are in {path}: the same command continues from there"),
        None => format!("{parts} were {} and none are kept: -o FILE.json would keep them", P::DONE),
    };
    Failure::Unfinished { signal, message }
}

/// A part as a line with the CRC-32 of its text.
pub(super) fn line_of<P: Part>(part: &P) -> io::Result<Vec<u8>> {
    let text = part.text()?;
    let sum = crc32fast::hash(text.as_bytes());
    let head = format!("{{\"crc32\":{sum},\"{}\":", P::NAME);
    Ok([&head, &*text, "}\n"].concat().into_bytes())
}

/// The part in a line written by [`line_of`]; `None` for any other line.
fn part_of<P: Part>(line: &[u8]) -> Option<P> {
    let line = str::from_utf8(line).ok()?;
    let separator = format!(",\"{}\":", P::NAME);
    let (sum, text) = line.strip_prefix("{\"crc32\":")?.split_once(&separator)?;
    let text = text.strip_suffix("}\n")?;
    let is_whole = sum.parse() == Ok(crc32fast::hash(text.as_bytes()));
    is_whole.then(|| P::of_text(text))?
}

fn open<P: Part>(
    session: &Session,
    path: &Path,
    output: &Path,
    head: &impl Serialize,
    has: impl Fn(usize) -> bool,
) -> io::Result<(File, P::All)> {
    let mut first = serde_json::to_vec(head)?;
    first.push(b'\n');
    let mut taken_over = None;
    if let Some(file) = beside::ours(path, MAGIC)? {
        let mut lines = BufReader::new(&file);
        let mut text = vec![];
        lines.read_until(b'\n', &mut text)?;
        // A kill may have left a part of the first line.
        if text != first && !first.starts_with(&text) {
            return Err(io::Error::other(other::<P>(&text)));
        }
        if text == first {
            let (length, parts) = read::<P>(session, path, lines, first.len(), has)?;
            if beside::names(&file)? <= 1 {
                // An incomplete last line is removed.
                file.set_len(length as u64)?;
                (&file).seek(SeekFrom::End(0))?;
                return Ok((file, parts));
            }
            taken_over = Some((file, length, parts));
        }
    }
    let mut file = beside::create_like(path, MAGIC, output)?;
    let Some((mut old, length, parts)) = taken_over else {
        file.write_all(&first)?;
        return Ok((file, P::All::default()));
    };
    old.rewind()?;
    io::copy(&mut old.take(length as u64), &mut file)?;
    Ok((file, parts))
}

/// Who made the parts, in the first line.
#[derive(Deserialize)]
struct Origin {
    software: Software,
    arithmetic: String,
}

/// The reason why parts cannot be resumed, from the first line.
fn other<P: Part>(first: &[u8]) -> String {
    match stickslip::from_json::<Origin>(first) {
        Ok(made) if made.arithmetic != arithmetic() => foreign(Some(&made.arithmetic)),
        Ok(made) if made.software != Software::this() => {
            format!("was made by {}, and only that version resumes it", made.software)
        }
        _ => format!("holds the {}s of another {}", P::NAME, P::WHOLE),
    }
}

/// The complete lines after the first: the length up to their end, and their parts.
fn read<P: Part>(
    session: &Session,
    path: &Path,
    mut lines: impl BufRead,
    first: usize,
    has: impl Fn(usize) -> bool,
) -> io::Result<(usize, P::All)> {
    let (mut length, mut damaged, mut parts) = (first, 0, P::All::default());
    let (mut seen, mut line) = (HashSet::new(), vec![]);
    while lines.read_until(b'\n', &mut line)? > 0 && line.ends_with(b"\n") {
        length += line.len();
        match part_of::<P>(&line) {
            Some(part) if has(part.index()) && seen.insert(part.index()) => parts.extend([part]),
            _ => damaged += 1,
        }
        line.clear();
    }
    if damaged > 0 {
        let path = path.display();
        session.remark(format_args!(
            "stickslip: {damaged} lines of {path} are damaged: their {}s are computed again",
            P::NAME
        ));
    }
    Ok((length, parts))
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

    /// The checksum detects a flipped bit anywhere in a line.
    #[test]
    fn no_flipped_bit_of_a_line_passes() {
        let line = line_of(&point(3)).unwrap();
        assert_eq!(part_of(&line), Some(point(3)));
        for at in 0..line.len() {
            for bit in 0..8 {
                let mut flipped = line.clone();
                flipped[at] ^= 1 << bit;
                assert_eq!(part_of::<SweepPoint>(&flipped), None, "byte {at}, bit {bit}");
            }
        }
    }

    #[test]
    fn parts_of_another_version_are_said_to_be_so() {
        let head = |software: Software| {
            let head = Head { software, arithmetic: arithmetic(), parameters: &1.5 };
            other::<SweepPoint>(&serde_json::to_vec(&head).unwrap())
        };
        assert_eq!(head(Software::this()), "holds the points of another sweep");
        let old = Software { version: "0.1.9".into(), ..Software::this() };
        assert!(head(old).starts_with("was made by stickslip 0.1.9"));
    }
}
