//! What is said of run documents that were damaged. No oracle: the contract of the reader alone.

use crate::folder::Folder;
use serde_json::{Value, json};

/// A change to a document, and what is said about it.
type Damage = (&'static str, fn(&mut Value), &'static str);

const DAMAGES: [Damage; 22] = [
    ("format", |d| d["format"] = json!("other/run"), "\"stickslip/run\" is needed"),
    ("format", |d| d["format"] = json!(3), "not a whole JSON document"),
    ("format_version", |d| d["format_version"] = json!(2), "this program reads 1"),
    ("array", |d| *d = json!([1, 2]), "not a whole JSON document"),
    ("extra field", |d| d["more"] = json!(1), "unknown field `more`"),
    ("null", |d| d["history"]["extension"][3] = Value::Null, "invalid type: null"),
    ("short", |d| drop(list(d, "t").pop()), "matching lengths"),
    ("short", |d| drop(list(d, "extension").pop()), "matching lengths"),
    ("short", |d| drop(list(d, "displacement").pop()), "matching lengths"),
    ("stages", |d| d["history"]["displacement"][3] = json!([0.1]), "displacement 3 has 1 entries"),
    ("empty", forget, "matching lengths"),
    ("backwards", |d| list(d, "t").reverse(), "t does not increase"),
    ("nodes", |d| d["history"]["nodes"] = json!([0.5, 1.0]), "nodes and weights"),
    ("weights", |d| d["history"]["weights"][0] = json!(0.7), "nodes and weights"),
    ("a gap", |d| d["history"]["extension"][3] = json!(7.5), "does not begin where step 2 ends"),
    ("huge", |d| d["history"]["extension"][3] = json!(1e300), "step 3 has numbers beyond"),
    ("huge", |d| d["history"]["displacement"][3][0] = json!(-1e308), "step 3 has numbers beyond"),
    ("huge", |d| d["history"]["t"][0] = json!(-1.7e308), "step 0 has numbers beyond"),
    ("r", |d| d["parameters"]["r"] = json!(0), "above 0, not 0"),
    ("alpha", |d| d["parameters"]["alpha"] = json!(-1), "0 or above, not -1"),
    ("tip", |d| d["parameters"]["tip"]["gaussians"][0]["width"] = json!(0), "above 0"),
    ("until", |d| d["parameters"]["until"] = json!(1), "starts at"),
];

fn list<'a>(document: &'a mut Value, name: &str) -> &'a mut Vec<Value> {
    document["history"][name].as_array_mut().unwrap()
}

fn forget(document: &mut Value) {
    ["t", "extension", "displacement"].iter().for_each(|name| list(document, name).clear());
}

#[test]
fn damaged_run_documents_are_refused() {
    let folder = Folder::new("damaged");
    let whole = folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 30");
    for (what, damage, words) in DAMAGES {
        let mut document: Value = serde_json::from_slice(&whole).unwrap();
        damage(&mut document);
        folder.write("run.json", document.to_string());
        println!("{what}");
        folder.refuses("surface run.json", &["RUN.json run.json", words]);
    }
    let text = String::from_utf8(whole).unwrap();
    let texts = [
        (String::new(), "not a whole JSON document"),
        (text[..text.len() / 2].into(), "write it again"),
        (text[..text.len() - 3].into(), "write it again"),
        (text.repeat(2), "not a whole JSON document"),
        (text.replace("\"extension\":[", "\"extension\":[NaN,"), "not a whole JSON document"),
        (text.replace("\"extension\":[", "\"extension\":[1e999,"), "damaged"),
        ("[".repeat(100_000), "not a whole JSON document"),
    ];
    for (text, words) in texts {
        folder.write("run.json", text);
        folder.refuses("surface run.json", &["RUN.json run.json", words]);
    }
}
