//! Sums of one kernel over scattered sources, at a cost per source and per target that does not
//! depend on their number:
//!
//! ```text
//! S(x) = Σ_j w_j K(x − y_j)
//! ```
//!
//! **Domain.** `K` is real and effectively band limited: its transform is below round-off for wavenumbers above
//! [`Kernel::band`]. It need not be even or odd, and need not decay.
//!
//! **Method.** A non-uniform fast Fourier transform and its inverse. Each source is spread over the sixteen nearest
//! cells of a uniform lattice with a smooth [`Window`] φ ([`Density`]); the lattice is transformed, multiplied by
//! `K̂/φ̂²` and transformed back ([`Convolver`]); each target is evaluated from sixteen cells with the same window
//! ([`Field`]). The lattice is twice as fine as the bandwidth requires, so that aliasing by the window is at
//! round-off.
//!
//! **Guarantee.** Errors are below `2e-14 Σ|w| max|K|`, and those of the derivative below `2e-14 Σ|w| max|K'|`, for
//! any number of sources, coinciding ones included. The tests of this crate reach 1.2e-15 and 1e-14 for one source,
//! and less for many. The error is relative to `Σ|w|`: cancellation of terms loses digits, as in [`direct_sum`].
//!
//! **Limits.** Memory and time also grow with the extent of sources and targets over the spacing, because every cell
//! between the first and the last is stored. For a few thousand pairs [`direct_sum`] is cheaper.
//!
//! **Source.** A. H. Barnett, J. Magland, L. af Klinteberg, A parallel nonuniform fast Fourier
//! transform library based on an "exponential of semicircle" kernel, SIAM J. Sci. Comput. 41
//! (2019) C479, <https://doi.org/10.1137/18M120885X>.
//!
//! ```
//! use stickslip_convolution::{Kernel, direct_sum, sum};
//!
//! let kernel = Kernel { value: &|x: f64| (-x * x / 2.0).exp(), band: 8.7, reach: Some(8.7) };
//! let sources: Vec<f64> = (0..1000).map(|j| 0.1 * j as f64).collect();
//! let weights = vec![0.1; 1000];
//! let targets = [-1.0, 50.03, 99.0];
//! let fast = sum(&kernel, &sources, &weights, &targets);
//! let slow = direct_sum(&kernel, &sources, &weights, &targets);
//! for (f, s) in fast.iter().zip(&slow) {
//!     assert!((f - s).abs() < 2e-14 * 100.0); // Σ|w| = 100, max|K| = 1
//! }
//! ```

mod convolver;
mod density;
mod expander;
mod field;
mod kernel;
mod lattice;
mod plan;
mod rows;
mod spectra;
mod sum;
mod transforms;
mod window;

pub use convolver::Convolver;
pub use density::Density;
pub use expander::{Expander, PowerSeries, TERMS};
pub use field::Field;
pub use kernel::Kernel;
pub use plan::{Plan, Taper};
pub use rows::Rows;
pub use spectra::Spectra;
pub use sum::{Sum, direct_sum, sum};
pub use transforms::Transform;
pub use window::Window;
