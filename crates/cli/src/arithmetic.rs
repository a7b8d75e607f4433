//! Identification of a machine's floating-point arithmetic: whether it can continue work of another machine with
//! identical bits.
//!
//! Sums, products and roots are the same on all machines, and in any vector instructions. exp, sin and similar functions
//! come from the system's library, which has variants for processors with and without a fused multiply-add. Variants
//! differ in the last digit of a few values in a thousand, and a motion that amplifies errors makes the difference
//! visible.

use crc32fast::Hasher;
use std::env::consts::ARCH;
use std::sync::OnceLock;
use std::thread;

/// Name of the arithmetic, such as `x86_64-1c291ca3`; equal names mean identical bits.
pub(crate) fn arithmetic() -> &'static str {
    static NAME: OnceLock<String> = OnceLock::new();
    NAME.get_or_init(|| format!("{ARCH}-{:08x}", functions()))
}

/// Lets another thread find the name, which takes half a millisecond, for a command that needs it soon.
pub(crate) fn prepare() {
    thread::Builder::new().spawn(arithmetic).ok();
}

/// The error message for work that was begun under another arithmetic.
pub(crate) fn foreign(made: Option<&str>) -> String {
    let made = made.unwrap_or("unknown");
    format!(
        "was made with {made} arithmetic, and this machine has {}: the last digits would differ; resume it on a \
         machine of that kind, or start again",
        arithmetic()
    )
}

type Function = fn(f64) -> f64;

/// All library functions in use.
const FUNCTIONS: [Function; 14] = [
    f64::exp,
    |x| x.abs().ln(),
    f64::sin,
    f64::cos,
    f64::tan,
    |x| x.abs().powf(0.3 + 0.1 * x),
    |x| x.atan2(1.7),
    |x| x.hypot(2.3),
    f64::exp_m1,
    |x| x.abs().ln_1p(),
    f64::sinh,
    f64::cosh,
    f64::tanh,
    |x| x.abs().log10(),
];
/// Number of arguments; sufficient to include several values at which variants differ.
const ARGUMENTS: u32 = 2000;

/// CRC-32 of the values of these functions at arguments from -12 to 12.
fn functions() -> u32 {
    /// Fractional part of the golden ratio: its multiples modulo 1 fill an interval evenly.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let arguments = (1..=ARGUMENTS).map(|i| 24.0 * ((f64::from(i) * GOLDEN).fract() - 0.5));
    let mut hasher = Hasher::new();
    for x in arguments {
        hasher.update(FUNCTIONS.map(|function| function(x).to_le_bytes()).as_flattened());
    }
    hasher.finalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_agrees_with_itself() {
        assert_eq!(functions(), functions());
        assert!(arithmetic().starts_with(ARCH));
    }
}
