//! Single fields of a document, so that a regime is read without serialising a million points.

use serde::ser::{Error as _, Impossible, Serialize, SerializeMap, SerializeStruct, Serializer};
use serde_json::{Error, Value, to_value};

/// The names of the fields.
///
/// # Errors
/// The document is not a struct.
pub(crate) fn names(document: &(impl Serialize + ?Sized)) -> Result<Vec<String>, Error> {
    let found = document.serialize(Fields { wanted: None, names: vec![], key: None, found: None });
    Ok(found?.names)
}

/// The field of this name, if there is one.
///
/// # Errors
/// The document is not a struct, or the field cannot be serialised.
pub(crate) fn field(
    document: &(impl Serialize + ?Sized),
    wanted: &str,
) -> Result<Option<Value>, Error> {
    let wanted = Some(wanted);
    Ok(document.serialize(Fields { wanted, names: vec![], key: None, found: None })?.found)
}

/// A serialiser that collects the names of fields and one value.
struct Fields<'a> {
    wanted: Option<&'a str>,
    names: Vec<String>,
    key: Option<String>,
    found: Option<Value>,
}

impl Fields<'_> {
    fn see(&mut self, name: String, value: &(impl Serialize + ?Sized)) -> Result<(), Error> {
        if self.wanted == Some(&*name) {
            self.found = Some(to_value(value)?);
        }
        self.names.push(name);
        Ok(())
    }
}

impl<'a> SerializeStruct for Fields<'a> {
    type Ok = Fields<'a>;
    type Error = Error;

    fn serialize_field<T: Serialize + ?Sized>(
        &mut self,
        name: &'static str,
        value: &T,
    ) -> Result<(), Error> {
        self.see(name.into(), value)
    }

    fn end(self) -> Result<Self::Ok, Error> {
        Ok(self)
    }
}

/// A struct with flattened fields is serialised as a map.
impl<'a> SerializeMap for Fields<'a> {
    type Ok = Fields<'a>;
    type Error = Error;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Error> {
        self.key = to_value(key)?.as_str().map(str::to_owned);
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Error> {
        let name = self.key.take().unwrap_or_default();
        self.see(name, value)
    }

    fn end(self) -> Result<Self::Ok, Error> {
        Ok(self)
    }
}

fn no_struct<T>() -> Result<T, Error> {
    Err(Error::custom("not a document: it has no fields"))
}

macro_rules! refused {
    ($($name:ident($($kind:ty),*) -> $out:ty;)+) => {
        $(fn $name(self, $(_: $kind),*) -> Result<$out, Error> {
            no_struct()
        })+
    };
}

type Nothing<'a> = Impossible<Fields<'a>, Error>;

impl<'a> Serializer for Fields<'a> {
    type Ok = Fields<'a>;
    type Error = Error;
    type SerializeSeq = Nothing<'a>;
    type SerializeTuple = Nothing<'a>;
    type SerializeTupleStruct = Nothing<'a>;
    type SerializeTupleVariant = Nothing<'a>;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Nothing<'a>;

    fn serialize_map(self, _: Option<usize>) -> Result<Self, Error> {
        Ok(self)
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Self, Error> {
        Ok(self)
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<Self, Error> {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<Self, Error> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: &T,
    ) -> Result<Self, Error> {
        no_struct()
    }

    refused! {
        serialize_bool(bool) -> Self;
        serialize_i8(i8) -> Self;
        serialize_i16(i16) -> Self;
        serialize_i32(i32) -> Self;
        serialize_i64(i64) -> Self;
        serialize_u8(u8) -> Self;
        serialize_u16(u16) -> Self;
        serialize_u32(u32) -> Self;
        serialize_u64(u64) -> Self;
        serialize_f32(f32) -> Self;
        serialize_f64(f64) -> Self;
        serialize_char(char) -> Self;
        serialize_str(&str) -> Self;
        serialize_bytes(&[u8]) -> Self;
        serialize_none() -> Self;
        serialize_unit() -> Self;
        serialize_unit_struct(&'static str) -> Self;
        serialize_unit_variant(&'static str, u32, &'static str) -> Self;
        serialize_seq(Option<usize>) -> Nothing<'a>;
        serialize_tuple(usize) -> Nothing<'a>;
        serialize_tuple_struct(&'static str, usize) -> Nothing<'a>;
        serialize_tuple_variant(&'static str, u32, &'static str, usize) -> Nothing<'a>;
        serialize_struct_variant(&'static str, u32, &'static str, usize) -> Nothing<'a>;
    }
}
