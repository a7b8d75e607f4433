//! Choice of the memory, and the limits up to which `direct` is the cheapest.

/// The memory: the algorithm for the history integral.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "MemoryName"))]
pub enum MemoryChoice {
    /// The cheapest memory: direct while few points lie within reach of the tip, then modes, or fft if no
    /// exponentials fit.
    #[default]
    Auto,
    /// A sum over the history within reach: the definition, slow for long histories.
    Direct,
    /// FFT convolution with the residence density: the same cost for any history.
    Fft,
    /// A sum of few exponentials, for tip functions that decay: the cost of a step stays constant and is below that
    /// of fft.
    Modes,
}

/// Number of nodes within reach above which a direct sum is the more expensive one. For the other memories a step
/// costs less than a direct sum over six nodes. But the plan of `fft` takes some 30 µs. The fit of `modes`, made once
/// for a footprint and an accuracy, takes some 300 µs: as much as the first 8 or 20 steps of a direct sum
/// (benches/memory.rs).
pub const CROSSOVER_NODES: usize = 48;

/// Number of remembered steps above which a direct sum is the more expensive one, at any distance: `direct` examines
/// all of them.
pub const CROSSOVER_STEPS: usize = 1024;
