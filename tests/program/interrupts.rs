//! Signals end every command at once, whatever it is at, and whatever it was started with; and what would go on
//! for ever is refused, or given up with a reason.

use crate::folder::{Folder, ended_by, said, wait_until_it_listens};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Of the processor: 0.2 s, and what a slow machine adds to it.
const AT_ONCE: Duration = Duration::from_millis(1000);

/// A table with a kink, which only a lattice as fine as its rows follows: everything takes long with it.
fn table() -> String {
    let row = |i: i32| {
        let x = 0.004 * f64::from(i);
        format!("{x},{}\n", (1.0 + x * x).powi(-4) + 1e-7 * (1.0 - x).max(0.0))
    };
    (0..2000).map(row).collect()
}

/// Lobes that no few exponentials follow.
const NARROW: &str = r#"{"gaussians":[{"amplitude":1,"center":0,"width":1},
    {"amplitude":0.1,"center":2,"width":0.1},{"amplitude":0.1,"center":-2,"width":0.1}]}"#;

/// Long work, each line at something else.
const LINES: [&str; 6] = [
    "boundary --tip-file tip.csv --r-range 0.1,2 --points 100000 -o out.json",
    "cycle --tip-file tip.csv --r 1 --alpha-above 0.3 --tolerance 1e-5 -o out.json",
    "continue --tip-file tip.json --r 1 --over alpha -o out.json",
    "sweep --tip-file tip.csv --r 1 --alpha 2.4:3:50 --tolerance 1e-5 -o out.json",
    "compare --alpha 1.2 --r 1 --until 3000 --spacing 0.02 -o out.json",
    "run --tip-file tip.csv --r 1 --alpha 2.5 --kick 0.1 --until 1e6 -o out.json",
];

#[cfg(unix)]
#[test]
fn a_signal_ends_every_command_even_where_it_was_to_be_ignored() {
    for (i, line) in LINES.iter().enumerate() {
        let folder = Folder::new(&format!("signal-{i}"));
        folder.write("tip.csv", table());
        folder.write("tip.json", NARROW);
        for (signal, status) in [("INT", 130), ("TERM", 143)] {
            let inner = folder.command(line);
            // As a job in the background of a script.
            let mut shell = Command::new("sh");
            shell.args(["-c", "trap '' INT; exec \"$0\" \"$@\""]).arg(inner.get_program());
            shell.args(inner.get_args()).current_dir(folder.path(""));
            let mut child = shell.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
            wait_until_it_listens(&mut child);
            sleep(Duration::from_millis(100));
            assert!(child.try_wait().unwrap().is_none(), "{line}: it must take longer");
            let (output, took) = ended_by(&format!("-{signal}"), child);
            assert_eq!(output.status.code(), Some(status), "{line}: {}", said(&output));
            assert!(said(&output).contains("interrupted"), "{line}: {}", said(&output));
            assert!(took < AT_ONCE, "{line}: {signal} took {took:?}");
        }
    }
}

#[test]
fn what_would_go_on_for_ever_has_an_end_and_a_reason() {
    let folder = Folder::new("endless");
    for line in [
        "cycle --alpha 1e18 --r 1",
        "cycle --alpha 1e308 --r 1",
        "cycle --alpha 1.2 --r 1e-9",
        "cycle --alpha 1.2 --r 1 --beta 1e18",
    ] {
        let output = folder.stickslip(line);
        assert!(matches!(output.status.code(), Some(1 | 2)), "{line}: {}", said(&output));
        assert!(output.stdout.is_empty() && said(&output).contains("take"), "{}", said(&output));
    }
    let grid = "compare --alpha 1.2 --r 1 --until 20 --time-limit 5 --grid-tolerance 1e-320";
    folder.refuses(grid, &["--grid-tolerance", "1e-15 or more"]);
    let sweep = folder.prints_json("sweep --alpha 1.2:1e18:2 --r 1");
    assert!(sweep["points"].as_array().unwrap().len() == 2, "{sweep}");
}

#[test]
fn sizes_are_judged_before_anything_is_made_of_them() {
    let folder = Folder::new("sizes");
    for n in ["18446744073709551615", "100000000000", "1000000000", "10000001"] {
        folder.refuses(&format!("sweep --r 1:2:{n} --alpha 1"), &["10000000 are accepted"]);
        folder.refuses(&format!("sweep --r 1 --alpha 1:2:{n}"), &["10000000 are accepted"]);
        folder
            .refuses(&format!("sweep --r 1 --alpha 1 --beta 0:1:{n}"), &["10000000 are accepted"]);
    }
    folder.refuses("sweep --r 1 --alpha 1 --beta 0:1:10001", &["10000 are accepted"]);
}

#[test]
fn samples_of_a_raster_are_counted_before_it_is_scanned() {
    let folder = Folder::new("raster_samples");
    let raster = "raster --alpha 1.2 --r 1 --pitch 1 --width-y 1 --length 100 -o out.json";
    let line = format!("{raster} --lines 200 --sample-every 1e-4");
    folder.refuses(&line, &["--sample-every 0.0001", "2.0e8 samples", "or more"]);
    let line = format!("{raster} --lines 1000000");
    folder.refuses(&line, &["--lines 1000000", "GB"]);
    let places: Vec<String> = (0..300).map(|i| format!("{}", f64::from(i) / 3.0)).collect();
    let line = format!("{raster} --lines 20000 --sample-at {}", places.join(","));
    folder.refuses(&line, &["--sample-at with 300 times", "take at most 250"]);
}

/// After the last line there is a document to make, write and draw: that ends too, and leaves nothing half-written.
#[cfg(unix)]
#[test]
fn a_signal_is_heard_while_a_result_is_written() {
    let folder = Folder::new("late_signal");
    let raster = "raster --tip gaussian --alpha 0.5 --r 1 --pitch 1 --width-y 1 --lines 40 --length 10 --tolerance 1e-4 \
                  --sample-every 1e-4 -o out.json --plot out.png";
    let runs = "run --alpha 1.2 --r 1 --kick 0.05 --until 400 --sample-every 2e-4 -o out.json --plot out.png";
    for (line, after) in [(raster, "40 of 40 lines"), (runs, "interrupted")] {
        for name in folder.names() {
            std::fs::remove_file(folder.path(&name)).unwrap();
        }
        let mut child = folder.command(line).stderr(Stdio::piped()).spawn().unwrap();
        // It is being written once its temporary file is there.
        while !folder.names().iter().any(|name| name.starts_with(".stickslip-")) {
            assert!(child.try_wait().unwrap().is_none(), "{line}: it must take longer to write");
            sleep(Duration::from_millis(1));
        }
        let (output, took) = ended_by("-TERM", child);
        assert_eq!(output.status.code(), Some(143), "{line}: {}", said(&output));
        assert!(said(&output).contains(after), "{line}: {}", said(&output));
        assert!(took < AT_ONCE, "{line}: took {took:?}");
        let left = |name: &String| {
            name.starts_with(".stickslip-")
                || name.starts_with("out.json") && !name.ends_with(".partial")
        };
        assert!(!folder.names().iter().any(left), "{:?}", folder.names());
    }
}
