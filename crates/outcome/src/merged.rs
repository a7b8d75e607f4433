//! Merging of neighbouring visits: a stuck tip makes hundreds of them within a width.

use std::collections::BTreeMap;
use stickslip_tip::elementary::sin_cos;

/// Length of a cell in widths of a Gaussian.
const CELL: f64 = 2.0;
/// Number of nodes in a cell. In a cell of length h the error of the polynomial through f' at m nodes is at most
/// 2 (h/4)^m/m! max|f^(m+1)|: some 1e-18 for a Gaussian of width 1.
const PLACES: usize = 24;

/// Weights at few nodes that give the same sum of f' as these visits (position, duration) at all distances. In each
/// cell with more visits than nodes, `W_k = Σ_i w_i ℓ_k(x_i)` with Lagrange's polynomials `ℓ_k`.
pub(crate) fn merged(visits: Vec<(f64, f64)>, width: f64) -> Vec<(f64, f64)> {
    let length = CELL * width;
    let mut cells: BTreeMap<i64, Vec<(f64, f64)>> = BTreeMap::new();
    for (x, weight) in visits {
        #[expect(clippy::cast_possible_truncation, reason = "a count of cells within reach")]
        let cell = (x / length).floor() as i64;
        cells.entry(cell).or_default().push((x, weight));
    }
    let together = |(cell, visits): (i64, Vec<(f64, f64)>)| {
        if visits.len() > PLACES {
            at_places((cell as f64 + 0.5) * length, length, &visits)
        } else {
            visits
        }
    };
    cells.into_iter().flat_map(together).collect()
}

/// Lagrange's polynomials at Chebyshev points, by the barycentric formula: Berrut & Trefethen, SIAM Rev. 46, 501
/// (2004).
fn at_places(center: f64, length: f64, visits: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let angle = |k: usize| std::f64::consts::PI * (k as f64 + 0.5) / PLACES as f64;
    let place = |k| center + 0.5 * length * sin_cos(angle(k)).1;
    let factor = |k: usize| sin_cos(angle(k)).0 * if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    let places: [f64; PLACES] = std::array::from_fn(place);
    let factors: [f64; PLACES] = std::array::from_fn(factor);
    let mut weights = [0.0; PLACES];
    for (x, weight) in visits {
        if let Some(at) = places.iter().position(|place| (place - x).abs() <= 0.0) {
            weights[at] += weight;
            continue;
        }
        let shares: [f64; PLACES] = std::array::from_fn(|k| factors[k] / (x - places[k]));
        let part = weight / shares.iter().sum::<f64>();
        weights.iter_mut().zip(shares).for_each(|(sum, share)| *sum += part * share);
    }
    places.into_iter().zip(weights).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_tip::TipFunction;

    /// Comparison with the sum over single visits, for a creeping tip: visits ever longer and closer together.
    #[test]
    fn few_places_make_the_slope_that_all_visits_make() {
        let table: Vec<f64> = (0..80).map(|i| 0.1 * f64::from(i)).collect();
        let values: Vec<f64> = table.iter().map(|x| (-x * x).exp() * (2.0 * x).cos()).collect();
        let tips = [
            TipFunction::triple_gaussian(1.0, 1.0),
            TipFunction::gaussian(0.01),
            TipFunction::table(&table, &values),
        ];
        for tip in tips.map(Result::unwrap) {
            let width = tip.widths(1.0);
            let visit = |i: u32| {
                let at = 0.008 * f64::from(i);
                (width * (at - 0.3), 10.0 * (-at).exp())
            };
            let visits: Vec<_> = (0..800).map(visit).collect();
            let few = merged(visits.clone(), width);
            assert!(few.len() < 120, "{}", few.len());
            let lasted: f64 = visits.iter().map(|v| v.1).sum();
            for i in 0..100 {
                let ahead = 0.1 * f64::from(i) * width;
                let slope = |visits: &[(f64, f64)]| -> f64 {
                    visits.iter().map(|(x, weight)| weight * tip.slope(ahead + x)).sum()
                };
                let off = (slope(&few) - slope(&visits)).abs() / lasted;
                let steepest = 1.0 / width;
                assert!(off < 4e-15 * steepest, "{tip:?} at {ahead}: {off:e}");
            }
        }
    }
}
