//! A signal at any moment: from the start of the program on it is heard, whatever the work is at, be it the fit of a
//! large table, its linear theory, eigenvalues, or the judgement of a run. Judged by the processor time that a command
//! still takes.

use crate::folder::{Folder, processor_time, wait_until_it_listens};
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;
use wait4::Wait4;

/// 0.2 s, the grain of the clock, and where debug assertions are on several times as much.
const AT_ONCE: Duration = Duration::from_millis(if cfg!(debug_assertions) { 900 } else { 230 });
/// Of fewer signals than these all may be too late.
const FEW: usize = 12;
const LINES: [&str; 6] = [
    "continue --tip-file tip.csv --r 1 --over alpha --tolerance 1e-6 -o out.json",
    "cycle --tip-file tip.csv --r 1 --alpha 2.67 --tolerance 1e-6 -o out.json",
    "run --tip-file tip.csv --r 1 --alpha 2.67 --kick 0.3 --until 60 --tolerance 1e-7 -o out.json",
    "sweep --tip-file tip.csv --r 1 --alpha 1.9:2.67:40 --tolerance 1e-6 --threads 1 -o out.json",
    "stability --tip-file tip.csv --r 1 --alpha 2.67 --roots 500 -o out.json",
    "boundary --tip-file tip.csv --r-range 0.2:2:4000 -o out.json",
];

/// At random moments of the first `longest` milliseconds of processor time.
fn signalled(each: usize, seed: u64, longest: u64) {
    let folder = Folder::new(&format!("signalled_{seed}"));
    // Not a sum of Gaussians, whose fits are over before a signal comes.
    let row = |i: i32| {
        let x = 0.0077 * f64::from(i);
        format!("{x},{}\n", (-x * x * x / 3.0).exp())
    };
    folder.write("tip.csv", (0..1204).map(row).collect::<String>());
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for line in LINES {
        let (mut over, mut slowest) = (0, Duration::ZERO);
        for _ in 0..each {
            let moment = Duration::from_millis(rng.random_range(0..longest));
            match after_signal(&folder, line, moment) {
                None => over += 1,
                Some(took) => {
                    slowest = slowest.max(took);
                    assert!(took < AT_ONCE, "{line}: at {moment:?} SIGINT took {took:?}");
                }
            }
            let left = folder.names().into_iter().filter(|name| name != "tip.csv");
            left.for_each(|name| std::fs::remove_file(folder.path(&name)).unwrap());
        }
        println!("{line}: {each} signals, {over} too late, at most {slowest:?}");
        assert!(over < each || each < FEW, "{line} is always over");
    }
}

/// What a command takes of the processor after a signal at this moment of its own; `None` if it was over before.
fn after_signal(folder: &Folder, line: &str, moment: Duration) -> Option<Duration> {
    let mut child = folder.command(line);
    let mut child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    wait_until_it_listens(&mut child);
    let id = child.id();
    let before = loop {
        if child.try_wait().unwrap().is_some() {
            return None;
        }
        let took = processor_time(id).unwrap_or_default();
        if took >= moment {
            break took;
        }
        sleep(Duration::from_millis(5));
    };
    Command::new("kill").args(["-INT", &id.to_string()]).stderr(Stdio::null()).status().unwrap();
    let ended = child.wait4().unwrap();
    if ended.status.code() == Some(0) {
        return None;
    }
    assert_eq!(ended.status.code(), Some(130), "{line}: at {moment:?}");
    Some((ended.rusage.utime + ended.rusage.stime).saturating_sub(before))
}

#[test]
fn a_signal_is_heard_at_any_moment() {
    signalled(1, 1, 1000);
}

#[test]
#[ignore = "240 signals take minutes: make survive"]
fn two_hundred_and_forty_signals_are_heard() {
    signalled(40, 2, 3000);
}
