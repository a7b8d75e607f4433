//! What is worth knowing of a memory, as data and in a sentence.

use super::choice::{CROSSOVER_NODES, CROSSOVER_STEPS, MemoryChoice};
use super::modes::{FitCertificate, FitError};

/// Which sum over the past was in use, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct MemoryReport {
    /// What was asked for.
    pub choice: MemoryChoice,
    /// The error of f' that modes may have.
    pub accuracy: f64,
    /// What was used.
    pub sum: Sum,
}

/// A sum over the past.
#[derive(Debug, Clone, PartialEq)]
pub enum Sum {
    /// The definition.
    Direct,
    /// The convolution.
    Fft {
        /// Why not modes, where they were to be tried.
        instead_of_modes: Option<FitError>,
    },
    /// Exponentials.
    Modes {
        /// How many, a conjugate pair being one.
        terms: usize,
        /// Largest errors of their sum.
        certificate: FitCertificate,
        /// How often the tip retreated beyond them.
        retreats: u64,
    },
}

impl MemoryReport {
    /// Name of the sum on the command line and in documents.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self.sum {
            Sum::Direct => "direct",
            Sum::Fft { .. } => "fft",
            Sum::Modes { .. } => "modes",
        }
    }

    /// Why the choice came to that sum, and how it fared.
    #[must_use]
    pub fn reason(&self) -> String {
        let why = if self.choice == MemoryChoice::Auto {
            self.crossover()
        } else {
            Some("asked for".to_string())
        };
        why.into_iter().chain(self.fared()).collect::<Vec<_>>().join("; ")
    }

    /// Why `auto` came to it.
    fn crossover(&self) -> Option<String> {
        let many = format!(
            "more than {CROSSOVER_NODES} nodes lay within reach, or {CROSSOVER_STEPS} steps were to be looked through"
        );
        Some(match &self.sum {
            Sum::Direct => {
                format!("at most {CROSSOVER_NODES} nodes lay within reach: a direct sum costs less")
            }
            Sum::Modes { .. } | Sum::Fft { instead_of_modes: None } => many,
            Sum::Fft { instead_of_modes: Some(FitError::NeverFades) } => {
                many + ", and modes need a footprint that fades"
            }
            Sum::Fft { instead_of_modes: Some(_) } => {
                format!("{many}, and modes do not fit f' to {:.1e}", self.accuracy)
            }
        })
    }

    pub(crate) fn fared(&self) -> Option<String> {
        let Sum::Modes { terms, certificate: FitCertificate { slope, area, .. }, retreats } =
            &self.sum
        else {
            return None;
        };
        let fit = format!(
            "{terms} exponentials fit f' to {slope:.1e}, and the force on a tip of velocity v to {area:.1e} alpha/v"
        );
        Some(match retreats {
            0 => fit,
            n => format!(
                "{fit}; {n} times the tip retreated beyond them, and fft took over until it was back"
            ),
        })
    }
}
