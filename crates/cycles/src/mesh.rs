//! The mesh that a cycle needs: steps long where the motion is smooth, short in its slips.

use super::orbit::Orbit;
use stickslip_tip::collocation::STAGES;
use stickslip_tip::step::{defect, interpolation_error, longest_displacement, velocity_at_end};

/// The residual of a collocation polynomial falls as this power of the step.
const ORDER: f64 = STAGES as f64;
/// A mesh aims at this fraction of the residual allowed.
const AIM: f64 = 0.4;
/// Neighbours are no more than so many times as dense.
const GRADING: f64 = 2.0;
const FEWEST: usize = 10;
pub(super) const MOST_STEPS: usize = 4000;
/// A guess may have more, which its mesh does not keep.
pub(super) const MOST_STEPS_OF_GUESS: usize = 4 * MOST_STEPS;

/// Largest residual of (18) within each step, estimated from where its polynomial begins, and that of the next: there
/// the true velocity is that at the end of the step before. Where the groove is stiff, a polynomial that errs by
/// interpolation errs by `stiffness` times that in the force.
pub(super) fn residuals(orbit: &Orbit, stiffness: &[f64]) -> Vec<f64> {
    let h: Vec<f64> = orbit.lengths().collect();
    let steps = h.len();
    let (mut defects, mut interpolation) = (vec![], vec![]);
    for n in 0..steps {
        let before = (n + steps - 1) % steps;
        let (d, d_before) = (&orbit.stages[n], &orbit.stages[before]);
        defects.push(defect(d, h[n], velocity_at_end(d_before, h[before])).abs());
        interpolation.push(interpolation_error(d, h[n], (d_before, h[before])));
    }
    let residual = |n: usize| {
        // What a defect is made of, a derivative, may grow within the step: its end is the next one's beginning.
        let next = (n + 1) % steps;
        let ratio = h[n] / h[next];
        let at_end = defects[next] * ratio.powf(ORDER);
        let interpolation = interpolation[n].max(interpolation[next] * ratio.powf(ORDER + 1.0));
        defects[n].max(at_end) + stiffness[n].max(stiffness[next]) * interpolation
    };
    (0..steps).map(residual).collect()
}

/// The mesh on which residuals would be evenly below the one allowed.
pub(super) fn adapted(orbit: &Orbit, band: f64, residuals: &[f64], allowed: f64) -> Vec<f64> {
    let longest = longest_displacement(band);
    let shares: Vec<f64> = orbit.mesh.windows(2).map(|ends| ends[1] - ends[0]).collect();
    let wanted = |n: usize| {
        let moved = orbit.stages[n].iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        let steps = (residuals[n] / (AIM * allowed)).powf(1.0 / ORDER).max(moved / longest);
        steps / shares[n]
    };
    let density = graded((0..shares.len()).map(wanted).collect());
    equidistributed(&orbit.mesh, &density)
}

/// Raises densities that fall too fast from one step to the next, around the period.
pub(super) fn graded(mut density: Vec<f64>) -> Vec<f64> {
    let n = density.len();
    for i in 0..2 * n {
        let (here, next) = (density[i % n], (i + 1) % n);
        density[next] = density[next].max(here / GRADING);
    }
    for i in (1..=2 * n).rev() {
        let (here, next) = (density[i % n], (i - 1) % n);
        density[next] = density[next].max(here / GRADING);
    }
    density
}

/// Ends of steps that each hold the same share of the density, constant on each step of the old mesh. They are no more
/// than it takes to see that there are too many.
pub(super) fn equidistributed(mesh: &[f64], density: &[f64]) -> Vec<f64> {
    let mut cumulated = vec![0.0];
    let mut total = 0.0;
    for (ends, density) in mesh.windows(2).zip(density) {
        total += density * (ends[1] - ends[0]);
        cumulated.push(total);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let steps = (total.ceil() as usize).clamp(FEWEST, MOST_STEPS_OF_GUESS + 1);
    let place = |i: usize| {
        let wanted = total * i as f64 / steps as f64;
        let after = cumulated.partition_point(|c| *c <= wanted).clamp(1, density.len());
        mesh[after - 1] + (wanted - cumulated[after - 1]) / density[after - 1]
    };
    let inner = (1..steps).map(place);
    [0.0].into_iter().chain(inner).chain([1.0]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_ends_where_there_are_too_many_steps() {
        let mesh = equidistributed(&[0.0, 0.5, 1.0], &[1e12, 1e300]);
        assert_eq!(mesh.len(), MOST_STEPS_OF_GUESS + 2);
        assert!(mesh.windows(2).all(|ends| ends[0] <= ends[1]));
    }
}
