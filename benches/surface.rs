//! Reconstruction of the Fig. 1 surface against the number of points: by FFT, by direct summation, and
//! as `heights` does it, with the initial surface. Images of 2,000 × 400 points against the number of
//! layers of the footprint.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use stickslip_surface::{Method, Surface, carved_by};
use stickslip_tip::{Footprint, Gaussian2d, Model, Scenario, TipFunction, run};

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

/// Pits side by side, a layer for each.
fn many(layers: usize) -> Footprint {
    let pit = |i: usize| {
        let side = if i == 0 { vec![0.0] } else { vec![-0.1 * i as f64, 0.1 * i as f64] };
        side.into_iter().map(|center_y| Gaussian2d {
            amplitude: 1.0 / layers as f64,
            center: 0.0,
            width: 1.0,
            center_y,
            width_y: 1.0,
        })
    };
    let terms: Vec<Gaussian2d> = (0..layers).flat_map(pit).collect();
    Footprint::gaussian_sum(&terms).expect("a valid footprint")
}

fn image(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("image");
    group.sample_size(10);
    let x: Vec<f64> = (0..2000).map(|i| 400.0 + 0.025 * f64::from(i)).collect();
    let y: Vec<f64> = (0..400).map(|j| -2.0 + 0.01 * f64::from(j)).collect();
    for layers in [1_usize, 10, 100] {
        let footprint = many(layers);
        let tip = TipFunction::of_footprint(footprint.clone());
        let model = Model::new(tip, 2.0, 1.0).expect("a valid model");
        let scenario = Scenario { kick: 0.01, ..Scenario::new(model, END) };
        let trajectory = run(&scenario).expect("a run that ends").trajectory;
        let initial = scenario.initial_surface().expect("a valid surface");
        let surface = Surface::new(&scenario.model, &initial, &trajectory);
        group.bench_function(BenchmarkId::new("layers", format!("{layers:03}")), |bencher| {
            bencher.iter(|| surface.image(&footprint, END, black_box(&x), &y).expect("within"));
        });
    }
    group.finish();
}

criterion_group!(benches, reconstruction, image);
criterion_main!(benches);
