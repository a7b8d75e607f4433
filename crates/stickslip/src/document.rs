//! The envelope of a document: the question, the program that answered it, the answer, and warnings.

use crate::documents::table::{Array, Named, Tabular};
use crate::parameter::{Parameters, strictly};
use crate::schema::JsonSchema;
use crate::{FORMAT_VERSION, History, InUnits, Physical, Software};
use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeOwned, DeserializeSeed, Error, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;
use std::fmt::{self, Debug};
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};

/// The parameters of a document: the question.
pub trait Question:
    Debug + Clone + Serialize + Parameters + JsonSchema + Send + Sync + 'static
{
    /// Format of the documents of this question: `stickslip/` and the name by which `stickslip schema` knows it.
    const FORMAT: &'static str;
    /// Type of the answer. Its fields are written next to those of the envelope.
    type Answer: Debug + Clone + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static;

    /// The dense history of an answer, if it has one. It is large, and no part of it is converted to physical units.
    fn history(_: &mut Self::Answer) -> Option<&mut Option<History>> {
        None
    }

    /// Arrays that follow from question and answer together, such as a surface.
    fn more_arrays(&self, _: &Self::Answer) -> Vec<(&'static str, Array<'static>)> {
        vec![]
    }

    /// The unit of the numbers in a column or array of measured data, if it is known.
    fn unit_of<'a>(&'a self, _: &'a Self::Answer, _column: &str) -> Option<&'a str> {
        None
    }
}

/// A question and its answer, as saved in a file. The fields of the answer are written next to those of the envelope.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[serde(bound = "")]
#[schemars(rename = "Document", deny_unknown_fields)]
pub struct Document<Q: Question> {
    /// "stickslip/" and the name of the question.
    pub format: String,
    /// Version of the format; 1.
    pub format_version: u32,
    /// The program that wrote the document.
    pub software: Software,
    /// The question.
    pub parameters: Q,
    /// The answer.
    #[serde(flatten)]
    pub answer: Q::Answer,
    /// Warnings to the reader, such as values that could not be computed; may be empty.
    #[serde(default)]
    pub remarks: Vec<String>,
    /// The numbers of the answer in nm, s and nN, if scales were given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

impl<Q: Question> Document<Q> {
    /// The value of the field `format`.
    pub const FORMAT: &'static str = Q::FORMAT;

    /// The JSON Schema of the document, with the format as its title and the description of the answer.
    #[cfg(feature = "schema")]
    pub fn schema() -> schemars::Schema {
        let mut schema = schemars::schema_for!(Self);
        schema.insert("title".into(), Q::FORMAT.into());
        if let Some(description) = schemars::schema_for!(Q::Answer).remove("description") {
            schema.insert("description".into(), description);
        }
        schema
    }

    /// A document of this question and answer, with the version of this program.
    pub fn new(parameters: Q, answer: Q::Answer, remarks: Vec<String>) -> Self {
        let (format, software) = (Q::FORMAT.into(), Software::this());
        let format_version = FORMAT_VERSION;
        Self { format, format_version, software, parameters, answer, remarks, physical: None }
    }
}

/// Gives access to the fields of the answer.
impl<Q: Question> Deref for Document<Q> {
    type Target = Q::Answer;

    fn deref(&self) -> &Q::Answer {
        &self.answer
    }
}

impl<Q: Question> DerefMut for Document<Q> {
    fn deref_mut(&mut self) -> &mut Q::Answer {
        &mut self.answer
    }
}

impl<Q: Question> Physical for Document<Q> {
    fn physical_mut(&mut self) -> &mut Option<InUnits> {
        &mut self.physical
    }

    fn lean(&mut self) -> serde_json::Result<Value> {
        let history = Q::history(&mut self.answer).and_then(Option::take);
        let value = serde_json::to_value(&*self as &dyn erased_serde::Serialize);
        if let Some(place) = Q::history(&mut self.answer) {
            *place = history;
        }
        value
    }
}

impl<Q: Question<Answer: Tabular>> Tabular for Document<Q> {
    fn columns(&self) -> Vec<Named<'_>> {
        self.answer.columns()
    }

    fn note(&self) -> Option<String> {
        self.answer.note()
    }

    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }

    fn unit_of(&self, column: &str) -> Option<&str> {
        self.parameters.unit_of(&self.answer, column)
    }

    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let mut arrays = self.answer.arrays();
        arrays.extend(self.parameters.more_arrays(&self.answer));
        arrays
    }
}

/// A wrapper that reads a question and rejects unknown fields.
struct Strict<Q>(Q);

impl<'de, Q: Question> Deserialize<'de> for Strict<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        strictly(deserializer).map(Self)
    }
}

/// The fields of the envelope that have been read so far.
struct Envelope<Q> {
    format: Option<String>,
    format_version: Option<u32>,
    software: Option<Software>,
    parameters: Option<Strict<Q>>,
    remarks: Option<Vec<String>>,
    physical: Option<Option<InUnits>>,
}

impl<'de, Q: Question> Envelope<Q> {
    /// Reads the value of `key` if it is a key of the envelope, and returns any other key.
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

/// A map reader that stores the fields of the envelope and passes on the others. (`#[serde(flatten)]` would copy the
/// whole content of a document.)
struct Rest<'a, M, Q> {
    map: M,
    envelope: &'a mut Envelope<Q>,
}

impl<'de, M: MapAccess<'de>, Q: Question> MapAccess<'de> for Rest<'_, M, Q> {
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

struct Whole<Q>(PhantomData<Q>);

impl<'de, Q: Question> Visitor<'de> for Whole<Q> {
    type Value = Document<Q>;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "a document \"{}\"", Q::FORMAT)
    }

    fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<Document<Q>, M::Error> {
        let mut envelope = Envelope {
            format: None,
            format_version: None,
            software: None,
            parameters: None,
            remarks: None,
            physical: None,
        };
        let rest = Rest { map, envelope: &mut envelope };
        let answer = Q::Answer::deserialize(MapAccessDeserializer::new(rest))?;
        let missing = M::Error::missing_field;
        Ok(Document {
            format: envelope.format.ok_or_else(|| missing("format"))?,
            format_version: envelope.format_version.ok_or_else(|| missing("format_version"))?,
            software: envelope.software.ok_or_else(|| missing("software"))?,
            parameters: envelope.parameters.ok_or_else(|| missing("parameters"))?.0,
            answer,
            remarks: envelope.remarks.unwrap_or_default(),
            physical: envelope.physical.flatten(),
        })
    }
}

impl<'de, Q: Question> Deserialize<'de> for Document<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Whole(PhantomData))
    }
}
