//! A command watched while it works, by a terminal of its own, by its processor time and by its size.

use crate::folder::{Folder, processor_time};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use std::fs::{File, OpenOptions};
use std::io::Read;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};
use wait4::Wait4;

/// Of the processor; where debug assertions are on, everything takes several times as long.
const SOON: Duration = Duration::from_millis(if cfg!(debug_assertions) { 8000 } else { 2000 });
/// Of the processor too, of each of two threads, and the clock's grain.
const AT_ONCE: Duration = Duration::from_millis(if cfg!(debug_assertions) { 1700 } else { 450 });
const ROOM: u64 = 256 << 20;
/// Of address space, in kB: what would fill the machine ends.
const MOST: u64 = 8_000_000;
/// A command that takes no processor time and does not end hangs.
const LONGEST: Duration = Duration::from_secs(120);

/// How a command ended.
#[derive(Debug)]
pub(super) struct Ended {
    status: ExitStatus,
    took: Duration,
    peak: u64,
    said: String,
    /// Bytes on standard output.
    written: u64,
    /// Of one that took long.
    interrupted: Option<Interrupted>,
}

#[derive(Debug)]
struct Interrupted {
    showed_progress: bool,
    /// Until it ended: of the processor, and by the clock.
    took: Duration,
    elapsed: Duration,
}

impl Ended {
    pub(super) fn told(&self) -> &'static str {
        match (&self.interrupted, self.status.code()) {
            (Some(_), _) => "interrupted",
            (None, Some(0)) => "done",
            (None, Some(2)) => "refused",
            (None, Some(_)) => "failed",
            (None, None) => "killed",
        }
    }

    pub(super) fn wrong(&self) -> Option<String> {
        let code = self.status.code();
        if self.said.contains("panicked") {
            return Some("panic".into());
        }
        if self.peak > ROOM {
            return Some(format!("{} MB", self.peak >> 20));
        }
        if let Some(Interrupted { showed_progress, took, elapsed }) = &self.interrupted {
            return match code {
                _ if !showed_progress => Some("no progress shown".into()),
                _ if *took > AT_ONCE => {
                    Some(format!("ended {took:.2?} ({elapsed:.2?}) after SIGINT"))
                }
                Some(0..=2 | 130) => None,
                _ => Some(format!("{:?}", self.status)),
            };
        }
        match code {
            _ if self.took > SOON => Some(format!("took {:.1?}", self.took)),
            Some(0) => None,
            Some(1 | 2) if self.said.trim().is_empty() => Some("not a word".into()),
            Some(2) if self.written > 0 => Some("wrote to standard output".into()),
            Some(1..=3) => None,
            _ => Some(format!("{:?}", self.status)),
        }
    }
}

/// Starts `stickslip` with these words and waits for its end, or brings it about.
pub(super) fn watched(folder: &Folder, words: &[String]) -> Ended {
    let (mut master, slave) = terminal();
    let stdout = tempfile::tempfile().unwrap();
    let inner = folder.command("");
    let mut shell = Command::new("sh");
    let script = format!("ulimit -v {MOST}; ulimit -c 0; exec \"$0\" \"$@\"");
    shell.current_dir(folder.path("")).arg("-c").arg(script).arg(inner.get_program()).args(words);
    shell.stdin(Stdio::null()).stdout(stdout.try_clone().unwrap()).stderr(slave);
    let mut child = shell.spawn().unwrap();
    // The terminal is closed here, and with the command it ends.
    drop(shell);
    let id = child.id();
    let is_quiet = words.iter().any(|word| word == "--quiet");
    let (said, heard) = channel();
    thread::spawn(move || {
        let mut bytes = [0; 4096];
        while let Ok(count @ 1..) = master.read(&mut bytes) {
            said.send(bytes[..count].to_vec()).unwrap_or_default();
        }
    });
    let (end, ended) = channel();
    thread::spawn(move || end.send(child.wait4().unwrap()));
    let started = Instant::now();
    let (mut told, mut interrupted) = (vec![], None);
    let usage = loop {
        match ended.recv_timeout(Duration::from_millis(10)) {
            Ok(usage) => break usage,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => unreachable!("it waits"),
        }
        told.extend(heard.try_iter().flatten());
        let (took, elapsed) = (processor_time(id).unwrap_or_default(), started.elapsed());
        if interrupted.is_none() && (took > SOON || elapsed > LONGEST) {
            // A bar is shown after a second.
            let progress = is_quiet || told.windows(2).any(|bytes| bytes == b"\x1b[");
            interrupted = Some((progress, took, Instant::now()));
            signal("-INT", id);
        }
        if interrupted.as_ref().is_some_and(|(.., at)| at.elapsed() > LONGEST / 4) {
            signal("-KILL", id);
        }
    };
    let took = usage.rusage.utime + usage.rusage.stime;
    told.extend(heard.iter().flatten());
    Ended {
        status: usage.status,
        took,
        peak: usage.rusage.maxrss,
        said: String::from_utf8_lossy(&told).into_owned(),
        written: stdout.metadata().unwrap().len(),
        interrupted: interrupted.map(|(showed_progress, before, at)| Interrupted {
            showed_progress,
            took: took.saturating_sub(before),
            elapsed: at.elapsed(),
        }),
    }
}

fn signal(name: &str, id: u32) {
    Command::new("kill").args([name, &id.to_string()]).stderr(Stdio::null()).status().unwrap();
}

/// Both ends of a terminal.
fn terminal() -> (File, File) {
    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
    grantpt(&master).unwrap();
    unlockpt(&master).unwrap();
    let name = ptsname(&master, vec![]).unwrap().into_string().unwrap();
    let slave = OpenOptions::new().read(true).write(true).open(name).unwrap();
    (File::from(master), slave)
}
