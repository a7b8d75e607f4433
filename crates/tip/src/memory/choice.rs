//! Which sum over the past is to be used, and from where on a direct one is not.

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

/// Nodes within reach from which a direct sum is the dearer one. A step costs the others less than a direct
/// sum over six nodes, but the plan of `fft` takes some 30 µs and the fit of `modes`, made once for a
/// footprint and an accuracy, some 300 µs: as much as the first 8 or 20 steps of a direct sum
/// (benches/memory.rs).
pub const CROSSOVER_NODES: usize = 48;

/// Remembered steps from which a direct sum is the dearer one, wherever they lie: `direct` looks through them all.
pub const CROSSOVER_STEPS: usize = 1024;
