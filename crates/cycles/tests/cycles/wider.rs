//! Cycles under the wider law against runs, which know nothing of them: their own steps, memories and corners.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use stickslip_cycles::{
    Continuation, Cycle, CycleError, End, Parameter, SpecialKind, cycle, cycle_near,
};
use stickslip_tip::motion::{Extremum, latest_extrema};
use stickslip_tip::{MemoryChoice, Model, Scenario, TipFunction, Wider, run};

fn model(beta: f64, alpha: f64, r: f64, [b, time, mass]: [f64; 3]) -> Model {
    let given = |value: f64| (value > 0.0).then_some(value);
    let (depth_limit, healing_time, inertia) = (given(b), given(time), given(mass));
    let wider = Wider { depth_limit, healing_time, inertia, spring: true };
    Model::under(wider, TipFunction::triple_gaussian(beta, 1.0).unwrap(), alpha, r).unwrap()
}

/// Maxima of l of a run with a kick, latest first.
fn maxima(model: &Model, until: f64, memory: MemoryChoice) -> Vec<Extremum> {
    maxima_with(model, until, (0.3, memory))
}

fn maxima_from(model: &Model, kick: f64, until: f64) -> Vec<Extremum> {
    maxima_with(model, until, (kick, MemoryChoice::Auto))
}

fn maxima_with(model: &Model, until: f64, (kick, memory): (f64, MemoryChoice)) -> Vec<Extremum> {
    let mut scenario = Scenario::new(model.clone(), 0.0);
    (scenario.kick, scenario.tolerance, scenario.memory) = (kick, 1e-12, memory);
    scenario.until = scenario.start_time() + until;
    let run = run(&scenario).unwrap();
    latest_extrema(&run.trajectory).into_iter().filter(|extremum| extremum.is_maximum).collect()
}

/// With a corner of |h| in them (β = 1, or deep slips at β = 0) and without, each extension and all together.
const CASES: [(f64, f64, f64, [f64; 3], f64); 8] = [
    (1.0, 20.0, 1.0, [10.0, 0.0, 0.0], 900.0),
    (0.0, 8.0, 1.0, [5.0, 0.0, 0.0], 300.0),
    (1.0, 1.3, 1.0, [5.0, 0.0, 0.0], 300.0),
    (1.0, 1.5, 1.0, [0.0, 10.0, 0.0], 300.0),
    (1.0, 1.2, 1.0, [0.0, 0.0, 0.3], 300.0),
    (0.0, 3.0, 0.3, [3.0, 0.0, 0.0], 500.0),
    (1.0, 2.0, 1.0, [4.0, 15.0, 0.3], 300.0),
    (1.0, 6.0, 0.5, [2.0, 20.0, 0.5], 500.0),
];

#[test]
fn periods_and_maxima_are_those_that_runs_settle_into() {
    for (beta, alpha, r, wider, until) in CASES {
        let model = model(beta, alpha, r, wider);
        let found = cycle(&model, 1e-9).unwrap();
        let maxima = maxima(&model, until, MemoryChoice::Auto);
        let period = maxima[0].t - maxima[1].t;
        let off = (found.period() - period).abs();
        println!("{beta} {alpha} {r} {wider:?}: period off {off:.1e}, error {:.1e}", found.error());
        assert!(off < 1e-8, "{beta} {alpha} {wider:?}: {} {period}", found.period());
        assert!((found.extremes().1 - maxima[0].l).abs() < 1e-8, "{beta} {alpha} {wider:?}");
        assert!(found.error() < 1e-8);
    }
}

/// The reference of the issue: a run of the prototype gave 51.2220627(2). And against `direct`, sums over the whole past.
#[test]
fn a_cycle_far_above_onset_with_corners_has_its_period() {
    let model = model(1.0, 20.0, 1.0, [10.0, 0.0, 0.0]);
    let found = cycle(&model, 1e-9).unwrap();
    assert!((found.period() - 51.222_062_7).abs() < 2e-7, "{}", found.period());
    let heights = |t: f64| found.motion().height(t).unwrap();
    let ends = found.motion().steps().iter().map(|step| heights(step.end()));
    let corners = ends.filter(|height| height.abs() < 1e-6).count();
    assert!(corners >= 2, "{corners}");
    let maxima = maxima(&model, 400.0, MemoryChoice::Direct);
    assert!((maxima[0].t - maxima[1].t - found.period()).abs() < 1e-8);
}

/// The multiplier of a shift in time is 1, whatever the law, with a corner on the way or without.
#[test]
fn a_shift_in_time_keeps_its_size() {
    for (beta, alpha, r, wider, _) in CASES {
        let found = cycle(&model(beta, alpha, r, wider), 1e-9).unwrap();
        let distance = found.multipliers().iter().map(|m| (m - 1.0).norm());
        let distance = distance.fold(f64::INFINITY, f64::min);
        println!("{beta} {alpha} {wider:?}: {distance:.1e}");
        assert!(distance < 1e-8, "{beta} {alpha} {wider:?}: {distance:e}");
    }
}

/// By the leading multiplier the maxima of a run come nearer to the cycle from period to period.
#[test]
fn leading_multipliers_are_those_by_which_runs_approach() {
    for (beta, alpha, r, wider, back) in [
        (0.0, 8.0, 1.0, [5.0, 0.0, 0.0], 8),
        (1.0, 1.3, 1.0, [5.0, 0.0, 0.0], 10),
        (1.0, 1.5, 1.0, [0.0, 10.0, 0.0], 12),
        (0.0, 2.6, 1.0, [0.0, 10.0, 0.1], 12),
    ] {
        let model = model(beta, alpha, r, wider);
        let found = cycle(&model, 1e-10).unwrap();
        let maxima = maxima(&model, 300.0, MemoryChoice::Auto);
        let highest = found.extremes().1;
        let earliest_first: Vec<f64> = maxima.iter().rev().map(|m| m.l - highest).collect();
        let ratio = earliest_first[back] / earliest_first[back - 1];
        let leading = found.nontrivial_multipliers().next().unwrap();
        println!("{beta} {alpha} {wider:?}: {ratio} {leading}");
        assert!(leading.im.abs() < 1e-9 && (ratio / leading.re - 1.0).abs() < 2e-2);
    }
}

/// Errors fall with the tolerance, and stay within what is said of them; also beside a corner that all amplitudes feel.
#[test]
fn tolerances_are_met() {
    for (beta, alpha, r, wider) in [
        (1.0, 20.0, 1.0, [10.0, 0.0, 0.0]),
        (1.0, 1.076, 1.0, [5.0, 0.0, 0.0]),
        (1.0, 1.5, 1.0, [0.0, 10.0, 0.0]),
        (1.0, 6.0, 0.5, [2.0, 20.0, 0.5]),
        (0.0, 2.6, 1.0, [20.0, 0.0, 0.0]),
    ] {
        let model = model(beta, alpha, r, wider);
        let best = cycle(&model, 1e-9).unwrap();
        for tolerance in [1e-4, 1e-5, 1e-6, 1e-7, 1e-8] {
            let found = cycle(&model, tolerance).unwrap();
            let off = (found.period() - best.period()).abs();
            let off = off.max((found.amplitude_x0() - best.amplitude_x0()).abs());
            println!("{alpha} {wider:?} {tolerance:e}: off {off:.1e}, said {:.1e}", found.error());
            assert!(off <= found.error() + best.error(), "{alpha} {wider:?} {tolerance:e} {off:e}");
            assert!(found.residual() <= tolerance);
        }
    }
}

/// A tip that swings back farther than the usual sums hold.
#[test]
fn a_tip_with_inertia_may_swing_back_far() {
    let model = model(1.0, 6.0, 0.5, [0.0, 20.0, 0.5]);
    let found = cycle(&model, 1e-8).unwrap();
    let maxima = maxima(&model, 1200.0, MemoryChoice::Auto);
    assert_eq!(found.slips(), 2);
    assert!((maxima[0].t - maxima[2].t - found.period()).abs() < 1e-7, "{}", found.period());
}

/// A branch from its non-smooth onset, and one from its smooth onset, lead to the cycles that are found by themselves.
#[test]
fn branches_lead_from_onset_to_cycles() {
    for (beta, wider, to, hopf) in [
        (1.0, [5.0, 0.0, 0.0], 1.3, 1.073_134),
        (0.0, [20.0, 0.0, 0.0], 2.6, 2.300_070),
        (1.0, [0.0, 10.0, 0.0], 1.5, 1.340_504),
        (1.0, [4.0, 15.0, 0.3], 1.9, f64::NAN),
    ] {
        let at = model(beta, to, 1.0, wider);
        let settings = Continuation { to, ..Continuation::default() };
        let go_on = |_: &_| std::ops::ControlFlow::Continue(());
        let branch = settings.from_onset_under((at.wider(), at.tip()), 1.0, go_on).unwrap();
        let onset = branch.special[0].alpha;
        assert!(hopf.is_nan() || (onset - hopf).abs() < 1e-6, "{onset}");
        let alone = cycle(&at, 1e-9).unwrap();
        assert!((branch.last.period() - alone.period()).abs() < 1e-8, "{beta} {wider:?}");
        assert!((branch.last.amplitude_x0() - alone.amplitude_x0()).abs() < 1e-8);
    }
}

/// The small cycle of this branch comes to touch the corner of |h|, and from there turns back: a fold that no smooth law
/// makes. Below onset there is steady motion beside the large cycle.
#[test]
fn a_branch_goes_on_where_its_cycles_begin_to_pass_the_corner() {
    let wider = [4.0, 15.0, 0.3];
    let at = model(1.0, 2.0, 1.0, wider);
    let settings = Continuation { to: 2.0, ..Continuation::default() };
    let go_on = |_: &_| std::ops::ControlFlow::Continue(());
    let branch = settings.from_onset_under((at.wider(), at.tip()), 1.0, go_on).unwrap();
    let onset = branch.special[0].alpha;
    let folds = branch.special.iter().filter(|s| s.kind == SpecialKind::Fold);
    let folds: Vec<f64> = folds.map(|fold| fold.alpha).collect();
    println!("{onset} {folds:?}");
    assert_eq!(folds.len(), 2);
    assert!(folds[0] > onset && folds[1] < onset - 0.1, "{onset} {folds:?}");
    // Below onset a run with a large kick goes to the large cycle, which attracts, beside steady motion that does.
    let below = model(1.0, 1.62, 1.0, wider);
    let large = cycle_at(&branch.last, 1.62, wider);
    assert!(large.is_stable());
    let near = maxima_from(&below, 1.5, 500.0);
    assert!((near[0].t - near[1].t - large.period()).abs() < 1e-8, "{near:?}");
    assert!((near[0].l - large.extremes().1).abs() < 1e-8);
}

/// The cycle at another α of the branch that this one is on.
fn cycle_at(cycle: &Cycle, alpha: f64, wider: [f64; 3]) -> Cycle {
    let settings = Continuation { to: alpha, ..Continuation::default() };
    let branch = settings.from_cycle(cycle, |_| std::ops::ControlFlow::Continue(())).unwrap();
    cycle_near(&model(1.0, alpha, 1.0, wider), branch.last.motion(), 1e-9).unwrap()
}

#[test]
fn a_cycle_leads_to_its_neighbour_and_what_has_none_is_refused() {
    let (here, there) =
        (model(1.0, 6.0, 0.5, [2.0, 20.0, 0.0]), model(1.0, 6.3, 0.5, [2.0, 20.0, 0.0]));
    let found = cycle(&here, 1e-9).unwrap();
    let next = cycle_near(&there, found.motion(), 1e-9).unwrap();
    assert!((next.period() - cycle(&there, 1e-9).unwrap().period()).abs() < 1e-8);
    let settings = Continuation { over: Parameter::R, to: 0.6, ..Continuation::default() };
    let branch = settings.from_cycle(&found, |_| std::ops::ControlFlow::Continue(())).unwrap();
    let end = cycle(&model(1.0, 6.0, 0.6, [2.0, 20.0, 0.0]), 1e-9).unwrap();
    assert!((branch.last.period() - end.period()).abs() < 1e-8);
    let free = Wider { spring: false, ..Wider::default() };
    let free = Model::under(free, here.tip().clone(), -3.0, 0.0).unwrap();
    assert_eq!(cycle(&free, 1e-9).unwrap_err(), CycleError::NoSpring);
}

/// From α = 4.84 on the tip moves back by more than half a width after each slip. The period at α = 5 is that of a
/// simulation in Python (f as a sum over a lattice of Gaussians, extrapolated midpoint rule at 1e-12), 29.001173605(5).
#[test]
fn a_branch_goes_on_where_a_tip_with_inertia_swings_back_farther() {
    let wider = [0.0, 8.0, 0.9];
    let before = cycle(&model(0.5, 4.8, 1.0, wider), 1e-9).unwrap();
    let settings = Continuation { to: 5.0, ..Continuation::default() };
    let branch = settings.from_cycle(&before, |_| std::ops::ControlFlow::Continue(())).unwrap();
    assert_eq!(branch.end, End::Reached);
    assert!((branch.last.period() - 29.001_173_605).abs() < 5e-9, "{}", branch.last.period());
}

/// From α = 1.4806 on the tip moves back by more than a quarter of the reach of the footprint after each slip. For the
/// period at α = 1.6 shooting in Python (f as a sum over a lattice of Gaussians, extrapolated midpoint rule at 1e-11)
/// gives this α to 1e-12, and the multiplier -4.4327385.
#[test]
fn a_branch_goes_on_where_a_tip_swings_back_by_more_than_two_widths() {
    let before = cycle(&model(0.5, 1.48, 0.8475, [0.0, 84.6, 2.55]), 1e-9).unwrap();
    let settings = Continuation { to: 1.6, ..Continuation::default() };
    let branch = settings.from_cycle(&before, |_| std::ops::ControlFlow::Continue(())).unwrap();
    assert_eq!(branch.end, End::Reached);
    assert!((branch.last.period() - 36.780_143_239).abs() < 2e-9, "{}", branch.last.period());
    let multiplier = branch.points.last().unwrap().leading;
    assert!((multiplier + 4.432_738_5).norm() < 1e-7, "{multiplier}");
}

/// A heavy tip swings back by up to the reach of its footprint. From there no sum covers its history, but a branch goes on:
/// for β = 0.5, r = 0.8475, T = 84.6, M = 2.55, which is lost at α = 2.4489, a continuation in Python (Fourier
/// collocation of f as it stands, 2,048 points) follows it from the fold at 2.4557 down to 2.13.
#[test]
fn a_branch_that_is_lost_where_a_tip_swings_back_farthest_says_so() {
    let law = Wider { inertia: Some(30.0), ..Wider::default() };
    let settings = Continuation { tolerance: 1e-4, longest_step: 0.4, ..Continuation::default() };
    let gaussian = TipFunction::gaussian(1.0).unwrap();
    let on = |_: &_| std::ops::ControlFlow::Continue(());
    let branch = settings.from_onset_under((&law, &gaussian), 1.0, on).unwrap();
    assert_eq!(branch.end, End::Lost);
    let reach = gaussian.reach().unwrap();
    let retreat = branch.last.farthest_retreat().unwrap();
    assert!(retreat > 0.999 * reach && retreat <= reach, "{retreat} of {reach}");
    let before = Continuation { to: 2.0, ..settings };
    let branch = before.from_onset_under((&law, &gaussian), 1.0, on).unwrap();
    assert_eq!((branch.end, branch.last.farthest_retreat()), (End::Reached, None));
}
