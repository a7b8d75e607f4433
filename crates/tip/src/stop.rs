//! Cancellation of long computations.
//!
//! The caller of a long computation sets a flag for its own thread, which a signal handler or another thread may
//! raise. Long loops read the flag and end early with an error. The flag applies to this thread only, so that other
//! computations continue.
//!
//! ```
//! use std::sync::Arc;
//! use std::sync::atomic::AtomicBool;
//! use stickslip_tip::stop;
//!
//! let flag = Arc::new(AtomicBool::new(true));
//! assert!(stop::with_flag(&flag, stop::is_requested));
//! assert!(!stop::is_requested());
//! ```

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    static FLAG: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// Runs a computation on this thread; it ends early once the flag is raised.
pub fn with_flag<T>(flag: &Arc<AtomicBool>, work: impl FnOnce() -> T) -> T {
    /// Restores the previous flag, even after a panic.
    struct Before(Option<Arc<AtomicBool>>);
    impl Drop for Before {
        fn drop(&mut self) {
            FLAG.set(self.0.take());
        }
    }
    let _before = Before(FLAG.replace(Some(Arc::clone(flag))));
    work()
}

/// The flag of this thread, if it has one, to be shared with other threads that take part in its computation.
pub fn flag() -> Option<Arc<AtomicBool>> {
    FLAG.with_borrow(Clone::clone)
}

/// Whether the computation on this thread is to end.
pub fn is_requested() -> bool {
    FLAG.with_borrow(|flag| flag.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed)))
}
