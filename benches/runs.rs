//! Whole runs of the regimes, over the tolerance, for each memory; a tip held on its line beside one that is free to move
//! across it.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use stickslip_tip::planar::{self, PlanarScenario};
use stickslip_tip::{Footprint, MemoryChoice, Model, Scenario, TipFunction, run};

/// (name, β, α, r, kick, until)
const CASES: [(&str, f64, f64, f64, f64, f64); 5] = [
    ("onset", 1.0, 1.079_036_174_947, 1.0, 0.01, 457.0),
    ("stick-slip", 1.0, 1.2, 1.0, 0.05, 76.0),
    ("period-doubled", 1.0, 1.62, 1.0, 0.05, 76.0),
    ("trapped", 1.0, 4.0, 1.0, 0.01, 457.0),
    ("small-r", 0.9, 0.05, 0.1, 0.01, 400.0),
];

fn whole_runs(criterion: &mut Criterion) {
    for (name, beta, alpha, r, kick, until) in CASES {
        let mut group = criterion.benchmark_group(format!("runs/{name}"));
        group.sample_size(10);
        let tip = TipFunction::triple_gaussian(beta, 1.0).expect("a valid tip");
        let model = Model::new(tip, alpha, r).expect("a valid model");
        let memories = [
            (MemoryChoice::Modes, "modes"),
            (MemoryChoice::Fft, "fft"),
            (MemoryChoice::Direct, "direct"),
        ];
        for (memory, label) in memories {
            for digits in [5, 7, 9, 11] {
                let tolerance = 10.0_f64.powi(-digits);
                let scenario =
                    Scenario { kick, tolerance, memory, ..Scenario::new(model.clone(), until) };
                let id = BenchmarkId::new(label, format!("1e-{digits:02}"));
                group.bench_function(id, |bencher| {
                    bencher.iter(|| run(black_box(&scenario)).expect("a run that ends"));
                });
            }
        }
        group.finish();
    }
}

/// α = 1.2 at κ_y = 1 and 1e-7, where 8 layers do: times per series, whose ratio is the cost of a step across.
fn across(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("runs/across");
    let tip = TipFunction::triple_gaussian(1.0, 1.0).expect("a valid tip");
    let footprint = Footprint::separable(tip, 1.0).expect("a valid footprint");
    let model = Model::new(TipFunction::of_footprint(footprint), 1.2, 1.0).expect("a valid model");
    let held = Scenario { kick: 0.05, tolerance: 1e-7, ..Scenario::new(model, 1000.0) };
    let free = PlanarScenario { kick_across: 0.01, ..PlanarScenario::new(held.clone(), 1.0) };
    let work = run(&held).expect("a run that ends").work;
    group.throughput(Throughput::Elements(work.series));
    group.bench_function("held", |bencher| {
        bencher.iter(|| run(black_box(&held)).expect("a run that ends"));
    });
    let found = planar::run(&free).expect("a run that ends");
    assert_eq!(found.layers.most, 8);
    group.throughput(Throughput::Elements(found.work.series));
    group.bench_function("free", |bencher| {
        bencher.iter(|| planar::run(black_box(&free)).expect("a run that ends"));
    });
    group.finish();
}

criterion_group!(benches, whole_runs, across);
criterion_main!(benches);
