//! Lambert's W.

use crate::elementary::ln;

/// The solution W ≥ 0 of W e^W = c for c ≥ 0; 0 for c < 0.
///
/// Newton's iteration for W + ln W = ln c. The left side is concave and increasing, so that iterates below W never
/// overshoot.
pub(crate) fn w0(c: f64) -> f64 {
    if c <= 0.0 {
        return 0.0;
    }
    // Small c: the series' first terms; large c: ln c - ln ln c.
    let mut w = if c < 1.0 { c / (1.0 + c) } else { ln(1.0 + c) * 0.7 };
    for _ in 0..30 {
        let step = w * (ln(c) - ln(w) - w) / (1.0 + w);
        let next = (w + step).max(0.1 * w);
        if (next - w).abs() <= f64::EPSILON * w {
            return next;
        }
        w = next;
    }
    w
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn w_solves_its_equation_from_the_smallest_to_the_largest() {
        for n in -300..300 {
            let c = 10_f64.powi(n);
            let w = w0(c);
            // In logarithms, where neither side leaves floating point.
            let miss = w + w.ln() - c.ln();
            assert!(miss.abs() < 1e-15 * (1.0 + c.ln().abs()) * 4.0, "{c:e} {w:e} {miss:e}");
        }
        assert!((w0(1.0) - 0.567_143_290_409_783_8).abs() < 1e-15, "the omega constant");
        assert!(w0(0.0).abs() < 1e-300);
    }
}
