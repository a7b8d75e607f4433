//! From text to a document.

use crate::FORMAT_VERSION;
use serde::de::{DeserializeOwned, Error as _, IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::error::Category;
use std::fmt::{self, Display};
use std::io::{self, BufReader, Cursor, Read};
use thiserror::Error;

/// What is wrong with a document, or with a part of it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Unusable(String);

impl Unusable {
    /// `reason` as the message.
    pub fn new(reason: impl Display) -> Self {
        Self(reason.to_string())
    }
}

/// What every document begins with.
#[derive(Debug, Clone, Deserialize)]
pub struct Kind {
    /// Such as "stickslip/run".
    pub format: Option<String>,
    /// Version of that format.
    pub format_version: Option<u32>,
}

impl Kind {
    /// Refuses all but the format wanted, in the version that this program reads.
    ///
    /// # Errors
    /// Names what was found instead.
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

/// The document of the format wanted, such as [`RunDocument::FORMAT`](crate::RunDocument::FORMAT), that a text holds.
///
/// # Errors
/// The text is no JSON, a document of another format or version, or damaged.
pub fn read<D: DeserializeOwned>(text: &str, wanted: &str) -> Result<D, Unusable> {
    read_from(text.as_bytes(), wanted)
}

/// The same from a stream, of which no more is read than it takes to tell that it is something else.
///
/// # Errors
/// As [`read`]; the stream fails.
pub fn read_from<D: DeserializeOwned>(source: impl Read, wanted: &str) -> Result<D, Unusable> {
    let (kind, whole) = told(source, wanted)?;
    kind.judge(wanted)?;
    serde_json::from_reader(whole).map_err(|error| match error.classify() {
        Category::Io => unreadable(&error),
        Category::Data => Unusable(format!("damaged: {error}")),
        Category::Syntax | Category::Eof => {
            Unusable(format!("damaged, or {}", no_document(&error, wanted)))
        }
    })
}

/// What a stream says it is, and the stream again from its beginning.
///
/// # Errors
/// As [`kind_of`].
pub fn told<R: Read>(source: R, wanted: &str) -> Result<(Kind, impl Read), Unusable> {
    let mut source = BufReader::with_capacity(BLOCK, source);
    let mut seen = vec![];
    let kind = kind_of(Seen { source: &mut source, seen: &mut seen }, wanted)?;
    Ok((kind, BufReader::with_capacity(BLOCK, Cursor::new(seen).chain(source))))
}

const BLOCK: usize = 1 << 16;
/// Within so many bytes a document must say what it is: half of what one number per point of the largest table takes.
const LARGEST_BEGINNING: u64 = 64 << 20;

fn unreadable(error: &serde_json::Error) -> Unusable {
    Unusable(format!("cannot be read: {error}"))
}

fn no_document(error: &serde_json::Error, wanted: &str) -> Unusable {
    let command = wanted.replace('/', " ");
    Unusable(format!(
        "not a whole JSON document ({error}); write it again with `{command} -o FILE.json`"
    ))
}

/// What a document, or its beginning, says it is, which it does first unless somebody has put its fields in another
/// order.
///
/// # Errors
/// It is no JSON, or ends before it has said so.
pub fn kind_of(source: impl Read, wanted: &str) -> Result<Kind, Unusable> {
    let mut kind = Kind { format: None, format_version: None };
    let source = BufReader::new(source.take(LARGEST_BEGINNING));
    let read = serde_json::Deserializer::from_reader(source).deserialize_map(Fields(&mut kind));
    match read {
        // Stopped because all is known.
        Err(_) if kind.format.is_some() && kind.format_version.is_some() => Ok(kind),
        Err(error) if error.is_io() => Err(unreadable(&error)),
        Err(error) => Err(no_document(&error, wanted)),
        Ok(()) => Ok(kind),
    }
}

/// Reads the fields of a document until it is known what it is.
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

/// A stream that remembers what was read of it.
struct Seen<'a, R> {
    source: &'a mut R,
    seen: &'a mut Vec<u8>,
}

impl<R: Read> Read for Seen<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        self.seen.extend(&buffer[..count]);
        Ok(count)
    }
}
