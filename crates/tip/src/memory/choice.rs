//! Choice of the memory, and the limits up to which `direct` is the cheapest.

/// Choice of the algorithm for the history integral.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MemoryChoice {
    /// The cheapest: `direct` while few nodes lie within reach of the tip and few steps have been made; then `modes`
    /// if exponentials fit f' to the required accuracy, else `fft`.
    Auto,
    /// The definition: a sum over all nodes within reach. Its cost is proportional to their number.
    Direct,
    /// A convolution with the residence density of the tip.
    Fft,
    /// A sum of few exponentials; `fft` replaces it while the tip has retreated beyond its range of validity.
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
