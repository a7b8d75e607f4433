//! Numbers with a unit in options: each gives, to the last bit, what the number of the model gives in its place.
//!
//! Judge: pairs `number|quantity`, converted by hand with σ = 20 nm, Γ/k = 16 ms, kσ²/a = 16 nm, kσ = 4 nN. The options are those
//! that the program declares: one that is neither in these lines nor among the numbers without a dimension fails the test.

use crate::folder::Folder;
use serde_json::Value;
use std::collections::BTreeSet;
use stickslip_cli::hosted;

const SCALES: &str = "--sigma 20nm --stiffness 0.2N/m --damping 3.2mNs/m --slope-force 5nN";

/// Each dimensional option of each command, as `number|quantity`.
const LINES: [&str; 20] = [
    "run --tip gaussian --width 1.2|24nm --r 0.8|1um/s --alpha 1.3|1.3um/s --until 20|320ms --kick 0.3|6nm --start-position 10|0.2um --healing-time 50|0.8s --depth-limit 30|480nm --inertia 0.1|5.12mg --noise 0.01|160pm --noise-spacing 0.2|4nm --tolerance 1e-6|20fm --sample-every 1|16ms --pulse 0.1,15,0.5|0.4nN,0.24s,8ms",
    "run --r 0.8 --alpha-above 0.03|30nm/s --until 12|192ms --hold 3,2|48ms,32ms --sample-at 1,4|16ms,64ms --tolerance 1e-6 --checkpoint-every 4|64ms --checkpoint run.checkpoint --start-position 7|140nm",
    "run --tip gaussian --r 1 --alpha 1.2 --inertia 0.1 --start flat --start-velocity 0.5|625nm/s --start-position 2 --until 4 --tolerance 1e-5",
    "run --tip gaussian --r 1 --alpha 1.2 --stiffness-across 0.5 --kick-across 0.1|2nm --width-y 1.3|26nm --noise 0.01 --noise-spacing-across 0.5|10nm --until 18 --tolerance 1e-4",
    "run --walker --alpha -1.3|-1.3um/s --start flat --pulse 0.1,1,0.5|0.4nN,16ms,8ms --rotation 0.1|6.25/s --largest-radius 4|80nm --kick 0.1|2nm --until 2|32ms --tolerance 1e-4",
    "raster --tip gaussian --width 1.2|24nm --r 0.8|1um/s --alpha 0.9|0.9um/s --pitch 0.7|14nm --lines 3 --length 6|120nm --tolerance 1e-4|2pm --sample-every 2|32ms --pulse 0.1,2,0.5|0.4nN,32ms,8ms --depth-limit 30|480nm --healing-time 50|0.8s --inertia 0.1|5.12mg --width-y 1.3|26nm",
    "raster --tip gaussian --r 1 --alpha-above -0.3|-300nm/s --pitch 1 --lines 2 --length 4 --stiffness-across 0.5 --kick-across 0.1|2nm --sample-at 1,2|16ms,32ms --tolerance 1e-4",
    "surface run.json --at 18|288ms --range 3:9|60nm:0.18um --spacing 0.5|10nm --y-range -1:1|-20nm:20nm --spacing-y 0.5|10nm --width-y 1.3|26nm",
    "surface run.json --at 18,19|288ms,304ms --x 3,5|60nm,100nm",
    "surface raster.json --range 1:3:5|20nm:60nm:5 --y 0,0.7|0,14nm",
    "stability --tip gaussian --width 1.2|24nm --r 0.8|1um/s --alpha 1.3|1.3um/s --re-above -3|-187.5/s --depth-limit 30|480nm --healing-time 50|0.8s --inertia 0.1|5.12mg",
    "stability --tip gaussian --r 1 --alpha-above -0.1|-0.1um/s --healing-time 50 --pitch 1|20nm --length 9|180nm --width-y 1.3|26nm",
    "boundary --tip gaussian --width 1.2|24nm --r-range 0.4:0.8:2|500nm/s:1um/s:2 --depth-limit 30|480nm --healing-time 50|0.8s --inertia 0.1|5.12mg",
    "boundary --tip gaussian --pitch-range 1:2:2|20nm:40nm:2 --r 0.8|1um/s --healing-time 50|0.8s --depth-limit 30|480nm --inertia 0.1|5.12mg --width-y 1.3|26nm --length 9|180nm",
    "response --tip gaussian --width 1.2|24nm --r 0.8|1um/s --alpha 0.9|0.9um/s --pulse 1e-3,20,0.5|4pN,320ms,8ms --until 30|0.48s --sample-every 2|32ms --start-position 10|200nm --depth-limit 30|480nm --healing-time 50|0.8s --inertia 0.1|5.12mg",
    "cycle --tip gaussian --width 1.2|24nm --r 0.8|1um/s --alpha 2.6|2.6um/s --tolerance 1e-6|1.25pm/s --healing-time 50|0.8s --inertia 0.1|5.12mg --depth-limit 90|1.44um",
    "continue --tip gaussian --width 1.2|24nm --r 0.8|1um/s --alpha-above 0.03|30nm/s --over alpha --to 2.2|2.2um/s --longest-period 60|0.96s --tolerance 1e-6|1.25pm/s --healing-time 50|0.8s --inertia 0.1|5.12mg --depth-limit 90|1.44um",
    "compare --tip gaussian --width 1.2|24nm --r 0.8|1um/s --alpha 0.9|0.9um/s --until 16|256ms --start-position 10|200nm --kick 0.1|2nm --noise 0.01|160pm --noise-spacing 0.5|10nm --tolerance 1e-5|0.2pm --spacing 0.5|10nm --grid-until 15|0.24s --pulse 0.1,14,0.5|0.4nN,224ms,8ms --sample-every 2|32ms --depth-limit 30|480nm --healing-time 50|0.8s --inertia 0.1|5.12mg",
    "sweep --tip gaussian --width 1.2|24nm --r 0.4:0.8:2|500nm/s:1um/s:2 --alpha 0.9,1.3|0.9um/s,1.3um/s --tolerance 1e-6|1.25pm/s --depth-limit 90|1.44um --healing-time 50|0.8s --inertia 0.1|5.12mg",
    "sweep raster --tip gaussian --width 1.2|24nm --r 0.8|1um/s --alpha 0.5:0.9:2|0.5um/s:0.9um/s:2 --pitch 1:2:2|20nm:40nm:2 --lines 3 --length 6|120nm --tolerance 1e-4|2pm --depth-limit 30|480nm --healing-time 50|0.8s --inertia 0.1|5.12mg --width-y 1.3|26nm",
];
/// As these, under conditions of their own: their work is not that of the lines above.
const MORE: [&str; 10] = [
    "boundary --alpha 1.3|1.3um/s --r 0.8|1um/s --load 10|10nN --load-range 2:20|0.002uN:20nN --r-range 0.4:1.6:3|500nm/s:2um/s:3",
    "compare --tip gaussian --r 1 --alpha 0.9 --pitch 1|20nm --lines 2 --length 3|60nm --tolerance 1e-4",
    "compare --tip gaussian --r 1 --alpha 0.9 --stiffness-across 0.5 --kick-across 0.1|2nm --width-y 1.3|26nm --noise 0.01 --noise-spacing 0.5 --noise-spacing-across 0.5|10nm --start-position 2 --until 4 --tolerance 1e-3 --time-limit 60",
    "compare --tip gaussian --r 1 --alpha 0.9 --inertia 0.1 --start flat --start-velocity 0.5|625nm/s --start-position 2 --until 4 --tolerance 1e-4",
    "response --tip gaussian --r 0.8 --alpha-above -0.3|-0.3um/s --pulse 1e-3,20,0.5 --until 30 --sample-at 21,25|336ms,400ms",
    "cycle --r 0.8 --alpha-above 0.03|30nm/s",
    "continue --r 0.8 --alpha 1.2|1.2um/s --over r --to 0.9|1.125um/s",
    "compare --tip gaussian --r 1 --alpha-above -0.3|-0.3um/s --until 9 --start-position 7 --hold 2,1|32ms,16ms --sample-at 1,4|16ms,64ms --step 0.01|160us --spacing 0.5 --grid sinc",
    "sweep --r 0.8 --alpha-above 0.03|30nm/s --until 12|192ms --start-position 7|140nm --kick 0.1|2nm --noise 0.01|160pm --noise-spacing 0.5|10nm --tolerance 1e-5|0.2pm",
    "sweep --r 0.8 --alpha 1.2 --inertia 0.1 --start flat --start-velocity 0.5,0.6|625nm/s,750nm/s --start-position 2 --until 4 --tolerance 1e-5",
];

/// Numbers without a dimension, and what is measured in seconds of a clock or on paper.
const DIMENSIONLESS: &[&str] = &[
    "beta",
    "seed",
    "points",
    "roots",
    "modes",
    "lines",
    "stiffness-across",
    "stiffness-range",
    "trap",
    "longest-step",
    "most-points",
    "grid-tolerance",
    "time-limit",
    "threads",
    "shard",
    "terms",
    "resamples",
    "dpi",
    "fps",
    "seconds",
    "height-gain",
    "force-gain",
    "start",
    "path",
    "memory",
    "format",
    "print",
    "history",
    "scan",
    "free",
    "solve-for",
    "over",
    "unit",
    "grid",
    "tip",
    "only",
    "force-unit",
    "sensitivity",
    "width-exponent",
];

#[test]
fn a_quantity_gives_what_its_number_gives_to_the_last_bit() {
    let folder = Folder::new("quantities");
    folder.prints(
        "run --tip gaussian --r 1 --alpha 1.2 --kick 0.1 --until 20 --tolerance 1e-5 -o run.json",
    );
    folder.prints("raster --tip gaussian --r 1 --alpha 0.9 --pitch 0.7 --lines 3 --length 6 --tolerance 1e-4 -o raster.json");
    for line in LINES.iter().chain(&MORE) {
        let part = |at: usize| {
            let word = |word: &str| {
                word.split('|').nth(at.min(word.matches('|').count())).unwrap().to_owned()
            };
            line.split_whitespace().map(word).collect::<Vec<_>>().join(" ")
        };
        let numbers = document(&folder, &format!("{} {SCALES}", part(0)));
        let quantities = document(&folder, &format!("{} {SCALES}", part(1)));
        assert!(quantities["physical"].is_object(), "{line}");
        assert_eq!(quantities, numbers, "{line}");
    }
}

/// The document that a line writes, without the time that it took.
fn document(folder: &Folder, line: &str) -> Value {
    folder.prints(&format!("{line} -o out.json"));
    let mut document = folder.json("out.json");
    std::fs::remove_file(folder.path("out.json")).unwrap();
    strip(&mut document);
    document
}

fn strip(value: &mut Value) {
    match value {
        Value::Object(fields) => {
            fields.retain(|name, _| !["seconds", "speedup"].contains(&&**name));
            fields.values_mut().for_each(strip);
        }
        Value::Array(entries) => entries.iter_mut().for_each(strip),
        _ => {}
    }
}

/// The options of the lines above that have a quantity, each with its command.
fn tried() -> BTreeSet<String> {
    let mut tried = BTreeSet::new();
    for line in LINES.iter().chain(&MORE) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let command = if words[1] == "raster" { "sweep raster" } else { words[0] };
        for pair in words.windows(2).filter(|pair| pair[1].contains('|')) {
            tried.insert(format!("{command} {}", pair[0].trim_start_matches("--")));
        }
    }
    tried
}

#[test]
fn each_option_with_a_dimension_is_tried() {
    let tried = tried();
    let mut left_out = vec![];
    let commands = hosted::commands().into_iter().map(|(name, _)| name);
    for command in commands.chain(["sweep raster".into()]) {
        // Quantities in themselves; measured data in their own unit; pictures: tests of their own.
        if ["units", "fit", "tip", "plot", "help"].contains(&&*command) {
            continue;
        }
        let path: Vec<&str> = command.split(' ').collect();
        for option in hosted::options(&path).unwrap() {
            let Some(value) = option.value.filter(|_| !option.is_positional) else { continue };
            let is_file =
                ["FILE", "DIR"].contains(&&*value) || value.contains('.') && value.contains("json");
            let is_scale = ["sigma", "stiffness", "damping", "velocity", "slope-force"]
                .contains(&&*option.name);
            let is_known = DIMENSIONLESS.contains(&&*option.name)
                || tried.contains(&format!("{command} {}", option.name));
            if !(is_file || is_scale || is_known) {
                left_out.push(format!("{command} --{} {value}", option.name));
            }
        }
    }
    assert!(left_out.is_empty(), "without a quantity in these tests: {left_out:#?}");
}

#[test]
fn what_cannot_be_converted_is_refused_as_typed() {
    let folder = Folder::new("quantities_refused");
    let run = "run --r 0.8 --alpha 1.3 --until";
    let refusals = [
        (format!("{run} 2s --sigma 20nm"), ["--until 2s", "--damping and --stiffness", "in Γ/k"]),
        (format!("{run} 2s"), ["--until 2s", "--units", "in Γ/k"]),
        (format!("{run} 2nm {SCALES}"), ["--until 2nm", "not a quantity in s", "5ms"]),
        (format!("{run} -2s {SCALES}"), ["--until -2s", "-2s is -125 Γ/k", ""]),
        (
            format!("surface run.json --range 3:6um:7 {SCALES}"),
            ["--range 3:6um:7", "`3` has no unit", "each"],
        ),
        ("tip pit.csv --r 1um/s".into(), ["--r 1um/s", "none here", "in kσ/Γ"]),
    ];
    for (line, wanted) in refusals {
        let output = folder.stickslip(&line);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{line}: {said}");
        assert!(output.stdout.is_empty());
        wanted.iter().for_each(|wanted| assert!(said.contains(wanted), "{line}: {said}"));
    }
}

#[test]
fn scales_come_from_options_documents_and_measured_tips() {
    let folder = Folder::new("quantities_scales");
    folder.prints(&format!(
        "run --tip gaussian --r 0.8 --alpha 1.3 --until 22 --tolerance 1e-5 {SCALES} -o run.json"
    ));
    let plain = document(&folder, "surface run.json --range 3:6:7");
    assert_eq!(document(&folder, "surface run.json --range 60nm:120nm:7"), plain);
    assert_eq!(document(&folder, "surface --range=60nm:120nm:7 run.json"), plain);
    // r, which gives the time with a velocity, may be that of a document.
    let velocity = "--sigma 20nm --velocity 1um/s";
    let wanted = document(&folder, &format!("run --parameters run.json --until 21 {velocity}"));
    assert_eq!(
        document(&folder, &format!("run --parameters run.json --until 336ms {velocity}")),
        wanted
    );
    // A bare number is one of the model with or without scales.
    let of = |line: &str| document(&folder, line)["samples"].clone();
    let bare = "run --tip gaussian --r 0.8 --alpha 1.3 --kick 0.3 --until 22 --tolerance 1e-5";
    assert_eq!(of(bare), of(&format!("{bare} {SCALES}")));
}

#[test]
fn measured_data_and_pictures_take_units_too() {
    let folder = Folder::new("quantities_data");
    let row =
        |i: i32| format!("{},{}\n", i * 2, -30.0 * (-f64::from((i - 25) * (i - 25)) / 98.0).exp());
    folder.write("pit.csv", format!("x_nm,z_nm\n{}", (0..50).map(row).collect::<String>()));
    let wanted = document(&folder, "tip pit.csv --centre 50 --terms 1 --resamples 10");
    for centre in ["50nm", "0.05um", "0.05um --unit nm"] {
        assert_eq!(
            document(&folder, &format!("tip pit.csv --centre {centre} --terms 1 --resamples 10")),
            wanted
        );
    }
    folder.prints(&format!(
        "run --tip gaussian --r 0.8 --alpha 1.3 --until 22 --tolerance 1e-5 {SCALES} -o run.json"
    ));
    let picture = |options: &str| {
        folder.prints(&format!("plot run.json {options} -o run.svg"));
        folder.read("run.svg")
    };
    assert_eq!(picture("--x-range 336ms:0.35s"), picture("--x-range 0.336:0.35"));
    // A fit has no scale of time.
    folder.refuses("fit --ripple pit.csv --healing-time 5s", &["--healing-time 5s", "in Γ/k"]);
    let refused = folder.stickslip("plot run.json --x-range 3um:6um -o run.svg");
    assert_eq!(refused.status.code(), Some(1));
}
