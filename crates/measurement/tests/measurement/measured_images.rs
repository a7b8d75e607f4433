//! Images of footprints: is f(x,y) what they were made of?
//!
//! Judge: the sums of Gaussians that the images are drawn from, off centre, on a tilted plane, with noise.

use crate::noise::normal;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use stickslip_measurement::{Image, Request, tip};

/// Amplitude, centre and width along x, width across; in nm.
type Lobe = [f64; 4];

fn image(lobes: &[Lobe], noise: f64, seed: u64) -> Image {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let x: Vec<f64> = (0..96).map(|i| 4.0 * f64::from(i) - 180.0).collect();
    let y: Vec<f64> = (0..80).map(|i| 5.0 * f64::from(i) - 210.0).collect();
    let f = |x: f64, y: f64| -> f64 {
        let bell = |away: f64, width: f64| (-0.5 * (away / width).powi(2)).exp();
        lobes.iter().map(|[a, c, w, v]| a * bell(x - c, *w) * bell(y, *v)).sum()
    };
    let row = |y: &f64| {
        let height = |x: &f64| 3.0 + 0.004 * x - 0.002 * y - 12.0 * f(x - 7.0, y + 11.0);
        x.iter().map(|x| height(x) + 12.0 * noise * normal(&mut random)).collect()
    };
    let rows = y.iter().map(row).collect();
    Image::new(x, y, rows).unwrap()
}

#[test]
fn widths_across_are_found() {
    let request = Request { resamples: 20, ..Request::default() };
    for (lobes, noise, within) in [
        (&[[1.0, 0.0, 30.0, 45.0]][..], 0.02, 0.02),
        (
            &[[1.0, 0.0, 30.0, 30.0], [-0.25, 60.0, 20.0, 40.0], [-0.25, -60.0, 20.0, 40.0]],
            0.002,
            0.05,
        ),
    ] {
        let image = image(lobes, noise, 1);
        let found = tip(&image.profile().unwrap(), &request).unwrap();
        let across = image.across(&found).unwrap();
        assert!((across.centre + 11.0).abs() < 0.5, "{}", across.centre);
        assert!((across.residual / (12.0 * noise) - 1.0).abs() < 0.1, "{across:?}");
        assert!((across.noise / (12.0 * noise) - 1.0).abs() < 0.2, "{across:?}");
        // f(x,y) itself, in parts of f(0): Gaussians that nearly cancel may be others than those that it was made of.
        let sigma = found.sigma.value;
        for (x, y) in [(0.0, 30.0), (20.0, 40.0), (60.0, 0.0), (60.0, 30.0), (0.0, 80.0)] {
            let bell = |away: f64, width: f64| (-0.5 * (away / width).powi(2)).exp();
            let of = |lobes: &[Lobe]| -> f64 {
                lobes.iter().map(|[a, c, w, v]| a * bell(x - c, *w) * bell(y, *v)).sum()
            };
            let terms = found.gaussians.iter().zip(&across.widths);
            let told: Vec<Lobe> = terms
                .map(|(g, v)| [g.amplitude, g.center * sigma, g.width * sigma, v * sigma])
                .collect();
            let (told, truth) = (of(&told), of(lobes) / lobes_at_zero(lobes));
            assert!((told - truth).abs() < within, "{x} {y}: {told} for {truth}");
        }
    }
}

fn lobes_at_zero(lobes: &[Lobe]) -> f64 {
    lobes.iter().map(|[a, c, w, _]| a * (-0.5 * (c / w).powi(2)).exp()).sum()
}

#[test]
fn what_is_no_image_of_a_footprint_is_refused() {
    let positions = |n: usize| (0..n).map(|i| i as f64).collect::<Vec<f64>>();
    assert!(Image::new(positions(5), positions(5), vec![vec![0.0; 5]; 5]).is_err());
    assert!(Image::new(positions(20), positions(20), vec![vec![0.0; 20]; 19]).is_err());
    let flat = Image::new(positions(20), positions(20), vec![vec![1.0; 20]; 20]).unwrap();
    assert!(flat.profile().is_err());
    let mut rows = vec![vec![1.0; 20]; 20];
    rows[3][4] = f64::NAN;
    assert!(Image::new(positions(20), positions(20), rows).is_err());
}
