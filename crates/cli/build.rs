//! How the program is linked.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let of_target = |name| env::var(format!("CARGO_CFG_TARGET_{name}")).unwrap_or_default();
    // A user who asks the compiler for static libraries gets them from it.
    let is_static = of_target("FEATURE").split(',').any(|feature| feature == "crt-static");
    if of_target("OS") == "linux" && of_target("ENV") == "gnu" && !is_static {
        // At a fixed address: a fifth of the time to start went to 23,000 addresses that a movable program fills in.
        println!("cargo:rustc-link-arg-bins=-no-pie");
        // With the system's libraries inside: to look for three of them, and to connect them, takes half a millisecond,
        // as long as all the rest of the start. (`-C target-feature=+crt-static` does it too, but no manifest can
        // contain it, and where the static libraries are missing the program would not link at all.)
        for argument in static_libraries().into_iter().flatten() {
            println!("cargo:rustc-link-arg-bins={argument}");
        }
    }
}

/// The names under which the standard library of Rust links to the system, and the static library for each.
const LIBRARIES: [(&str, &str); 7] = [
    ("gcc_s", "gcc_eh"),
    ("c", "c"),
    ("m", "m"),
    ("rt", "rt"),
    ("pthread", "pthread"),
    ("util", "util"),
    ("dl", "dl"),
];

/// The arguments with which the linker takes static libraries; `None` where they are missing, where a program linked
/// with them does not run, for another machine, or with another linker.
fn static_libraries() -> Option<[String; 2]> {
    if env::var("HOST") != env::var("TARGET") || env::var_os("RUSTC_LINKER").is_some() {
        return None;
    }
    let folder = PathBuf::from(env::var_os("OUT_DIR")?).join("static");
    fs::create_dir_all(&folder).ok()?;
    for (name, library) in LIBRARIES {
        let file = found(&format!("lib{library}.a"))?;
        println!("cargo:rerun-if-changed={}", file.display());
        // The linker looks into this folder first: a name in it stands before the shared library of that name.
        fs::write(folder.join(format!("lib{name}.a")), format!("INPUT({})\n", file.display()))
            .ok()?;
    }
    let arguments = ["-static".into(), format!("-L{}", folder.display())];
    runs(&folder, &arguments).unwrap_or(false).then_some(arguments)
}

/// Where the linker finds this file.
fn found(file: &str) -> Option<PathBuf> {
    let output = Command::new("cc").arg(format!("-print-file-name={file}")).output().ok()?;
    let path = PathBuf::from(String::from_utf8(output.stdout).ok()?.trim());
    path.is_absolute().then_some(path).filter(|path| path.is_file())
}

/// Whether a program that is linked like this runs: with threads, a panic that is caught, and a function of the library
/// of mathematics.
fn runs(folder: &Path, arguments: &[String]) -> io::Result<bool> {
    let (source, program) = (folder.join("trial.rs"), folder.join("trial"));
    let text = "fn main() {
        let thread = std::thread::spawn(|| assert!(std::env::args().count() == 0));
        assert!(thread.join().is_err());
        println!(\"{}\", (std::env::args().count() as f64).sin());
    }";
    fs::write(&source, text)?;
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let flags = env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default();
    let flags = flags.split('\u{1f}').filter(|flag| !flag.is_empty());
    let linked = Command::new(rustc)
        .args(flags)
        .args(["--edition=2024", "-Clink-arg=-no-pie"])
        .args(arguments.iter().map(|argument| format!("-Clink-arg={argument}")))
        .args([source.as_os_str(), "-o".as_ref(), program.as_os_str()])
        .output()?;
    let ran = Command::new(&program).output()?;
    Ok(linked.status.success() && ran.status.success() && ran.stdout.starts_with(b"0.84147098"))
}
