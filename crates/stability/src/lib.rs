//! Linear stability of steady motion (section IV of the paper), and what follows from it.
//!
//! A small deviation l - l0 ∝ e^{λt} of the reduced lag l from its steady value l0 grows or decays with a root λ = rΛ of
//!
//! ```text
//!     h(Λ) = rΛ + 1 + (α/r) G(Λ) = 0,    G(Λ) = ∫_0^∞ f''(y) e^{-Λy}dy      (30)
//! ```
//!
//! [`critical`] and [`Boundary`] find where the first root reaches the imaginary axis. [`roots`] and [`leading_roots`]
//! list all roots right of a line, with a [`Certificate`] that none is missing. [`response`] is the motion after weak
//! pulses, a sum over these roots, and [`onset`] gives the oscillation that bifurcates at the boundary.
//! [`trapping_alpha`] is the threshold above which a tip may creep permanently without slipping, and [`creep`] lists
//! the possible creep rates. [`critical_r`], [`onset`], [`trapping_alpha`], [`creep`] and the curves of
//! [`Boundary::branches`] require the basic model; the other functions also accept the extended one (a depth limit,
//! healing, inertia). A tip that is flexible across the scan may [snake](Snaking), and its scan lines may bunch
//! ([`Raster::with_stiffness_across`]). [`least_depth_limit`] and [`memory_length`] give limits within which steady
//! motion is always stable. [`walking_speeds`] and [`walk`] treat a tip without a spring, and [`orbits`] treats a
//! walker in the plane. `docs/explanation/linear-theory.md` derives the theory. Nothing here integrates (18) in time,
//! so that linear theory and integration are independent tests of each other.

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
mod extent;
mod half_plane;
mod inversion;
mod kept;
mod law;
mod limits;
mod newton;
mod one_sided;
mod onset;
mod orbits;
mod raster;
mod response;
mod roots;
mod scaled_erfc;
mod snaking;
mod transform;
mod walking;
mod winding;

#[cfg(test)]
#[path = "../tests/stability/tables/mod.rs"]
mod tables;

pub use boundary::{Boundary, BoundaryBranch, critical};
pub use certificate::{Certificate, Region, Spectrum};
pub use creep::{Creep, creep, trapping_alpha};
pub use critical::{Critical, OnsetKind, critical_r};
pub use error::StabilityError;
pub use inversion::Inversion;
pub use limits::{least_depth_limit, memory_length};
pub use onset::{Criticality, Onset, onset, onset_at};
pub use orbits::{Orbit, orbits};
pub use raster::{Raster, RasterCertificate, RasterCritical, RasterKind, RasterPath};
pub use response::{Response, ResponseMode, response};
pub use roots::{certify, leading_roots, roots, unstable_count};
pub use snaking::{Snaking, SnakingCertificate, SnakingCritical};
pub use walking::{Walk, walk, walking_alpha, walking_speeds};
