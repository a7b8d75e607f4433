//! Scan of the lines; each is saved when finished.

use crate::commands::finished::{Finished, Parts, line_of};
use crate::commands::progress::Progress;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::session::Session;
use std::collections::HashSet;
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip::{KeptLine, Raster};
use stickslip_raster::{Line, Plan, Scanning};
use stickslip_tip::stop;

/// All lines, on this number of threads (0: one per core), including those of an interrupted raster with the same
/// output.
pub(super) fn scan(
    session: &Session,
    plan: &Plan,
    parameters: &Raster,
    file: Option<&Path>,
    interrupt: &Interrupt,
    threads: usize,
) -> Result<(Vec<Line>, Finished<KeptLine>), Failure> {
    let has = |index| index < plan.lines();
    let mut finished: Finished<KeptLine> = Finished::beside(session, file, parameters, has)?;
    let taken_up = taken_up(plan, finished.parts().clone());
    let mut scanning = Scanning::resumed(plan, taken_up).map_err(Failure::run)?;
    let kept: HashSet<usize> = finished.parts().iter().map(|line| line.index).collect();
    let (first, count) = (scanning.lines().len(), plan.lines());
    finished.announce(session, first, count);
    let scanned = Arc::new(AtomicUsize::new(first));
    finished.need_not_end(interrupt, &scanned, count);
    let mut progress = Progress::new(session, first as f64, count as f64).at_every_call();
    let (mut index, mut unkept) = (first, None);
    let is_kept = finished.path().is_some();
    let text = |n: usize, line: &Line| {
        (is_kept && !kept.contains(&n)).then(|| line_of(&KeptLine::of(n, line)))
    };
    let mut take = |_: &Line, text: Option<io::Result<Vec<u8>>>| {
        unkept = text.and_then(|text| text.and_then(|text| finished.keep(&text)).err());
        index += 1;
        scanned.store(index, Ordering::Relaxed);
        progress.counted(index as f64, || format!("{index} of {count} lines"));
        unkept.is_none()
    };
    let scan = || scanning.scan_with(threads, text, &mut take);
    if let Err(error) = stop::with_flag(interrupt.flag(), scan) {
        // A file without lines would only keep other rasters from this output.
        if index == 0 && finished.parts().is_empty() {
            finished.remove();
        }
        return Err(Failure::run(error));
    }
    if let Some(error) = unkept {
        return Err(finished.unkept(error));
    }
    if let (true, Some(signal)) = (scanning.lines().len() < count, interrupt.signal()) {
        return Err(finished.unfinished(scanning.lines().len(), count, signal));
    }
    Ok((scanning.into_lines(), finished))
}

/// The leading lines that are all finished.
fn taken_up(plan: &Plan, mut kept: Vec<KeptLine>) -> Vec<Line> {
    kept.order();
    let in_order = kept.iter().enumerate().take_while(|(n, line)| line.index == *n);
    in_order.map_while(|(_, line)| line.line(plan).ok()).collect()
}
