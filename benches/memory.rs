//! Cost of a step against the history within reach of the tip.
//!
//! A trapped tip piles up history in one place: 1e2 to 1e6 nodes within reach. `fft` must be flat,
//! `direct` is linear. One step here is what the integrator asks of a memory: the groove at the stages
//! twice (Newton's iterations) and one step remembered.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use stickslip_tip::memory::{Direct, Fft, Memory};
use stickslip_tip::{STAGES, TipFunction, nodes_and_weights};

/// A memory with this many nodes within reach, spread over two widths about the tip.
fn filled(mut memory: Box<dyn Memory>, nodes: usize) -> Box<dyn Memory> {
    let (c, b) = nodes_and_weights();
    for step in 0..nodes / STAGES {
        let length = if step % 2 == 0 { 1.0 } else { -1.0 };
        memory.remember(&c.map(|c| length * c), &b.map(|b| 1e-3 * b));
    }
    memory
}

fn a_step(memory: &mut dyn Memory, to_and_fro: f64) {
    let (c, b) = nodes_and_weights();
    let at = c.map(|c| to_and_fro * 0.3 * c);
    let (mut slope, mut curvature) = ([0.0; STAGES], [0.0; STAGES]);
    for _ in 0..2 {
        memory.groove(black_box(&at), &mut slope, &mut curvature);
    }
    memory.remember(&at, &b.map(|b| 1e-6 * b));
    black_box((slope, curvature));
}

fn step_against_history(criterion: &mut Criterion) {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).expect("a valid tip");
    let mut group = criterion.benchmark_group("memory/step");
    group.sample_size(10);
    for nodes in [24, 48, 96, 1_000, 10_000, 100_000, 1_000_000] {
        let memories: [Box<dyn Memory>; 2] =
            [Box::new(Fft::new(tip.clone())), Box::new(Direct::new(tip.clone()))];
        for memory in memories {
            let name = memory.name();
            let mut memory = filled(memory, nodes);
            let mut to_and_fro = 1.0;
            group.bench_function(BenchmarkId::new(name, format!("{nodes:07}")), |bencher| {
                bencher.iter(|| {
                    to_and_fro = -to_and_fro;
                    a_step(memory.as_mut(), to_and_fro);
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, step_against_history);
criterion_main!(benches);
