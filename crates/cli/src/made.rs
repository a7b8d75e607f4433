//! What a command has made, in hand: a document of any kind, with words for it.

use serde::Serialize;
use std::any::Any;
use stickslip::Tabular;
use stickslip_figures::Drawn;

/// What a command has made.
pub struct Made {
    /// The document.
    pub document: Box<dyn Document>,
    /// What was found, in a line.
    pub headline: String,
    /// The same, and what belongs to it, in aligned lines.
    pub text: String,
}

/// A document whose kind is known to those alone who ask for it.
pub trait Document: Send + Sync {
    /// For a serializer.
    fn serialized(&self) -> &dyn erased_serde::Serialize;
    /// For tables.
    fn table(&self) -> &dyn Tabular;
    /// For a picture, if there is one of its kind.
    fn drawn(&self) -> Option<&dyn Drawn>;
    /// Another of it.
    fn copy(&self) -> Box<dyn Document>;
    /// For those who know its kind.
    fn any(&self) -> &dyn Any;
    /// The same, to be taken apart.
    fn any_mut(&mut self) -> &mut dyn Any;
}

struct Held<D> {
    document: D,
    drawn: Option<fn(&D) -> &dyn Drawn>,
}

/// A document that has no picture.
pub(crate) fn plain<D>(document: D) -> Box<dyn Document>
where
    D: Serialize + Tabular + Clone + Send + Sync + 'static,
{
    Box::new(Held { document, drawn: None })
}

/// A document that has one.
pub(crate) fn pictured<D>(document: D) -> Box<dyn Document>
where
    D: Serialize + Tabular + Drawn + Clone + Send + Sync + 'static,
{
    Box::new(Held { document, drawn: Some(|document| document) })
}

impl<D: Serialize + Tabular + Clone + Send + Sync + 'static> Document for Held<D> {
    fn serialized(&self) -> &dyn erased_serde::Serialize {
        &self.document
    }

    fn table(&self) -> &dyn Tabular {
        &self.document
    }

    fn drawn(&self) -> Option<&dyn Drawn> {
        self.drawn.map(|drawn| drawn(&self.document))
    }

    fn copy(&self) -> Box<dyn Document> {
        Box::new(Self { document: self.document.clone(), drawn: self.drawn })
    }

    fn any(&self) -> &dyn Any {
        &self.document
    }

    fn any_mut(&mut self) -> &mut dyn Any {
        &mut self.document
    }
}
