//! Sweeps over any number of the model or the start: each point is what its own command says, and an ensemble of seeds
//! has the statistics of its points.

use crate::folder::Folder;
use serde_json::Value;

fn points(document: &Value) -> Vec<Value> {
    document["points"].as_array().unwrap().clone()
}

#[test]
fn a_point_that_is_a_run_is_what_run_says_to_the_last_bit() {
    let folder = Folder::new("sweep_runs");
    let law = "--alpha 1.4 --r 1 --until 120 --noise 1e-3";
    let found = folder
        .prints_json(&format!("sweep {law} --healing-time 20,50 --kick 0.02:0.1:2 --seed 1:3:3"));
    let points = points(&found);
    assert_eq!(points.len(), 12);
    let mut periods = 0;
    for point in &points {
        let at = point["at"].as_array().unwrap();
        let seed = at[2].as_f64().unwrap();
        let own = format!("--healing-time {} --kick {} --seed {seed}", at[0], at[1]);
        let alone = folder.prints_json(&format!("run {law} {own}"));
        assert_eq!(point["regime"], alone["regime"], "{own}");
        assert_eq!(point["source"], "run");
        for name in ["period", "wavelength", "amplitude_x0", "amplitude_u", "slips"] {
            let alone = alone["oscillation"].get(name).unwrap_or(&Value::Null);
            assert_eq!(&point[name], alone, "{name}, {own}");
        }
        periods += usize::from(point["period"].is_number());
        let samples = alone["samples"]["l"].as_array().unwrap();
        let l: Vec<f64> = samples.iter().skip(1000).map(|l| l.as_f64().unwrap()).collect();
        let (mean, deviation) = definitions(&l);
        let count = l.len() as f64;
        let deviation = deviation * ((count - 1.0) / count).sqrt();
        // A thousand intervals of the run's own against two thousand.
        assert!((point["mean_l"].as_f64().unwrap() - mean).abs() < 1e-3, "{own}");
        assert!((point["deviation_l"].as_f64().unwrap() - deviation).abs() < 1e-3, "{own}");
    }
    assert!(periods > 0, "some are in stick-slip");
    let seeds = |i: usize| points[i]["at"][2].as_f64().unwrap();
    assert_eq!([0, 1, 2, 3].map(seeds).map(|seed| seed as u8), [1, 2, 3, 1], "seeds vary fastest");
}

/// Positions of the tip at slips at r = 1, from samples alone: between minima of the lag half a deviation below its mean, the
/// largest half a deviation above, on the parabola through three samples.
fn slips_of_samples(samples: &Value) -> Vec<f64> {
    let column = |name: &str| -> Vec<f64> {
        samples[name].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    };
    let (t, l, x0) = (column("t"), column("l"), column("x0"));
    let late = l.len() / 2;
    let (mean, deviation) = definitions(&l[late..]);
    let is_minimum = |i: &usize| l[i - 1] > l[*i] && l[*i] <= l[i + 1];
    let low = (late + 1..l.len() - 1).filter(|i| is_minimum(i) && l[*i] < mean - 0.5 * deviation);
    let low: Vec<usize> = low.collect();
    let highest =
        |pair: &[usize]| (pair[0]..pair[1]).max_by(|a, b| l[*a].total_cmp(&l[*b])).unwrap();
    let highest = low.windows(2).map(highest);
    // The lag is at rest there, so the tip moves at the velocity of the support.
    let between = |i: usize| {
        let curvature = l[i - 1] - 2.0 * l[i] + l[i + 1];
        (t[i + 1] - t[i]) / 2.0 * (l[i - 1] - l[i + 1]) / curvature
    };
    highest.filter(|i| l[*i] > mean + 0.5 * deviation).map(|i| x0[i] + between(i)).collect()
}

#[test]
fn slips_on_noise_are_as_far_apart_as_in_the_samples_of_a_run() {
    let folder = Folder::new("sweep_slips");
    let law = "--alpha 1.4 --r 1 --until 300 --noise 0.02";
    let found = points(&folder.prints_json(&format!("sweep {law} --seed 1:3:3")));
    for (point, seed) in found.iter().zip(1..) {
        let line = format!("run {law} --seed {seed} --sample-every 0.02 --history none");
        let slips = slips_of_samples(&folder.prints_json(&line)["samples"]);
        let distances: Vec<f64> = slips.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let (mean, deviation) = definitions(&distances);
        assert!(slips.len() > 10, "{} slips", slips.len());
        let [distance, error] =
            ["slip_distance", "slip_distance_error"].map(|name| point[name].as_f64().unwrap());
        println!("{distance} ± {error}, by samples {mean}");
        assert!((distance / mean - 1.0).abs() < 3e-5, "{distance} {mean}");
        let expected = deviation / (distances.len() as f64).sqrt();
        assert!((error / expected - 1.0).abs() < 1e-2, "{error} {expected}");
    }
    // Of a motion that repeats itself it is the wavelength, or that over the number of slips.
    let settled = "sweep --alpha 1.2,1.3 --r 1 --kick 0.05 --until 900";
    for point in points(&folder.prints_json(settled)) {
        let number = |name: &str| point[name].as_f64().unwrap();
        let apart = number("wavelength") / number("slips");
        assert!((number("slip_distance") / apart - 1.0).abs() < 2e-3, "{point}");
    }
    let steady = &points(&folder.prints_json("sweep --alpha 0.9,1 --r 1 --until 100"))[0];
    assert!(steady.get("slip_distance").is_none(), "{steady}");
}

/// Runs that share vector lanes: bytes depend neither on threads nor on parts, and regimes and numbers are those of `run`
/// within its tolerance.
#[test]
fn runs_side_by_side_do_not_depend_on_their_company() {
    let folder = Folder::new("sweep_side_by_side");
    let line = "sweep --alpha 0.9:1.3:11 --r 1 --kick 0.05 --until 150";
    folder.prints(&format!("{line} --threads 1 -o one.json"));
    folder.prints(&format!("{line} --threads 2 -o two.json"));
    assert_eq!(folder.read("one.json"), folder.read("two.json"));
    for part in 1..=3 {
        folder.prints(&format!("{line} --shard {part}/3 -o part-{part}.json"));
    }
    folder.prints("sweep merge part-3.json part-1.json part-2.json -o merged.json");
    assert_eq!(folder.read("one.json"), folder.read("merged.json"));
    let document: Value = serde_json::from_slice(&folder.read("one.json")).unwrap();
    for point in points(&document).iter().step_by(3) {
        let run = format!("run --alpha {} --r 1 --kick 0.05 --until 150", point["alpha"]);
        let alone = folder.prints_json(&run);
        assert_eq!(point["regime"], alone["regime"], "{run}");
        let l: Vec<f64> = alone["samples"]["l"].as_array().unwrap()[1000..]
            .iter()
            .map(|l| l.as_f64().unwrap())
            .collect();
        let (mean, _) = definitions(&l);
        assert!((point["mean_l"].as_f64().unwrap() - mean).abs() < 1e-3, "{run}");
        if let Some(period) = point["period"].as_f64() {
            let alone = alone["oscillation"]["period"].as_f64().unwrap();
            assert!((period - alone).abs() < 1e-7, "{run}: {period} {alone}");
        }
    }
}

#[test]
fn what_a_tip_settles_into_over_the_law_and_the_width_is_that_of_single_sweeps() {
    let folder = Folder::new("sweep_law");
    let found = folder
        .prints_json("sweep --beta 0:1:2 --width 0.8,1.3 --r 1 --alpha 1.5:3:2 --depth-limit 5,20");
    let points = points(&found);
    assert_eq!(points.len(), 16);
    for (index, point) in points.iter().enumerate() {
        assert_eq!(point["index"], index);
        let (width, beta, alpha) = (&point["width"], &point["beta"], &point["alpha"]);
        let line = format!(
            "sweep --beta {beta} --width {width} --r 1 --alpha {alpha} --depth-limit {}",
            point["at"][0]
        );
        let mut alone = folder.prints_json(&line)["points"][0].clone();
        let mut here = point.clone();
        for name in ["index", "width", "at"] {
            alone.as_object_mut().unwrap().remove(name);
            here.as_object_mut().unwrap().remove(name);
        }
        assert_eq!(here, alone, "{line}");
    }
    let widths = points.iter().map(|p| p["width"].as_f64().unwrap()).collect::<Vec<_>>();
    assert!(widths[7] < 1.0 && widths[8] > 1.0, "width varies slowest: {widths:?}");
}

/// Sums by their definitions, in one loop: the oracle of a mean and a deviation of numbers near each other.
fn definitions(numbers: &[f64]) -> (f64, f64) {
    let count = numbers.len() as f64;
    let mean = numbers.iter().map(|x| x / count).sum::<f64>();
    let pairs = numbers.iter().flat_map(|a| numbers.iter().map(move |b| (a - b).powi(2)));
    (mean, (pairs.sum::<f64>() / (2.0 * count * (count - 1.0))).sqrt())
}

#[test]
fn an_ensemble_has_the_statistics_of_its_points_however_they_are_shared_out() {
    let folder = Folder::new("sweep_ensemble");
    let line = "sweep --alpha 1.2:4:2 --r 1 --until 60 --noise 1e-2 --seed 1:8:8";
    let alone = folder.prints(line);
    let found: Value = serde_json::from_slice(&alone).unwrap();
    let ensembles = found["ensembles"].as_array().unwrap();
    assert_eq!(ensembles.len(), 2);
    assert_eq!(ensembles[1]["regimes"]["trapped"], 8);
    let (points, first) = (points(&found), &ensembles[0]);
    // On noise that goes on no motion repeats itself: there are no periods.
    assert_eq!(first["regimes"]["transient"], 8);
    assert!(first["period"].is_null());
    assert_eq!((&first["first"], &ensembles[1]["first"]), (&0.into(), &8.into()));
    for name in ["mean_l", "deviation_l", "slip_distance"] {
        let mut numbers: Vec<f64> = points[..8].iter().filter_map(|p| p[name].as_f64()).collect();
        numbers.sort_by(f64::total_cmp);
        let (mean, deviation) = definitions(&numbers);
        let told = |what: &str| first[name][what].as_f64().unwrap();
        assert_eq!(first[name]["count"], numbers.len());
        assert!((told("mean") / mean - 1.0).abs() < 1e-14, "{name}");
        assert!((told("deviation") - deviation).abs() < 1e-12 * mean, "{name}");
        let error = deviation / (numbers.len() as f64).sqrt();
        assert!((told("error") - error).abs() < 1e-12 * mean, "{name}");
        assert!((told("least") - numbers[0]).abs() < f64::MIN_POSITIVE);
        assert!((told("largest") - numbers[numbers.len() - 1]).abs() < f64::MIN_POSITIVE);
        assert!((numbers[0]..=numbers[numbers.len() - 1]).contains(&told("median")));
    }
    for part in 1..=3 {
        let written = format!("{line} --shard {part}/3 -o part-{part}.json");
        folder.prints(&written);
        assert!(folder.json(&format!("part-{part}.json")).get("ensembles").is_none());
    }
    assert_eq!(folder.prints("sweep merge part-1.json part-2.json part-3.json"), alone);
    folder.refuses("sweep merge part-2.json", &["PART.json", "--array=1,3", "--shard slurm/3"]);
    let table = String::from_utf8(folder.prints(&format!("{line} --format csv"))).unwrap();
    assert!(table.starts_with("beta,r,alpha,seed,critical_alpha,"), "{table}");
}

#[test]
fn what_no_run_can_begin_with_is_refused_by_name() {
    let folder = Folder::new("sweep_axes_refused");
    let sweep = |more: &str| format!("sweep --alpha 1.2 --r 1 {more}");
    for (more, words) in [
        ("--kick 0:1:3", &["--until"][..]),
        ("--seed 1:3:3 --until 50", &["--noise"]),
        ("--seed 1:2:4 --noise 1e-3 --until 50", &["--seed", "whole number"]),
        ("--until 3", &["--until 3"]),
        ("--depth-limit 0:1:3", &["--depth-limit 0"]),
        ("--kick 1,x --until 50", &["--kick", "V1,V2,…"]),
        ("--seed 1:10000:10000 --noise 1,2 --kick 0:1:1000 --until 50", &["make 20000000 points"]),
        ("--shard slurm", &["--shard", "SLURM_ARRAY_TASK_ID is not set"]),
    ] {
        folder.refuses(&sweep(more), words);
    }
}

#[test]
fn pictures_have_whatever_varies_on_their_axes() {
    let folder = Folder::new("sweep_axes_drawn");
    let drawn = |line: &str| {
        folder.prints(&format!("{line} -o map.json --plot map.svg"));
        String::from_utf8(folder.read("map.svg")).unwrap()
    };
    let cells = drawn("sweep --r 1 --alpha 2:4:2 --depth-limit 5:20:2");
    assert!(cells.contains("depth limit") && cells.contains("α"), "{cells}");
    // A hundred seeds share an abscissa.
    let row = drawn("sweep --r 1 --alpha 1.2:1.4:2 --until 60 --noise 1e-3 --seed 1:4:4");
    assert!(row.contains("mean of l") && !row.contains("seed"), "{row}");
    folder.refuses(
        "sweep --r 1:2:2 --alpha 2:4:2 --depth-limit 5:20:2 -o map.json --plot map.svg",
        &["--plot", "two ranges"],
    );
}
