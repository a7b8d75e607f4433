//! The derive macro `JsonSchema` of stickslip without its feature `schema`.
//!
//! Schemas are files, which are made once from the types: a program that derived them again would take a tenth longer
//! to compile, and would make them at each start.

use proc_macro::TokenStream;

/// Derives nothing, and accepts the attributes that schemars reads.
#[proc_macro_derive(JsonSchema, attributes(schemars))]
pub fn json_schema(_: TokenStream) -> TokenStream {
    TokenStream::new()
}
