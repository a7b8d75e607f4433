//! Does the integrator converge at its order? Judged by a manufactured solution: l(t) is chosen, the
//! force that makes it exact comes from Gauss-Legendre quadrature of (15) in this file, which shares
//! nothing with the integrator but f'.

use crate::acceptance::{largest_difference, observed_order};
use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;
use stickslip_tip::memory::{Policy, Retreat};
use stickslip_tip::{
    Force, InitialSurface, Integrator, MemoryChoice, Model, STAGES, Scenario, Step, TipFunction,
    Trajectory, nodes_and_weights,
};

const X: f64 = 14.0;
const DURATION: f64 = 12.0;

fn model() -> Model {
    Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.2, 1.0).unwrap()
}

/// Extension of the spring rt - x0, chosen: it starts at the steady lag and swings by one width.
fn extension(model: &Model, since: f64) -> f64 {
    model.steady_lag() + 0.5 * (1.0 - (1.1 * since).cos()) + 0.1 * (2.3 * since).sin()
}

fn extension_rate(since: f64) -> f64 {
    0.55 * (1.1 * since).sin() + 0.23 * (2.3 * since).cos()
}

/// Fext(t) = x0' + u_x(x0) - (rt - x0), u_x = u0'(x0) - α ∫ f'(x0(t) - x0(t'))dt'.
fn manufactured_force(model: &Model) -> Force {
    let rule = GaussLegendre::new(NonZeroUsize::new(12).unwrap());
    let model = model.clone();
    let t1 = (X + model.steady_lag()) / model.r();
    Force::from_fn(move |t| {
        let since = t - t1;
        let x0 = |since: f64| model.r() * (t1 + since) - extension(&model, since);
        let here = x0(since);
        let panels = (since / 0.3).ceil().max(1.0);
        let width = since / panels;
        let mut integral = 0.0;
        for panel in 0..panels as u32 {
            for (node, weight) in rule.as_node_weight_pairs() {
                let then = width * (f64::from(panel) + 0.5 * (1.0 + node));
                integral += 0.5 * width * weight * model.tip().slope(here - x0(then));
            }
        }
        let u0_slope = model.alpha() / model.r() * model.tip().value(here - X);
        let velocity = model.r() - extension_rate(since);
        velocity + u0_slope - model.alpha() * integral - extension(&model, since)
    })
}

/// Errors at step ends and anywhere, with n equal steps.
fn errors(model: &Model, force: &Force, memory: Policy, n: u32) -> (f64, f64) {
    errors_after(model, force, (memory, f64::INFINITY), n)
}

/// The same of a memory that forgets what is older than an age.
fn errors_after(
    model: &Model,
    force: &Force,
    (memory, oldest): (Policy, f64),
    n: u32,
) -> (f64, f64) {
    let surface = InitialSurface::steady(model, X);
    let t1 = (X + model.steady_lag()) / model.r();
    let end = t1 + DURATION;
    let scenario = Scenario {
        start_position: X,
        force: force.clone(),
        tolerance: 1e-13,
        ..Scenario::new(model.clone(), end)
    };
    let mut integrator =
        Integrator::new(&scenario, &surface, memory).with_fixed_step(DURATION / f64::from(n));
    let mut steps = vec![];
    while integrator.t() < end {
        integrator.step().unwrap();
        steps.extend(integrator.last());
        if oldest.is_finite() {
            *integrator.memory_mut() = cut(model, &steps, oldest);
        }
    }
    let exact = |t: f64| extension(model, t - t1) - model.r();
    let trajectory = Trajectory::new(model.r(), steps);
    let at_ends = trajectory.steps().iter().map(|s| (trajectory.l(s.t) - exact(s.t)).abs());
    let anywhere = largest_difference(|t| trajectory.l(t), exact, (t1, end), 5000);
    (at_ends.fold(0.0, f64::max), anywhere)
}

fn memory(choice: MemoryChoice, model: &Model) -> Policy {
    Policy::new(choice, model.tip().clone(), 0.0, Retreat::Small).unwrap()
}

/// Errors at step ends fall to round-off before those within a step become asymptotic, so each order has
/// a range of its own: h from 1 to 0.4, and from 0.2 to 0.1.
#[test]
fn order_11_at_step_ends_and_7_within_for_both_memories() {
    let model = model();
    let force = manufactured_force(&model);
    for choice in [MemoryChoice::Direct, MemoryChoice::Fft] {
        let ladder = |counts: [u32; 6]| {
            counts.map(|n| {
                (DURATION / f64::from(n), errors(&model, &force, memory(choice, &model), n))
            })
        };
        let ends = ladder([12, 15, 18, 21, 25, 30]).map(|(h, (at_ends, _))| (h, at_ends));
        let within = ladder([61, 70, 80, 92, 106, 120]).map(|(h, (_, anywhere))| (h, anywhere));
        let (p, q) = (observed_order(&ends), observed_order(&within));
        println!("{choice:?}: order {p:.2} at step ends {ends:?}, {q:.2} anywhere {within:?}");
        let s = STAGES as f64;
        assert!((p - (2.0 * s - 1.0)).abs() < 1.0, "{choice:?}: order {p} at step ends");
        assert!((q - (s + 1.0)).abs() < 0.5, "{choice:?}: order {q} anywhere");
    }
}

/// The memory of the last steps, of at most this duration together.
fn cut(model: &Model, steps: &[Step], oldest: f64) -> Policy {
    let mut memory = memory(MemoryChoice::Direct, model);
    let (_, b) = nodes_and_weights();
    let mut age = 0.0;
    let recent = steps.iter().rev().take_while(|step| {
        age += step.h;
        age <= oldest
    });
    let recent: Vec<&Step> = recent.collect();
    for step in recent.into_iter().rev() {
        memory.remember(&step.displacement, &b.map(|b| b * step.h));
    }
    memory
}

/// Negative control: a memory that forgets what is older than four time units.
#[test]
fn a_memory_cut_by_time_does_not_converge() {
    let model = model();
    let force = manufactured_force(&model);
    let forgetful = (memory(MemoryChoice::Direct, &model), 4.0);
    let (at_ends, _) = errors_after(&model, &force, forgetful, 30);
    println!("cut by time: {at_ends:.2e}");
    assert!(at_ends > 1e-3);
}
