//! Memories: algorithms for the groove, the history integral of the footprint.
//!
//! A memory has two main operations. `remember` adds positions of the tip with the time spent at each. `groove`
//! evaluates height, slope and curvature of ∫ f(x - x0(t'))dt' at points near the tip. If the surface heals, `fade`
//! multiplies all weights by a factor. The groove depends on distances, not on ages: positions beyond the reach of f
//! have no effect, and positions within it count at any age.
//!
//! Three algorithms compute the groove: `direct`, the definition; `fft`, a convolution; `modes`, a sum of a few
//! exponentials. [`Policy`] chooses one of them and owns the history buffer from which each of them is built.

mod choice;
mod derivatives;
mod direct;
mod fading;
mod fft;
mod groove;
mod modes;
mod policy;
mod record;
mod report;

pub use choice::{CROSSOVER_NODES, CROSSOVER_STEPS, MemoryChoice};
pub use derivatives::{Derivatives, ROOM, SteadyPast};
pub use direct::{POINTS, slopes_of};
pub(crate) use fading::Fading;
pub(crate) use fft::Fft;
pub use groove::{Groove, longest_look};
pub(crate) use modes::{
    ExpandedPart, FINEST_OF_SWINGING, HIGHEST_DEGREE, LOWEST_DEGREE, Prepared, TERMS, Terms,
    expansion_lengths,
};
pub use modes::{Fit, FitCertificate, FitError, Retreat, Term, accuracy_needed, displacement};
pub use policy::Policy;
pub(crate) use record::Record;
pub use report::{MemoryReport, Sum};
