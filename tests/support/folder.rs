//! The program as a user drives it: command lines, each in a folder with its files.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]

use assert_cmd::cargo::{cargo_bin, cargo_bin_cmd};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::io::{Read, Seek};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::{Mutex, PoisonError};
use std::thread::{JoinHandle, sleep, spawn};
use std::time::{Duration, Instant};
use wait4::Wait4;

/// Bad input is found out within this processor time.
const REFUSAL: Duration = Duration::from_secs(1);
/// No command line of these tests takes longer, on whatever machine: what does hangs.
const LONGEST: Duration = Duration::from_secs(60);

/// What a command said, and what it took.
pub struct Measured {
    pub output: Output,
    /// Of the processor.
    pub took: Duration,
    /// Largest resident set, in bytes.
    pub peak: u64,
}

/// A command run to its end.
pub fn measured(command: &mut Command) -> Measured {
    let files = ["out", "err"].map(|_| tempfile::tempfile().unwrap());
    let [stdout, stderr] = files.each_ref().map(|file| file.try_clone().unwrap());
    let mut child = command.stdin(Stdio::null()).stdout(stdout).stderr(stderr).spawn().unwrap();
    let ended = child.wait4().unwrap();
    let [stdout, stderr] = files.map(|mut file| {
        let mut bytes = vec![];
        file.rewind().and_then(|()| file.read_to_end(&mut bytes)).unwrap();
        bytes
    });
    let (took, peak) = (ended.rusage.utime + ended.rusage.stime, ended.rusage.maxrss);
    Measured { output: Output { status: ended.status, stdout, stderr }, took, peak }
}

/// A folder under the target directory, empty at first.
pub struct Folder(PathBuf);

/// The folders of the tests of this process, which run side by side.
static TAKEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

impl Folder {
    pub fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let is_new = TAKEN.lock().unwrap_or_else(PoisonError::into_inner).insert(path.clone());
        assert!(is_new, "another test has the folder {name}");
        if path.exists() {
            fs::remove_dir_all(&path).unwrap();
        }
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        fs::write(self.path(name), contents).unwrap();
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }

    /// Names of all files, sorted.
    pub fn names(&self) -> Vec<String> {
        let name = |entry: fs::DirEntry| entry.file_name().into_string().unwrap();
        let mut names: Vec<_> = fs::read_dir(&self.0).unwrap().map(|e| name(e.unwrap())).collect();
        names.sort();
        names
    }

    /// `stickslip` with the words of `line`, its working directory here.
    pub fn stickslip(&self, line: &str) -> Output {
        self.stickslip_reading(line, "")
    }

    /// The same, given `input` on its standard input.
    pub fn stickslip_reading(&self, line: &str, input: impl Into<Vec<u8>>) -> Output {
        let mut command = cargo_bin_cmd!("stickslip");
        command.current_dir(&self.0).args(line.split_whitespace());
        command.write_stdin(input).timeout(LONGEST).output().unwrap()
    }

    /// The same, and the processor time that it took, which no other work on the machine adds to.
    pub fn stickslip_timed(&self, line: &str) -> (Output, Duration) {
        let Measured { output, took, .. } = measured(&mut self.command(line));
        (output, took)
    }

    /// The same, but the system ends it after a limit of processor time, in seconds.
    #[cfg(unix)]
    pub fn measured_within(&self, line: &str, seconds: u64) -> Measured {
        let inner = self.command(line);
        let mut shell = Command::new("sh");
        let script = format!("ulimit -t {seconds}; exec \"$0\" \"$@\"");
        shell.current_dir(&self.0).arg("-c").arg(script);
        measured(shell.arg(inner.get_program()).args(inner.get_args()))
    }

    /// A command for those tests that watch the program while it runs.
    pub fn command(&self, line: &str) -> Command {
        let mut command = Command::new(cargo_bin!("stickslip"));
        command.current_dir(&self.0).args(line.split_whitespace());
        command
    }

    /// What `stickslip` prints, once it has ended well.
    pub fn prints(&self, line: &str) -> Vec<u8> {
        let output = self.stickslip(line);
        let said = said(&output);
        assert!(output.status.success(), "{line}\n{said}");
        output.stdout
    }

    /// As JSON.
    pub fn prints_json(&self, line: &str) -> Value {
        serde_json::from_slice(&self.prints(line)).unwrap()
    }

    /// Unusable input: status 2, a message with all of `words`, nothing on standard output, at once.
    pub fn refuses(&self, line: &str, words: &[&str]) {
        let (output, took) = self.stickslip_timed(line);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(2), "{line}\n{said}");
        assert!(output.stdout.is_empty(), "{line}\nwrote to standard output");
        assert!(took < REFUSAL, "{line}\ntook {took:?}");
        for word in words {
            assert!(said.contains(word), "{line}\nsaid nothing of {word:?}:\n{said}");
        }
    }
}

/// What a child says once it has a signal, and what it still has of the processor until it ends.
pub fn ended_by(signal: &str, mut child: Child) -> (Output, Duration) {
    let (before, sent) = (processor_time(child.id()).unwrap_or_default(), Instant::now());
    Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    fn reader(pipe: Option<impl Read + Send + 'static>) -> JoinHandle<Vec<u8>> {
        spawn(move || {
            let mut bytes = vec![];
            pipe.map(|mut pipe| pipe.read_to_end(&mut bytes).unwrap());
            bytes
        })
    }
    let (stdout, stderr) = (reader(child.stdout.take()), reader(child.stderr.take()));
    let ended = child.wait4().unwrap();
    let [stdout, stderr] = [stdout, stderr].map(|reader| reader.join().unwrap());
    assert!(sent.elapsed() < LONGEST, "it waited, {:?} long", sent.elapsed());
    let output = Output { status: ended.status, stdout, stderr };
    (output, (ended.rusage.utime + ended.rusage.stime).saturating_sub(before))
}

/// What a process that goes on has had of the processor, where the system tells: in hundredths of a second.
pub fn processor_time(id: u32) -> Option<Duration> {
    let stat = fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
    // Behind the name, which may hold anything.
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut ticks = || fields.next()?.parse::<u64>().ok();
    Some(Duration::from_millis(10 * (ticks()? + ticks()?)))
}

/// Waits until a process listens for SIGINT and has been at its work for a while; where the system does not tell, for
/// half a second.
pub fn wait_until_it_listens(child: &mut Child) {
    const SIGINT: u64 = 1 << 1;
    const AT_WORK: Option<Duration> = Some(Duration::from_millis(60));
    let started = Instant::now();
    let caught = |status: &str| {
        let line = status.lines().find_map(|line| line.strip_prefix("SigCgt:"))?;
        u64::from_str_radix(line.trim(), 16).ok()
    };
    while child.try_wait().unwrap().is_none() && started.elapsed() < LONGEST {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id()));
        match status.ok().as_deref().and_then(caught) {
            Some(signals) if signals & SIGINT != 0 && processor_time(child.id()) >= AT_WORK => {
                return;
            }
            Some(_) => sleep(Duration::from_millis(5)),
            None => return sleep(Duration::from_millis(500)),
        }
    }
}

/// Standard error, on which no panic is ever seen.
pub fn said(output: &Output) -> String {
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(!said.contains("panicked"), "{said}");
    said
}
