//! The envelope of a document: what was asked, who answered, the answer, and remarks on it.

use crate::documents::table::{Array, Named, Tabular};
use crate::parameter::strictly;
use crate::{FORMAT_VERSION, History, InUnits, Physical, Software};
use schemars::{JsonSchema, Schema, schema_for};
use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeOwned, DeserializeSeed, Error, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;
use std::fmt::{self, Debug};
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};

/// The parameters of a document: what was asked.
pub trait Question:
    Debug + Clone + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static
{
    /// Format of its documents: `stickslip/` and the name that `stickslip schema` knows it by.
    const FORMAT: &'static str;
    /// The result, whose fields stand in the document beside its envelope.
    type Answer: Debug + Clone + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static;

    /// The dense history in an answer, if it has one: it is large, and nothing of it is repeated in physical units.
    fn history(_: &mut Self::Answer) -> Option<&mut Option<History>> {
        None
    }

    /// Arrays that follow from question and answer together, such as a surface.
    fn more_arrays(&self, _: &Self::Answer) -> Vec<(&'static str, Array<'static>)> {
        vec![]
    }
}

/// A question and its answer, as they are saved. The fields of the answer stand beside those of the envelope.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[serde(bound = "")]
#[schemars(rename = "Document", deny_unknown_fields)]
pub struct Document<Q: Question> {
    /// "stickslip/" and the name of the question.
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// The question.
    pub parameters: Q,
    /// The answer.
    #[serde(flatten)]
    pub answer: Q::Answer,
    /// What a reader should know, such as values that are left out; empty if there is nothing.
    #[serde(default)]
    pub remarks: Vec<String>,
    /// Its numbers in nm, s and nN, where scales were given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

impl<Q: Question> Document<Q> {
    /// Its `format`.
    pub const FORMAT: &'static str = Q::FORMAT;

    /// Its JSON Schema, called by its format and described as its answer is.
    pub fn schema() -> Schema {
        let mut schema = schema_for!(Self);
        schema.insert("title".into(), Q::FORMAT.into());
        if let Some(description) = schema_for!(Q::Answer).remove("description") {
            schema.insert("description".into(), description);
        }
        schema
    }

    /// Question and answer as this program writes them.
    pub fn new(parameters: Q, answer: Q::Answer, remarks: Vec<String>) -> Self {
        let (format, software) = (Q::FORMAT.into(), Software::this());
        let format_version = FORMAT_VERSION;
        Self { format, format_version, software, parameters, answer, remarks, physical: None }
    }
}

/// A document is read as its answer.
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
        let value = serde_json::to_value(&*self);
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

    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let mut arrays = self.answer.arrays();
        arrays.extend(self.parameters.more_arrays(&self.answer));
        arrays
    }
}

/// A question that has no names but its parameters.
struct Strict<Q>(Q);

impl<'de, Q: Question> Deserialize<'de> for Strict<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        strictly(deserializer).map(Self)
    }
}

/// The fields of the envelope, as far as they have been read.
struct Envelope<Q> {
    format: Option<String>,
    format_version: Option<u32>,
    software: Option<Software>,
    parameters: Option<Strict<Q>>,
    remarks: Option<Vec<String>>,
    physical: Option<Option<InUnits>>,
}

impl<'de, Q: Question> Envelope<Q> {
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
