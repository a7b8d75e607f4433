//! Checkpoints that were moved, forged, or made by a machine that rounds otherwise; names that collide; results cut
//! short; and what is read of files that are something else.

use crate::folder::{Folder, Measured, ended_by, measured, said};
use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

const RUN: &str = "run --alpha 1.2 --r 1 --kick 0.05 --until 60";
/// Takes minutes.
const LONG: &str = "run --alpha 1.2 --r 1 --kick 0.05 --until 1e7 --tolerance 1e-12";

#[test]
fn a_folder_that_is_moved_or_copied_has_its_runs() {
    let folder = Folder::new("moved");
    fs::create_dir(folder.path("old")).unwrap();
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 100 --checkpoint-every 20";
    for (output, plot) in [("a.jsonl", ""), ("a.json", "--plot old/a.svg"), ("a.csv", "")] {
        let outputs: Vec<&str> =
            [output].into_iter().chain((!plot.is_empty()).then_some("a.svg")).collect();
        folder.prints(&format!("{run} -o old/{output} --checkpoint old/ck {plot}"));
        let expected: Vec<_> =
            outputs.iter().map(|name| folder.read(&format!("old/{name}"))).collect();
        fs::create_dir(folder.path("copy")).unwrap();
        for entry in fs::read_dir(folder.path("old")).unwrap() {
            let entry = entry.unwrap();
            fs::copy(entry.path(), folder.path("copy").join(entry.file_name())).unwrap();
        }
        fs::rename(folder.path("old"), folder.path("new")).unwrap();
        for place in ["new", "copy"] {
            let told = folder.stickslip(&format!("run --resume {place}/ck"));
            assert_eq!(told.status.code(), Some(0), "{}", said(&told));
            assert!(said(&told).contains(&format!("{place}/{output}")), "{}", said(&told));
            for (name, expected) in outputs.iter().zip(&expected) {
                let found = folder.read(&format!("{place}/{name}"));
                crate::runs::assert_same(&found, expected, name);
            }
        }
        // And elsewhere, if that is asked for; what was there stays.
        let elsewhere = format!("b.{}", output.strip_prefix("a.").unwrap());
        let plot = if plot.is_empty() { "" } else { "--plot b.svg" };
        let before = folder.read(&format!("new/{output}"));
        folder.prints(&format!("run --resume new/ck -o {elsewhere} {plot}"));
        crate::runs::assert_same(&folder.read(&elsewhere), &expected[0], output);
        assert!(folder.read(&format!("new/{output}")) == before);
        // From then on the checkpoint names that, which is outside of its folder.
        folder.refuses("run --resume new/ck", &["--resume", &elsewhere, "not in its folder"]);
        for name in ["new", "copy"] {
            fs::remove_dir_all(folder.path(name)).unwrap();
        }
        fs::create_dir(folder.path("old")).unwrap();
    }
}

/// With a right checksum, but words in its head that nobody asked for.
#[test]
fn a_forged_checkpoint_leads_nowhere() {
    let folder = Folder::new("forged");
    fs::create_dir(folder.path("in")).unwrap();
    folder.write("precious.json", "precious");
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 60 --checkpoint in/ck -o in/a";
    let forge = |from: &str, to: &str| {
        let whole = folder.read("in/ck");
        let end = whole.iter().position(|b| *b == b'\n').unwrap();
        let head = String::from_utf8(whole[..end].to_vec()).unwrap();
        assert!(head.contains(from), "{head}");
        let mut bytes = head.replacen(from, to, 1).into_bytes();
        bytes.extend(&whole[end..whole.len() - 4]);
        let sum = crc32fast::hash(&bytes);
        bytes.extend(sum.to_le_bytes());
        folder.write("in/forged", bytes);
    };
    folder.prints(&format!("{run}.json --plot in/a.svg"));
    fs::copy(folder.path("in/ck.journal"), folder.path("in/forged.journal")).unwrap();
    let absolute = folder.path("precious.json").display().to_string();
    let mut elsewhere =
        vec!["../precious.json", "x/../../precious.json", &absolute, "/etc/none.json"];
    if cfg!(unix) {
        #[cfg(unix)]
        std::os::unix::fs::symlink("../precious.json", folder.path("in/link.json")).unwrap();
        elsewhere.push("link.json");
    }
    for path in elsewhere {
        forge("\"output\":\"a.json\"", &format!("\"output\":\"{path}\""));
        folder.refuses("run --resume in/forged", &["--resume", path, "not in its folder"]);
        forge("\"plot\":\"a.svg\"", &format!("\"plot\":\"{path}\""));
        folder.refuses("run --resume in/forged", &["--resume", path, "not in its folder"]);
    }
    assert_eq!(folder.read("precious.json"), b"precious");
    forge("\"output\":\"a.json\"", "\"output\":\"forged\"");
    folder.refuses("run --resume in/forged", &["a name of its own"]);
    forge("\"output\":\"a.json\"", "\"output\":\"forged.journal\"");
    folder.refuses("run --resume in/forged", &["a name of its own"]);
    for (from, to) in [
        ("\"samples\":2001", "\"samples\":18446744073709551615"),
        ("\"samples\":2001", "\"samples\":0"),
        ("\"intervals\":2000", "\"intervals\":18446744073709551615"),
        ("\"every\":0.02", "\"every\":1e-300,\"x\":0.02"),
        ("\"t\":60.0", "\"t\":59.0"),
    ] {
        let whole = String::from_utf8_lossy(&folder.read("in/ck")).into_owned();
        if whole.contains(from) {
            forge(from, to);
            folder.refuses("run --resume in/forged", &["--resume", "is damaged"]);
        }
    }
}

#[test]
fn names_that_go_with_others_are_not_given_to_files() {
    let folder = Folder::new("companions");
    folder.prints("cycle --alpha 1.2 --r 1 -o c.json");
    folder.prints("sweep --r 1 --alpha 1:1.4:4 --shard 1/2 -o a.json");
    folder.prints("sweep --r 1 --alpha 1:1.4:4 --shard 2/2 -o b.json");
    folder.write(
        "tip.csv",
        (0..9).map(|i| format!("{},{}\n", i, (-i * i).max(-9) / 9 + 1)).collect::<String>(),
    );
    let mut lines = vec![
        format!("{RUN} -o o.jsonl --checkpoint o.jsonl.part"),
        format!("{RUN} --format json -o c.journal --checkpoint c"),
        format!("{RUN} --format json -o c --checkpoint c.part"),
        "sweep merge a.json b.json -o a.json".into(),
        "sweep merge a.json b.json -o ./b.json".into(),
        "cycle --from c.json -o c.json".into(),
        "stability --r 1 --alpha 1 -o s.svg.json --plot ./s.svg.json.svg --tip-file s.svg.json"
            .into(),
        "sweep --r 1 --alpha 1 -o m.json --tip-file m.json.partial".into(),
    ];
    if cfg!(unix) {
        fs::hard_link(folder.path("tip.csv"), folder.path("hard.csv")).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink("tip.csv", folder.path("soft.csv")).unwrap();
        lines.push(format!("{RUN} --tip-file tip.csv -o hard.csv"));
        lines.push(format!("{RUN} --tip-file soft.csv -o hard.csv"));
    }
    let before = folder.names();
    for line in lines {
        folder.refuses(&line, &["a name of its own"]);
        assert_eq!(folder.names(), before, "{line}");
    }
}

#[cfg(unix)]
#[test]
fn what_is_cut_short_says_so_in_every_format() {
    use std::process::Command;
    let folder = Folder::new("cut_short");
    for name in ["a.csv", "a.npz"] {
        folder.prints(&format!("{RUN} -o {name}"));
        let whole = folder.read(name);
        let child = folder.command(&format!("{LONG} -o {name}")).stderr(Stdio::piped()).spawn();
        let mut child = child.unwrap();
        crate::folder::wait_until_it_listens(&mut child);
        sleep(Duration::from_millis(100));
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert_eq!(child.wait_with_output().unwrap().status.code(), Some(130));
        let words =
            if name == "a.csv" { &b"# interrupted at t = "[..] } else { b"interrupted.npy" };
        let has = |bytes: &[u8]| bytes.windows(words.len()).any(|w| w == words);
        assert!(has(&folder.read(name)) && !has(&whole), "{name}");
    }
}

/// Samples without end in one step: a signal is heard.
#[cfg(unix)]
#[test]
fn a_step_full_of_samples_can_be_interrupted() {
    let folder = Folder::new("full_step");
    let line = "run --alpha 1 --r 1 --until 30 --tolerance 1e-2 --sample-every 1e-11 -o a.jsonl --checkpoint ck";
    let mut child = folder.command(line).stderr(Stdio::piped()).spawn().unwrap();
    crate::folder::wait_until_it_listens(&mut child);
    sleep(Duration::from_millis(200));
    let (output, took) = ended_by("-INT", child);
    assert_eq!(output.status.code(), Some(130));
    assert!(took < Duration::from_secs(2), "{took:?}");
}

#[cfg(unix)]
#[test]
fn what_is_something_else_is_refused_before_it_is_read() {
    use std::io::{Seek, SeekFrom, Write};
    let folder = Folder::new("something_else");
    folder.prints(&format!("{RUN} -o a.jsonl --checkpoint ck"));
    // Of no length on the disk.
    let huge = |name: &str, begins: &str| {
        let mut file = fs::File::create(folder.path(name)).unwrap();
        file.write_all(begins.as_bytes()).unwrap();
        file.seek(SeekFrom::Start(8 << 30)).unwrap();
        file.write_all(b"\n").unwrap();
    };
    huge("zeros.json", "");
    huge("zeros.jsonl", "");
    huge("run.json", "{\"format\":\"stickslip/run\",\"format_version\":1,\"samples\":");
    huge("run.jsonl", "{\"format\":\"stickslip/run-lines\",\"format_version\":1,");
    huge("ck.huge", "{\"format\":\"stickslip/checkpoint\",");
    huge("table.csv", "0,1\n1,2\n");
    for line in [
        "verify /dev/zero",
        "verify zeros.json",
        "verify zeros.jsonl",
        "verify run.json",
        "verify table.csv",
        "surface /dev/zero",
        "surface run.json",
        "surface table.csv",
        "cycle --alpha 1 --from /dev/zero",
        "continue --over alpha --to 2 --from table.csv",
        "sweep merge table.csv",
        "run --resume table.csv",
        "run --resume zeros.json",
    ] {
        // What it takes is limited, for all that it reads.
        let inner = folder.command(line);
        let mut shell = std::process::Command::new("sh");
        shell.current_dir(folder.path("")).arg("-c").arg("ulimit -v 400000; exec \"$0\" \"$@\"");
        let Measured { output, took, .. } =
            measured(shell.arg(inner.get_program()).args(inner.get_args()));
        assert_eq!(output.status.code(), Some(2), "{line}: {}", said(&output));
        assert!(took < Duration::from_secs(1), "{line}: {took:?}");
    }
    for name in ["zeros.json", "zeros.jsonl", "run.json", "run.jsonl", "ck.huge", "table.csv"] {
        fs::remove_file(folder.path(name)).unwrap();
    }
}

/// The checkpoint with a part of its head replaced, its checksum right.
fn resealed(folder: &Folder, from: &str, to: &str) {
    let whole = folder.read("ck");
    let end = whole.iter().position(|b| *b == b'\n').unwrap();
    let head = String::from_utf8(whole[..end].to_vec()).unwrap();
    assert!(head.contains(from), "{head}");
    let mut bytes = head.replacen(from, to, 1).into_bytes();
    bytes.extend(&whole[end..whole.len() - 4]);
    let sum = crc32fast::hash(&bytes);
    bytes.extend(sum.to_le_bytes());
    folder.write("ck", bytes);
}

#[test]
fn what_another_arithmetic_began_is_not_gone_on_with() {
    let folder = Folder::new("arithmetic");
    folder.prints(&format!("{RUN} -o a.jsonl --checkpoint ck"));
    let head = folder.read("ck");
    let head: serde_json::Value =
        serde_json::from_slice(head.split(|b| *b == b'\n').next().unwrap()).unwrap();
    let here = head["arithmetic"].as_str().unwrap();
    resealed(&folder, here, "vax-00000000");
    folder.refuses("run --resume ck", &["--resume ck", "vax-00000000", here, "last digits"]);

    let sweep = "sweep --r 0.5:2:100 --alpha 1:2:100 -o m.json";
    let mut child = folder.command(sweep).stderr(Stdio::null()).spawn().unwrap();
    while !folder.path("m.json.partial").exists() || folder.read("m.json.partial").is_empty() {
        sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = String::from_utf8(folder.read("m.json.partial")).unwrap();
    let other = kept.replacen(here, "vax-00000000", 1);
    assert!(other != kept);
    folder.write("m.json.partial", &other);
    folder.refuses(sweep, &["m.json.partial", "vax-00000000", here, "last digits"]);
    assert_eq!(folder.read("m.json.partial"), other.as_bytes());

    for (part, name) in [("1/2", "a.json"), ("2/2", "b.json")] {
        folder.prints(&format!("sweep --r 1 --alpha 1:1.4:4 --shard {part} -o {name}"));
    }
    let part = String::from_utf8(folder.read("b.json")).unwrap();
    let elsewhere = part.replace(here, "vax-00000000");
    folder.write("b.json", &elsewhere);
    folder.refuses("sweep merge a.json b.json -o m.json", &["b.json", "was changed"]);
    // As another machine would have written it, with its checksum.
    let [mut from, _, _, to] =
        ["\"parameters\":", ",\"points\":", ",\"arithmetic\":", ",\"crc32\":"]
            .map(|key| elsewhere.rfind(key).unwrap());
    from += "\"parameters\":".len();
    let sealed = elsewhere[from..to].replacen(",\"points\":", ",", 1);
    let sealed = format!("[{}]", sealed.replacen(",\"arithmetic\":", ",", 1));
    let sum = format!("\"crc32\":{}", crc32fast::hash(sealed.as_bytes()));
    let mine = folder.json("b.json")["crc32"].as_u64().unwrap();
    folder.write("b.json", elsewhere.replace(&format!("\"crc32\":{mine}"), &sum));
    let merged = folder.stickslip("sweep merge a.json b.json -o m.json");
    assert!(said(&merged).contains("b.json was computed by a machine with different rounding"));
    assert!(folder.json("m.json")["arithmetic"].is_null());
}

/// A library that takes this for a processor without a fused multiply-add rounds otherwise, and that is noticed.
#[cfg(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64"))]
#[test]
fn a_library_with_other_variants_is_another_arithmetic() {
    if !is_x86_feature_detected!("fma") {
        return;
    }
    let folder = Folder::new("without_fma");
    folder.prints(&format!("{RUN} -o a.jsonl --checkpoint ck"));
    let tunables = "glibc.cpu.hwcaps=-FMA,-AVX2_Usable,-AVX2,-FMA4";
    let mut command = folder.command("run --resume ck");
    let output = command.env("GLIBC_TUNABLES", tunables).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).contains("last digits"), "{}", said(&output));
}
