//! Cycles with their multipliers, from nothing, over α: from sinusoidal to relaxation; and a branch.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::ops::ControlFlow;
use stickslip_cycles::{Continuation, DEFAULT_TOLERANCE, cycle};
use stickslip_stability::critical;
use stickslip_tip::{Model, TipFunction, Wider};

fn tip() -> TipFunction {
    TipFunction::triple_gaussian(1.0, 1.0).expect("a valid tip")
}

fn from_nothing(criterion: &mut Criterion) {
    let onset = critical(&Wider::default(), &tip(), 1.0).expect("a critical point").alpha;
    let mut group = criterion.benchmark_group("cycles/from-nothing");
    group.sample_size(20);
    for (name, alpha) in [
        ("onset+1e-6", onset + 1e-6),
        ("onset+0.01", onset + 0.01),
        ("1.20", 1.2),
        ("1.40", 1.4),
        ("1.62-doubled", 1.62),
        ("1.90", 1.9),
        ("2.00", 2.0),
    ] {
        let model = Model::new(tip(), alpha, 1.0).expect("a valid model");
        group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
            bencher.iter(|| cycle(black_box(&model), DEFAULT_TOLERANCE).expect("a cycle"));
        });
    }
    group.finish();
}

fn branch(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("cycles/branch");
    group.sample_size(10);
    let settings = Continuation { to: 1.83, ..Continuation::default() };
    group.bench_function("onset-to-1.83", |bencher| {
        bencher.iter(|| {
            settings.from_onset(&tip(), 1.0, |_| ControlFlow::Continue(())).expect("a branch")
        });
    });
    group.finish();
}

criterion_group!(benches, from_nothing, branch);
criterion_main!(benches);
