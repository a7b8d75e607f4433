//! Are branches of cycles followed, and their special points found where they are? Judged by
//!
//! - linear stability of steady motion (crates/tip/src/stability), which knows nothing of cycles, for Hopf points,
//! - the branch of twice the period, which must begin and end where the other one doubles,
//! - runs of the integrator on both sides of a point,
//! - the branch itself with other steps and tolerances.

use crate::acceptance::Acceptance;
use std::ops::ControlFlow;
use stickslip_cycles::{
    Branch, Continuation, Cycle, DEFAULT_TOLERANCE, End, Parameter, Special, SpecialKind, cycle,
};
use stickslip_outcome::{Regime, run_and_judge};
use stickslip_stability::{critical, critical_r};
use stickslip_tip::{Gaussian, Model, Scenario, TipFunction, Wider};

fn tip() -> TipFunction {
    TipFunction::triple_gaussian(1.0, 1.0).unwrap()
}

fn on(_: &Cycle) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// β = 1, r = 1, from onset to α = 1.83.
fn branch(settings: Continuation) -> Branch {
    Continuation { to: 1.83, ..settings }.from_onset(&tip(), 1.0, on).unwrap()
}

fn of_kind(branch: &Branch, kind: SpecialKind) -> Vec<Special> {
    branch.special.iter().filter(|s| s.kind == kind).cloned().collect()
}

fn judge(name: &str, error: f64, bound: f64) {
    Acceptance { floor: bound, slack: 0.0 }.judge(name, error.abs(), 0.0);
}

/// Where single-period cycles lose their stability, and where they regain it. As found here; what they are
/// worth, the tests below say.
const DOUBLINGS: [f64; 2] = [1.504_462_997, 1.789_591_909];

#[test]
fn the_period_doubles_and_comes_back_where_branches_of_twice_the_period_say_so() {
    let settings = Continuation::default();
    let single = branch(settings);
    let doublings = of_kind(&single, SpecialKind::PeriodDoubling);
    assert_eq!(doublings.len(), 2);
    for (special, known) in doublings.iter().zip(DOUBLINGS) {
        judge("known", special.alpha - known, 2e-9);
        let leading = special.cycle.as_ref().unwrap().nontrivial_multipliers().next().unwrap();
        judge("multiplier + 1", (leading + 1.0).norm(), 1e-8);
    }
    // The branch of twice the period that leaves at one ends at the other, either way.
    for (from, to) in [(0, 1), (1, 0)] {
        let doubled = settings.switched(&doublings[from], on).unwrap();
        assert_eq!(doubled.end, End::Halved);
        let halving = of_kind(&doubled, SpecialKind::PeriodHalving);
        judge("where it ends", halving[0].alpha - doublings[to].alpha, 1e-8);
        // Its own multiplier, of another orbit on another mesh, is 1 where it begins: extrapolated from its
        // first three cycles, quadratically.
        let [a, b, c] = [0, 1, 2].map(|i| &doubled.points[i]);
        let x = [a, b, c].map(|p| p.leading.re - 1.0);
        let weight = |i: usize, j: usize, k: usize| x[j] * x[k] / ((x[i] - x[j]) * (x[i] - x[k]));
        let begins =
            a.alpha * weight(0, 1, 2) + b.alpha * weight(1, 2, 0) + c.alpha * weight(2, 0, 1);
        judge("where its multiplier is 1", begins - doublings[from].alpha, 1e-6);
        assert!(doubled.points.iter().all(|p| p.stable));
        judge("period", a.period / (2.0 * doublings[from].period) - 1.0, 1e-4);
    }
    // Between the two, and nowhere else, single-period cycles are unstable.
    for point in &single.points {
        let unstable = (DOUBLINGS[0]..DOUBLINGS[1]).contains(&point.alpha);
        assert_eq!(point.stable, !unstable, "α = {}", point.alpha);
    }
}

#[test]
fn runs_on_both_sides_of_a_doubling_have_one_slip_or_two() {
    for (alpha, slips) in [
        (DOUBLINGS[0] - 2e-3, 1),
        (DOUBLINGS[0] + 2e-3, 2),
        (DOUBLINGS[1] - 2e-3, 2),
        (DOUBLINGS[1] + 2e-3, 1),
    ] {
        let model = Model::new(tip(), alpha, 1.0).unwrap();
        let scenario = Scenario { kick: 0.1, tolerance: 1e-8, ..Scenario::new(model.clone(), 1e4) };
        let outcome = run_and_judge(&scenario).unwrap().1;
        let oscillation = outcome.oscillation.unwrap();
        assert_eq!(oscillation.slips, slips, "α = {alpha}");
        // And what is found from nothing is what runs settle into.
        let found = cycle(&model, DEFAULT_TOLERANCE).unwrap();
        assert!(found.is_stable());
        judge("period", found.period() - oscillation.period, 1e-5);
    }
}

#[test]
fn special_points_depend_neither_on_steps_nor_on_the_tolerance() {
    let steps = Continuation { longest_step: 0.02, ..Continuation::default() };
    let tolerance = Continuation { tolerance: 1e-7, ..Continuation::default() };
    for (settings, bound) in [(steps, 2e-9), (tolerance, 1e-7)] {
        let doublings = of_kind(&branch(settings), SpecialKind::PeriodDoubling);
        for (special, known) in doublings.iter().zip(DOUBLINGS) {
            judge("doubling", special.alpha - known, bound);
        }
        assert_eq!(doublings.len(), 2);
    }
}

#[test]
fn a_branch_consists_of_the_cycles_that_are_found_alone() {
    let all = branch(Continuation::default());
    assert_eq!(all.end, End::Reached);
    judge("end", all.last.model().alpha() - 1.83, 1e-15);
    for point in all.points.iter().filter(|p| p.stable).step_by(5) {
        let alone = cycle(&Model::new(tip(), point.alpha, 1.0).unwrap(), DEFAULT_TOLERANCE);
        let alone = alone.unwrap();
        judge("period", alone.period() - point.period, 1e-8);
        judge("amplitude of x0", alone.amplitude_x0() - point.amplitude_x0, 1e-8);
        judge("amplitude of u", alone.amplitude_u() - point.amplitude_u, 1e-8);
    }
}

#[test]
fn a_branch_followed_back_ends_at_the_critical_point() {
    let start = cycle(&Model::new(tip(), 1.2, 1.0).unwrap(), DEFAULT_TOLERANCE).unwrap();
    for (over, to) in [(Parameter::Alpha, 0.1), (Parameter::R, 9.0)] {
        let settings = Continuation { over, to, ..Continuation::default() };
        let back = settings.from_cycle(&start, on).unwrap();
        assert_eq!(back.end, End::Steady);
        let hopf = &of_kind(&back, SpecialKind::Hopf)[0];
        let known = match over {
            Parameter::Alpha => critical(&Wider::default(), &tip(), 1.0).unwrap(),
            Parameter::R => critical_r(&Wider::default(), &tip(), 1.2).unwrap(),
        };
        judge("α", hopf.alpha - known.alpha, 1e-8);
        judge("r", hopf.r - known.r, 1e-8);
        judge("period", hopf.period - known.period, 1e-7);
    }
}

/// Where onset is subcritical: an unstable cycle is born downwards, and turns back as a stable one.
#[test]
fn a_branch_goes_through_its_fold() {
    let term = |width| Gaussian { amplitude: 1.0, center: 0.0, width };
    let broad = TipFunction::gaussian_sum(vec![term(1.0), term(3.0)]).unwrap();
    let settings = Continuation { to: 1.69, tolerance: 1e-7, ..Continuation::default() };
    let born = critical(&Wider::default(), &broad, 1.0).unwrap();
    let found = settings.from_onset(&broad, 1.0, on).unwrap();
    assert_eq!(found.end, End::Reached);
    let folds = of_kind(&found, SpecialKind::Fold);
    assert_eq!(folds.len(), 1);
    let fold = &folds[0];
    assert!(fold.alpha < born.alpha - 1e-3);
    let leading = fold.cycle.as_ref().unwrap().nontrivial_multipliers().next().unwrap();
    // At a fold 1 is a double eigenvalue, known to the root of what others are known to.
    judge("multiplier - 1", (leading - 1.0).norm(), 1e-4);
    let turn = found.points.iter().position(|p| p.stable).unwrap();
    assert!(found.points[..turn].iter().all(|p| !p.stable));
    assert!(found.points[turn..].iter().all(|p| p.stable && p.alpha >= fold.alpha));
    // Between fold and onset a small kick dies out, and a large one does not.
    let model = Model::new(broad, 0.5 * (fold.alpha + born.alpha), 1.0).unwrap();
    let ends = [0.2, 6.0].map(|kick| {
        let scenario = Scenario { kick, tolerance: 1e-7, ..Scenario::new(model.clone(), 2e4) };
        run_and_judge(&scenario).unwrap().1.regime
    });
    assert_eq!(ends, [Regime::Steady, Regime::StickSlip]);
}

#[test]
fn towards_trapping_a_branch_ends_with_its_period() {
    let settings = Continuation { longest_period: 100.0, ..Continuation::default() };
    let long = settings.from_onset(&tip(), 1.0, on).unwrap();
    assert_eq!(long.end, End::LongPeriod);
    assert!(long.last.period() > 100.0 && long.last.model().alpha() < 2.086_841);
}

#[test]
fn an_observer_may_stop_a_branch() {
    let mut seen = 0;
    let stopped = Continuation::default().from_onset(&tip(), 1.0, |_| {
        seen += 1;
        if seen == 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let stopped = stopped.unwrap();
    assert_eq!((stopped.end, stopped.points.len()), (End::Interrupted, 7));
}
