//! Work side by side on several threads.

use std::thread::{Builder, available_parallelism, scope};

/// The given number of threads; one per processor for 0.
pub fn count(given: usize) -> usize {
    match given {
        0 => available_parallelism().map_or(1, usize::from),
        given => given,
    }
}

/// Calls `work` on this number of threads, of which the calling one, whose memory is there already, is one. A thread that
/// cannot be started leaves its work to the others.
///
/// ```
/// use std::sync::atomic::{AtomicUsize, Ordering};
/// use stickslip_tip::threads::side_by_side;
///
/// let (next, sum) = (AtomicUsize::new(0), AtomicUsize::new(0));
/// side_by_side(3, || {
///     while let n @ ..100 = next.fetch_add(1, Ordering::Relaxed) {
///         sum.fetch_add(n, Ordering::Relaxed);
///     }
/// });
/// assert_eq!(sum.into_inner(), 4950);
/// ```
pub fn side_by_side(threads: usize, work: impl Fn() + Sync) {
    scope(|scope| {
        for _ in 1..threads {
            Builder::new().spawn_scoped(scope, &work).ok();
        }
        work();
    });
}
