//! `--stiffness-across` of linear theory as a user meets it: where a single line snakes. The numbers are those of PHYSICS.md and of prototypes that share no code with this project; crates/stability/tests
//! judges more of them.

use crate::folder::Folder;
use serde_json::Value;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn words(folder: &Folder, line: &str) -> String {
    String::from_utf8(folder.prints(&format!("{line} --format text"))).unwrap()
}

#[test]
fn a_single_line_says_where_it_snakes() {
    let folder = Folder::new("snaking_line");
    let soft = "stability --r 1 --stiffness-across 0.25";
    let found = folder.prints_json(&format!("{soft} --alpha 0.9"));
    assert!((number(&found["snaking"]["alpha"]) - 0.830_541_012_7).abs() < 6e-11);
    assert!((number(&found["snaking"]["wavelength"]) - 17.1).abs() < 0.05);
    // Along the scan it is stable up to 1.069.
    assert_eq!(found["stable"], false);
    assert_eq!(folder.prints_json("stability --r 1 --alpha 0.9")["stable"], true);
    let said = words(&folder, &format!("{soft} --alpha 0.9"));
    for part in ["is unstable; along the scan it loses", "the line snakes above α = 0.8305410127"]
    {
        assert!(said.contains(part), "{said}");
    }
    assert!(words(&folder, &format!("{soft} --tip gaussian")).contains("no α"));
    folder.prints(&format!("{soft} --alpha 0.9 -o roots.csv --plot roots.svg"));
    let picture = String::from_utf8(folder.read("roots.svg")).unwrap();
    assert!(picture.contains("snakes") && picture.contains("along the scan"));
    let help = String::from_utf8(folder.prints("stability --help")).unwrap();
    assert!(help.contains("--stiffness-across <K>"));
}
