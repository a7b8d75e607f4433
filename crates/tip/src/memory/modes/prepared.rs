//! Tables that follow from a fit alone, made once for each fit and shared by the runs that use it.

use super::bank::Tables;
use super::fit::Fit;
use super::powers::Powers;
use crate::cache::Cache;
use std::sync::Arc;

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
        static CACHE: Cache<Arc<Fit>, Arc<Prepared>> = Cache::new(MOST);
        CACHE.get(|known| Arc::ptr_eq(known, fit)).unwrap_or_else(|| {
            let powers = Powers::new(fit.terms());
            let prepared = Arc::new(Self { bank: Arc::new(Tables::new(fit)), powers });
            CACHE.keep(Arc::clone(fit), Arc::clone(&prepared));
            prepared
        })
    }
}
