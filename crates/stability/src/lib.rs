//! Linear stability of steady motion (section IV of the paper), and what follows from it.
//!
//! A small deviation l - l0 ∝ e^{λt} grows or decays with a root λ = rΛ of
//!
//! ```text
//!     h(Λ) = rΛ + 1 + (α/r) G(Λ) = 0,    G(Λ) = ∫_0^∞ f''(y) e^{-Λy}dy      (30)
//! ```
//!
//! [`critical`] and [`Boundary`] find where the first root reaches the imaginary axis, [`roots`] and
//! [`leading_roots`] list all roots right of a line with a [`Certificate`] that none is missing,
//! [`response`] adds them up after a weak pulse, and [`onset`] says what is born at the boundary.
//! [`trapping_alpha`] is the threshold of motion that never returns to stick-slip, [`creep`] lists all rates at
//! which it may creep. All but these and [`onset`] take the wider law (a depth limit, healing, inertia) as well:
//! A tip that gives way across the scan may [snake](Snaking), and lines of it bunch ([`Raster::with_stiffness_across`]).
//! [`least_depth_limit`] and [`memory_length`] say what leaves nothing unstable, [`walking_speeds`] and [`walk`] what a
//! tip without a spring does. `docs/stability.md` derives all of it. Nothing here integrates (18) in time, so either
//! can judge the other.

mod axis;
mod bessel_roots;
mod boundary;
mod bounds;
mod cell;
mod certificate;
mod characteristic;
mod corner;
mod creep;
mod critical;
mod crossings;
mod error;
mod half_plane;
mod inversion;
mod kept;
mod law;
mod limits;
mod newton;
mod one_sided;
mod onset;
mod pulse;
mod raster;
mod response;
mod roots;
mod scaled_erfc;
mod snaking;
mod spectrum;
mod transform;
mod trapping;
mod walking;
mod winding;

#[cfg(test)]
#[path = "../tests/stability/tables/mod.rs"]
mod tables;

pub use boundary::{Boundary, BoundaryBranch, critical};
pub use certificate::{Certificate, Region};
pub use creep::{Creep, creep};
pub use critical::{Critical, OnsetKind, critical_r};
pub use error::StabilityError;
pub use inversion::Inversion;
pub use limits::{least_depth_limit, memory_length};
pub use onset::{Criticality, Onset, onset, onset_at};
pub use raster::{Raster, RasterCertificate, RasterCritical, RasterKind, RasterPath};
pub use response::{Response, ResponseMode, response};
pub use roots::{certify, leading_roots, roots, unstable_count};
pub use snaking::{Snaking, SnakingCertificate, SnakingCritical, SnakingCurve};
pub use spectrum::Spectrum;
pub use trapping::trapping_alpha;
pub use walking::{Walk, walk, walking_alpha, walking_speeds};
