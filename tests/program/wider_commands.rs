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
}

/// The points of `boundary --pitch-range` are the thresholds of `stability --pitch`; a limit that never bites is the paper's law.
#[test]
fn thresholds_of_rasters_over_pitch_are_those_of_stability() {
    let folder = Folder::new("wider_raster_boundary");
    for law in
        ["--tip gaussian --depth-limit 8", "--beta 0.5 --healing-time 40 --length 30 --inertia 0.3"]
    {
        let line = format!("boundary {law} --pitch-range 0.5:1:2 --r 1");
        let over = folder.prints_json(&line);
        for (n, pitch) in [0.5, 1.0].into_iter().enumerate() {
            let alone = folder.prints_json(&format!("stability {law} --pitch {pitch} --r 1"));
            for name in ["alpha", "q", "kappa", "crest_angle"] {
                assert_eq!(over[name][n], alone["critical"][name], "{law} {name}");
            }
            if law.contains("healing") {
                assert_eq!(over["alpha_zigzag"][n], Value::Null);
                continue;
            }
            let line = format!("stability {law} --pitch {pitch} --r 1 --path zigzag");
            let zigzag = folder.prints_json(&line);
            assert_eq!(over["alpha_zigzag"][n], zigzag["critical"]["alpha"]);
        }
    }
    let deep = "boundary --tip gaussian --pitch-range 0.5:1:2 --r 1";
    let papers = folder.prints_json(deep);
    let limited = folder.prints_json(&format!("{deep} --depth-limit 1e12"));
    for n in 0..2 {
        let [one, other] = [&papers, &limited].map(|b| b["alpha"][n].as_f64().unwrap());
        assert!((one - other).abs() < 1e-9, "{one} {other}");
    }
    folder.prints("boundary --tip gaussian --depth-limit 8 --pitch-range 0.5:1:2 --r 1 -o p.json --plot p.svg");
    // A single line is steady at any alpha under so low a limit: far lines are too.
    let shallow =
        folder.prints_json("boundary --tip gaussian --depth-limit 1 --pitch-range 0.25:6:2 --r 1");
    assert_eq!(shallow["pitch"], serde_json::json!([0.25]));
    assert!(shallow["remarks"][0].as_str().unwrap().contains("1 pitches from 6"), "{shallow}");
    for (line, words) in [
        ("boundary --depth-limit 3 --pitch-range 0.5:1:2 --r 1", ["--depth-limit", "corner"]),
        ("boundary --no-spring --pitch-range 0.5:1:2 --r 1", ["--no-spring", "support"]),
        (
            "boundary --tip gaussian --healing-time 9 --pitch-range 0.5:1:2 --r 1",
            ["--length", "heals"],
        ),
        (
            "boundary --tip gaussian --length 9 --pitch-range 0.5:1:2 --r 1",
            ["--length", "healing-time"],
        ),
        (
            "stability --tip gaussian --healing-time 90 --length 9 --pitch 1 --r 1 --path zigzag",
            ["--path zigzag", "healing surface"],
        ),
    ] {
        folder.refuses(line, &words);
    }
}

/// A reference of the law's prototypes: period 51.2220627(2).
#[test]
fn cycles_and_branches_of_a_wider_law_are_documents_that_their_readers_take() {
    let folder = Folder::new("wider_cycles");
    let cycle = schema(&folder, "cycle");
    folder.prints("cycle --alpha 20 --r 1 --depth-limit 10 -o c.json --plot c.svg");
    let document = folder.json("c.json");
    validate(&cycle, &document);
    assert!((document["period"].as_f64().unwrap() - 51.222_062_7).abs() < 2e-7);
    assert!(document["floquet_error"].as_f64().unwrap() < 1e-8);
    assert_eq!(document["parameters"]["depth_limit"], 10.0);
    let heights = numbers(&document["profile"]["height"]);
    assert!(heights.iter().any(|h| *h > 0.0) && heights.iter().any(|h| *h < 0.0));
    folder.prints("plot c.json -o c.pdf");
    for format in ["csv", "npz"] {
        folder.prints(&format!("cycle --alpha 20 --r 1 --depth-limit 10 -o c.{format}"));
    }
    assert!(folder.read("c.csv").starts_with(b"t,l,velocity,height"));
    // From a document: its law, but for what is given.
    let again = folder.prints_json("cycle --from c.json --alpha 20.3");
    assert_eq!(again["parameters"]["depth_limit"], 10.0);
    let alone = folder.prints_json("cycle --alpha 20 --r 1 --depth-limit 10.2");
    let other = folder.prints_json("cycle --from c.json --depth-limit 10.2");
    let [alone, other] = [alone, other].map(|document| document["period"].as_f64().unwrap());
    assert!((alone - other).abs() < 1e-8, "{alone} {other}");
    // A run comes to it, and says so by it.
    let run = folder.prints_json("run --alpha 20 --r 1 --depth-limit 10 --kick 0.1 --until 800");
    assert_eq!(run["regime"], "stick-slip");
    let oscillation = &run["oscillation"];
    let number = |field: &str| oscillation[field].as_f64().unwrap();
    let off = (number("period") - document["period"].as_f64().unwrap()).abs();
    assert!(off <= number("period_error") && number("period_error") < 1e-7, "{oscillation}");
    // A surface that heals, inertia, all together.
    for (line, slips) in [
        ("--alpha 1.5 --r 1 --healing-time 10", 1),
        ("--alpha 1.2 --r 1 --inertia 0.3", 1),
        ("--alpha 2 --r 1 --depth-limit 4 --healing-time 15 --inertia 0.3", 1),
        ("--tip cosine --alpha 3 --r 1 --healing-time 3", 1),
    ] {
        let found = folder.prints_json(&format!("cycle {line} --plot c.svg"));
        validate(&cycle, &found);
        assert_eq!(found["slips"], slips, "{line}");
        assert!(found["floquet_error"].as_f64().unwrap() < 1e-7, "{line}: {}", found["floquet"]);
    }
    let healing = "--alpha 1.5 --r 1 --healing-time 10 --format text";
    for line in [format!("cycle {healing}"), format!("run {healing} --kick 0.1 --until 300")] {
        let text = String::from_utf8(folder.prints(&line)).unwrap();
        assert!(text.contains("amplitude of u, unhealed"), "{text}");
    }
    let branch = schema(&folder, "continue");
    let line =
        "continue --over alpha --beta 0 --r 1 --depth-limit 20 --to 2.6 -o b.json --plot b.svg";
    folder.prints(line);
    let document = folder.json("b.json");
    validate(&branch, &document);
    assert_eq!(document["parameters"]["depth_limit"], 20.0);
    assert_eq!(document["trapping"], Value::Null);
    let hopf = document["special"][0]["alpha"].as_f64().unwrap();
    assert!((hopf - 2.300_070).abs() < 1e-6, "{hopf}");
    // A branch ends where its cycles reach the corner of |h|.
    let line = "continue --over alpha --r 0.7731 --healing-time 96.2 --depth-limit 5.52 --to 1.5";
    let document = folder.prints_json(line);
    assert_eq!(document["branches"][0]["end"], "lost");
    let remark = document["remarks"][0].as_str().unwrap_or_default();
    assert!(remark.contains("the height under the tip reaches 0"), "{document}");
    let from = "continue --over r --from c.json --to 1.1";
    assert_eq!(folder.prints_json(from)["parameters"]["depth_limit"], 10.0);
}

#[test]
fn a_sweep_of_a_wider_law_knows_no_trapping_where_nothing_is_held() {
    let folder = Folder::new("wider_sweep");
    let sweep = schema(&folder, "sweep");
    let line = "sweep --beta 0 --r 1 --alpha 1:13:5 --depth-limit 5 -o map.json --plot map.svg";
    folder.prints(line);
    let document = folder.json("map.json");
    validate(&sweep, &document);
    assert_eq!(document["parameters"]["depth_limit"], 5.0);
    let regimes: Vec<&Value> =
        document["points"].as_array().unwrap().iter().map(|point| &point["regime"]).collect();
    assert_eq!(regimes, ["steady", "steady", "stick-slip", "stick-slip", "stick-slip"]);
    for point in document["points"].as_array().unwrap() {
        assert!((point["critical_alpha"].as_f64().unwrap() - 5.197_881).abs() < 1e-6);
        if point["regime"] == "stick-slip" {
            let line = format!("cycle --beta 0 --r 1 --alpha {} --depth-limit 5", point["alpha"]);
            let alone = folder.prints_json(&line)["period"].as_f64().unwrap();
            assert!((point["period"].as_f64().unwrap() - alone).abs() < 1e-9);
        }
    }
    // In parts, from the points above onset, and where there is none.
    for part in ["1/2", "2/2"] {
        let name = part.replace('/', "-");
        folder.prints(&format!(
            "sweep --r 1 --alpha-above 0.1:0.3:3 --healing-time 10 --inertia 0.2 --shard {part} -o part-{name}.json"
        ));
    }
    folder.prints("sweep merge part-1-2.json part-2-2.json -o whole.json");
    let whole = folder.json("whole.json");
    let periods = whole["points"].as_array().unwrap().iter().map(|point| &point["period"]);
    assert!(periods.clone().all(Value::is_number), "{:?}", periods.collect::<Vec<_>>());
    let stable = folder.prints_json("sweep --beta 0 --r 1 --alpha 1:50:3 --depth-limit 1.5");
    assert!(stable["points"].as_array().unwrap().iter().all(|point| point["regime"] == "steady"));
    let above = folder.prints_json("sweep --beta 0 --r 1 --alpha-above 1 --depth-limit 1.5");
    assert!(above["points"][0]["error"].as_str().unwrap().contains("stable for every alpha"));
}

#[test]
fn commands_of_cycles_refuse_what_nothing_drags() {
    let folder = Folder::new("wider_cycle_refusals");
    folder.refuses("cycle --alpha -3 --no-spring", &["--no-spring", "nothing drags"]);
    folder.refuses("sweep --alpha 1 --r 1 --no-spring", &["--no-spring", "nothing drags"]);
    folder.refuses("continue --over alpha --r 1 --no-spring", &["--no-spring", "nothing drags"]);
    folder.refuses("sweep --alpha 1 --r 1 --healing-time 0", &["--healing-time 0", "above 0"]);
    folder.refuses("continue --over alpha --r 1 --inertia -1", &["--inertia -1", "above 0"]);
    folder.refuses("cycle --alpha 1 --r 1 --tip cosine", &["--tip cosine", "--healing-time"]);
    let over = "continue --over r --alpha 1 --depth-limit 5";
    folder.refuses(over, &["--alpha 1", "basic model"]);
}

/// Oza, Rosales and Bush (2013) for J0: v² = (2B - 1 - √(1+4B))/2, B = -α; the fixed points of the Lorenz system for cos.
#[test]
fn without_a_spring_stability_lists_steady_walks() {
    let folder = Folder::new("walks");
    let walking = schema(&folder, "walking");
    folder.prints(
        "stability --no-spring --tip bessel --alpha -3 --healing-time 1 -o w.json --plot w.svg",
    );
    let droplet = folder.json("w.json");
    validate(&walking, &droplet);
    let speed = droplet["walks"][0]["speed"].as_f64().unwrap();
    assert!((speed - (2.5 - f64::sqrt(13.0) / 2.0).sqrt()).abs() < 1e-12, "{speed}");
    assert_eq!(droplet["walks"][0]["stable"], true);
    assert!((droplet["walking_alpha"].as_f64().unwrap() + 2.0).abs() < 1e-12);
    let lorenz = "stability --no-spring --tip cosine --alpha -28 --inertia 0.1 --healing-time 1";
    let unstable = folder.prints_json(lorenz);
    let walks = unstable["walks"].as_array().unwrap();
    assert_eq!(walks.len(), 1);
    assert!((walks[0]["speed"].as_f64().unwrap() - f64::sqrt(27.0)).abs() < 1e-11);
    assert_eq!(walks[0]["stable"], false);
    let resting = folder.prints_json(&lorenz.replace("-28", "-0.9"));
    assert!(resting["walks"].as_array().unwrap().is_empty(), "{resting}");
    let table = String::from_utf8(folder.prints(&format!("{lorenz} --format csv"))).unwrap();
    assert!(table.starts_with("speed,re,im\n") && table.lines().count() == 5, "{table}");
    folder.refuses(&format!("{lorenz} --pitch 1"), &["--pitch", "--no-spring"]);
    folder.refuses(&format!("{lorenz} --re-above=-3"), &["--re-above -3", "--no-spring"]);
    folder.refuses(&format!("{lorenz} --r 1"), &["--r 1", "leave it out"]);
    folder.refuses(
        "stability --no-spring --tip cosine --alpha -2",
        &["--tip cosine", "--healing-time"],
    );
}
