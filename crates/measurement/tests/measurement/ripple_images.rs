//! α, r, wavelength and crest angle from images of rasters by the crate `raster`, whose lines are integrated one after another in
//! time: it shares no code with the settled pattern that is fitted.

use crate::noise::normal;
use chacha20::ChaCha8Rng;
use rand::SeedableRng;
use stickslip_measurement::{
    Image, RippleError, RippleRequest, Ripples, has_lines_along_y, ripples,
};
use stickslip_raster::{Path, Plan, Scanned, Scanning};
use stickslip_stability::{Raster, RasterPath};
use stickslip_tip::{Footprint, Model, TipFunction, Wider};

const SIGMA: f64 = 30.0;
const GAIN: f64 = 18.0;

/// A raster above its threshold, and its settled part.
struct Made {
    alpha: f64,
    r: f64,
    pitch: f64,
    scanned: Scanned,
    /// First and last x and y of the settled part.
    window: [[f64; 2]; 2],
}

fn made(above: f64, r: f64, pitch: f64, (length, height): (f64, f64)) -> Made {
    let tip = TipFunction::gaussian(1.0).unwrap();
    let footprint = Footprint::separable(tip.clone(), 1.0).unwrap();
    let critical = Raster::new(&footprint, Wider::default(), (r, pitch), 1.0)
        .unwrap()
        .critical(RasterPath::OneWay)
        .unwrap();
    let alpha = above * critical.alpha;
    let lines = (height / pitch) as usize;
    let model = Model::new(tip, alpha, r).unwrap();
    let mut plan = Plan::new(footprint, model, Path::OneWay, pitch, lines, length);
    plan.law.tolerance = 1e-6;
    let mut scanning = Scanning::new(&plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    let scanned = Scanned::new(&plan, &scanning.into_lines());
    let window = [[0.5 * length, length - 8.0], [0.55 * height, height - 6.0]];
    Made { alpha, r, pitch, scanned, window }
}

/// An image in nm with noise, a tilt and an offset of each line, each relative to the height of the ripples.
fn image(made: &mut Made, pixels: usize, noise: f64, seed: u64, mirrored: [bool; 2]) -> Image {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let shift = [normal(&mut random), normal(&mut random)].map(|v| (v * 7.3).sin());
    let [x, y] = [0, 1].map(|i| {
        let [first, last] = made.window[i];
        let at = |k: usize| first + shift[i] + (last - first) * k as f64 / pixels as f64;
        (0..pixels).map(at).collect::<Vec<f64>>()
    });
    let heights = made.scanned.heights(&x, &y);
    let size = {
        let mean = heights.mean().unwrap();
        heights.iter().map(|u| (u - mean).powi(2)).sum::<f64>().sqrt() / pixels as f64
    };
    let tilt = [normal(&mut random), normal(&mut random)].map(|v| 0.05 * v * size);
    let mut rows = vec![];
    for (j, row) in heights.outer_iter().enumerate() {
        let offset = 0.5 * size * normal(&mut random);
        let one = |(i, u): (usize, &f64)| {
            let ground = offset + tilt[0] * x[i] + tilt[1] * y[j];
            GAIN * (u + ground + noise * size * normal(&mut random))
        };
        let mut row: Vec<f64> = row.iter().enumerate().map(one).collect();
        if mirrored[0] {
            row.reverse();
        }
        rows.push(row);
    }
    if mirrored[1] {
        rows.reverse();
    }
    // Positions of the mirrored image ascend too.
    let from_first = |at: &[f64]| at.iter().map(|v| SIGMA * (v - at[0])).collect::<Vec<f64>>();
    Image::new(from_first(&x), from_first(&y), rows).unwrap()
}

fn request(made: &Made) -> RippleRequest {
    let footprint = Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    RippleRequest::new(footprint, SIGMA, SIGMA * made.pitch)
}

fn summary(made: &Made, found: &Ripples) -> String {
    let Ripples { alpha, r, .. } = found;
    format!(
        "α {} in [{:.4}, {:.4}] {:.4}, r {} in [{:.4}, {:.4}] {:.4}, misfit {:.3}, λ {:.3} ± {:.3}, {:.2} ± {:.2}°, gain {:.2}",
        made.alpha,
        alpha.low,
        alpha.high,
        alpha.value,
        made.r,
        r.low,
        r.high,
        r.value,
        found.misfit,
        found.wavelength.value / SIGMA,
        0.5 * (found.wavelength.high - found.wavelength.low) / SIGMA,
        found.crest_angle.value,
        0.5 * (found.crest_angle.high - found.crest_angle.low),
        found.height_gain * SIGMA * SIGMA
    )
}

#[test]
fn alpha_and_r_follow_from_an_image_of_ripples() {
    let mut made = made(1.12, 1.0, 1.0, (120.0, 120.0));
    for (pixels, noise, mirrored) in
        [(64, 0.1, [false, false]), (128, 0.3, [true, false]), (256, 0.02, [false, true])]
    {
        let image = image(&mut made, pixels, noise, 7 + pixels as u64, mirrored);
        let found = ripples(&image, &request(&made)).unwrap();
        let all = summary(&made, &found);
        eprintln!("{all}");
        assert!((found.alpha.value / made.alpha - 1.0).abs() < 0.05, "{all}");
        assert!((found.r.value / made.r - 1.0).abs() < 0.05, "{all}");
        assert!((found.height_gain * SIGMA * SIGMA / GAIN - 1.0).abs() < 0.05, "{all}");
        assert_eq!([!found.forward, !found.upward], mirrored, "{all}");
        // As measured, and levelled line by line; of plain ripples nothing is known.
        let levelled: Vec<Vec<f64>> = image.rows().iter().map(|row| without_mean(row)).collect();
        let levelled = Image::new(image.x().to_vec(), image.y().to_vec(), levelled).unwrap();
        for image in [&image, &levelled] {
            assert!(!has_lines_along_y(image) && has_lines_along_y(&transposed(image)), "{pixels}");
        }
    }
    let plain = plain(&mut made);
    assert!(!has_lines_along_y(&plain) && !has_lines_along_y(&transposed(&plain)));
}

fn without_mean(row: &[f64]) -> Vec<f64> {
    let mean = row.iter().sum::<f64>() / row.len() as f64;
    row.iter().map(|z| z - mean).collect()
}

fn transposed(image: &Image) -> Image {
    let columns = (0..image.x().len()).map(|i| image.rows().iter().map(|row| row[i]).collect());
    Image::new(image.y().to_vec(), image.x().to_vec(), columns.collect()).unwrap()
}

/// The ripples without noise, tilt and offsets.
fn plain(made: &mut Made) -> Image {
    let at = made.window.map(|[first, last]| {
        (0..96).map(|k| first + (last - first) * f64::from(k) / 96.0).collect::<Vec<f64>>()
    });
    let heights = made.scanned.heights(&at[0], &at[1]);
    let rows = heights.outer_iter().map(|row| row.to_vec()).collect();
    let [x, y] = at;
    Image::new(x, y, rows).unwrap()
}

#[test]
fn noise_has_no_ripples() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let at: Vec<f64> = (0..64).map(f64::from).collect();
    let rows = (0..64).map(|_| (0..64).map(|_| normal(&mut random)).collect()).collect();
    let image = Image::new(at.clone(), at, rows).unwrap();
    let footprint = Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    let request = RippleRequest::new(footprint, 2.0, 2.0);
    let found = ripples(&image, &request);
    assert!(matches!(found, Err(RippleError::Nothing)), "{found:?}");
}

/// Noise of the images with a retrace, in the unit of their heights.
const NOISE: f64 = 5.0;

/// Ripples of a raster seen twice, with offsets, tilts and noise of their own, the second time three columns further.
#[test]
fn a_retrace_narrows_the_intervals() {
    let mut made = made(1.12, 1.0, 1.0, (120.0, 120.0));
    // One frame, without noise; each way has noise as large as half of the ripples.
    let clean = image(&mut made, 96, 0.0, 11, [false; 2]);
    let noisy = |seed: u64| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut row = |row: &Vec<f64>| -> Vec<f64> {
            let offset = normal(&mut random);
            row.iter().map(|z| z + offset + NOISE * normal(&mut random)).collect()
        };
        let rows = clean.rows().iter().map(&mut row).collect();
        Image::new(clean.x().to_vec(), clean.y().to_vec(), rows).unwrap()
    };
    let (there, back) = (noisy(1), noisy(2));
    let columns = 3;
    let cut = |image: &Image, first: usize, factor: f64| {
        let kept = image.x().len() - columns;
        let row = |row: &Vec<f64>| row[first..first + kept].iter().map(|z| factor * z).collect();
        let rows = image.rows().iter().map(row).collect();
        Image::new(image.x()[..kept].to_vec(), image.y().to_vec(), rows).unwrap()
    };
    let (trace, retrace) = (cut(&there, 0, 1.0), cut(&back, columns, 1.0));
    let asked = |image: Image| RippleRequest { retrace: Some(image), ..request(&made) };
    let alone = ripples(&trace, &request(&made)).unwrap();
    let both = ripples(&trace, &asked(retrace.clone())).unwrap();
    let beside = both.retrace.unwrap();
    let all = format!("{}\n{}\n{beside:?}", summary(&made, &alone), summary(&made, &both));
    let step = trace.x()[1] - trace.x()[0];
    assert!((beside.shift + columns as f64 * step).abs() < 0.2 * step, "{step}: {all}");
    assert!((beside.ratio - 1.0).abs() < 0.05 && beside.agreement > 0.005, "{all}");
    for (one, two, truth) in [(alone.alpha, both.alpha, made.alpha), (alone.r, both.r, made.r)] {
        assert!(two.low < truth && truth < two.high, "{all}");
        let narrower = (two.high - two.low) / (one.high - one.low);
        assert!((0.5..0.95).contains(&narrower), "{narrower}: {all}");
    }
    // A retrace that is higher by a fifth is said; one that lies the other way round is refused.
    let other = ripples(&trace, &asked(cut(&back, columns, 1.2))).unwrap();
    assert!(other.retrace.unwrap().agreement < 0.005, "{:?}", other.retrace);
    assert!(other.remarks().iter().any(|remark| remark.contains("differ by more than noise")));
    let mirrored = image(&mut made, 96, 0.5, 12, [true, false]);
    let found = ripples(&there, &RippleRequest { retrace: Some(mirrored), ..request(&made) });
    assert!(matches!(found, Err(RippleError::Retrace(_))), "{found:?}");
    let found = ripples(&there, &RippleRequest { retrace: Some(trace), ..request(&made) });
    assert!(matches!(found, Err(RippleError::Retrace(_))), "{found:?}");
}
