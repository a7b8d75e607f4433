//! Tables that follow from a fit alone, made once for each fit and shared by the runs that use it.

use super::bank::Tables;
use super::fit::Fit;
use super::powers::Powers;
use std::sync::{Arc, Mutex, PoisonError};

/// Tables for the states of the exponentials.
#[derive(Debug)]
pub(crate) struct Prepared {
    pub(crate) bank: Arc<Tables>,
    pub(crate) powers: Powers,
}

/// Number of fits whose tables are kept.
const MOST: usize = 32;

impl Prepared {
    /// The tables for this fit, made at its first use.
    pub(crate) fn cached(fit: &Arc<Fit>) -> Arc<Self> {
        static CACHE: Mutex<Vec<(Arc<Fit>, Arc<Prepared>)>> = Mutex::new(vec![]);
        // A thread that panicked did not leave half an entry behind.
        let mut cache = CACHE.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = cache.iter().find(|(known, _)| Arc::ptr_eq(known, fit)) {
            return Arc::clone(known);
        }
        let powers = Powers::new(fit.terms());
        let prepared = Arc::new(Self { bank: Arc::new(Tables::new(fit)), powers });
        if cache.len() == MOST {
            cache.remove(0);
        }
        cache.push((Arc::clone(fit), Arc::clone(&prepared)));
        prepared
    }
}
