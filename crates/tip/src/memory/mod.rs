//! All that the past does to the tip: the groove that it left.
//!
//! A memory has two verbs: it is told of visits, where the tip was and for how long, and tells the groove
//! about a place: height, slope and curvature of ∫ f(x - x0(t'))dt'. (Where the surface heals, a third lets
//! all of it fade.) It is indifferent to time: what the tip
//! left at a distance beyond the reach of f is out of sight, what it left nearby is never forgotten.
//!
//! Three sums give the groove: `direct`, the definition; `fft`, a convolution; `modes`, a few exponentials.
//! [`Policy`] decides between them, and holds the one record of the past that each of them is made from.

mod choice;
mod derivatives;
mod direct;
mod fft;
mod groove;
mod modes;
mod policy;
mod record;
mod report;

pub use choice::{CROSSOVER_NODES, CROSSOVER_STEPS, MemoryChoice};
pub use derivatives::{Derivatives, ROOM, SteadyPast};
pub use groove::{Groove, Memory, longest_look};
pub(crate) use modes::Powers;
pub use modes::{Fit, FitCertificate, FitError, Retreat, Term, accuracy_needed, displacement};
pub(crate) use modes::{HIGHEST_DEGREE, LOWEST_DEGREE, expansion_lengths};
pub use policy::Policy;
pub use report::{MemoryReport, Sum};
