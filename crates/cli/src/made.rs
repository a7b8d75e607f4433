//! The result of a command in memory: a document of any kind, with a summary.

use std::any::Any;
use stickslip::Tabular;
use stickslip_figures::Drawn;
use stickslip_saved::Saved;

/// The result of a command.
pub struct Made {
    /// The document.
    pub document: Box<dyn Document>,
    /// The main result, in one line.
    pub headline: String,
    /// The summary as aligned lines.
    pub text: String,
}

/// A document whose type is not known at compile time.
pub trait Document: Send + Sync {
    /// The document for a serializer.
    fn serialized(&self) -> &dyn erased_serde::Serialize;
    /// The document as a table.
    fn table(&self) -> &dyn Tabular;
    /// The document as a picture, if its kind has one.
    fn drawn(&self) -> Option<&dyn Drawn>;
    /// A copy of the document.
    fn copy(&self) -> Box<dyn Document>;
    /// The document for a downcast.
    fn any(&self) -> &dyn Any;
    /// The document for a mutable downcast.
    fn any_mut(&mut self) -> &mut dyn Any;
}

struct Held<D> {
    document: D,
    drawn: Option<fn(&D) -> &dyn Drawn>,
}

/// Wraps a document without a picture.
pub(crate) fn plain<D>(document: D) -> Box<dyn Document>
where
    D: Saved + Tabular,
{
    Box::new(Held { document, drawn: None })
}

/// Wraps a document with a picture.
pub(crate) fn pictured<D>(document: D) -> Box<dyn Document>
where
    D: Saved + Tabular + Drawn,
{
    Box::new(Held { document, drawn: Some(|document| document) })
}

impl<D: Saved + Tabular> Document for Held<D> {
    fn serialized(&self) -> &dyn erased_serde::Serialize {
        self.document.serialized()
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
