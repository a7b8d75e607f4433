//! Where the schemas of documents come from: with the feature `schema` from the types, by schemars; without it from
//! files, which a test compares with them.

#[cfg(feature = "schema")]
pub use schemars::JsonSchema;
#[cfg(not(feature = "schema"))]
pub use stickslip_schemaless::JsonSchema;

/// In place of the trait of schemars, in builds that read schemas from files: every type has it.
#[cfg(not(feature = "schema"))]
pub trait JsonSchema {}

#[cfg(not(feature = "schema"))]
impl<T: ?Sized> JsonSchema for T {}
