//! All that the past does to the tip: the groove that it left.
//!
//! A memory has two verbs: it is told of visits, where the tip was and for how long, and tells the groove
//! about a place: height, slope and curvature of ∫ f(x - x0(t'))dt'. It is indifferent to time: what the tip
//! left at a distance beyond the reach of f is out of sight, what it left nearby is never forgotten.
//!
//! Three sums give the groove: `direct`, the definition; `fft`, a convolution; `modes`, a few exponentials.
//! [`Policy`] decides between them, and holds the one record of the past that each of them is made from.

mod direct;
mod fft;
mod modes;
mod policy;
mod record;
mod report;

pub use modes::{Fit, FitCertificate, FitError, Term, accuracy_needed};
pub use policy::{CROSSOVER_NODES, CROSSOVER_STEPS, Policy};
pub use report::{MemoryReport, Sum};

use crate::TipFunction;

/// Memory of the tip's past. Positions are displacements from where the tip stands now.
pub trait Memory {
    /// Remembers visits: the tip spent the time `weight[j]` at `position[j]`, and now stands at the last of
    /// these positions. A time may be multiplied by how strongly the tip indented then.
    fn remember(&mut self, position: &[f64], weight: &[f64]);

    /// Tells the groove at the points x = tip + `at`, each at most [`longest_look`] from the tip.
    fn groove(&mut self, at: &[f64], groove: &mut Groove<'_>);
}

/// What a memory tells: integrals over the remembered past, one number for each point asked about.
#[derive(Debug)]
pub struct Groove<'a> {
    /// ∫ f'(x - x0(t'))dt'
    pub slope: &'a mut [f64],
    /// ∫ f''(x - x0(t'))dt'
    pub curvature: &'a mut [f64],
    /// ∫ f(x - x0(t'))dt', for those who want it: it costs as much again.
    pub height: Option<&'a mut [f64]>,
}

impl<'a> Groove<'a> {
    /// Slope and curvature only.
    pub fn new(slope: &'a mut [f64], curvature: &'a mut [f64]) -> Self {
        Self { slope, curvature, height: None }
    }

    /// The height too.
    #[must_use]
    pub fn with_height(self, height: &'a mut [f64]) -> Self {
        Self { height: Some(height), ..self }
    }

    /// Nothing carved.
    fn clear(&mut self) {
        self.slope.fill(0.0);
        self.curvature.fill(0.0);
        self.height.iter_mut().for_each(|height| height.fill(0.0));
    }
}

/// Which sum over the past is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MemoryChoice {
    /// The cheapest: `direct` while few nodes lie within reach of the tip and few steps have been made; from
    /// then on `modes` where f' can be fitted by exponentials as well as is needed, else `fft`.
    Auto,
    /// The definition: a sum over every visit within reach. It costs as much as there are of them.
    Direct,
    /// A convolution with the residence density of the tip.
    Fft,
    /// A sum of few exponentials, and `fft` while the tip has retreated beyond what they hold for.
    Modes,
}

/// The farthest from the tip that a memory is asked about the groove, ahead or behind: 4.6 widths of
/// a Gaussian. The integrator rejects steps that would lead further.
#[must_use]
pub fn longest_look(tip: &TipFunction) -> f64 {
    (40.0 / tip.band()).min(12.0)
}

/// Ends of the interval that these values span.
fn range(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)))
}
