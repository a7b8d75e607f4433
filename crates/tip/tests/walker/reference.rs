//! The reference: the equation as it stands, summed over the whole past at every stage of a fixed step.
//!
//! ```text
//!     M x'' + x' = α ∫ ∇J0(|x - x(t')|) e^{-(t-t')/T} dt' - Ω ẑ × x' - K x + F(t)
//! ```
//!
//! Gauss collocation of four stages, of order 8 at the ends of steps, its equations solved by plain iteration; the integral
//! is the method's own quadrature. J1 is that of the C library. Nothing here is shared with the library: no plane waves, no
//! series, no forgetting.

use crate::gauss::{Method, STAGES};
use stickslip_tip::walker::WalkerScenario;

const MOST_ITERATIONS: usize = 200;

/// Where the particle was, when, and for how long.
struct Visit {
    t: f64,
    at: [f64; 2],
    spent: f64,
}

/// ∇J0(|d|) = -J1(|d|) d/|d|
fn gradient([x, y]: [f64; 2]) -> [f64; 2] {
    let d = x.hypot(y);
    let factor = if d > 0.0 { -libm::j1(d) / d } else { -0.5 };
    [factor * x, factor * y]
}

/// Times and positions at the ends of so many equal steps on a field that is flat at first.
pub(crate) fn motion(scenario: &WalkerScenario, steps: usize) -> Vec<(f64, [f64; 2])> {
    let (method, h) = (Method::new(), scenario.until / steps as f64);
    let (mut at, mut v) = (scenario.position, scenario.velocity);
    let (mut visits, mut motion): (Vec<Visit>, _) = (vec![], vec![(0.0, at)]);
    for n in 0..steps {
        let t = h * n as f64;
        let stages = stages(scenario, (&method, t, h), (at, v), &visits);
        for (k, (place, rate, gain)) in stages.iter().enumerate() {
            let spent = h * method.b[k];
            visits.push(Visit { t: t + h * method.c[k], at: *place, spent });
            for j in 0..2 {
                at[j] += spent * rate[j];
                v[j] += spent * gain[j];
            }
        }
        motion.push((t + h, at));
    }
    motion
}

type Stage = ([f64; 2], [f64; 2], [f64; 2]);

/// Position, x' and x'' at the stages of a step.
fn stages(
    scenario: &WalkerScenario,
    (method, t, h): (&Method, f64, f64),
    (at, v): ([f64; 2], [f64; 2]),
    visits: &[Visit],
) -> [Stage; STAGES] {
    let mut stages: [Stage; STAGES] = [(at, v, [0.0; 2]); STAGES];
    for n in 0..MOST_ITERATIONS {
        let before = stages;
        let carried = |part: fn(&Stage) -> [f64; 2], i: usize, j: usize| -> f64 {
            h * (0..STAGES).map(|k| method.a[i][k] * part(&before[k])[j]).sum::<f64>()
        };
        stages = std::array::from_fn(|i| {
            let place = [0, 1].map(|j| at[j] + carried(|s| s.1, i, j));
            let now = t + h * method.c[i];
            let mut force = [0, 1].map(|j| scenario.force[j].value(now) - scenario.trap * place[j]);
            let own = (0..STAGES).map(|k| Visit {
                t: t + h * method.c[k],
                at: before[k].0,
                spent: h * method.a[i][k],
            });
            for visit in visits {
                add(scenario, (now, place), visit, &mut force);
            }
            own.for_each(|visit| add(scenario, (now, place), &visit, &mut force));
            let turn = scenario.rotation;
            match scenario.inertia {
                None => {
                    let over = 1.0 / (1.0 + turn * turn);
                    let [x, y] = force;
                    (place, [over * (x + turn * y), over * (y - turn * x)], [0.0; 2])
                }
                Some(mass) => {
                    let rate = [0, 1].map(|j| v[j] + carried(|s| s.2, i, j));
                    let turning = [turn * rate[1], -turn * rate[0]];
                    (place, rate, [0, 1].map(|j| (force[j] + turning[j] - rate[j]) / mass))
                }
            }
        });
        let moved = |(a, b): (&Stage, &Stage)| {
            (0..2).map(|j| (a.0[j] - b.0[j]).abs() + (a.1[j] - b.1[j]).abs()).fold(0.0, f64::max)
        };
        if n > 0 && stages.iter().zip(&before).map(moved).fold(0.0, f64::max) < 1e-14 {
            return stages;
        }
    }
    panic!("the iteration of the reference does not converge: take shorter steps");
}

fn add(scenario: &WalkerScenario, (t, at): (f64, [f64; 2]), visit: &Visit, force: &mut [f64; 2]) {
    let weight = scenario.alpha * visit.spent * (-(t - visit.t) / scenario.healing_time).exp();
    let slope = gradient([at[0] - visit.at[0], at[1] - visit.at[1]]);
    (0..2).for_each(|j| force[j] += weight * slope[j]);
}
