//! Scan of the lines; each is saved when finished.

use crate::commands::finished::{Finished, Parts};
use crate::commands::progress::Progress;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use std::collections::HashSet;
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip::{KeptLine, Raster};
use stickslip_raster::{Line, Plan, Scanning};
use stickslip_tip::stop;

/// All lines, including those of an interrupted raster with the same output.
pub(super) fn scan(
    plan: &Plan,
    parameters: &Raster,
    file: Option<&Path>,
    interrupt: &Interrupt,
) -> Result<(Vec<Line>, Finished<KeptLine>), Failure> {
    let mut finished: Finished<KeptLine> = match file {
        Some(file) => Finished::beside(file, parameters, |index| index < plan.lines())?,
        None => Finished::in_memory(),
    };
    let failed = |error: stickslip_raster::RasterError| Failure::Run(error.to_string());
    let mut scanning =
        Scanning::resumed(plan, taken_up(plan, finished.parts().clone())).map_err(failed)?;
    let kept: HashSet<usize> = finished.parts().iter().map(|line| line.index).collect();
    let (first, count) = (scanning.lines().len(), plan.lines());
    if let (Some(path), true) = (finished.path(), first > 0) {
        remark(format_args!("stickslip: {first} of {count} lines are in {}", path.display()));
    }
    let scanned = Arc::new(AtomicUsize::new(first));
    {
        // All that is scanned is in a file, or nowhere: whatever this is at, it need not come to an end.
        let (done, path) = (Arc::clone(&scanned), finished.path().map(Path::to_owned));
        interrupt.or_else(move |signal| {
            unfinished(done.load(Ordering::Relaxed), count, path.as_deref(), signal)
        });
    }
    let mut progress = Progress::new(first as f64, count as f64).at_every_call();
    for index in first..count {
        let next = || scanning.next_line().map(|line| line.is_some());
        let is_scanned = stop::where_asked_by(interrupt.flag(), next).map_err(failed)?;
        if let (false, Some(signal)) = (is_scanned, interrupt.signal()) {
            return Err(unfinished(index, count, finished.path(), signal));
        }
        if !kept.contains(&index) {
            let line = KeptLine::of(index, &scanning.lines()[index]);
            finished.keep(&line).map_err(|error: io::Error| {
                let target =
                    finished.path().map_or("memory".into(), |path| path.display().to_string());
                Failure::Write { target, error }
            })?;
        }
        scanned.store(index + 1, Ordering::Relaxed);
        progress.counted(index as f64 + 1.0, || format!("{} of {count} lines", index + 1));
    }
    Ok((scanning.into_lines(), finished))
}

/// The leading lines that are all finished.
fn taken_up(plan: &Plan, mut kept: Vec<KeptLine>) -> Vec<Line> {
    kept.order();
    let in_order = kept.iter().enumerate().take_while(|(n, line)| line.index == *n);
    in_order.map_while(|(_, line)| line.line(plan).ok()).collect()
}

fn unfinished(done: usize, count: usize, path: Option<&Path>, signal: u8) -> Failure {
    let message = match path {
        Some(path) => format!(
            "{done} of {count} lines are in {}: the same command continues from there",
            path.display()
        ),
        None => format!(
            "{done} of {count} lines were scanned and none are kept: -o FILE.json would keep them"
        ),
    };
    Failure::Unfinished { signal, message }
}
