//! Linear stability and onset, judged by runs: two programs that share the tip function and nothing
//! else. The stability side integrates nothing in time, the integrator knows of no root.
//!
//! - Growth exponents against those fitted to runs from kicks of either sign, whose half difference is
//!   free of all even orders in the kick.
//! - The response (A.9) against runs with a pulse.
//! - The slope of amplitude² against limit cycles at α - αc = 1e-3 and 1e-4, extrapolated. A cycle is
//!   found by varying the start until the amplitude neither grows nor decays: waiting for one to settle
//!   would take some 1/(α - αc) units of time.

use std::f64::consts::PI;
use stickslip_stability::{critical, leading_roots, onset, response};
use stickslip_tip::{Force, Model, Pulse, Scenario, TipFunction, Trajectory, Wider, run};

pub(crate) fn triple(beta: f64) -> TipFunction {
    TipFunction::triple_gaussian(beta, 1.0).unwrap()
}

/// A tip that is in no figure of the paper: a narrow apex on a broad base.
fn apex() -> TipFunction {
    let g = |amplitude, width| stickslip_tip::Gaussian { amplitude, center: 0.0, width };
    TipFunction::gaussian_sum(vec![g(0.7, 0.6), g(0.3, 1.3)]).unwrap()
}

fn model_above(tip: &TipFunction, r: f64, above: f64) -> Model {
    let alpha = critical(&Wider::default(), tip, r).unwrap().alpha + above;
    Model::new(tip.clone(), alpha, r).unwrap()
}

/// The motion for `span` after a steady start with a kick.
fn kicked(model: &Model, kick: f64, span: f64) -> Trajectory {
    let base = Scenario::new(model.clone(), 0.0);
    let until = base.start_time() + span;
    run(&Scenario { kick, until, tolerance: 1e-13, ..base }).unwrap().trajectory
}

/// λ of the oscillation A e^{λt} + c.c. that y, sampled every `dt`, is: Prony's method, with
/// y(t+2dt) = p y(t+dt) + q y(t) in the least-squares sense.
pub(crate) fn fitted_exponent(y: &[f64], dt: f64) -> (f64, f64) {
    let sum = |f: &dyn Fn(&[f64]) -> f64| y.windows(3).map(f).sum::<f64>();
    let (aa, ab, bb) = (sum(&|w| w[1] * w[1]), sum(&|w| w[1] * w[0]), sum(&|w| w[0] * w[0]));
    let (ca, cb) = (sum(&|w| w[2] * w[1]), sum(&|w| w[2] * w[0]));
    let determinant = aa * bb - ab * ab;
    let (p, q) = ((ca * bb - cb * ab) / determinant, (cb * aa - ca * ab) / determinant);
    // The zeros of z² - pz - q are e^{λdt}, |z|² = -q, Re z = p/2.
    let modulus = (-q).sqrt();
    (modulus.ln() / dt, (0.5 * p / modulus).acos() / dt)
}

#[test]
fn leading_roots_are_the_exponents_fitted_to_runs_on_both_sides_of_the_boundary() {
    const KICK: f64 = 3e-5;
    // Further modes fade within 40 time units, to e^{-0.5·40} = 2e-9.
    const FROM: f64 = 40.0;
    let mut worst = 0.0_f64;
    for (tip, r) in [(triple(1.0), 1.0), (apex(), 0.7)] {
        for above in [-0.03, 0.03] {
            let model =
                model_above(&tip, r, above * critical(&Wider::default(), &tip, r).unwrap().alpha);
            let (up, down) = (kicked(&model, KICK, 140.0), kicked(&model, -KICK, 140.0));
            // A tenth of the period or so, and a hundred time units of it.
            let dt = 0.6;
            let y: Vec<f64> = (0..166)
                .map(|i| up.start() + FROM + dt * f64::from(i))
                .map(|t| 0.5 * (up.l(t) - down.l(t)))
                .collect();
            let fitted = fitted_exponent(&y, dt);
            let root = leading_roots(&model, 2).unwrap().roots[0];
            println!(
                "{above:+}: root {root:.10}, off {:.1e} {:.1e}",
                fitted.0 - root.re,
                fitted.1 - root.im
            );
            assert!(root.re * above > 1e-4, "the sides differ: {root}");
            worst = worst.max((fitted.0 - root.re).hypot(fitted.1 - root.im));
            // Negative control: the critical frequency is not the one fitted.
            assert!((fitted.1 - critical(&Wider::default(), &tip, r).unwrap().omega).abs() > 1e-4);
        }
    }
    println!("worst {worst:.1e} of 1e-7");
    assert!(worst < 1e-7, "{worst:e}");
}

#[test]
fn the_residue_sum_is_what_a_weak_pulse_does_to_a_run() {
    let (time, width) = (30.0, 0.5);
    for (tip, r, above) in [(triple(1.0), 1.0, -0.1), (triple(1.0), 1.0, 0.05), (apex(), 0.7, -0.2)]
    {
        let model = model_above(&tip, r, above);
        for amplitude in [1e-6, 1e-5, 1e-4] {
            let pulse = Pulse { amplitude, time, width };
            let force = Force::new(vec![pulse], None).unwrap();
            let base = Scenario::new(model.clone(), 0.0);
            let motion = run(&Scenario { force, until: 60.0, tolerance: 1e-13, ..base }).unwrap();
            let response = response(&model, &[pulse], 10).unwrap();
            let difference =
                |t: f64| (motion.trajectory.l(t) - model.steady_l() - response.at(t)).abs();
            let largest = |from: f64, to: f64, f: &dyn Fn(f64) -> f64| {
                (0..=400).map(|i| f(from + (to - from) * f64::from(i) / 400.0)).fold(0.0, f64::max)
            };
            let size = largest(time, 60.0, &|t| response.at(t).abs());
            // Three units of time after the center of the pulse, and while it lasts.
            let (after, during) = (
                largest(time + 3.0, 60.0, &difference) / size,
                largest(time - 2.0, time + 1.0, &difference) / size,
            );
            println!("α = {:.3}, A = {amplitude:e}: {after:.1e} of its size", model.alpha());
            // What is of second order in the pulse, and the tolerance of the run.
            assert!(after < 5.0 * amplitude + 1e-7, "{amplitude:e} {after:e}");
            // While the pulse lasts the modes left out are missed, and that is all.
            assert!((1e-3..0.1).contains(&during), "{during:e}");
        }
    }
}

/// The sum over twenty modes is off by up to a quarter then.
#[test]
fn while_a_pulse_lasts_the_response_is_what_it_does_to_runs() {
    const STRENGTH: f64 = 1e-3;
    for (tip, alpha, r, width) in
        [(triple(1.0), 0.9, 1.0, 0.5), (triple(0.0), 1.5, 1.0, 0.2), (apex(), 0.3, 0.7, 1.0)]
    {
        let model = Model::new(tip, alpha, r).unwrap();
        let center = Scenario::new(model.clone(), 0.0).start_time() + 12.0 * width;
        let (from, until) = (center - 3.0 * width, center + 6.0);
        let pushed = |strength: f64| {
            let pulse = Pulse { amplitude: strength, time: center, width };
            let force = Force::new(vec![pulse], None).unwrap();
            let base = Scenario::new(model.clone(), until);
            run(&Scenario { force, tolerance: 1e-13, ..base }).unwrap().trajectory
        };
        let (up, down) = (pushed(STRENGTH), pushed(-STRENGTH));
        let pulse = Pulse { amplitude: 1.0, time: 0.0, width };
        let modes = response(&model, &[pulse], 20).unwrap();
        let early = modes.while_pulses_last(&model, until - center).unwrap();
        let (mut worst, mut worst_of_modes, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
        for i in 0..=400 {
            let t = from + (until - from) * f64::from(i) / 400.0;
            let exact = 0.5 * (up.l(t) - down.l(t)) / STRENGTH;
            worst = worst.max((early.at(t - center) - exact).abs());
            worst_of_modes = worst_of_modes.max((modes.at(t - center) - exact).abs());
            largest = largest.max(exact.abs());
        }
        println!("off by {:.1e}, modes {:.1e}", worst / largest, worst_of_modes / largest);
        // Of third order in the pulse.
        assert!(worst < 1e-5 * largest);
        assert!(worst_of_modes > 1e-3 * largest);
    }
}

/// Half peak-to-peak of l over the period that ends at `end`.
fn amplitude(trajectory: &Trajectory, end: f64, period: f64) -> f64 {
    let extreme = |sign: f64| {
        let at = |i: i32| end - period + period * f64::from(i) / 64.0;
        let l = |t: f64| sign * trajectory.l(t);
        let best = (1..64).max_by(|a, b| l(at(*a)).total_cmp(&l(at(*b)))).unwrap();
        let (mut low, mut high) = (at(best - 1), at(best + 1));
        while high - low > 1e-7 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if l(a) < l(b) { low = a } else { high = b }
        }
        l(0.5 * (low + high))
    };
    0.5 * (extreme(1.0) + extreme(-1.0))
}

/// The motion for `span` after a force of the frequency of `period`, swelling and fading within 26
/// periods, which excites the leading pair of roots and hardly any other.
fn driven(model: &Model, strength: f64, period: f64, span: f64) -> Trajectory {
    let width = 2.0 * period;
    let base = Scenario::new(model.clone(), 0.0);
    let center = base.start_time() + 5.0 * width;
    let force = Force::from_fn(move |t| {
        let since = t - center;
        strength * (-0.5 * (since / width).powi(2)).exp() * (2.0 * PI * since / period).cos()
    });
    let until = base.start_time() + span;
    run(&Scenario { force, until, tolerance: 1e-13, ..base }).unwrap().trajectory
}

/// a² of the limit cycle at α = αc + above.
fn squared_amplitude(tip: &TipFunction, r: f64, above: f64) -> f64 {
    let onset = onset(tip, r).unwrap();
    let model = model_above(tip, r, above);
    let period = onset.critical.period + onset.period_slope * above;
    let faded = 26.0 * period;
    // The growth of ln a over forty periods, and a² in their middle.
    let growth = |strength: f64| {
        let trajectory = driven(&model, strength, period, faded + 40.0 * period);
        let first = amplitude(&trajectory, trajectory.start() + faded, period);
        let last = amplitude(&trajectory, trajectory.end(), period);
        ((last / first).ln(), first * last)
    };
    // Any strength; a second, corrected by what it made; then secants.
    let wanted = onset.amplitude_squared_slope * above;
    let strength = 0.1 * wanted.sqrt();
    let mut before = (strength, growth(strength));
    let strength = 0.97 * before.0 * (wanted / before.1.1).sqrt();
    let mut here = (strength, growth(strength));
    for _ in 0..8 {
        let slope = (before.1.0 - here.1.0) / (before.0 - here.0);
        assert!(slope < 0.0, "the cycle attracts: {before:?} {here:?}");
        let strength = here.0 - here.1.0 / slope;
        (before, here) = (here, (strength, growth(strength)));
        if here.1.0.abs() < 1e-8 {
            break;
        }
    }
    assert!(here.1.0.abs() < 1e-8, "not on the cycle: {here:?}");
    println!("  α - αc = {above:e}: a = {:.9}, ln a grows by {:.0e}", here.1.1.sqrt(), here.1.0);
    here.1.1
}

#[test]
fn the_square_of_the_amplitude_grows_with_the_slope_of_the_expansion() {
    let mut worst = 0.0_f64;
    for (beta, r) in [(1.0, 1.0), (0.0, 1.0), (1.0, 0.3), (0.0, 0.3)] {
        let tip = triple(beta);
        let [coarse, fine] = [1e-3, 1e-4].map(|above| squared_amplitude(&tip, r, above) / above);
        let extrapolated = fine + (fine - coarse) / 9.0;
        let slope = onset(&tip, r).unwrap().amplitude_squared_slope;
        let off = (extrapolated / slope - 1.0).abs();
        println!(
            "β = {beta}, r = {r}: cycles {extrapolated:.8}, expansion {slope:.8}, off {off:.1e}"
        );
        worst = worst.max(off);
        // Negative control: not extrapolated, the cycles are further off.
        assert!((coarse / slope - 1.0).abs() > 2.0 * off, "{coarse} {slope}");
    }
    println!("worst {worst:.1e} of 1e-4");
    assert!(worst < 1e-4, "{worst:e}");
}
