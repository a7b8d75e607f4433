//! What the page computes at most.

/// Time to which a page runs: the history of a fast motion takes some 100 MB then.
pub(crate) const MOST_TIME: f64 = 20_000.0;
/// Lines that a page has the patience for.
pub(crate) const MOST_LINES: usize = 400;
/// Milliseconds that a run may take: then it is cut off, and says so.
pub(crate) const MOST_MILLISECONDS: f64 = 4_000.0;
