//! Questions whose answer is a list of points, each computed independently of the others.

use crate::{Context, Failure, Question, ShardDocument};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::threads::{count, side_by_side};

/// Groups of points per thread: some take longer than others.
const GROUPS_PER_THREAD: usize = 4;

/// A question about a grid of parameters. A point depends on its own parameters alone: points may be computed in any
/// order, in any groups and on any machine.
pub trait Points: Question + Sync {
    /// The answer at one point.
    type Point: Send;

    /// Number of points of the whole grid.
    fn points(&self) -> usize;

    /// The part of the grid that is computed; `None` for the whole.
    fn shard(&self) -> Option<ShardDocument>;

    /// The indices of the points of this part of the grid.
    fn indices(&self) -> Vec<usize> {
        self.shard().unwrap_or(ShardDocument::WHOLE).indices(self.points()).collect()
    }

    /// Index of a point.
    fn index(point: &Self::Point) -> usize;

    /// Largest number of points that gain from being computed together.
    fn together(&self) -> usize {
        1
    }

    /// Whether a point has parallel parts itself, which threads without a point of their own share.
    fn has_parallel_parts(&self) -> bool {
        false
    }

    /// Computes these points, and passes each to `take` as soon as it is complete.
    fn compute(&self, indices: &[usize], take: &mut dyn FnMut(Self::Point));

    /// The point with this index, which could not be computed for this reason.
    fn failed(&self, index: usize, why: &str) -> Self::Point;
}

fn pool(threads: usize) -> Result<ThreadPool, Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| Failure::Failed(format!("cannot start threads: {error}")))
}

/// Runs work whose parallel parts use this number of threads (0: one per core).
///
/// # Errors
/// No threads can be started.
pub fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    Ok(pool(threads)?.install(work))
}

/// Computes points on this number of threads (0 means one per core). Passes each to `keep` as soon as it is complete,
/// until `keep` returns false.
///
/// # Errors
/// The work is cancelled; or no threads can be started, of points with parallel parts.
pub fn each_point<Q: Points>(
    question: &Q,
    indices: &[usize],
    threads: usize,
    context: &Context,
    keep: impl FnMut(Q::Point) -> bool + Send,
) -> Result<(), Failure> {
    // More threads than points would have nothing to do.
    let threads = count(threads).min(indices.len().max(1));
    let groups = GROUPS_PER_THREAD * threads;
    let size = indices.len().div_ceil(groups).clamp(1, question.together());
    let begun = AtomicUsize::new(0);
    let next = || indices.chunks(size).nth(begun.fetch_add(1, Ordering::Relaxed));
    let keep = Mutex::new(keep);
    let is_kept = AtomicBool::new(true);
    let goes_on = || is_kept.load(Ordering::Relaxed) && !context.is_cancelled();
    let take = |point| {
        // A cancelled computation makes no point.
        if goes_on() && !keep.lock().unwrap_or_else(PoisonError::into_inner)(point) {
            is_kept.store(false, Ordering::Relaxed);
        }
    };
    let work = || {
        let groups = || {
            while let Some(group) = next().filter(|_| goes_on()) {
                safely(question, group, &mut |point| take(point));
            }
            Ok(())
        };
        context.keeping(groups).ok();
    };
    if question.has_parallel_parts() {
        // This thread wakes all others: one that another of them wakes may wait until the scheduler moves it to a
        // processor of its own.
        pool(threads)?.broadcast(|_| work());
    } else {
        side_by_side(threads, work);
    }
    if context.is_cancelled() { Err(Failure::Cancelled) } else { Ok(()) }
}

/// Computes these points. If a library panics, the missing points are computed one by one, and a point at which it
/// panics again gets an error.
fn safely<Q: Points>(question: &Q, indices: &[usize], take: &mut dyn FnMut(Q::Point)) {
    let mut missing = indices.to_vec();
    let mut each = |point| {
        missing.retain(|index| *index != Q::index(&point));
        take(point);
    };
    if catch_unwind(AssertUnwindSafe(|| question.compute(indices, &mut each))).is_ok() {
        return;
    }
    for index in missing {
        let alone = AssertUnwindSafe(|| question.compute(&[index], take));
        if catch_unwind(alone).is_err() {
            let why = "the computation failed for an unknown reason: please report it";
            take(question.failed(index, why));
        }
    }
}

/// All points of this part, by rising index, with progress.
pub(crate) fn all_points<Q: Points>(
    question: &Q,
    context: &Context,
) -> Result<Vec<Q::Point>, Failure> {
    let indices = question.indices();
    let mut points = Vec::with_capacity(indices.len());
    each_point(question, &indices, 0, context, |point| {
        points.push(point);
        context.counted(points.len(), indices.len(), "points").is_ok()
    })?;
    sort_by_number(&mut points, |point| Q::index(point) as f64);
    Ok(points)
}
