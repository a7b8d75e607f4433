//! Cost of a step against the history within reach of the tip.
//!
//! A trapped tip piles up history in one place: 1e2 to 1e6 nodes within reach. `fft` and `modes` must be
//! flat, `direct` is linear. One step here is what the integrator asks of a memory: the groove at the stages
//! twice (Newton's iterations) and one step remembered.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::{Duration, Instant};
use stickslip_tip::memory::{Groove, Policy, Retreat};
use stickslip_tip::{MemoryChoice, STAGES, TipFunction, nodes_and_weights};

/// A memory with this many nodes within reach, spread over a fifth of a width about the tip.
fn filled(mut memory: Policy, nodes: usize) -> Policy {
    let (c, b) = nodes_and_weights();
    for step in 0..nodes / STAGES {
        // Forward only as far as the modes hold; the same to and fro for all.
        let length = if step % 2 == 0 { 0.2 } else { -0.2 };
        memory.remember(&c.map(|c| length * c), &b.map(|b| 1e-3 * b));
    }
    memory
}

fn a_step(memory: &mut Policy, to_and_fro: f64) {
    let (c, b) = nodes_and_weights();
    let at = c.map(|c| to_and_fro * 0.2 * c);
    let (mut slope, mut curvature) = ([0.0; STAGES], [0.0; STAGES]);
    for _ in 0..2 {
        memory.groove(black_box(&at), &mut Groove::new(&mut slope, &mut curvature));
    }
    memory.remember(&at, &b.map(|b| 1e-6 * b));
    black_box((slope, curvature));
}

/// Time of a number of steps on about a number of nodes: the memory is filled anew before it has grown by a
/// tenth.
fn timed(name: &str, tip: &TipFunction, nodes: usize, steps: u64) -> Duration {
    let before_it_grows = (nodes / (10 * STAGES)).max(1) as u64;
    let mut total = Duration::ZERO;
    let mut left = steps;
    while left > 0 {
        let choice = match name {
            "fft" => MemoryChoice::Fft,
            "modes" => MemoryChoice::Modes,
            _ => MemoryChoice::Direct,
        };
        let mut memory =
            filled(Policy::new(choice, tip.clone(), 1e-10, Retreat::Small).expect("a fit"), nodes);
        // The first look at a memory just filled pays for the cache, not for the method.
        a_step(&mut memory, 1.0);
        let batch = left.min(before_it_grows);
        let started = Instant::now();
        for step in 0..batch {
            a_step(&mut memory, if step % 2 == 0 { -1.0 } else { 1.0 });
        }
        total += started.elapsed();
        left -= batch;
    }
    total
}

fn step_against_history(criterion: &mut Criterion) {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).expect("a valid tip");
    let mut group = criterion.benchmark_group("memory/step");
    group.sample_size(10);
    for nodes in [24, 48, 96, 1_000, 10_000, 100_000, 1_000_000] {
        for name in ["modes", "fft", "direct"] {
            group.bench_function(BenchmarkId::new(name, format!("{nodes:07}")), |bencher| {
                bencher.iter_custom(|steps| timed(name, &tip, nodes, steps));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, step_against_history);
criterion_main!(benches);
