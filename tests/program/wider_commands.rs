//! `boundary`, `cycle`, `continue` and `sweep` under the wider law.

use crate::folder::Folder;
use crate::runs::{schema, validate};
use serde_json::Value;

fn numbers(of: &Value) -> Vec<f64> {
    of.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// Reference values of the prototypes that the law was derived with: a spectral PDE and direct sums.
#[test]
fn the_boundary_of_a_wider_law_is_that_of_stability_and_says_what_leaves_nothing_unstable() {
    let folder = Folder::new("wider_boundary");
    let boundary = schema(&folder, "boundary");
    for (line, at_one, least, memory) in [
        ("--beta 0 --depth-limit 5", 5.197_881, Some(1.671_049), 0.860_935),
        ("--beta 0 --depth-limit 20", 2.300_070, Some(1.671_049), 0.860_935),
        ("--healing-time 10", 1.340_504, None, 0.758_028),
        ("--depth-limit 5", 1.073_134, None, 0.758_028),
    ] {
        folder.prints(&format!("boundary {line} --r-range 0.5:1.5:3 -o b.json --plot b.svg"));
        let document = folder.json("b.json");
        validate(&boundary, &document);
        assert_eq!(numbers(&document["r"]), [0.5, 1.0, 1.5], "{line}");
        let alpha = numbers(&document["alpha"]);
        assert!((alpha[1] - at_one).abs() < 1e-6, "{line} {alpha:?}");
        for (r, (alpha, wave)) in
            [0.5, 1.0, 1.5].into_iter().zip(alpha.iter().zip(numbers(&document["Omega"])))
        {
            let point = folder.prints_json(&format!("stability {line} --r {r}"));
            let critical = &point["critical"];
            assert!(
                (critical["alpha"].as_f64().unwrap() - alpha).abs() < 1e-12 * alpha,
                "{line} {r}"
            );
            assert!((critical["omega"].as_f64().unwrap() / r - wave).abs() < 1e-12, "{line} {r}");
        }
        let kind = if line == "--depth-limit 5" { "non-smooth" } else { "smooth" };
        assert_eq!(document["kind"][1], kind, "{line}");
        let limits = &document["limits"];
        assert!((limits["memory_length"].as_f64().unwrap() - memory).abs() < 1e-6, "{limits}");
        if let Some(least) = least {
            let found = numbers(&limits["least_depth_limit"]);
            assert!((found[1] - least).abs() < 1e-6, "{limits}");
            // A critical α exists above it (just above, it is beyond all numbers) and none just below.
            let beside = |b: f64| {
                let line = format!("boundary --beta 0 --depth-limit {b} --r-range 1:1.000001:2");
                folder.prints_json(&line)["r"].as_array().unwrap().len()
            };
            assert_eq!([beside(1.05 * least), beside(0.999 * least)], [2, 0]);
        }
    }
    let papers = folder.prints_json("boundary --r-range 0.5:1.5:3");
    assert!(papers.get("limits").is_none() && papers.get("kind").is_none());
}

#[test]
fn a_boundary_without_onset_is_said_and_not_drawn() {
    let folder = Folder::new("wider_no_boundary");
    let line = "boundary --beta 0 --depth-limit 1 --r-range 1:2:3";
    let nothing = folder.prints_json(line);
    assert_eq!(nothing["r"], Value::Array(vec![]));
    assert!(nothing["remarks"][0].as_str().unwrap().contains("3 values of r are left out"));
    folder.refuses("boundary --no-spring --r-range 0.5:1.5:3", &["--no-spring"]);
    folder.refuses("boundary --depth-limit 0 --r-range 0.5:1.5:3", &["--depth-limit 0", "above 0"]);
    folder
        .refuses("boundary --tip cosine --r-range 0.5:1.5:3", &["--tip cosine", "--healing-time"]);
    let raster = "boundary --depth-limit 5 --pitch-range 0.5:1:2 --r 1";
    folder.refuses(raster, &["--depth-limit", "boundary --pitch-range"]);
}
