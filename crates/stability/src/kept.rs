//! Cache of results that depend on a footprint alone and take long to compute, shared by all threads.

use std::sync::Arc;
use stickslip_tip::cache::Cache;
use stickslip_tip::{TipFunction, stop};

/// Number of footprints in the cache, the most recently used ones.
const MOST: usize = 4;

/// Results of a function of a footprint, for the most recent footprints.
pub(super) struct Kept<T>(Cache<TipFunction, Arc<T>>);

impl<T> Kept<T> {
    pub(super) const fn new() -> Self {
        Self(Cache::new(MOST))
    }

    /// The result for this footprint, equal to that of `make`.
    pub(super) fn of(&self, tip: &TipFunction, make: impl FnOnce() -> T) -> Arc<T> {
        if let Some(made) = self.0.get(|known| known == tip) {
            return made;
        }
        let made = Arc::new(make());
        // A cancelled computation may be unfinished.
        if !stop::is_requested() {
            self.0.keep(tip.clone(), Arc::clone(&made));
        }
        made
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn what_was_asked_for_last_is_kept_and_nothing_unfinished() {
        let kept = Kept::new();
        let tip = |i: u32| TipFunction::gaussian(1.0 + f64::from(i)).unwrap();
        let made = std::cell::Cell::new(0);
        let make = |i: u32| {
            made.set(made.get() + 1);
            i
        };
        let of = |i: u32| *kept.of(&tip(i), || make(i));
        for i in [0, 1, 2, 3, 0, 4, 0, 3] {
            assert_eq!(of(i), i);
        }
        // 1 made room for 4.
        assert_eq!(made.get(), 5);
        assert_eq!((of(0), of(1), made.get()), (0, 1, 6));
        let flag = Arc::new(AtomicBool::new(true));
        stop::with_flag(&flag, || of(9));
        assert_eq!((of(9), made.get()), (9, 8));
    }
}
