//! Reads the reference tables in `data/`: just enough JSON for lists of flat records.

use std::path::Path;

/// Every number of each record of the list `key` in `data/<file>`, in the order of the file; numbers kept
/// as strings, for their many digits, count as numbers.
pub(crate) fn records(file: &str, key: &str) -> Vec<Vec<f64>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(file);
    let text = std::fs::read_to_string(&path).expect("the table is in data/");
    let start = text.find(&format!("\"{key}\": [")).expect("the list is in the table");
    let list = &text[start..];
    let list = &list[list.find('[').unwrap_or(0)..];
    let mut records = Vec::new();
    let mut depth = 0;
    let mut token = String::new();
    for c in list.chars() {
        match c {
            '[' | '{' => {
                depth += 1;
                if depth == 2 {
                    records.push(Vec::new());
                }
            }
            ',' | ']' | '}' | ':' => {
                if let (Ok(number), Some(record)) = (token.trim().parse(), records.last_mut()) {
                    record.push(number);
                }
                token.clear();
                depth -= i32::from(matches!(c, ']' | '}'));
                if depth == 0 {
                    break;
                }
            }
            '"' => {}
            c => token.push(c),
        }
    }
    records
}
