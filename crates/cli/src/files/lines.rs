//! Reading of a run written as lines, without keeping them in memory.

use super::text::unreadable;
use crate::session::Session;
use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read, Seek};
use std::ops::RangeInclusive;
use std::path::Path;
use stickslip::{Kind, RunEnd, RunHead, SampleLine, kind_of};

/// Largest length of a line except the first.
const LONGEST_LINE: u64 = 1 << 20;
/// Largest length of the first line, which may contain a profile and a table of the force.
const LONGEST_HEAD: u64 = 1 << 29;
/// Number of bytes that identify the kind of a file.
const BEGINNING: u64 = 64;
/// Largest difference of the start of a run computed on another machine, relative and absolute.
const SLACK: f64 = 1e-9;

/// A run to be read.
pub(crate) enum Written {
    Document(Box<dyn Read>),
    /// Lines in a file that can be read twice.
    Lines(File),
}

/// Opens an output of `stickslip run` (`-`: standard input). Lines from a pipe are copied to a temporary file.
pub(crate) fn open(session: &Session, path: &Path) -> Result<Written, String> {
    opened(session, path).map_err(unreadable)
}

fn opened(session: &Session, path: &Path) -> io::Result<Written> {
    if let Some(bytes) = session.bytes(path) {
        return Ok(Written::Document(Box::new(Cursor::new(bytes))));
    }
    let mut source: Box<dyn Read> = match path {
        path if path == Path::new("-") => Box::new(io::stdin().lock()),
        path if path.metadata()?.is_file() => {
            let mut file = File::open(path)?;
            let is_lines = are_lines(path, &beginning(&mut file)?);
            file.rewind()?;
            return Ok(if is_lines {
                Written::Lines(file)
            } else {
                Written::Document(Box::new(file))
            });
        }
        path => Box::new(File::open(path)?),
    };
    let beginning = beginning(&mut source)?;
    let is_lines = are_lines(path, &beginning);
    let mut all = Cursor::new(beginning).chain(source);
    if !is_lines {
        return Ok(Written::Document(Box::new(all)));
    }
    let mut file = tempfile::tempfile()?;
    io::copy(&mut all, &mut file)?;
    file.rewind()?;
    Ok(Written::Lines(file))
}

fn beginning(source: &mut impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = vec![];
    source.take(BEGINNING).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Whether a file contains lines, by its name or by its beginning.
fn are_lines(path: &Path, beginning: &[u8]) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy().to_ascii_lowercase());
    let is_named =
        name.is_some_and(|name| name.ends_with(".jsonl") || name.ends_with(".jsonl.part"));
    let dense: Vec<u8> =
        beginning.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect();
    is_named || dense.starts_with(format!("{{\"format\":\"{}\"", RunHead::FORMAT).as_bytes())
}

/// The reason why lines cannot be used.
#[derive(Debug)]
pub(crate) enum Flaw {
    /// They end within the first line.
    NoHead,
    /// They end before the first sample after the start.
    NoSamples,
    /// They are not the output of a run, or cannot be read.
    Damaged(String),
}

/// The extent of a run after its first line.
#[derive(Debug)]
pub(crate) struct Extent {
    /// Number of samples; they begin on the second line.
    pub(crate) samples: u64,
    /// Time of the last sample.
    pub(crate) last: Option<f64>,
    /// The last line; `None` if the run is incomplete.
    pub(crate) end: Option<RunEnd>,
}

/// A reader of lines.
pub(crate) struct Lines<R> {
    reader: R,
    line: Vec<u8>,
    /// Number of lines read.
    number: u64,
}

impl<'a> Lines<BufReader<&'a File>> {
    /// A reader from the beginning of a file.
    pub(crate) fn of(mut file: &'a File) -> Result<Self, Flaw> {
        file.rewind().map_err(|error| Flaw::Damaged(unreadable(error)))?;
        Ok(Self::new(BufReader::new(file)))
    }
}

impl<R: BufRead> Lines<R> {
    pub(crate) fn new(reader: R) -> Self {
        Self { reader, line: vec![], number: 0 }
    }

    /// Reads the next line; false at the end.
    fn advance(&mut self, longest: u64) -> Result<bool, Flaw> {
        self.line.clear();
        let mut limited = (&mut self.reader).take(longest);
        limited.read_until(b'\n', &mut self.line).map_err(|e| Flaw::Damaged(unreadable(e)))?;
        self.number += 1;
        if self.line.len() as u64 == longest {
            return Err(self.damaged(format!("it is longer than {longest} bytes")));
        }
        Ok(!self.line.is_empty())
    }

    /// Reads the first line; a file of another kind is read only as far as necessary to recognise that.
    fn advance_to_head(&mut self) -> Result<(), Flaw> {
        (self.line, self.number) = (vec![], 1);
        loop {
            let before = self.line.len();
            let mut limited = (&mut self.reader).take(LONGEST_LINE);
            limited.read_until(b'\n', &mut self.line).map_err(|e| Flaw::Damaged(unreadable(e)))?;
            if self.line.len() == before || !self.is_broken_off() {
                return Ok(());
            }
            if before == 0 && self.line.len() as u64 == LONGEST_LINE {
                let kind = kind_of(&mut &*self.line, RunHead::FORMAT)
                    .and_then(|k| k.judge(RunHead::FORMAT));
                kind.map_err(|error| self.damaged(error))?;
            }
            if self.line.len() as u64 > LONGEST_HEAD {
                return Err(self.damaged(format!("it is longer than {LONGEST_HEAD} bytes")));
            }
        }
    }

    fn parse<D: DeserializeOwned>(&self) -> serde_json::Result<D> {
        stickslip::from_json(&self.line)
    }

    /// Whether the current line is incomplete.
    fn is_broken_off(&self) -> bool {
        self.line.last() != Some(&b'\n')
    }

    fn damaged(&self, message: impl std::fmt::Display) -> Flaw {
        Flaw::Damaged(format!("line {} is damaged: {message}", self.number))
    }

    /// The first line.
    pub(crate) fn head(&mut self) -> Result<RunHead, Flaw> {
        self.advance_to_head()?;
        let kind: Kind = match self.parse() {
            Err(_) if self.is_broken_off() => return Err(Flaw::NoHead),
            kind => kind.map_err(|error| self.damaged(within(&error)))?,
        };
        kind.judge(RunHead::FORMAT).map_err(|error| Flaw::Damaged(error.to_string()))?;
        self.parse().map_err(|error| self.damaged(within(&error)))
    }

    /// Checks that all other lines are those of a run over this span of time, and returns their extent.
    pub(crate) fn survey(mut self, span: &RangeInclusive<f64>) -> Result<Extent, Flaw> {
        let mut extent = Extent { samples: 0, last: None, end: None };
        while self.advance(LONGEST_LINE)? {
            if extent.end.is_some() {
                return Err(self.damaged("it comes after the end of the run"));
            }
            match SampleLine::on(&self.line) {
                Ok(sample) => {
                    self.judge_time(sample.t, &extent, span)?;
                    extent.samples += 1;
                    extent.last = Some(sample.t);
                }
                Err(error) => match self.parse::<RunEnd>() {
                    Ok(end) => {
                        self.judge_end(&end, &extent, span)?;
                        extent.end = Some(end);
                    }
                    Err(_) if self.is_broken_off() => break,
                    Err(_) => {
                        let message =
                            format!("neither a sample ({}) nor the end of a run", within(&error));
                        return Err(self.damaged(message));
                    }
                },
            }
        }
        Ok(extent)
    }

    /// Reads the next line, which must be a sample.
    pub(crate) fn sample(&mut self) -> Result<SampleLine, Flaw> {
        self.advance(LONGEST_LINE)?;
        SampleLine::on(&self.line).map_err(|_| Flaw::Damaged("it changed while it was read".into()))
    }

    fn judge_time(&self, t: f64, extent: &Extent, span: &RangeInclusive<f64>) -> Result<(), Flaw> {
        let (start, until) = (span.start(), span.end());
        let early = start - SLACK * start.abs().max(1.0);
        if !(early..=*until).contains(&t) {
            let message =
                format!("t = {t} is outside of the run, which lasts from {start} to {until}");
            return Err(self.damaged(message));
        }
        match extent.last.filter(|last| t < *last) {
            Some(last) => Err(self.damaged(format!("t = {t} comes after t = {last}"))),
            None => Ok(()),
        }
    }

    /// Checks that a run that was not interrupted ends at its end time, up to round-off.
    fn judge_end(
        &self,
        end: &RunEnd,
        extent: &Extent,
        span: &RangeInclusive<f64>,
    ) -> Result<(), Flaw> {
        let until = span.end();
        let slack = SLACK * until.abs().max(1.0);
        let early = if end.interrupted { *span.start() } else { until - slack };
        let reached = extent.last.is_none_or(|last| last <= end.end);
        if reached && (early..=until + slack).contains(&end.end) {
            return Ok(());
        }
        let message = format!(
            "it gives the end of the run as t = {}, which is not that of its samples",
            end.end
        );
        Err(self.damaged(message))
    }
}

/// The message of an error within a line, without the line number of the parser, which is always 1.
fn within(error: &serde_json::Error) -> String {
    error.to_string().replace(" at line 1 column ", " at column ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_known_by_their_name_or_their_beginning() {
        let begins = b"{ \"format\" : \"stickslip/run-lines\", ";
        for (name, beginning, expected) in [
            ("a.jsonl", &b""[..], true),
            ("a.JSONL.part", b"{", true),
            ("-", begins, true),
            ("a.json", begins, true),
            ("a.json", b"{\"format\":\"stickslip/run\",", false),
            ("-", b"", false),
        ] {
            assert_eq!(are_lines(Path::new(name), beginning), expected, "{name}");
        }
    }

    /// A line without end must not fill the memory.
    #[test]
    fn a_line_that_never_ends_is_refused() {
        let mut lines = Lines::new(BufReader::new(io::repeat(b' ')));
        match lines.advance(LONGEST_LINE) {
            Err(Flaw::Damaged(message)) => {
                assert!(message.contains("line 1 is damaged"), "{message}")
            }
            other => panic!("{other:?}"),
        }
    }
}
