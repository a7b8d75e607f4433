//! The mesh of a cycle: long steps where the motion is smooth, short ones in its slips.

use super::orbit::Orbit;
use stickslip_tip::collocation::STAGES;
use stickslip_tip::step::{defect, interpolation_error, longest_displacement, velocity_at_end};

/// The residual of a collocation polynomial falls as this power of the step.
const ORDER: f64 = STAGES as f64;
/// Target of a mesh, as a fraction of the allowed residual.
const AIM: f64 = 0.4;
/// Largest ratio of the densities of neighbouring steps.
const GRADING: f64 = 2.0;
const FEWEST: usize = 10;
/// Number of neighbouring steps on either side, at least one of which shows the residual of a resonant motion.
const AROUND: usize = 2;
/// A step shorter than this fraction of a neighbour belongs to a kink crossing: its residual is round-off, and is no
/// estimate for the neighbour.
const SLIVER: f64 = 0.02;
/// After a kink crossing the steps of a run grow gradually to their usual length. A step need not be short if its
/// residual is below this fraction of the largest one.
const NEGLIGIBLE: f64 = 1e-6;
/// A step need not be short either if its residual is below this and below [`SMALL`] times the allowed one.
const ROUND_OFF: f64 = 1e-12;
const SMALL: f64 = 1e-3;
pub(super) const MOST_STEPS: usize = 4000;
/// Largest number of steps of a guess, which its mesh need not keep.
pub(super) const MOST_STEPS_OF_GUESS: usize = 4 * MOST_STEPS;

/// Properties of a linearised step that determine the mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct OfStep {
    /// Stiffness of the groove.
    pub(super) stiffness: f64,
    /// [Quadrature error](super::quadrature) of the force of the step's own groove.
    pub(super) missed: f64,
}

/// Largest residual of (18) within each step, estimated at the starts of its polynomial and of the next one. There the
/// true velocity is that at the end of the step before. If the groove is stiff, an interpolation error of a polynomial
/// causes an error of the force larger by the factor `stiffness`. The quadrature error at the nodes is not added to this
/// estimate, but replaces it if larger.
pub(super) fn residuals(orbit: &Orbit, of_steps: &[OfStep]) -> Vec<f64> {
    let h: Vec<f64> = orbit.lengths().collect();
    let steps = h.len();
    let signs = |n: usize| {
        if is_sliver(&h, n) {
            return (0.0, 0.0);
        }
        let before = (n + steps - 1) % steps;
        let (d, d_before) = (&orbit.stages[n], &orbit.stages[before]);
        let defect = defect(d, h[n], velocity_at_end(d_before, h[before]));
        // Polynomials do not continue beyond a corner of |h|, nor far beyond their own step.
        let continues = orbit.side(n) * orbit.side(before) > 0.0 && !is_sliver(&h, before);
        let interpolation =
            if continues { interpolation_error(d, h[n], (d_before, h[before])) } else { 0.0 };
        (defect.abs(), interpolation)
    };
    let signs: Vec<(f64, f64)> = (0..steps).map(signs).collect();
    let residual = |n: usize| {
        let (mut defect, mut interpolation) = signs[n];
        let next = (n + 1) % steps;
        let mut stiff = of_steps[n].stiffness;
        if !is_sliver(&h, n) && !is_sliver(&h, next) && orbit.side(n) * orbit.side(next) > 0.0 {
            // What both are made of, a derivative, may grow within the step: its end is the next one's beginning.
            let ratio = h[n] / h[next];
            defect = defect.max(signs[next].0 * ratio.powf(ORDER));
            interpolation = interpolation.max(signs[next].1 * ratio.powf(ORDER + 1.0));
            stiff = stiff.max(of_steps[next].stiffness);
        }
        (defect + stiff * interpolation).max(of_steps[n].missed)
    };
    (0..steps).map(residual).collect()
}

fn is_sliver(lengths: &[f64], n: usize) -> bool {
    let count = lengths.len();
    let beside = lengths[(n + count - 1) % count].max(lengths[(n + 1) % count]);
    lengths[n] < SLIVER * beside
}

/// Requirements for a mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aim {
    /// The allowed residual, of which a mesh aims at a fraction.
    pub(super) allowed: f64,
    /// Additional reduction factor, if earlier meshes did not come close to the target.
    pub(super) sharper: f64,
    /// Whether no step may become longer.
    pub(super) only_finer: bool,
    /// Whether the motion may be resonant. A step then shows no residual where the leading derivative passes through zero,
    /// and on the next mesh this is another step.
    pub(super) may_ring: bool,
}

/// The mesh on which the residuals would be equal and below the allowed one, with these kink crossings among its
/// points.
pub(super) fn adapted(
    orbit: &Orbit,
    band: f64,
    (residuals, aim): (&[f64], Aim),
    corners: &[f64],
) -> Vec<f64> {
    let longest = longest_displacement(band);
    let shares: Vec<f64> = orbit.mesh.windows(2).map(|ends| ends[1] - ends[0]).collect();
    let limited = !orbit.heights.is_empty();
    let largest = residuals.iter().copied().fold(0.0, f64::max);
    let negligible = (NEGLIGIBLE * largest).max(ROUND_OFF.min(SMALL * aim.allowed));
    let wanted = |n: usize| {
        let moved = orbit.stages[n].iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        let least = if aim.only_finer { 1.0 } else { 0.0 };
        let of_residual = match residuals[n] {
            small if limited && small < negligible => 0.0,
            residual => residual / (AIM * aim.sharper * aim.allowed),
        };
        let steps = of_residual.powf(1.0 / ORDER).max(moved / longest).max(least);
        steps / shares[n]
    };
    let mut density: Vec<f64> = (0..shares.len()).map(wanted).collect();
    let count = shares.len();
    if aim.may_ring {
        let least = |n: usize| {
            let window = count - AROUND..=count + AROUND;
            window.map(|k| density[(n + k) % count]).fold(0.0, f64::max)
        };
        density = (0..count).map(least).collect();
    }
    equidistributed(&orbit.mesh, &graded(density), corners)
}

/// Raises densities that decrease too fast from one step to the next, periodically.
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

/// Ends of steps with equal shares of the density, which is constant on each step of the old mesh. Kink crossings
/// (`corners`) are among the ends, so that shares are equal only between two of them. The list is cut off if there are
/// too many steps.
pub(super) fn equidistributed(mesh: &[f64], density: &[f64], corners: &[f64]) -> Vec<f64> {
    let mut cumulated = vec![0.0];
    let mut total = 0.0;
    for (ends, density) in mesh.windows(2).zip(density) {
        total += density * (ends[1] - ends[0]);
        cumulated.push(total);
    }
    let place = |wanted: f64| {
        let after = cumulated.partition_point(|c| *c <= wanted).clamp(1, density.len());
        mesh[after - 1] + (wanted - cumulated[after - 1]) / density[after - 1]
    };
    let held = |at: &f64| {
        let after = mesh.partition_point(|end| end <= at).clamp(1, density.len());
        cumulated[after - 1] + (at - mesh[after - 1]) * density[after - 1]
    };
    let (mut ends, mut from) = (vec![0.0], 0.0);
    let last = [(1.0, total)].into_iter();
    for (end, to) in corners.iter().map(|corner| (*corner, held(corner))).chain(last) {
        let fewest = FEWEST as f64 * (end - ends[ends.len() - 1]);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let steps = (to - from).ceil().max(fewest.ceil()).max(1.0) as usize;
        let steps = steps.min(MOST_STEPS_OF_GUESS + 1);
        ends.extend((1..steps).map(|i| place(from + (to - from) * i as f64 / steps as f64)));
        ends.push(end);
        from = to;
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_ends_where_there_are_too_many_steps() {
        let mesh = equidistributed(&[0.0, 0.5, 1.0], &[1e12, 1e300], &[]);
        assert_eq!(mesh.len(), MOST_STEPS_OF_GUESS + 2);
        assert!(mesh.windows(2).all(|ends| ends[0] <= ends[1]));
    }
}
