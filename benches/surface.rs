//! Reconstruction of the Fig. 1 surface against the number of points: by FFT, by direct summation, and
//! as `heights` does it, with the initial surface.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use stickslip_surface::{Method, Surface, carved_by};
use stickslip_tip::{Model, Scenario, TipFunction, run};

const END: f64 = 457.0;

fn reconstruction(criterion: &mut Criterion) {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).expect("a valid tip");
    let model = Model::new(tip.clone(), 1.079_036_174_947, 1.0).expect("a valid model");
    let scenario = Scenario { kick: 0.01, ..Scenario::new(model, END) };
    let trajectory = run(&scenario).expect("a run that ends").trajectory;
    let initial = scenario.initial_surface().expect("a valid surface");
    let surface = Surface::new(&scenario.model, &initial, &trajectory);
    let (positions, weights) = trajectory.residence(END);

    let mut group = criterion.benchmark_group("surface");
    group.sample_size(10);
    for points in [50_usize, 500, 5_000, 50_000, 500_000] {
        let spacing = 470.0 / points as f64;
        let x: Vec<f64> = (0..points).map(|i| -5.0 + spacing * i as f64).collect();
        group.throughput(Throughput::Elements(points as u64));
        let id = |name: &str| BenchmarkId::new(name, format!("{points:06}"));
        for (method, name) in [(Method::Fft, "fft"), (Method::Direct, "direct")] {
            if name == "direct" && points > 50_000 {
                continue;
            }
            group.bench_function(id(name), |bencher| {
                bencher.iter(|| carved_by(method, &tip, &positions, &weights, black_box(&x)));
            });
        }
        group.bench_function(id("heights"), |bencher| {
            bencher.iter(|| surface.heights(END, black_box(&x)).expect("within the run"));
        });
    }
    group.finish();
}

criterion_group!(benches, reconstruction);
criterion_main!(benches);
