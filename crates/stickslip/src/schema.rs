//! Source of the schemas of documents: with the feature `schema` the types, by schemars; without it files, which a test
//! compares with the types.

#[cfg(feature = "schema")]
pub use schemars::JsonSchema;
#[cfg(not(feature = "schema"))]
pub use stickslip_schemaless::JsonSchema;

/// Replaces the trait of schemars in builds that read schemas from files; every type implements it.
#[cfg(not(feature = "schema"))]
pub trait JsonSchema {}

#[cfg(not(feature = "schema"))]
impl<T: ?Sized> JsonSchema for T {}
