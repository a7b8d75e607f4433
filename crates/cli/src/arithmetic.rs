//! Identification of a machine's floating-point arithmetic: whether it can continue work of another machine with
//! identical bits.
//!
//! Sums, products and roots are the same on all machines, and in any vector instructions. exp, sin and similar functions
//! come from the system's library, which has variants for processors with and without a fused multiply-add. Variants
//! differ in the last digit of at most one value in a thousand, and a motion that amplifies errors makes the difference
//! visible.

use crc32fast::Hasher;
use std::env::consts::ARCH;
use std::sync::OnceLock;

/// Name of the arithmetic, such as `x86_64-30e62884`; equal names mean identical bits.
pub(crate) fn arithmetic() -> &'static str {
    static NAME: OnceLock<String> = OnceLock::new();
    NAME.get_or_init(|| format!("{ARCH}-{:08x}", functions()))
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
/// Arguments of each at which implementations are most probably different: up to six at which the variants of glibc with
/// and without a fused multiply-add are, and those whose value is nearest to the midpoint of two numbers. Printed by
/// `data/arithmetic_arguments.py`.
const ARGUMENTS: [[u16; 12]; 14] = [
    [669, 13989, 26620, 31157, 39274, 47826, 28409, 60955, 12934, 61224, 22774, 42415],
    [13728, 27185, 37987, 60944, 63260, 43538, 41394, 28835, 10413, 46193, 28523, 23656],
    [4988, 17032, 20413, 29055, 39282, 53799, 212, 28204, 26116, 27522, 11067, 7419],
    [1707, 9536, 18457, 30876, 39723, 54645, 26714, 56016, 17541, 50215, 17025, 937],
    [18600, 54753, 64831, 65154, 14703, 47736, 26718, 52704, 39422, 38219, 32289, 56282],
    [85, 16997, 21897, 28486, 45266, 55111, 56329, 52363, 41123, 62747, 22910, 54619],
    [4164, 11517, 23524, 32599, 50034, 54944, 42444, 43989, 52686, 35233, 53271, 61313],
    [32444, 61874, 44487, 41063, 6830, 8356, 42503, 33946, 25413, 18191, 4278, 34688],
    [195, 7942, 14356, 17228, 34383, 54372, 28409, 12934, 46818, 40976, 42415, 51532],
    [796, 5984, 10417, 29762, 39466, 42094, 27286, 4735, 11985, 39010, 36634, 30670],
    [545, 4897, 16905, 27564, 37814, 54372, 16745, 13721, 4985, 20370, 37234, 56501],
    [3290, 13989, 27273, 32831, 39742, 54093, 48589, 42138, 40355, 45927, 28670, 63890],
    [14157, 24310, 24760, 25103, 27687, 29970, 51369, 18797, 33546, 35999, 47759, 29645],
    [60944, 35097, 41306, 23723, 57092, 44326, 42736, 56804, 30747, 33396, 5805, 7748],
];

/// Argument i of those that fill the interval from -12 to 12 evenly.
fn argument(i: u16) -> f64 {
    /// Fractional part of the golden ratio.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    24.0 * ((f64::from(i) * GOLDEN).fract() - 0.5)
}

/// CRC-32 of the values of these functions.
fn functions() -> u32 {
    let mut hasher = Hasher::new();
    for (function, arguments) in FUNCTIONS.iter().zip(ARGUMENTS) {
        hasher.update(arguments.map(|i| function(argument(i)).to_le_bytes()).as_flattened());
    }
    hasher.finalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The functions of crate libm are another implementation, which differs from glibc in 3 of 100 values. Each is
    /// noticed.
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    #[test]
    fn another_implementation_differs_at_these_arguments() {
        let others: [Function; 14] = [
            libm::exp,
            |x| libm::log(x.abs()),
            libm::sin,
            libm::cos,
            libm::tan,
            |x| libm::pow(x.abs(), 0.3 + 0.1 * x),
            |x| libm::atan2(x, 1.7),
            |x| libm::hypot(x, 2.3),
            libm::expm1,
            |x| libm::log1p(x.abs()),
            libm::sinh,
            libm::cosh,
            libm::tanh,
            |x| libm::log10(x.abs()),
        ];
        for (n, arguments) in ARGUMENTS.into_iter().enumerate() {
            let differs = |x: &f64| FUNCTIONS[n](*x).to_bits() != others[n](*x).to_bits();
            let differing = arguments.map(argument).iter().filter(|x| differs(x)).count();
            assert!(differing > 1, "function {n}: {differing}");
        }
    }

    #[test]
    fn a_machine_agrees_with_itself() {
        assert_eq!(functions(), functions());
        assert!(arithmetic().starts_with(ARCH));
    }
}
