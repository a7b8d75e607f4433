//! Checkpoints, written so that a kill at any time leaves the last complete one.

use super::motion::Motion;
use super::record::Record;
use crate::arithmetic::{arithmetic, foreign};
use crate::failure::Failure;
use crate::files::paths::{folder_of, seen_from};
use crate::files::place::Target;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use stickslip::{CheckpointHead, FORMAT_VERSION, Order, Software};
use stickslip_tip::state::State;

/// Default number of checkpoints of a run.
const DEFAULT_NUMBER: f64 = 100.0;
/// Beginning of every checkpoint.
const MAGIC: &[u8] = b"{\"format\":\"stickslip/";
/// Largest length of the first line, which may contain a profile and a table of the force.
const LONGEST_HEAD: u64 = 1 << 29;
/// Largest size of a checkpoint; realistic states are far smaller.
const LARGEST: u64 = 1 << 30;

/// Times and file of the checkpoints.
pub(super) struct Checkpoints {
    file: Target,
    order: Order,
    start: f64,
    every: f64,
    due: f64,
    /// Time of the last checkpoint.
    last: Option<f64>,
}

impl Checkpoints {
    pub(super) fn new(file: Target, order: &Order, start: f64, every: f64, t: f64) -> Self {
        // As it is seen from there: the folder may move, with all that is in it.
        let seen = |path: &PathBuf| seen_from(folder_of(file.path()), path);
        let (output, plot) = (seen(&order.output), order.plot.as_ref().map(seen));
        let order = Order { output, plot, ..order.clone() };
        let mut checkpoints = Self { file, order, start, every, due: t, last: None };
        checkpoints.plan(t);
        checkpoints
    }

    /// Plans the next checkpoint, at the next multiple of the interval.
    fn plan(&mut self, t: f64) {
        let passed = ((t - self.start) / self.every).floor();
        // Round-off of t may swallow an interval: never the same time again.
        self.due = (self.start + (passed + 1.0) * self.every).max(t.next_up());
    }

    pub(super) fn is_due(&self, t: f64) -> bool {
        t >= self.due
    }

    pub(super) fn write<R: Motion>(
        &mut self,
        running: &R,
        record: &mut Record<R::Step>,
        seconds: f64,
    ) -> Result<(), Failure> {
        let done = record.sync().and_then(|written| {
            let state = running.save();
            let head = CheckpointHead {
                format: CheckpointHead::FORMAT.into(),
                format_version: FORMAT_VERSION,
                software: Software::this(),
                arithmetic: Some(arithmetic().into()),
                order: self.order.clone(),
                t: running.t(),
                samples: record.taken,
                written,
                seconds,
                words: state.words().len() as u64,
            };
            let bytes = bytes(&head, &state).map_err(Failure::run)?;
            let replaced = self.file.replace(&|out| out.write_all(&bytes));
            replaced.map_err(|error| Failure::writing(self.file.path(), error))
        });
        self.plan(running.t());
        match (&done, self.last) {
            (Err(failure), Some(t)) => Err(Failure::Run(format!(
                "{failure}; the last checkpoint, at t = {t}, is complete: resume from it once that is corrected"
            ))),
            _ => {
                self.last = Some(running.t());
                done
            }
        }
    }
}

fn bytes(head: &CheckpointHead, state: &State) -> serde_json::Result<Vec<u8>> {
    let mut bytes = serde_json::to_vec(head)?;
    bytes.push(b'\n');
    bytes.reserve(8 * state.words().len() + 4);
    for word in state.words() {
        bytes.extend_from_slice(&word.to_le_bytes());
    }
    let sum = crc32fast::hash(&bytes);
    bytes.extend(sum.to_le_bytes());
    Ok(bytes)
}

/// A checkpoint read from a file.
pub(super) fn read(path: &Path) -> Result<(CheckpointHead, State), Failure> {
    let refused = |message: String| Failure::file("--resume", path, message);
    let unreadable = |error: io::Error| refused(format!("cannot be read: {error}"));
    let mut file = BufReader::new(File::open(path).map_err(unreadable)?);
    let mut bytes = vec![];
    // Only as many bytes as identify the kind of file.
    (&mut file).take(MAGIC.len() as u64).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes != MAGIC {
        return Err(refused(
            "is not a checkpoint, or is damaged: it has the wrong beginning".into(),
        ));
    }
    (&mut file).take(LONGEST_HEAD).read_until(b'\n', &mut bytes).map_err(unreadable)?;
    let head: CheckpointHead =
        stickslip::from_json(&bytes).map_err(|error| refused(format!("is damaged: {error}")))?;
    let rest = head.words.saturating_mul(8).saturating_add(4).min(LARGEST);
    file.take(rest + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    let (head, state) = parse(&bytes).map_err(refused)?;
    match head.arithmetic.as_deref() {
        Some(made) if made == arithmetic() => Ok((head, state)),
        made => Err(refused(foreign(made))),
    }
}

/// The checkpoint in bytes written by [`write`](Checkpoints::write).
pub(crate) fn parse(bytes: &[u8]) -> Result<(CheckpointHead, State), String> {
    let no_checkpoint = || "is no checkpoint, or not all of one".to_string();
    let (body, sum) = bytes.split_last_chunk::<4>().ok_or_else(no_checkpoint)?;
    if crc32fast::hash(body) != u32::from_le_bytes(*sum) {
        return Err("is damaged, or not a checkpoint: its checksum does not match".into());
    }
    let line = body.iter().position(|byte| *byte == b'\n').ok_or_else(no_checkpoint)?;
    let head: CheckpointHead =
        stickslip::from_json(&body[..line]).map_err(|error| format!("is damaged: {error}"))?;
    if !head.is_of_this_build() {
        return Err(format!(
            "was made by {}, {} {}: only that version reproduces every bit; resume it with that version",
            head.software, head.format, head.format_version
        ));
    }
    let (words, rest) = body[line + 1..].as_chunks::<8>();
    if words.len() as u64 != head.words || !rest.is_empty() {
        return Err("is damaged: its length does not match".into());
    }
    let every = head.order.checkpoint_every;
    if !head.order.samples.are_usable() || !every.is_some_and(|every| every > 0.0) {
        return Err("is damaged: an interval is not above 0".into());
    }
    let words = words.iter().map(|word| u64::from_le_bytes(*word)).collect();
    Ok((head, State::from_words(words)))
}

/// The interval requested, or the default.
pub(super) fn interval(asked: Option<f64>, (start, end): (f64, f64)) -> Result<f64, Failure> {
    match asked {
        None => Ok((end - start) / DEFAULT_NUMBER),
        Some(every) if every.is_finite() && every > 0.0 => Ok(every),
        Some(every) => {
            Err(Failure::number("--checkpoint-every", every, "must be a finite time above 0"))
        }
    }
}
