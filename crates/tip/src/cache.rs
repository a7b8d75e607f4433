//! Results that are kept for later callers.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// The latest results of one computation, for all threads.
pub struct Cache<K, V> {
    most: usize,
    known: Mutex<Vec<(K, V)>>,
}

impl<K, V: Clone> Cache<K, V> {
    /// An empty cache for this number of results.
    pub const fn new(most: usize) -> Self {
        Self { most, known: Mutex::new(vec![]) }
    }

    /// The result with this key.
    pub fn get(&self, is_key: impl Fn(&K) -> bool) -> Option<V> {
        let mut known = self.lock();
        let at = known.iter().position(|(key, _)| is_key(key))?;
        known[at..].rotate_left(1);
        known.last().map(|(_, value)| value.clone())
    }

    /// Keeps a result, in place of the one that was not asked for the longest if the cache is full.
    pub fn keep(&self, key: K, value: V) {
        let mut known = self.lock();
        if known.len() == self.most {
            known.remove(0);
        }
        known.push((key, value));
    }

    fn lock(&self) -> MutexGuard<'_, Vec<(K, V)>> {
        // A thread that panicked did not leave half an entry behind.
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
