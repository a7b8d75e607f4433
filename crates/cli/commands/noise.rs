//! What the noise of a measured table does to the answers that are made of it.
//!
//! αc feels f'' and with it the noise of neighbouring rows, over their distance squared: 2 % of noise can halve
//! αc. How large the noise is, is told by sixth differences, in which a smooth f all but vanishes; what it does, by
//! adding as much again.

use crate::message::say;
use std::f64::consts::PI;
use stickslip_stability::critical;
use stickslip_tip::TipFunction;

/// Fewer rows have no sixth differences to speak of.
const FEWEST_ROWS: usize = 16;
/// A relative change of αc at r = 1 that is told.
const TOLD: f64 = 0.02;
/// Where noise can change αc by no more, nobody tries how much it does.
const NOT_TOLD: f64 = 0.1 * TOLD;
/// A sum over many random rows is at most so many standard deviations.
const LARGEST_DRAW: f64 = 5.0;
/// How often noise is added.
const DRAWS: u32 = 5;
/// Binomial coefficients of a sixth difference, and the root of the sum of their squares.
const SIXTH: [f64; 7] = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];
const SIXTH_NORM: f64 = 30.397;

/// Tells where noise like that of a table would change αc.
pub(super) fn tell_of_noise(option: &str, (x, f): (&[f64], &[f64]), tip: &TipFunction) {
    let Some(change) = change((x, f), tip) else { return };
    if change > TOLD {
        say(format_args!(
            "stickslip: {option}: as much noise as the rows have, added once more, changes alpha_c by {:.0} % (r = 1): \
             noise, or too few rows, decide; a table that is smoothed, or a formula fitted to it, will do better",
            100.0 * change
        ));
    }
}

/// Relative change of αc(1), root mean square, with noise like that of the table added.
fn change((x, f): (&[f64], &[f64]), tip: &TipFunction) -> Option<f64> {
    if x.len() < FEWEST_ROWS {
        return None;
    }
    let alpha = |tip: &TipFunction| critical(tip, 1.0).ok().map(|at| at.alpha);
    let all = alpha(tip)?;
    let noise = noise(f);
    if all * most_felt(x, noise) < NOT_TOLD {
        return Some(0.0);
    }
    let changes = (0..DRAWS).map(|draw| {
        let mut random = uniform(draw);
        let last = f.len() - 1;
        // Variance 1/3 on [-1, 1]; the end where f has faded stays.
        let mut more = |i: usize| if i < last { 3_f64.sqrt() * noise * random() } else { 0.0 };
        let noisy: Vec<f64> = f.iter().enumerate().map(|(i, f)| f + more(i)).collect();
        let changed = TipFunction::table(x, &noisy).ok().and_then(|tip| alpha(&tip));
        // Noise that leaves no footprint changes all.
        changed.map_or(1.0, |changed| (changed / all).ln().abs())
    });
    let squares: Vec<f64> = changes.map(|change| change * change).collect();
    Some((squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// A bound of what noise adds to ∫f''(y) e^{-iqy}dy, to which 1/αc(1) is proportional, at any wave number that rows
/// resolve: q² times its transform, a sum over random rows, and q times its value at 0.
fn most_felt(x: &[f64], noise: f64) -> f64 {
    let length = x[x.len() - 1];
    let spacing = length / (x.len() - 1) as f64;
    let q = PI / spacing;
    LARGEST_DRAW * noise * (q * q * (spacing * length).sqrt() + q)
}

/// Standard deviation of what is not smooth from row to row.
fn noise(f: &[f64]) -> f64 {
    let difference = |rows: &[f64]| rows.iter().zip(SIXTH).map(|(f, c)| f * c).sum::<f64>();
    let squares: Vec<f64> = f.windows(7).map(|rows| difference(rows).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / SIXTH_NORM
}

/// Numbers in [-1, 1] that look random and are the same in every run.
fn uniform(seed: u32) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(2_654_435_769).wrapping_add(12_345);
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX) * 2.0 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Gaussian in this many rows, each off by up to `noise`, the last one 0.
    fn changed(rows: u32, noise: f64) -> f64 {
        let x: Vec<f64> = (0..rows).map(|i| 8.0 * f64::from(i) / f64::from(rows - 1)).collect();
        let mut random = uniform(7);
        let mut f: Vec<f64> = x.iter().map(|x| (-0.5 * x * x).exp() + noise * random()).collect();
        f[rows as usize - 1] = 0.0;
        change((&x, &f), &TipFunction::table(&x, &f).unwrap()).unwrap()
    }

    #[test]
    fn noise_is_told_and_smooth_tables_are_not() {
        for rows in [40, 60, 120] {
            assert!(changed(rows, 0.02) > TOLD, "{rows}: {}", changed(rows, 0.02));
            assert!(changed(rows, 1e-6) < TOLD, "{rows}: {}", changed(rows, 1e-6));
        }
        assert!(changed(20, 0.0) < TOLD, "{}", changed(20, 0.0));
    }

    /// Where the bound says that it cannot be felt, it is not.
    #[test]
    fn noise_that_is_not_tried_changes_nothing() {
        for (rows, noise) in [(60, 1e-7), (60, 2e-6), (200, 1e-8), (200, 1e-7), (600, 1e-9)] {
            let x: Vec<f64> = (0..rows).map(|i| 8.0 * f64::from(i) / f64::from(rows - 1)).collect();
            let exact: Vec<f64> = x.iter().map(|x| (-0.5 * x * x).exp()).collect();
            let mut random = uniform(3);
            let noisy: Vec<f64> = exact.iter().map(|f| f + noise * random()).collect();
            let alpha =
                |f: &[f64]| critical(&TipFunction::table(&x, f).unwrap(), 1.0).unwrap().alpha;
            let change = (alpha(&noisy) / alpha(&exact) - 1.0).abs();
            let bound = alpha(&exact) * most_felt(&x, noise / 3_f64.sqrt());
            assert!(change < bound, "{rows} {noise}: {change} above {bound}");
        }
    }
}
