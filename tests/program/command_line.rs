//! What a user of the command line may rely on: where results go, when they appear under their name, what
//! a signal or a closed pipe does, and that every help text shows how.

use crate::folder::{Folder, said, wait_until_it_listens};
use serde_json::{Value, json};
use std::process::Command;

#[test]
fn a_document_is_json_on_standard_output_unless_a_file_is_named() {
    let folder = Folder::new("standard_output");
    let bare = folder.prints_json("run --alpha 1.2 --r 1 --until 30");
    let dash = folder.prints_json("run --alpha 1.2 --r 1 --until 30 --output -");
    assert_eq!(bare["format"], "stickslip/run");
    assert_eq!(bare["history"], dash["history"]);
    assert!(folder.prints("run --alpha 1.2 --r 1 --until 30 -o run.json").is_empty());
    assert_eq!(folder.json("run.json")["history"], bare["history"]);
    assert_eq!(folder.prints_json("surface run.json")["format"], "stickslip/surface");
    assert!(folder.prints("surface run.json -o u.JSON").is_empty());
    assert_eq!(folder.names(), ["run.json", "u.JSON"]);
}

#[test]
fn the_name_alone_shows_a_short_screen_whose_commands_run() {
    let folder = Folder::new("first_screen");
    let output = folder.stickslip("");
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    let screen = said(&output);
    assert!(screen.lines().count() <= 20, "{screen}");
    assert!(screen.lines().all(|line| line.chars().count() <= 90), "{screen}");
    let commands: Vec<&str> =
        screen.lines().filter_map(|line| line.strip_prefix("  stickslip ")).collect();
    assert_eq!(commands.len(), 5, "{screen}");
    for command in commands {
        let output = folder.stickslip(command);
        assert!(output.status.success(), "{command}: {}", said(&output));
    }
    assert_eq!(folder.names(), ["run.json", "run.svg", "surface.csv"]);
}

#[test]
fn a_steady_run_says_whether_it_would_stay_so() {
    let folder = Folder::new("unstable");
    for (options, hint) in [
        ("--alpha 1.2", true),
        ("--alpha-above=-0.01", false),
        ("--alpha 1.2 --tip bessel", true),
        ("--alpha 1.2 --kick 0.05", false),
    ] {
        let output = folder.stickslip(&format!("run {options} --r 1 --until 60 -o run.json"));
        assert!(output.status.success());
        assert_eq!(
            said(&output).contains("is unstable, without a disturbance"),
            hint,
            "{}",
            said(&output)
        );
    }
}

#[test]
fn a_surface_reads_its_run_from_standard_input() {
    let folder = Folder::new("standard_input");
    let run = folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 40");
    folder.write("run.json", &run);
    let from_file = folder.prints("surface run.json --x 20,21");
    let piped = folder.stickslip_reading("surface - --x 20,21", run);
    assert!(piped.status.success(), "{}", said(&piped));
    assert_eq!(piped.stdout, from_file);
    let nothing = folder.stickslip_reading("surface -", "");
    assert_eq!(nothing.status.code(), Some(2), "{}", said(&nothing));
}

#[test]
fn far_behind_leaves_the_initial_surface_out() {
    let folder = Folder::new("far_behind");
    let u = |line: &str| folder.prints_json(line)["surfaces"][0]["u"].clone();
    folder.prints("run --start flat --alpha 1.2 --r 1 --until 40 -o flat.json");
    assert_eq!(u("surface flat.json --x 20"), u("surface flat.json --x 20 --far-behind"));
    folder.prints("run --alpha 1.2 --r 1 --until 40 -o steady.json");
    // The tip started at 14.
    let [all, carved] = ["", "--far-behind"]
        .map(|option| u(&format!("surface steady.json --x 13 {option}"))[0].as_f64().unwrap());
    assert!((all - carved).abs() > 0.1, "{all} {carved}");
}

#[test]
fn a_surface_written_before_is_an_initial_surface() {
    let folder = Folder::new("second_pass");
    folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 60 -o first.json");
    folder.prints("surface first.json --range 10,70 --spacing 0.1 -o written.csv");
    let written = folder.read("written.csv");
    let rows = std::str::from_utf8(&written).unwrap().lines();
    let profile: Vec<&str> = rows.map(|row| row.split_once(',').unwrap().1).collect();
    folder.write("profile.csv", profile.join("\n"));
    let samples = |file: &str| {
        let line =
            format!("run --alpha 1.2 --r 1 --start flat --until 60 --initial-surface {file}");
        folder.prints_json(&line)["samples"].clone()
    };
    assert_eq!(samples("written.csv"), samples("profile.csv"));
    folder.prints("surface first.json --at 50,60 --range 10,70 --spacing 0.1 -o both.csv");
    let line = "run --alpha 1.2 --r 1 --until 60 --initial-surface both.csv";
    folder.refuses(line, &["--initial-surface both.csv", "several times, 50 and 60", "--at"]);
}

#[test]
fn a_failed_run_leaves_what_was_there_before() {
    let folder = Folder::new("failed");
    folder.write("run.json", "precious");
    folder.write("run.svg", "drawing");
    // Nothing can follow a pulse like that.
    let failing = "run --alpha 1 --r 1 --until 60 --pulse 1,20,1e-300 -o run.json --plot run.svg";
    let output = folder.stickslip(failing);
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("at t = 20"), "{}", said(&output));
    let refused = folder.stickslip("run --alpha 1 --r 1 --until 60 --tolerance 0 -o run.json");
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(folder.read("run.json"), b"precious");
    assert_eq!(folder.read("run.svg"), b"drawing");
    assert_eq!(folder.names(), ["run.json", "run.svg"]);
}

#[test]
fn samples_reach_the_end_where_the_interval_divides_the_run() {
    let folder = Folder::new("samples");
    for (until, every, count) in [("0.3", "0.1", 4), ("1", "0.3", 4), ("30", "0.1", 301)] {
        let line = format!(
            "run --alpha 1 --r 1 --start flat --start-position 0 --until {until} --sample-every {every}"
        );
        let times = folder.prints_json(&line)["samples"]["t"].clone();
        assert_eq!(times.as_array().unwrap().len(), count, "{line}");
    }
    let line = "run --alpha 1 --r 1 --until 30 --sample-at 30,20,25.5";
    assert_eq!(folder.prints_json(line)["samples"]["t"], json!([30.0, 20.0, 25.5]));
}

/// A step that ended just beyond a knot was once tried again and again at the same length.
#[test]
fn a_run_over_noise_ends_at_every_tolerance_and_spacing() {
    let folder = Folder::new("noise");
    for tolerance in ["1e-2", "1e-4", "1e-9"] {
        for options in
            ["1e-3 --noise-spacing 0.03", "0.1 --noise-spacing 0.1", "1 --noise-spacing 0.3"]
        {
            for seed in ["1", "2"] {
                folder.prints(&format!(
                    "run --alpha 1.2 --r 1 --until 20 --tolerance {tolerance} --seed {seed} --noise {options}"
                ));
            }
        }
    }
}

#[test]
fn negative_numbers_are_values() {
    let folder = Folder::new("negative");
    let cases = [
        ("--kick -0.1", "/parameters/kick", json!(-0.1)),
        ("--kick -1e-3", "/parameters/kick", json!(-1e-3)),
        ("--kick=-1E-3", "/parameters/kick", json!(-1e-3)),
        ("--start-position -3.5", "/parameters/start_position", json!(-3.5)),
        ("--pulse=-2,30,1", "/parameters/pulses/0/amplitude", json!(-2.0)),
        ("--pulse -2e-1,30,1", "/parameters/pulses/0/amplitude", json!(-0.2)),
        ("--pulse 1,20,1 --pulse -2,-30,1", "/parameters/pulses/1/time", json!(-30.0)),
        ("--start flat --start-position -5 --sample-at -4,-3", "/samples/t", json!([-4.0, -3.0])),
        ("--beta -5e-1", "/parameters/tip/gaussians/1/amplitude", json!(0.25)),
    ];
    for (options, pointer, value) in cases {
        let document = folder.prints_json(&format!("run --alpha 1 --r 1 --until 32 {options}"));
        assert_eq!(document.pointer(pointer), Some(&value), "{options}");
    }
    let below = folder.prints_json("run --r 1 --until 32 --alpha-above -1e-2");
    assert_eq!(below["parameters"]["alpha_above"], json!(-0.01));
    folder.write("run.json", below.to_string());
    let range = folder.prints_json("surface run.json --range -5,460 --spacing 5");
    assert_eq!(range["surfaces"][0]["x"].as_array().unwrap().len(), 94);
    let x = folder.prints_json("surface run.json --x -1e-1,2 --at 20,30");
    assert_eq!(x["surfaces"][1]["x"], json!([-0.1, 2.0]));
}

#[test]
fn plots_are_written_in_the_format_of_their_name_whatever_the_motion() {
    let folder = Folder::new("plots");
    let cases = [
        "--alpha 1.2 --r 1 --until 17",
        "--alpha 1.2 --r 1 --kick 0.05 --until 60",
        "--alpha 4 --r 1 --until 40",
        "--alpha 0 --r 1 --until 2.0000001 --start-position 1",
        "--alpha 1 --r 1e-12 --until 2 --start flat --start-position 0",
        "--alpha 1.2 --r 1 --until 30 --sample-at 20",
        "--tip bessel --alpha 0.5 --r 1 --until 30",
    ];
    for options in cases {
        folder.prints(&format!("run {options} -o run.json --plot run.svg"));
        assert!(folder.read("run.svg").starts_with(b"<svg"), "{options}");
        folder.prints("surface run.json --plot surface.svg -o u.csv");
        assert!(folder.read("surface.svg").starts_with(b"<svg"), "{options}");
    }
    folder.prints("surface run.json --at 30 --x 15 --plot point.svg -o u.csv");
    assert!(folder.read("point.svg").starts_with(b"<svg"));
    if cfg!(feature = "png") {
        folder.prints("run --alpha 1.2 --r 1 --until 17 -o run.json --plot run.PNG");
        assert!(folder.read("run.PNG").starts_with(b"\x89PNG\r\n\x1a\n"));
    }
}

#[test]
fn the_help_of_every_command_shows_an_example() {
    let folder = Folder::new("help");
    let help = |line: &str| String::from_utf8(folder.prints(line)).unwrap();
    let general = help("--help");
    let commands = general.split("Commands:").nth(1).unwrap().split("\n\n").next().unwrap();
    // What is said of a command may go on in the next line.
    let begin = |line: &&str| line.starts_with("  ") && !line.starts_with("   ");
    let commands = commands.lines().filter(begin).filter_map(|l| l.split_whitespace().next());
    let commands: Vec<&str> = commands.collect();
    assert!(commands.contains(&"run") && commands.contains(&"surface"), "{commands:?}");
    for command in commands.into_iter().filter(|command| *command != "help") {
        let text = help(&format!("{command} --help"));
        let examples = text.split("Example").nth(1).unwrap_or_default();
        assert!(examples.contains(&format!("stickslip {command}")), "{command}:\n{text}");
    }
    assert!(help("run --help").contains("[default: 1e-9]"));
}

#[test]
fn the_version_is_one_line_and_its_details_another() {
    let folder = Folder::new("version");
    let printed = |option: &str| String::from_utf8(folder.prints(option)).unwrap();
    let (short, long) = (printed("-V"), printed("--version"));
    assert_eq!(short, format!("stickslip {}\n", env!("CARGO_PKG_VERSION")));
    let details = long.strip_prefix(&short).unwrap_or_else(|| panic!("{long}"));
    let software = &folder.prints_json("stability --r 1")["software"];
    let named = software["commit"].as_str().map(|commit| {
        let tree = if software["clean"] == true { "clean" } else { "with changes" };
        format!("commit {commit}, {tree}\n")
    });
    assert_eq!(details, named.unwrap_or("commit unknown\n".into()));
}

/// The script, loaded by bash itself and asked what comes next.
#[test]
fn bash_completes_commands_and_options() {
    let folder = Folder::new("completions");
    folder.write("stickslip.bash", folder.prints("completions bash"));
    for (line, wanted) in [
        ("stickslip sta", "stability"),
        ("stickslip comple", "completions"),
        ("stickslip run --alpha-a", "--alpha-above"),
        ("stickslip sweep raster --pit", "--pitch"),
        ("stickslip cycle --tip gau", "gaussian"),
        ("stickslip completions f", "fish"),
    ] {
        let words = line.split(' ').count();
        let script = format!(
            "source ./stickslip.bash; COMP_WORDS=({line}); COMP_CWORD={}; \
             _stickslip stickslip \"${{COMP_WORDS[-1]}}\" \"${{COMP_WORDS[-2]}}\"; echo \"${{COMPREPLY[@]}}\"",
            words - 1
        );
        let mut bash = Command::new("bash");
        let output = bash.args(["-c", &script]).current_dir(folder.path(".")).output().unwrap();
        let offered = String::from_utf8(output.stdout).unwrap();
        assert!(offered.split_whitespace().any(|word| word == wanted), "{line}: {offered}");
    }
    for shell in ["zsh", "fish"] {
        let script = String::from_utf8(folder.prints(&format!("completions {shell}"))).unwrap();
        assert!(script.contains("alpha-above") && script.contains("stability"), "{shell}");
    }
    folder.refuses("completions tcsh", &["tcsh", "bash"]);
}

#[cfg(unix)]
mod on_unix {
    use super::*;
    use crate::folder::ended_by;
    use std::ffi::OsStr;
    use std::io::Read;
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::fs::PermissionsExt;
    use std::process::{Child, Command, Output, Stdio};
    use std::thread::sleep;
    use std::time::Duration;

    #[test]
    fn a_pipe_that_is_closed_early_is_no_matter() {
        let folder = Folder::new("closed_pipe");
        // More than a pipe holds.
        for line in ["run --alpha 1.2 --r 1 --kick 0.1 --until 60", "schema run"] {
            let mut child = folder.command(line);
            let mut child = child.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
            let mut start = [0; 10];
            child.stdout.take().unwrap().read_exact(&mut start).unwrap();
            let output = child.wait_with_output().unwrap();
            assert!(said(&output).is_empty(), "{line}\n{}", said(&output));
        }
    }

    /// A run without end, caught at work.
    fn endless(folder: &Folder, options: &str) -> Child {
        let line = format!("run --alpha 1.2 --r 1 --kick 0.05 --until 1e9 {options}");
        let mut command = folder.command(&line);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        wait_until_it_listens(&mut child);
        sleep(Duration::from_millis(100));
        child
    }

    /// How the program ends after a signal, within a second of the processor.
    fn after(child: Child, signal: &str) -> Output {
        let (output, took) = ended_by(signal, child);
        assert!(took < Duration::from_secs(1), "took {took:?}");
        output
    }

    #[test]
    fn an_interrupted_run_writes_what_it_has() {
        for (signal, status) in [("-INT", 130), ("-TERM", 143)] {
            let folder = Folder::new(&format!("interrupted{signal}"));
            let output = after(endless(&folder, "-o run.json"), signal);
            assert_eq!(output.status.code(), Some(status), "{}", said(&output));
            assert!(said(&output).contains("interrupted"), "{}", said(&output));
            let document = folder.json("run.json");
            assert_eq!(document["interrupted"], json!(true));
            let end =
                document["history"]["t"].as_array().unwrap().last().unwrap().as_f64().unwrap();
            let samples = document["samples"]["t"].as_array().unwrap();
            assert!(samples.iter().all(|t| t.as_f64().unwrap() <= end), "samples beyond {end}");
            assert_eq!(
                folder.prints_json("surface run.json --x 20")["surfaces"][0]["t"],
                json!(end)
            );
            assert_eq!(folder.names(), ["run.json"]);
        }
    }

    /// Between the judgement of the options and the result there is nothing to be left behind.
    #[test]
    fn a_command_stopped_at_work_leaves_no_file() {
        let folder = Folder::new("stopped");
        let row =
            |i: i32| format!("{},{}\n", 0.1 * f64::from(i), (-0.005 * f64::from(i * i)).exp());
        folder.write("tip.csv", (0..80).map(row).collect::<String>());
        let long =
            "boundary --tip-file tip.csv --r-range 0.1,2 --points 100000 -o b.json --plot b.svg";
        let mut child = folder.command(long).spawn().unwrap();
        sleep(Duration::from_millis(500));
        assert!(child.try_wait().unwrap().is_none(), "it must take longer");
        after(child, "-INT");
        assert_eq!(folder.names(), ["tip.csv"]);
    }

    /// A checkpoint is text, and must name the output.
    #[cfg(target_os = "linux")]
    #[test]
    fn names_of_any_bytes_will_do_but_beside_a_checkpoint() {
        let folder = Folder::new("odd_names");
        let run = |options: &[&OsStr]| {
            let mut command = folder.command("run --alpha 1.2 --r 1 --until 30 -o");
            command.args(options).output().unwrap()
        };
        let name = OsStr::from_bytes(b"odd\xff.json");
        assert!(run(&[name]).status.success());
        assert!(folder.path("").join(name).is_file());
        let output =
            run(&[OsStr::from_bytes(b"new\xff.jsonl"), "--checkpoint".as_ref(), "run.ck".as_ref()]);
        assert_eq!(output.status.code(), Some(2));
        assert!(said(&output).contains("--output new"), "{}", said(&output));
        assert_eq!(std::fs::read_dir(folder.path("")).unwrap().count(), 1);
    }

    #[test]
    fn a_file_has_the_permissions_that_the_umask_leaves() {
        let folder = Folder::new("umask");
        for (umask, mode) in [("022", 0o644), ("027", 0o640), ("077", 0o600)] {
            let line = "run --alpha 1.2 --r 1 --until 30 -o run.json --plot run.svg";
            let inner = folder.command(line);
            let mut shell = Command::new("sh");
            shell
                .current_dir(folder.path(""))
                .arg("-c")
                .arg(format!("umask {umask}; exec \"$0\" \"$@\""));
            let done = shell.arg(inner.get_program()).args(inner.get_args()).output().unwrap();
            assert!(done.status.success(), "{}", said(&done));
            for name in ["run.json", "run.svg"] {
                let permissions = folder.path(name).metadata().unwrap().permissions();
                assert_eq!(permissions.mode() & 0o777, mode, "{name} with umask {umask}");
            }
        }
    }

    #[test]
    fn a_link_is_followed_and_a_device_is_written_as_it_is() {
        let folder = Folder::new("links");
        folder.write("target.json", "old");
        std::os::unix::fs::symlink("target.json", folder.path("link.json")).unwrap();
        folder.prints("run --alpha 1.2 --r 1 --until 30 -o link.json");
        assert!(folder.path("link.json").is_symlink());
        assert_eq!(folder.json("target.json")["format"], "stickslip/run");
        let document = folder.prints("run --alpha 1.2 --r 1 --until 30 -o /dev/stdout");
        let document: Value = serde_json::from_slice(&document).unwrap();
        assert_eq!(document["format"], "stickslip/run");
    }
}
