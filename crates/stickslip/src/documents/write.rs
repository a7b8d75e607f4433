//! JSON of documents, written by one thread or several. One thread goes through the document but leaves each number as
//! its bits; all threads turn numbers into text, piece by piece.

use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::Formatter;
use std::collections::VecDeque;
use std::io::{self, BufWriter, Write};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

/// Marks the bits of a number; this byte does not occur in UTF-8.
const NUMBER: u8 = 0xff;
/// Length at which a piece is full, in bytes.
const PIECE: usize = 1 << 16;
/// Largest number of pieces that wait for their text.
const WAITING: usize = 8;
/// Largest useful number of threads: the one that goes through the document takes a third of the time.
const MOST_THREADS: usize = 4;

/// A JSON formatter that escapes all characters that could control a terminal, also those that JSON allows.
struct Harmless;

impl Formatter for Harmless {
    fn write_string_fragment<W: Write + ?Sized>(
        &mut self,
        writer: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        if fragment.is_ascii() && !fragment.contains('\u{7f}') {
            return writer.write_all(fragment.as_bytes());
        }
        for c in fragment.chars() {
            if is_harmful(c) {
                // None of them is beyond the first plane.
                write!(writer, "\\u{:04x}", u32::from(c))?;
            } else {
                write!(writer, "{c}")?;
            }
        }
        Ok(())
    }
}

/// Whether a character is a control, a mark of direction or of separation, or has no width.
pub fn is_harmful(c: char) -> bool {
    let is_invisible = matches!(c,
        '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}');
    c.is_control() || is_invisible
}

/// Writes a document as JSON, in which characters that could control a terminal are escaped.
///
/// # Errors
/// The output fails.
pub fn write(out: &mut dyn Write, document: &impl Serialize) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(PIECE, out);
    document.serialize(&mut Serializer::with_formatter(&mut out, Harmless))?;
    out.flush()
}

/// Writes the same bytes as [`write`], by this number of threads.
///
/// # Errors
/// The output fails.
pub fn write_on_threads(
    out: &mut dyn Write,
    document: &impl Serialize,
    threads: usize,
) -> io::Result<()> {
    let helpers = threads.min(MOST_THREADS).saturating_sub(1);
    if helpers == 0 {
        return write(out, document);
    }
    let (send, receive) = mpsc::channel();
    let tasks = &Mutex::new(receive);
    thread::scope(|scope| {
        for _ in 0..helpers {
            scope.spawn(|| {
                let next = || lock(tasks).recv();
                while let Ok(task) = next() {
                    work_on(task);
                }
            });
        }
        let (piece, waiting) = (vec![], VecDeque::new());
        let mut pieces = Pieces { out, piece, send, tasks, waiting };
        document.serialize(&mut Serializer::with_formatter(&mut pieces, Bits))?;
        pieces.pass_on()?;
        pieces.write_until(0)
    })
}

/// A piece, and the channel that takes its text.
type Task = (Vec<u8>, Sender<Vec<u8>>);

/// Turns the numbers of a piece into text.
fn work_on((piece, text): Task) {
    // Nobody waits for it once the document cannot be written.
    text.send(text_of(&piece)).ok();
}

fn lock(tasks: &Mutex<Receiver<Task>>) -> MutexGuard<'_, Receiver<Task>> {
    tasks.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Writes the texts of pieces in their order.
struct Pieces<'a> {
    out: &'a mut dyn Write,
    piece: Vec<u8>,
    send: Sender<Task>,
    tasks: &'a Mutex<Receiver<Task>>,
    waiting: VecDeque<Receiver<Vec<u8>>>,
}

impl Pieces<'_> {
    /// Passes the piece to the threads, and begins a new one.
    fn pass_on(&mut self) -> io::Result<()> {
        let (send, receive) = mpsc::channel();
        let piece = std::mem::replace(&mut self.piece, Vec::with_capacity(PIECE + 64));
        self.send.send((piece, send)).map_err(io::Error::other)?;
        self.waiting.push_back(receive);
        self.write_until(WAITING)
    }

    /// Writes the texts that are ready, and then those of all but this number of pieces; this thread works on them too.
    fn write_until(&mut self, most: usize) -> io::Result<()> {
        while let Some(first) = self.waiting.front() {
            let text = match first.try_recv() {
                Ok(text) => text,
                Err(_) if self.waiting.len() <= most => break,
                Err(_) => {
                    match self.tasks.try_lock().ok().and_then(|tasks| tasks.try_recv().ok()) {
                        Some(task) => {
                            work_on(task);
                            continue;
                        }
                        None => first.recv().map_err(io::Error::other)?,
                    }
                }
            };
            self.out.write_all(&text)?;
            self.waiting.pop_front();
        }
        Ok(())
    }
}

impl Write for Pieces<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.write_all(bytes)?;
        Ok(bytes.len())
    }

    /// A piece may end before any write: a mark and the bits of its number are written together.
    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        if self.piece.len() >= PIECE {
            self.pass_on()?;
        }
        self.piece.extend_from_slice(bytes);
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A formatter that leaves numbers as their bits.
struct Bits;

impl Formatter for Bits {
    fn write_f64<W: Write + ?Sized>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        let mut bytes = [NUMBER; 9];
        bytes[1..].copy_from_slice(&value.to_le_bytes());
        writer.write_all(&bytes)
    }

    fn write_string_fragment<W: Write + ?Sized>(
        &mut self,
        writer: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        Harmless.write_string_fragment(writer, fragment)
    }
}

fn text_of(piece: &[u8]) -> Vec<u8> {
    let (mut text, mut rest) = (Vec::with_capacity(5 * piece.len() / 2), piece);
    while let Some(at) = rest.iter().position(|byte| *byte == NUMBER) {
        text.extend_from_slice(&rest[..at]);
        let Some((bits, after)) = rest[at + 1..].split_first_chunk() else { break };
        Harmless.write_f64(&mut text, f64::from_le_bytes(*bits)).ok();
        rest = after;
    }
    text.extend_from_slice(rest);
    text
}
