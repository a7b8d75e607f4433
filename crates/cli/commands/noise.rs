//! What the noise of a measured table does to the answers that are made of it.
//!
//! αc feels f'' and with it the noise of neighbouring rows, over their distance squared: 2 % of noise can halve
//! αc. Every other row has the same shape, and noise of a quarter of the weight.

use crate::message::say;
use stickslip_stability::critical;
use stickslip_tip::TipFunction;

/// Fewer rows tell nothing when halved.
const FEWEST_ROWS: usize = 16;
/// A relative change of αc at r = 1 that is told.
const TOLD: f64 = 0.05;

/// Tells where every other row of a table leads to another αc than all of them.
pub(super) fn tell_of_noise(option: &str, (x, f): (&[f64], &[f64]), tip: &TipFunction) {
    let Some((all, half)) = critical_alphas((x, f), tip) else { return };
    let change = (half / all - 1.0).abs();
    if change > TOLD {
        say(format_args!(
            "stickslip: {option}: every other row of the table leads to alpha_c = {half:.3} where all lead to \
             {all:.3} (r = 1): noise, or too few rows, decide to {:.0} %; a table that is smoothed, or a \
             formula fitted to it, will do better",
            100.0 * change
        ));
    }
}

/// αc(1) of all rows, and that of every other one, the even or the odd, which is farther from it.
fn critical_alphas((x, f): (&[f64], &[f64]), tip: &TipFunction) -> Option<(f64, f64)> {
    if x.len() < FEWEST_ROWS {
        return None;
    }
    let alpha = |tip: &TipFunction| critical(tip, 1.0).ok().map(|at| at.alpha);
    let all = alpha(tip)?;
    let last = x.len() - 1;
    let half = |first: usize| {
        // A table begins at 0 and ends where f has faded.
        let kept = |column: &[f64]| -> Vec<f64> {
            let rows = (first..last - 1).step_by(2).filter(|i| *i > 0);
            [0].into_iter().chain(rows).chain([last]).map(|i| column[i]).collect()
        };
        alpha(&TipFunction::table(&kept(x), &kept(f)).ok()?)
    };
    let halves = [half(2), half(1)].into_iter().flatten();
    let farther = halves.max_by(|a, b| (a / all).ln().abs().total_cmp(&(b / all).ln().abs()));
    Some((all, farther?))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Gaussian in this many rows, each off by up to `noise`, the last one 0.
    fn changed(rows: u32, noise: f64) -> f64 {
        let x: Vec<f64> = (0..rows).map(|i| 8.0 * f64::from(i) / f64::from(rows - 1)).collect();
        let mut seed = 1_u32;
        let mut f: Vec<f64> = x.iter().map(|x| (-0.5 * x * x).exp()).collect();
        for f in &mut f {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *f += noise * (f64::from(seed) / f64::from(u32::MAX) * 2.0 - 1.0);
        }
        f[rows as usize - 1] = 0.0;
        let tip = TipFunction::table(&x, &f).unwrap();
        let (all, half) = critical_alphas((&x, &f), &tip).unwrap();
        (half / all - 1.0).abs()
    }

    #[test]
    fn noise_is_told_and_smooth_tables_are_not() {
        for rows in [60, 120, 300] {
            assert!(changed(rows, 0.02) > TOLD, "{rows}: {}", changed(rows, 0.02));
            assert!(changed(rows, 1e-6) < TOLD, "{rows}: {}", changed(rows, 1e-6));
        }
    }
}
