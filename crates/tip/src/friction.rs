//! Friction: the work that the support does on a tip.

use crate::{Step, Support, SupportPath, Trajectory};
use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// A closed loop of the support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loop {
    /// Start time, in Γ/k.
    pub from: f64,
    /// End time, in Γ/k.
    pub to: f64,
    /// Work ∮ (R - x0)dR, in kσ².
    pub work: f64,
}

/// Number of Gauss points: on each step the lag is a polynomial of a degree below twice this number.
const POINTS: usize = 4;

static GAUSS: LazyLock<GaussLegendre> =
    LazyLock::new(|| GaussLegendre::new(const { NonZeroUsize::new(POINTS).unwrap() }));

/// Successive loops of a support on a path. Each ends when the support returns to its first position and moves in its
/// first direction, or when it stops there. A support of constant velocity has no loops.
#[must_use]
pub fn loops(motion: &Trajectory) -> Vec<Loop> {
    let Support::Path(path) = motion.support() else { return vec![] };
    let ends = ends_of_loops(path);
    let within = ends.iter().copied().take_while(|end| *end <= motion.end());
    let mut from = motion.start();
    within
        .map(|to| {
            let found = Loop { from, to, work: work(motion, from, to) };
            from = to;
            found
        })
        .collect()
}

/// Work ∫ (R - x0)dR of the support between two times.
#[must_use]
pub fn work(motion: &Trajectory, from: f64, to: f64) -> f64 {
    let support = motion.support();
    let of_step = |step: &Step| {
        let (a, b) = (step.t.max(from), step.end().min(to));
        if b <= a {
            return 0.0;
        }
        // R is straight within a step.
        let velocity = support.velocity(step.t);
        velocity * GAUSS.integrate(a, b, |t| step.lag(support, t))
    };
    motion.steps().iter().map(of_step).sum()
}

/// Times after the start at which the support is at its first position again, and moves in its first direction or is
/// at the end of its path: there a closed loop ends.
#[must_use]
pub fn ends_of_loops(path: &SupportPath) -> Vec<f64> {
    let (t, way) = path.knots();
    let pieces = || t.windows(2).zip(way.windows(2));
    let first = pieces().map(|(_, way)| way[1] - way[0]).find(|way| way.abs() > 0.0);
    let Some(first) = first else { return vec![] };
    let mut found = vec![];
    for (i, (t, way)) in pieces().enumerate() {
        let rises = (way[1] - way[0]) * first > 0.0;
        let begins = way[0].abs() <= 0.0 && rises && i > 0;
        let crosses = way[0] * way[1] < 0.0 && rises;
        if begins && found.last().is_none_or(|last| *last < t[0]) {
            found.push(t[0]);
        } else if crosses {
            found.push(t[0] - way[0] * (t[1] - t[0]) / (way[1] - way[0]));
        }
    }
    // Where it stops, too.
    if let ([.., t], [.., 0.0]) = (t, way) {
        found.push(*t);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, Scenario, TipFunction, run};

    #[test]
    fn loops_end_where_the_support_is_back_and_goes_on_as_it_began() {
        let path = |knots: &[(f64, f64)]| {
            SupportPath::new(
                knots.iter().map(|k| k.0).collect(),
                knots.iter().map(|k| k.1).collect(),
            )
        };
        let triangle = path(&[(0.0, 0.0), (1.0, 2.0), (2.0, 0.0), (3.0, 2.0), (4.0, 0.0)]).unwrap();
        assert_eq!(ends_of_loops(&triangle), [2.0, 4.0]);
        let about_the_start =
            path(&[(0.0, 0.0), (1.0, 1.0), (3.0, -1.0), (5.0, 1.0), (7.0, -1.0), (8.0, 0.0)]);
        assert_eq!(ends_of_loops(&about_the_start.unwrap()), [4.0, 8.0]);
        let away = path(&[(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)]).unwrap();
        assert!(ends_of_loops(&away).is_empty());
    }

    /// What the support puts in is lost by the drag: without a groove, ∫ x0'² dt and what the spring holds.
    #[test]
    fn without_a_groove_the_work_of_a_loop_is_that_of_the_drag() {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let model = Model::new(tip, 0.0, 1.0).unwrap();
        let path = SupportPath::new(vec![0.0, 10.0, 20.0], vec![0.0, 10.0, 0.0]).unwrap();
        let scenario = Scenario { path: Some(path), ..Scenario::new(model, 20.0) };
        let motion = run(&scenario).unwrap().trajectory;
        let [found] = loops(&motion)[..] else { unreachable!("one loop") };
        let n = 20_000;
        let h = 20.0 / f64::from(n);
        let lost: f64 = (0..n).map(|i| h * motion.velocity((f64::from(i) + 0.5) * h).powi(2)).sum();
        let spring = |t: f64| 0.5 * motion.lag(t).powi(2);
        let balance = lost + spring(20.0) - spring(0.0);
        assert!((found.work - balance).abs() < 1e-6, "{} {balance}", found.work);
        assert!(found.work > 10.0);
    }
}
