//! Friction: the work that the support does on a tip, and the peak of the lateral force after a rest of the support.

use crate::motion::extrema_within;
use crate::{Step, Support, SupportPath, Trajectory};
use gauss_quad::legendre::GaussLegendre;
use std::cmp::Ordering;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// A closed loop of the support.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "LoopDocument"))]
pub struct Loop {
    /// Time at which the loop begins, in Γ/k.
    pub from: f64,
    /// Time at which the loop ends, in Γ/k.
    pub to: f64,
    /// ∮ (R - x0)dR, the work that the support does, in kσ².
    pub work: f64,
}

/// A hold: the support stops, and later moves on.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "HoldDocument"))]
pub struct Hold {
    /// Time at which the support stops, in Γ/k.
    pub from: f64,
    /// Time at which the support moves on, in Γ/k.
    pub to: f64,
    /// The peak of the lateral force in the motion after the hold, up to the next turn or stop of the support; null if
    /// the force is largest at the end of this motion.
    pub peak: Option<Peak>,
}

/// A peak of the lateral force.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "PeakDocument"))]
pub struct Peak {
    /// Time, in Γ/k.
    pub t: f64,
    /// R - x0, the extension of the spring, in σ: the lateral force, in kσ; negative if the support moves backwards.
    pub lag: f64,
}

/// Number of Gauss points: on each step the lag is a polynomial of a degree below twice this number.
const POINTS: usize = 4;

static GAUSS: LazyLock<GaussLegendre> =
    LazyLock::new(|| GaussLegendre::new(const { NonZeroUsize::new(POINTS).unwrap() }));

/// Successive loops of a support on a path. Each ends when the support returns to its first position and moves in its
/// first direction, or when it stops there. A support of constant velocity has no loops.
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

/// The rests of a support on a path, without one that lasts until the end of the motion.
pub fn holds(motion: &Trajectory) -> Vec<Hold> {
    let Support::Path(path) = motion.support() else { return vec![] };
    let (t, way) = path.knots();
    let pieces = t.windows(2).zip(way.windows(2));
    let pieces: Vec<Phase> = pieces
        .map(|(t, way)| Phase { from: t[0], to: t[1], direction: direction(way[1] - way[0]) })
        .collect();
    // Neighbouring pieces in the same direction are one.
    let phases: Vec<Phase> = pieces
        .chunk_by(|a, b| a.direction == b.direction)
        .map(|part| Phase { to: part[part.len() - 1].to, ..part[0] })
        .collect();
    phases
        .windows(2)
        .filter(|pair| pair[0].direction == Ordering::Equal && pair[0].to < motion.end())
        .map(|pair| Hold { from: pair[0].from, to: pair[0].to, peak: peak(motion, pair[1]) })
        .collect()
}

/// A part of a path in which the support moves in one direction, or stands still.
#[derive(Debug, Clone, Copy)]
struct Phase {
    from: f64,
    to: f64,
    direction: Ordering,
}

fn direction(way: f64) -> Ordering {
    way.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// The largest extension of the spring in the direction of the support; `None` if it is reached at the end of the
/// phase.
fn peak(motion: &Trajectory, phase: Phase) -> Option<Peak> {
    let support = motion.support();
    let steps = motion.steps();
    let first = steps.partition_point(|step| step.t < phase.from);
    let within: Vec<&Step> = steps[first..].iter().take_while(|step| step.t < phase.to).collect();
    let mut at = vec![];
    for step in &within {
        let mut add = |t| at.push(Peak { t, lag: step.lag(support, t) });
        add(step.t);
        // R - x0 turns where l of a support of the same velocity does.
        extrema_within(step, support.velocity(step.t), |turn| add(turn.t));
        add(step.end());
    }
    let larger = |a: &Peak, b: &Peak| match phase.direction {
        Ordering::Less => b.lag.total_cmp(&a.lag),
        _ => a.lag.total_cmp(&b.lag),
    };
    let end = within.last()?.end();
    at.into_iter().max_by(larger).filter(|peak| peak.t < end)
}

/// Work ∫ (R - x0)dR of the support between two times.
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

/// Times at which closed loops of the support end: it is at its first position again, and moves in its first direction
/// or is at the end of its path.
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
    use crate::{Model, Scenario, Start, TipFunction, Wider, run};

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

    /// Without a groove a tip of inertia 1 is a damped oscillator: the lag y = R - x0 obeys y'' + y' + y = v, from
    /// y = 0 and y' = v on.
    #[test]
    fn the_peak_after_a_rest_is_that_of_the_free_oscillator() {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let path = |knots: &[(f64, f64)]| {
            let (t, way) = knots.iter().copied().unzip();
            SupportPath::new(t, way).unwrap()
        };
        // A long rest from the start, then forwards, a rest, and backwards in two pieces.
        let knots =
            [(0.0, 0.0), (60.0, 0.0), (100.0, 40.0), (160.0, 40.0), (180.0, 20.0), (190.0, 5.0)];
        let wider = Wider { inertia: Some(1.0), ..Wider::default() };
        let model = Model::under(wider, tip, 0.0, 1.0).unwrap();
        let scenario = Scenario {
            path: Some(path(&knots)),
            start: Start::Flat,
            ..Scenario::new(model, 175.0)
        };
        let found = holds(&run(&scenario).unwrap().trajectory);
        let (rate, omega) = (0.5, 0.75_f64.sqrt());
        let lag = |s: f64| {
            1.0 - (-rate * s).exp() * ((omega * s).cos() - (1.0 - rate) / omega * (omega * s).sin())
        };
        let slope = |s: f64| (lag(s + 1e-6) - lag(s - 1e-6)) / 2e-6;
        let (mut low, mut high) = (0.5, 4.0);
        while high - low > 1e-12 {
            let middle = 0.5 * (low + high);
            if slope(middle) > 0.0 { low = middle } else { high = middle }
        }
        assert_eq!(found.len(), 2);
        for (hold, (from, to, sign)) in found.iter().zip([(0.0, 60.0, 1.0), (100.0, 160.0, -1.0)]) {
            assert!((hold.from - from).abs() < 1e-12 && (hold.to - to).abs() < 1e-12, "{hold:?}");
            let peak = hold.peak.unwrap();
            assert!(
                (peak.t - to - low).abs() < 1e-5 && (peak.lag - sign * lag(low)).abs() < 1e-8,
                "{hold:?} {low}"
            );
        }
        let short = Scenario { until: 60.5, ..scenario.clone() };
        let rising = holds(&run(&short).unwrap().trajectory);
        assert!(matches!(rising[..], [Hold { peak: None, .. }]), "{rising:?}");
        let resting = Scenario { until: 59.0, ..scenario };
        assert!(holds(&run(&resting).unwrap().trajectory).is_empty());
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
