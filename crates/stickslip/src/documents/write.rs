//! JSON of documents, written by one thread or several: these turn the elements of long lists into text.

use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::Formatter;
use std::collections::HashMap;
use std::io::{self, BufWriter, Write};
use std::iter::repeat_n;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread;

/// Length of the buffer, in bytes.
const BUFFER: usize = 1 << 16;
/// Number of elements that a thread turns into text at a time.
const TOGETHER: usize = 4;
/// Largest number of texts of a thread that wait to be written.
const WAITING: usize = 4;

/// A JSON formatter that escapes all characters that could control a terminal, also those that JSON allows.
struct Harmless;

impl Formatter for Harmless {
    fn write_string_fragment<W: Write + ?Sized>(
        &mut self,
        writer: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        const DELETE: u8 = 0x7f;
        if fragment.bytes().all(|byte| byte < DELETE) {
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
    let mut out = BufWriter::with_capacity(BUFFER, out);
    document.serialize(&mut json(&mut out))?;
    out.flush()
}

/// Elements of a list, and the text of each.
pub struct List<'a> {
    count: usize,
    text_of: Box<TextOf<'a>>,
}

/// Appends the text of an element.
type TextOf<'a> = dyn Fn(usize, &mut Vec<u8>) -> io::Result<()> + Sync + 'a;

impl<'a> List<'a> {
    /// The list of these elements.
    pub fn of<T: Serialize + Sync>(elements: &'a [T]) -> Self {
        let text_of = |n: usize, text: &mut Vec<u8>| Ok(elements[n].serialize(&mut json(text))?);
        Self { count: elements.len(), text_of: Box::new(text_of) }
    }

    /// The text of the elements from n on that are turned into text together. It is expected to be no longer than the
    /// longest before.
    fn text(&self, n: usize, longest: &mut usize) -> io::Result<Vec<u8>> {
        let mut text = Vec::with_capacity(*longest);
        for n in n..self.count.min(n + TOGETHER) {
            if n > 0 {
                text.push(b',');
            }
            (self.text_of)(n, &mut text)?;
        }
        *longest = text.len().max(*longest);
        Ok(text)
    }
}

fn json<W: Write>(out: W) -> Serializer<W, Harmless> {
    Serializer::with_formatter(out, Harmless)
}

/// Writes the same bytes as [`write`], by this number of threads, of a document with `lists` under the name `name`. The
/// `frame` is this document with empty lists, and has no other empty list of that name.
///
/// # Errors
/// The output fails; the frame has fewer empty lists.
pub fn write_lists(
    out: &mut dyn Write,
    frame: &impl Serialize,
    (name, lists): (&str, &[List]),
    threads: usize,
) -> io::Result<()> {
    let mut text = vec![];
    frame.serialize(&mut json(&mut text))?;
    let text = String::from_utf8(text).map_err(io::Error::other)?;
    let (mut rest, empty) = (&*text, format!("\"{name}\":[]"));
    for list in lists {
        let parts = rest.split_once(&empty);
        let (before, after) = parts.ok_or_else(|| io::Error::other(format!("no {empty}")))?;
        write!(out, "{before}\"{name}\":[")?;
        write_elements(out, list, threads)?;
        out.write_all(b"]")?;
        rest = after;
    }
    out.write_all(rest.as_bytes())
}

/// The threads, of which this is one, take the next elements as soon as they can; this one writes all in their order.
fn write_elements(out: &mut dyn Write, list: &List, threads: usize) -> io::Result<()> {
    let groups = list.count.div_ceil(TOGETHER);
    let others = threads.clamp(1, groups.max(1)) - 1;
    let next = &AtomicUsize::new(0);
    let take = move || Some(next.fetch_add(1, Ordering::Relaxed)).filter(|n| *n < groups);
    thread::scope(|scope| {
        let (send, receive) = sync_channel(WAITING * others);
        for send in repeat_n(send, others) {
            scope.spawn(move || {
                let mut longest = 0;
                while let Some(n) = take() {
                    let text = list.text(n * TOGETHER, &mut longest);
                    // Nobody waits for more once the document cannot be written.
                    if send.send((n, text)).is_err() {
                        break;
                    }
                }
            });
        }
        let (mut texts, mut longest) = (HashMap::new(), 0);
        for n in 0..groups {
            while !texts.contains_key(&n) {
                let made = receive.try_recv().ok().or_else(|| {
                    let own = |n| (n, list.text(n * TOGETHER, &mut longest));
                    take().map(own).or_else(|| receive.recv().ok())
                });
                texts.extend([made.ok_or_else(|| io::Error::other("a thread has ended"))?]);
            }
            if let Some(text) = texts.remove(&n) {
                out.write_all(&text?)?;
            }
        }
        Ok(())
    })
}
