//! Conversions between a type of a document and its twin in a library.

/// Implements `From` between types with the same variants, or with the same fields; for `&From` the fields are copied.
macro_rules! twins {
    ($from:ident => $to:ident: $($variant:ident)|+) => {
        impl From<$from> for $to {
            fn from(from: $from) -> Self {
                match from {
                    $($from::$variant => Self::$variant),+
                }
            }
        }
    };
    ($from:ident => $to:ident { $($field:ident),+ }) => {
        impl From<$from> for $to {
            fn from(from: $from) -> Self {
                Self { $($field: from.$field),+ }
            }
        }
    };
    (&$from:ident => $to:ident { $($field:ident),+ }) => {
        impl From<&$from> for $to {
            fn from(from: &$from) -> Self {
                Self { $($field: from.$field),+ }
            }
        }
    };
}

pub(crate) use twins;
