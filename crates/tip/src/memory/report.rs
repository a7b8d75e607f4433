//! Reports of a memory, as data and in a sentence.

use super::choice::{CROSSOVER_NODES, CROSSOVER_STEPS, MemoryChoice};
use super::modes::{FitCertificate, FitError};

/// The memory in use, and the reason for it.
#[derive(Debug, Clone, PartialEq)]
pub struct MemoryReport {
    /// Requested memory.
    pub choice: MemoryChoice,
    /// Allowed error of f' for `modes`.
    pub accuracy: f64,
    /// Memory in use.
    pub sum: Sum,
}

/// An algorithm for the history integral.
#[derive(Debug, Clone, PartialEq)]
pub enum Sum {
    /// The definition.
    Direct,
    /// The convolution.
    Fft {
        /// Reason for not using `modes`, if they were considered.
        instead_of_modes: Option<FitError>,
    },
    /// Exponentials.
    Modes {
        /// Number of terms; a conjugate pair is one term.
        terms: usize,
        /// Largest errors of the sum.
        certificate: FitCertificate,
        /// Number of retreats of the tip beyond the range of validity.
        retreats: u64,
    },
}

impl MemoryReport {
    /// Name of the memory on the command line and in documents.
    pub fn name(&self) -> &'static str {
        match self.sum {
            Sum::Direct => "direct",
            Sum::Fft { .. } => "fft",
            Sum::Modes { .. } => "modes",
        }
    }

    /// Reason for the memory, and its errors.
    pub fn reason(&self) -> String {
        let why = match self.choice {
            MemoryChoice::Auto => self.crossover(),
            _ => "requested".to_string(),
        };
        std::iter::once(why).chain(self.errors_in_words()).collect::<Vec<_>>().join("; ")
    }

    /// Reason for the choice of `auto`.
    fn crossover(&self) -> String {
        let many = format!(
            "more than {CROSSOVER_NODES} nodes lay within reach, or {CROSSOVER_STEPS} steps had to be searched"
        );
        match &self.sum {
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
        }
    }

    pub(crate) fn errors_in_words(&self) -> Option<String> {
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
