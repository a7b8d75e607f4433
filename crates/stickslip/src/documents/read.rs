//! Reading of documents from text.

use crate::FORMAT_VERSION;
use serde::de::{DeserializeOwned, Error as _, IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt::{self, Display};
use std::io::{self, BufReader, Cursor, Read};
use thiserror::Error;

/// An error in a document or in a part of it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Unusable(String);

impl Unusable {
    /// An error with `reason` as its message.
    pub fn new(reason: impl Display) -> Self {
        Self(reason.to_string())
    }
}

/// The fields with which every document begins.
#[derive(Debug, Clone, Deserialize)]
pub struct Kind {
    /// Format, such as "stickslip/run".
    pub format: Option<String>,
    /// Version of that format.
    pub format_version: Option<u32>,
}

impl Kind {
    /// Rejects every format except the one wanted, in the version that this program reads.
    ///
    /// # Errors
    /// The document has another format or version; the message names it.
    pub fn judge(&self, wanted: &str) -> Result<(), Unusable> {
        match (self.format.as_deref(), self.format_version) {
            (Some(format), Some(FORMAT_VERSION)) if format == wanted => Ok(()),
            (Some(format), version) if format == wanted => {
                let found = version.map_or("none".into(), |v| v.to_string());
                Err(Unusable(format!(
                    "format_version is {found}, this program reads {FORMAT_VERSION}: run it again with this version"
                )))
            }
            (format, _) => {
                let found = format.unwrap_or("missing");
                Err(Unusable(format!("format is {found}, \"{wanted}\" is needed")))
            }
        }
    }
}

/// Reads a document of the format wanted, such as [`RunDocument::FORMAT`](crate::RunDocument::FORMAT), from a text.
///
/// # Errors
/// The text is not JSON, is a document of another format or version, or is damaged.
pub fn read<D: DeserializeOwned>(text: &str, wanted: &str) -> Result<D, Unusable> {
    read_from(text.as_bytes(), wanted)
}

/// Reads a document from a stream. Of a document of another format, only the beginning is read.
///
/// # Errors
/// As [`read`]; or the stream fails.
pub fn read_from<D: DeserializeOwned>(mut source: impl Read, wanted: &str) -> Result<D, Unusable> {
    read_through(&mut source, wanted)
}

/// Reads a document from a stream of any type: the long code that reads documents is compiled once for all types.
fn read_through<D: DeserializeOwned>(source: &mut dyn Read, wanted: &str) -> Result<D, Unusable> {
    let (kind, mut whole) = identified(Box::new(source), wanted)?;
    kind.judge(wanted)?;
    // From memory JSON is read in two thirds of the time that it takes byte by byte from a stream. Damage is found also in
    // a stream without end: that of the first megabyte within 16 times its distance from the beginning.
    let mut text = vec![];
    let mut most = BLOCK;
    loop {
        (&mut whole).take((most - text.len()) as u64).read_to_end(&mut text).map_err(unreadable)?;
        let found: serde_json::Result<D> = from_json(&text);
        if text.len() == most && found.as_ref().err().is_none_or(serde_json::Error::is_eof) {
            most *= if most < MEGABYTE { 16 } else { 256 };
            continue;
        }
        return found.map_err(|error| {
            if error.is_data() {
                Unusable(format!("damaged: {error}"))
            } else {
                Unusable(format!("damaged, or {}", no_document(&error, wanted)))
            }
        });
    }
}

/// A value from its JSON in UTF-8.
///
/// # Errors
/// The bytes are not UTF-8, not JSON, or JSON of another type.
pub fn from_json<T: DeserializeOwned>(bytes: &[u8]) -> serde_json::Result<T> {
    let no_text = |at: usize| serde_json::Error::custom(format!("byte {} is not UTF-8", at + 1));
    // From text, not bytes: the compiled serde_json contains that reader.
    match str::from_utf8(bytes) {
        Ok(text) => serde_json::from_str(text),
        Err(error) if error.error_len().is_some() => Err(no_text(error.valid_up_to())),
        // The last character is cut in two: what precedes it may be the beginning of a document.
        Err(error) => {
            let text = str::from_utf8(&bytes[..error.valid_up_to()]).unwrap_or_default();
            serde_json::from_str::<T>(text).and(Err(no_text(text.len())))
        }
    }
}

/// The kind of document in a stream, and the stream again from its beginning.
///
/// # Errors
/// As [`kind_of`].
pub fn identified<'a>(
    source: Box<dyn Read + 'a>,
    wanted: &str,
) -> Result<(Kind, BufReader<Box<dyn Read + 'a>>), Unusable> {
    let mut source = BufReader::with_capacity(BLOCK, source);
    let mut seen = vec![];
    let kind = kind_of(&mut Seen { source: &mut source, seen: &mut seen }, wanted)?;
    let whole: Box<dyn Read + 'a> = Box::new(Cursor::new(seen).chain(source));
    Ok((kind, BufReader::with_capacity(BLOCK, whole)))
}

const BLOCK: usize = 1 << 16;
const MEGABYTE: usize = 1 << 20;
/// Length of the beginning of a document, in bytes, within which its format must be found: half the size of one
/// column of the largest table.
const LARGEST_BEGINNING: u64 = 64 << 20;

fn unreadable(error: impl Display) -> Unusable {
    Unusable(format!("cannot be read: {error}"))
}

fn no_document(error: &serde_json::Error, wanted: &str) -> Unusable {
    let command = wanted.replace('/', " ");
    Unusable(format!(
        "not a complete JSON document ({error}); write it again with `{command} -o FILE.json`"
    ))
}

/// The kind of a document, from its beginning. The format is the first field unless the fields were reordered.
///
/// # Errors
/// The source is not JSON, or ends before the format.
pub fn kind_of(source: &mut dyn Read, wanted: &str) -> Result<Kind, Unusable> {
    let mut kind = Kind { format: None, format_version: None };
    let source = BufReader::new(source.take(LARGEST_BEGINNING));
    let read = serde_json::Deserializer::from_reader(source).deserialize_map(Fields(&mut kind));
    match read {
        // Stopped because all is known.
        Err(_) if kind.format.is_some() && kind.format_version.is_some() => Ok(kind),
        Err(error) if error.is_io() => Err(unreadable(error)),
        Err(error) => Err(no_document(&error, wanted)),
        Ok(()) => Ok(kind),
    }
}

/// Reads the fields of a document until its kind is known.
struct Fields<'a>(&'a mut Kind);

impl<'de> Visitor<'de> for Fields<'_> {
    type Value = ();

    fn expecting(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str("a document")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "format" => self.0.format = map.next_value()?,
                "format_version" => self.0.format_version = map.next_value()?,
                _ => drop(map.next_value::<IgnoredAny>()?),
            }
            if self.0.format.is_some() && self.0.format_version.is_some() {
                return Err(A::Error::custom("no more is needed"));
            }
        }
        Ok(())
    }
}

/// A stream that keeps a copy of the bytes read from it.
struct Seen<'a> {
    source: &'a mut dyn Read,
    seen: &'a mut Vec<u8>,
}

impl Read for Seen<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        self.seen.extend(&buffer[..count]);
        Ok(count)
    }
}
