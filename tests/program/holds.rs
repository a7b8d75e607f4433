//! `--hold T,H`: slide, hold, slide, without a table of the path.

use crate::folder::Folder;
use serde_json::{Value, json};

/// A document without the processor time of the run.
fn document(folder: &Folder, line: &str) -> Value {
    let mut document = folder.prints_json(line);
    assert!(document["work"]["seconds"].take().is_number());
    document
}

/// The knots were written by hand; 2, 5 and 12 times r = 0.5 are exact.
#[test]
fn a_hold_is_the_path_that_it_stands_for() {
    let folder = Folder::new("holds");
    folder.write("path.csv", "t,R\n0,0\n5,2.5\n12,2.5\n20,6.5\n");
    let run = "run --alpha 0.8 --r 0.5 --until 20 --sample-every 1 --format json";
    let held = document(&folder, &format!("{run} --hold 5,7"));
    assert_eq!(held, document(&folder, &format!("{run} --support-path path.csv")));
    assert!(held["parameters"]["hold"].is_null(), "the documents contain the path");
    folder.write("slide.csv", "t,R\n0,0\n5,2.5\n20,10\n");
    let slide = document(&folder, &format!("{run} --support-path slide.csv"));
    assert_ne!(held["samples"], slide["samples"]);
    // Another hold takes the place of the path in a parameter file.
    folder.write("held.json", held.to_string());
    let longer = document(&folder, "run --parameters held.json --hold 5,9 --format json");
    assert_eq!(longer["parameters"]["support_path"]["t"], json!([0.0, 5.0, 14.0, 20.0]));
    folder.write("asked.json", r#"{"alpha": 0.8, "r": 0.5, "until": 20, "hold": [5, 7]}"#);
    let asked = "run --parameters asked.json --sample-every 1 --format json";
    assert_eq!(held, document(&folder, asked));
}

#[test]
fn a_hold_without_sense_is_refused_by_name() {
    let folder = Folder::new("holds_refused");
    folder.write("path.csv", "t,R\n0,0\n40,20\n");
    let run = "run --alpha 0.8 --r 1 --until 30";
    for hold in ["20", "20,-1", "0,5", "1,2,3", "-1,2"] {
        folder.refuses(&format!("{run} --hold {hold}"), &[&format!("--hold {hold}"), "T,H"]);
    }
    folder.refuses(&format!("{run} --hold nan,1"), &["--hold", "finite"]);
    folder.refuses(&format!("{run} --hold 20,10"), &["--hold 20,10", "ends at t = 30", "--until"]);
    let both = format!("{run} --hold 2,10 --support-path path.csv");
    folder.refuses(&both, &["--hold 2,10", "--support-path", "leave one of them out"]);
    let free = "run --alpha 0.8 --no-spring --until 30 --hold 2,10";
    folder.refuses(free, &["--hold 2,10", "without a spring"]);
    folder.refuses("run --walker --alpha=-3 --until 30 --hold 2,10", &["--hold", "--walker"]);
}
