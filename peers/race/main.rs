//! The contestants of the race that are in Rust: our memories, our grids, and the delay solver of the
//! crate differential-equations. `peers/race.py` runs it and the others, and makes the table.
//!
//! `race reference` prints the case and its reference solution, `race rows` a row per contestant and
//! setting: seconds, largest error of l, and the span of time that was run. `race embedded` and `race embedded-rows` do the
//! same for those who know the embedding.

mod case;
mod delay_crate;
mod embedded;
mod grids;
mod memories;

use case::Reference;
use serde_json::{Value, json};
use std::time::Instant;

fn main() {
    let reference = Reference::new();
    let document = match std::env::args().nth(1).as_deref() {
        Some("reference") => reference.document(),
        Some("rows") => {
            let mut rows = memories::rows(&reference);
            rows.extend(delay_crate::rows(&reference));
            rows.extend(grids::rows(&reference));
            Value::Array(rows)
        }
        Some("embedded") => embedded::document(),
        Some("embedded-rows") => Value::Array(embedded::rows()),
        _ => panic!("usage: race reference|rows|embedded|embedded-rows"),
    };
    println!("{document}");
}

/// A row of the table.
fn row(contestant: &str, setting: String, seconds: f64, error: Option<f64>, remark: &str) -> Value {
    eprintln!("{contestant}, {setting}: {seconds:.3e} s, error {error:?}");
    json!({
        "contestant": contestant, "setting": setting, "seconds": seconds, "error": error,
        "span": case::UNTIL - case::scenario(stickslip_tip::MemoryChoice::Auto, 1e-9).start_time(),
        "remark": remark,
    })
}

/// What `work` returns, and the time of one of as many runs as half a second of the processor allows, at
/// least one, at most a thousand: the shortest, or the processor's time on average if that is less, as it
/// is where other work interrupts.
fn timed<T>(mut work: impl FnMut() -> T) -> (T, f64) {
    let (begun, before) = (Instant::now(), processor_seconds());
    let (mut best, mut count) = (f64::INFINITY, 0);
    loop {
        let clock = Instant::now();
        let result = work();
        best = best.min(clock.elapsed().as_secs_f64());
        count += 1;
        let spent = processor_seconds().zip(before).map(|(after, before)| after - before);
        let spent = spent.unwrap_or(begun.elapsed().as_secs_f64());
        // The processor's clock may lag by some milliseconds.
        if count == 1000 && spent < 0.1 {
            return (result, best);
        }
        if count == 1000 || spent > 0.5 {
            return (result, best.min(spent / f64::from(count)));
        }
    }
}

/// Seconds that this thread has spent on a processor, where the system reports it.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(1e-9 * nanoseconds)
}
