//! Questions: data that one function answers.
//!
//! A question is a struct whose fields are its parameters, such as [`Cycle`](crate::Cycle). [`Ask::ask`] answers it with a
//! [`Document`], which holds both, or refuses it by the name of a parameter. Faces (the command line, Python, a page) make
//! questions of what they are given and write documents; they compute nothing.
//!
//! ```
//! use stickslip::{Ask, Context, Cycle, Indentation, Tip};
//! use stickslip::tip::TipFunction;
//!
//! let tip = Tip(TipFunction::triple_gaussian(1.0, 1.0)?); // β = 1, width 1
//! let found = Cycle::new(tip, Indentation::above_critical(0.01), 1.0).ask(&Context::default())?;
//! assert!((found.period - 6.693688892159).abs() < 1e-8); // by harmonic balance with 30 digits
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod boundary;
pub(crate) mod context;
pub(crate) mod cycle;
pub(crate) mod failure;
pub(crate) mod model;
pub(crate) mod question;

use crate::documents::table::{Array, Named, Tabular};
use crate::{Context, FORMAT_VERSION, Failure, InUnits, Physical, Software};
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeOwned, DeserializeSeed, Error, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt::{self, Debug};
use std::marker::PhantomData;
use std::ops::Deref;

/// A question.
pub trait Ask:
    Debug + Clone + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static
{
    /// Name of the command, and what follows `stickslip/` in the format of its documents.
    const NAME: &'static str;
    /// Format of its documents, `stickslip/NAME`.
    const FORMAT: &'static str;
    /// The result, whose fields stand in the document beside its envelope.
    type Answer: Debug + Clone + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static;

    /// The question with everything that it leaves to be computed first, such as α of αc(r) + D: as a document holds it.
    ///
    /// # Errors
    /// A parameter is out of its range, or contradicts another.
    fn resolved(self, _context: &Context) -> Result<Self, Failure> {
        Ok(self)
    }

    /// The answer to a resolved question, and remarks on it.
    ///
    /// # Errors
    /// A parameter is out of its range; nothing was found; the work was cancelled.
    fn answer(&self, context: &Context) -> Result<(Self::Answer, Vec<String>), Failure>;

    /// Question and answer.
    ///
    /// # Errors
    /// As [`resolved`](Self::resolved) and [`answer`](Self::answer).
    fn ask(self, context: &Context) -> Result<Document<Self>, Failure> {
        context.within(|| self.resolved(context))?.answered(context)
    }

    /// A resolved question and its answer.
    ///
    /// # Errors
    /// As [`answer`](Self::answer).
    fn answered(self, context: &Context) -> Result<Document<Self>, Failure> {
        let (answer, remarks) = context.within(|| self.answer(context))?;
        Ok(Document::new(self, answer, remarks))
    }
}

/// A question and its answer, as they are saved. The fields of the answer stand beside those of the envelope.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[serde(bound = "")]
#[schemars(rename = "Document", deny_unknown_fields)]
pub struct Document<A: Ask> {
    /// "stickslip/" and the name of the question.
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// The question.
    pub parameters: A,
    /// The answer.
    #[serde(flatten)]
    pub answer: A::Answer,
    /// What a reader should know, such as values that are left out; empty if there is nothing.
    #[serde(default)]
    pub remarks: Vec<String>,
    /// Its numbers in nm, s and nN, where scales were given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

impl<A: Ask> Document<A> {
    /// Its `format`.
    pub const FORMAT: &'static str = A::FORMAT;

    /// Question and answer as this program writes them.
    pub fn new(parameters: A, answer: A::Answer, remarks: Vec<String>) -> Self {
        let (format, software) = (A::FORMAT.into(), Software::this());
        let format_version = FORMAT_VERSION;
        Self { format, format_version, software, parameters, answer, remarks, physical: None }
    }
}

/// A document is read as its answer.
impl<A: Ask> Deref for Document<A> {
    type Target = A::Answer;

    fn deref(&self) -> &A::Answer {
        &self.answer
    }
}

impl<A: Ask> Physical for Document<A> {
    fn physical_mut(&mut self) -> &mut Option<InUnits> {
        &mut self.physical
    }
}

impl<A: Ask<Answer: Tabular>> Tabular for Document<A> {
    fn columns(&self) -> Vec<Named<'_>> {
        self.answer.columns()
    }

    fn note(&self) -> Option<String> {
        self.answer.note()
    }

    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }

    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        self.answer.arrays()
    }
}

/// The fields of the envelope, as far as they have been read.
struct Envelope<A> {
    format: Option<String>,
    format_version: Option<u32>,
    software: Option<Software>,
    parameters: Option<A>,
    remarks: Option<Vec<String>>,
    physical: Option<Option<InUnits>>,
}

impl<'de, A: Ask> Envelope<A> {
    /// Reads the value of a key of the envelope; gives back any other key.
    fn take<M: MapAccess<'de>>(
        &mut self,
        key: String,
        map: &mut M,
    ) -> Result<Option<String>, M::Error> {
        match key.as_str() {
            "format" => once(&mut self.format, "format", map)?,
            "format_version" => once(&mut self.format_version, "format_version", map)?,
            "software" => once(&mut self.software, "software", map)?,
            "parameters" => once(&mut self.parameters, "parameters", map)?,
            "remarks" => once(&mut self.remarks, "remarks", map)?,
            "physical" => once(&mut self.physical, "physical", map)?,
            _ => return Ok(Some(key)),
        }
        Ok(None)
    }
}

fn once<'de, T: Deserialize<'de>, M: MapAccess<'de>>(
    place: &mut Option<T>,
    name: &'static str,
    map: &mut M,
) -> Result<(), M::Error> {
    if place.is_some() {
        return Err(M::Error::duplicate_field(name));
    }
    *place = Some(map.next_value()?);
    Ok(())
}

/// A map without the fields of the envelope, which are put aside: `#[serde(flatten)]` would copy all that a document holds
/// once more.
struct Rest<'a, M, A> {
    map: M,
    envelope: &'a mut Envelope<A>,
}

impl<'de, M: MapAccess<'de>, A: Ask> MapAccess<'de> for Rest<'_, M, A> {
    type Error = M::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, M::Error> {
        while let Some(key) = self.map.next_key::<String>()? {
            if let Some(key) = self.envelope.take(key, &mut self.map)? {
                return seed.deserialize(key.into_deserializer()).map(Some);
            }
        }
        Ok(None)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, M::Error> {
        self.map.next_value_seed(seed)
    }
}

struct Whole<A>(PhantomData<A>);

impl<'de, A: Ask> Visitor<'de> for Whole<A> {
    type Value = Document<A>;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "a document \"{}\"", A::FORMAT)
    }

    fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<Document<A>, M::Error> {
        let mut envelope = Envelope {
            format: None,
            format_version: None,
            software: None,
            parameters: None,
            remarks: None,
            physical: None,
        };
        let rest = Rest { map, envelope: &mut envelope };
        let answer = A::Answer::deserialize(MapAccessDeserializer::new(rest))?;
        let missing = M::Error::missing_field;
        Ok(Document {
            format: envelope.format.ok_or_else(|| missing("format"))?,
            format_version: envelope.format_version.ok_or_else(|| missing("format_version"))?,
            software: envelope.software.ok_or_else(|| missing("software"))?,
            parameters: envelope.parameters.ok_or_else(|| missing("parameters"))?,
            answer,
            remarks: envelope.remarks.unwrap_or_default(),
            physical: envelope.physical.flatten(),
        })
    }
}

impl<'de, A: Ask> Deserialize<'de> for Document<A> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Whole(PhantomData))
    }
}
