//! How long work is told that nobody waits for it any more.
//!
//! Whoever starts long work on this thread lends it a flag, which a signal handler or another thread may raise;
//! loops that may be long look at it, and end early as if they had failed. It is the thread's own, so that the
//! work of others goes on.
//!
//! ```
//! use std::sync::Arc;
//! use std::sync::atomic::AtomicBool;
//! use stickslip_tip::stop;
//!
//! let flag = Arc::new(AtomicBool::new(true));
//! assert!(stop::where_asked_by(&flag, stop::is_asked));
//! assert!(!stop::is_asked());
//! ```

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    static FLAG: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// Does some work on this thread, that ends early once the flag is raised.
pub fn where_asked_by<T>(flag: &Arc<AtomicBool>, work: impl FnOnce() -> T) -> T {
    /// Puts back what was there before, even where the work panics.
    struct Before(Option<Arc<AtomicBool>>);
    impl Drop for Before {
        fn drop(&mut self) {
            FLAG.set(self.0.take());
        }
    }
    let _before = Before(FLAG.replace(Some(Arc::clone(flag))));
    work()
}

/// The flag lent to this thread, for it to lend to others that share its work.
#[must_use]
pub fn flag() -> Option<Arc<AtomicBool>> {
    FLAG.with_borrow(Clone::clone)
}

/// Whether the work under way on this thread is to end.
#[must_use]
pub fn is_asked() -> bool {
    FLAG.with_borrow(|flag| flag.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed)))
}
