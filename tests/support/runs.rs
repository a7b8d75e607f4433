//! What long runs leave, and what it is compared by.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]

use crate::folder::Folder;
use jsonschema::Validator;
use serde_json::Value;

/// That the program prints.
pub fn schema(folder: &Folder, name: &str) -> Validator {
    jsonschema::validator_for(&folder.prints_json(&format!("schema {name}"))).unwrap()
}

/// # Panics
/// If the document is not one.
pub fn validate(schema: &Validator, document: &Value) {
    let errors: Vec<String> = schema.iter_errors(document).map(|e| e.to_string()).collect();
    assert!(errors.is_empty(), "{document}\n{}", errors.join("\n"));
}

/// Of JSON.
pub fn lines(bytes: &[u8]) -> Vec<Value> {
    bytes
        .split_inclusive(|b| *b == b'\n')
        .map(|line| serde_json::from_slice(line).unwrap())
        .collect()
}

/// The bytes but for the one field that may differ.
pub fn without_seconds(bytes: &[u8]) -> Vec<u8> {
    let Some(at) = bytes.windows(10).rposition(|w| w == b"\"seconds\":") else {
        return bytes.to_vec();
    };
    let after = bytes[at..].iter().position(|b| b"},".contains(b)).unwrap();
    [&bytes[..at], &bytes[at + after..]].concat()
}

/// # Panics
/// If anything else differs.
pub fn assert_same(a: &[u8], b: &[u8], what: &str) {
    assert!(without_seconds(a) == without_seconds(b), "{what}: the bytes differ");
}

/// Time at which the checkpoint `run.ck` was made.
pub fn checkpoint_time(folder: &Folder) -> f64 {
    let bytes = folder.read("run.ck");
    let head: Value = serde_json::from_slice(bytes.split(|b| *b == b'\n').next().unwrap()).unwrap();
    head["t"].as_f64().unwrap()
}
