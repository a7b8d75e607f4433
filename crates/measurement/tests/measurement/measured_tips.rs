//! Is αc of a measured tip within its own interval, and never silently wrong?
//!
//! Judge: profiles drawn from footprints whose αc is known: sums of Gaussians exactly, others from a clean table of
//! 401 rows. Noise of 0.5 to 5 % of the apex, a tilt of up to 30 % over the profile and in one of four a curved drift, rows
//! at uneven distances, off centre, one side or both.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use rand::RngExt;
use stickslip_measurement::{MeasuredTip, Profile, Request, tip};
use stickslip_stability::critical;
use stickslip_tip::{TipFunction, Wider};

/// A footprint: its shape, and the half width at which it has fallen to half of its apex.
struct Truth {
    name: &'static str,
    shape: fn(f64) -> f64,
    alpha: f64,
    half_width: f64,
}

type Shape = (&'static str, fn(f64) -> f64);

const SHAPES: [Shape; 6] = [
    ("gaussian", |x| (-0.5 * x * x).exp()),
    ("triple", |x| bell(x) - 0.5 * (bell(x - 2.0) + bell(x + 2.0))),
    ("shallow lobes", |x| bell(x) - 0.15 * (bell(x - 2.2) + bell(x + 2.2))),
    ("two widths", |x| 0.6 * bell(x / 0.7) + 0.4 * bell(x / 1.6)),
    ("algebraic", |x| (1.0 + x * x / 8.0).powi(-4)),
    ("flat top", |x| (-0.5 * x * x - 0.15 * x.powi(4)).exp()),
];

fn bell(x: f64) -> f64 {
    (-0.5 * x * x).exp()
}

impl Truth {
    fn of((name, shape): Shape) -> Self {
        let apex = shape(0.0);
        let mut half_width = 0.0;
        while shape(half_width) > 0.5 * apex {
            half_width += 1e-5;
        }
        let sigma = half_width / (2.0 * 2_f64.ln()).sqrt();
        let x: Vec<f64> = (0..=400).map(|i| 14.0 / 400.0 * f64::from(i)).collect();
        let f: Vec<f64> = x.iter().map(|x| shape(x * sigma) / apex).collect();
        let alpha =
            critical(&Wider::default(), &TipFunction::table(&x, &f).unwrap(), 1.0).unwrap().alpha;
        Self { name, shape, alpha, half_width }
    }
}

/// A normal deviate, by Box and Muller.
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let (u, v): (f64, f64) = (random.random_range(1e-12..1.0), random.random());
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

struct Drawn {
    profile: Profile,
    centre: Option<f64>,
    noise: f64,
}

/// In nm.
fn drawn(truth: &Truth, random: &mut ChaCha8Rng) -> Drawn {
    let width = random.random_range(15.0..60.0);
    let noise = 0.005 * 10_f64.powf(random.random::<f64>());
    let (rows, extent) = (random.random_range(60..400), random.random_range(4.5..7.5));
    let is_half = random.random::<bool>();
    let off = if is_half { 0.0 } else { random.random_range(-1.0..1.0) };
    let (apex, tilt) = (random.random_range(3.0..30.0), random.random_range(-0.15..0.15));
    let bend = if random.random_range(0..4) == 0 { random.random_range(-0.01..0.01) } else { 0.0 };
    let offset = random.random_range(-5.0..5.0);
    let sign = if random.random::<bool>() { 1.0 } else { -1.0 };
    let (mut x, mut f) = (vec![], vec![]);
    for i in 0..rows {
        let jitter = random.random_range(-0.4..0.4);
        let part = ((f64::from(i) + jitter) / f64::from(rows - 1)).clamp(0.0, 1.0);
        let at = if is_half { part * extent } else { (2.0 * part - 1.0) * extent };
        let value = (truth.shape)(at - off) / (truth.shape)(0.0);
        let ground = tilt * at / extent + bend * (at / extent).powi(2);
        x.push(width * at);
        f.push(sign * apex * (value + ground + noise * normal(random)) + offset);
    }
    Drawn { profile: Profile::new(x, f).unwrap(), centre: is_half.then_some(0.0), noise }
}

/// What is said of a result of which one should beware: a wide interval, or a residual that is not noise.
fn is_warned(found: &MeasuredTip) -> bool {
    !found.remarks().is_empty()
}

fn campaign(profiles: usize, resamples: usize, seed: u64) {
    let truths = SHAPES.map(Truth::of);
    let (mut held, mut silent, mut refused) = (0, vec![], 0);
    let mut worst = 0.0_f64;
    for i in 0..profiles {
        let truth = &truths[i % truths.len()];
        let mut random = ChaCha8Rng::seed_from_u64(seed + i as u64);
        let Drawn { profile, centre, noise } = drawn(truth, &mut random);
        let request = Request { centre, resamples, ..Request::default() };
        let found = match tip(&profile, &request) {
            Ok(found) => found,
            Err(error) => {
                println!("{} noise {noise:.4}: {error}", truth.name);
                refused += 1;
                continue;
            }
        };
        let alpha = found.critical_alpha;
        let error = (alpha.value / truth.alpha - 1.0).abs();
        // The truth is known to 1e-6.
        let holds = [-1e-6, 1e-6].iter().any(|e| alpha.holds(truth.alpha * (1.0 + e)));
        held += usize::from(holds);
        worst = worst.max(error);
        let sign = found.apex.signum();
        println!(
            "{:14} noise {noise:.4} rows {:3} {} terms {} alpha {:.4} [{:.4}, {:.4}] for {:.4}: {} sigma {:.4}{}{sign:+}",
            truth.name,
            profile.x().len(),
            if centre.is_some() { "half" } else { "both" },
            found.candidates[found.chosen].terms,
            alpha.value,
            alpha.low,
            alpha.high,
            truth.alpha,
            if holds { "held" } else { "MISSED" },
            found.sigma.value / truth.half_width * (2.0 * 2_f64.ln()).sqrt(),
            if is_warned(&found) { " warned " } else { " " },
        );
        if error > 0.1 && !is_warned(&found) {
            silent.push((truth.name, i, error));
        }
    }
    println!(
        "{held} of {profiles} within their interval, {refused} refused, largest error {worst:.3}"
    );
    assert!(silent.is_empty(), "wrong without a word: {silent:?}");
    assert!(held + refused >= profiles * 9 / 10, "{held} of {profiles}");
    assert!(refused <= profiles / 20, "{refused} refused");
}

#[test]
fn a_few_measured_tips_hold_their_onset() {
    campaign(12, 60, 9000);
}

/// Curved by 5 % of the apex, as a scanner bows: on commit cd9d12b three of twelve were off by 4 to 7 % without a remark.
#[test]
fn a_curved_ground_is_told_from_a_lobe() {
    let (mut held, mut halves) = (0, vec![]);
    for seed in 0..10 {
        let truth = Truth::of(SHAPES[usize::from(seed % 2 == 0)]);
        let mut random = ChaCha8Rng::seed_from_u64(300 + seed);
        let x: Vec<f64> = (0..200).map(|i| 0.065 * f64::from(i) - 6.4).collect();
        let bend = if random.random::<bool>() { 0.05 } else { -0.05 };
        let height = |x: &f64| {
            let ground = 0.02 * x + bend * (x / 6.4).powi(2);
            (truth.shape)(*x) / (truth.shape)(0.0) + ground + 0.01 * normal(&mut random)
        };
        let f = x.iter().map(height).collect();
        let request = Request { resamples: 40, ..Request::default() };
        let found = tip(&Profile::new(x, f).unwrap(), &request).unwrap();
        let alpha = found.critical_alpha;
        let error = (alpha.value / truth.alpha).ln().abs();
        println!(
            "{} {alpha:?} for {:.4} on order {}",
            truth.name,
            truth.alpha,
            found.ground.len() - 1
        );
        assert!(error < 0.04 || is_warned(&found), "{} {seed}: off by {error}", truth.name);
        held += usize::from(alpha.holds(truth.alpha));
        halves.push(alpha.relative());
    }
    halves.sort_by(f64::total_cmp);
    assert!(held >= 9, "{held} of 10");
    assert!(halves[9] < 5.0 * halves[5], "half-widths {halves:.3?}");
}

/// Those by which the intervals are calibrated.
#[test]
#[ignore = "minutes"]
fn two_hundred_other_tips_hold_their_onset() {
    campaign(200, 200, 5000);
}

/// `make survive`.
#[test]
#[ignore = "minutes"]
fn two_hundred_measured_tips_hold_their_onset() {
    campaign(200, 200, 9000);
}

/// αc of an algebraic footprint whose apex is 10 nm beyond the last row is off by up to 20 %, more than its interval.
#[test]
fn an_apex_outside_of_the_profile_is_named() {
    for seed in 0..4 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let x: Vec<f64> = (0..=200).map(|i| 1.5 * f64::from(i) - 150.0).collect();
        for (apex, is_named) in [(160.0, true), (100.0, false)] {
            let height =
                |x: &f64| -12.0 / (1.0 + ((x - apex) / 20.0).powi(2)) + 0.12 * normal(&mut random);
            let profile = Profile::new(x.clone(), x.iter().map(height).collect()).unwrap();
            let found = tip(&profile, &Request { resamples: 10, ..Request::default() }).unwrap();
            eprintln!("{apex}: {} {}", found.centre, found.critical_alpha.value);
            let is_found = found.remarks().iter().any(|remark| remark.contains("lies outside"));
            assert_eq!(is_found, is_named, "seed {seed}: {:?}", found.remarks());
        }
    }
}

/// A file that was written twice holds each row twice: copies are no measurements, and intervals stay as wide.
#[test]
fn rows_that_all_stand_twice_count_once() {
    let x: Vec<f64> = (0..40).map(|i| 0.3 * f64::from(i) - 6.0).collect();
    let f: Vec<f64> = x.iter().map(|x| (-x * x).exp() + 0.01 * (37.0 * x).sin()).collect();
    let profile = Profile::new(x.clone(), f.clone()).unwrap();
    let each_twice = |values: &[f64]| values.iter().flat_map(|v| [*v; 2]).collect();
    assert_eq!(Profile::new(each_twice(&x), each_twice(&f)).unwrap(), profile);
    assert_eq!(Profile::new(x.repeat(2), f.repeat(2)).unwrap(), profile);
    // Rows of which only some stand twice are all kept.
    let some_twice = Profile::new([&x, &x[..5]].concat(), [&f, &f[..5]].concat()).unwrap();
    assert_eq!(some_twice.x().len(), 45);
}
