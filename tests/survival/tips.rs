//! Random footprints, as the files that a user brings.

use chacha20::ChaCha20Rng;
use rand::{RngExt, SeedableRng};
use std::fmt::Write;
use stickslip_tip::{Gaussian, TipFunction};

#[allow(dead_code, reason = "printed")]
/// How one was made.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kind {
    /// This many pairs of lobes beside a Gaussian of width 1.
    Lobes(usize),
    /// A table of so many rows of a smooth shape, measured with this noise, in parts of its height.
    Table(usize, f64),
    /// The same of both halves, of which `stickslip tip` makes a tip file.
    Profile(usize, f64),
}

/// A footprint, and the file that holds it.
pub(crate) struct Brought {
    pub(crate) kind: Kind,
    pub(crate) name: &'static str,
    pub(crate) contents: String,
}

/// So many tips that are accepted, always the same: lobes and tables by turns, every eighth of them noisy.
pub(crate) fn tips(count: usize) -> Vec<Brought> {
    let mut rng = ChaCha20Rng::seed_from_u64(12);
    let mut tips = vec![];
    while tips.len() < count {
        let i = tips.len();
        tips.extend(if i.is_multiple_of(2) {
            lobed(&mut rng)
        } else {
            table(&mut rng, i % 8 == 5)
        });
    }
    tips
}

/// So many tables, always the same: 8 to 2,000 rows, every second one noisy, every third one of both halves.
pub(crate) fn tables(count: usize) -> Vec<Brought> {
    let mut rng = ChaCha20Rng::seed_from_u64(17);
    let mut tables = vec![];
    while tables.len() < count {
        let i = tables.len();
        tables.extend(match i % 3 {
            2 => Some(profile(&mut rng, i.is_multiple_of(2))),
            _ => table(&mut rng, i.is_multiple_of(2)),
        });
    }
    tables
}

fn lobed(rng: &mut ChaCha20Rng) -> Option<Brought> {
    let pairs = rng.random_range(1..=3);
    let mut terms = vec![Gaussian { amplitude: 1.0, center: 0.0, width: 1.0 }];
    for _ in 0..pairs {
        let amplitude = rng.random_range(-0.6..0.8);
        let (center, width) = (rng.random_range(0.3..5.0), 60_f64.powf(rng.random::<f64>()) * 0.05);
        terms.extend([center, -center].map(|center| Gaussian { amplitude, center, width }));
    }
    TipFunction::gaussian_sum(terms.clone()).ok()?;
    let each = |g: &Gaussian| {
        let Gaussian { amplitude, center, width } = g;
        format!(r#"{{"amplitude":{amplitude},"center":{center},"width":{width}}}"#)
    };
    let each: Vec<String> = terms.iter().map(each).collect();
    let contents = format!(r#"{{"gaussians":[{}]}}"#, each.join(","));
    Some(Brought { kind: Kind::Lobes(pairs), name: "tip.json", contents })
}

/// A shape with up to two lobes at either side, and how far out it is sampled.
fn shape(rng: &mut ChaCha20Rng) -> (impl Fn(f64) -> f64 + use<>, f64) {
    let (shape, length) = (rng.random_range(0..6), rng.random_range(4.0..12.0));
    let (lobe, at) = (rng.random_range(-0.3..0.5), rng.random_range(1.0..3.0));
    let (far, further) = (rng.random_range(-0.2..0.3), rng.random_range(2.5..5.0));
    let twins = |x: f64, at: f64, width: f64| {
        let bell = |away: f64| (-0.5 * (away / width).powi(2)).exp();
        bell(x - at) + bell(x + at)
    };
    let f = move |x: f64| match shape {
        0 => (-0.5 * x * x).exp(),
        1 => (1.0 + x * x).powi(-4),
        2 => 1.0 / x.cosh(),
        3 => (-0.5 * x * x).exp() + lobe * twins(x, at, 0.5),
        4 => (-0.5 * x * x).exp() + lobe * twins(x, at, 0.6) + far * twins(x, further, 0.4),
        _ => (1.0 - (x / 3.0).powi(2)).max(0.0).powi(3),
    };
    (f, length)
}

/// Rows, and noise in parts of the height.
fn sampling(rng: &mut ChaCha20Rng, is_noisy: bool) -> (usize, f64) {
    let rows = (8.0 * 250_f64.powf(rng.random::<f64>())) as usize;
    (rows, if is_noisy { 1e-5 * 2000_f64.powf(rng.random::<f64>()) } else { 0.0 })
}

/// Rows from one end to the other.
fn sampled(
    rng: &mut ChaCha20Rng,
    f: impl Fn(f64) -> f64,
    (rows, noise): (usize, f64),
    (from, to): (f64, f64),
) -> (Vec<f64>, Vec<f64>) {
    let x: Vec<f64> =
        (0..rows).map(|i| from + (to - from) * i as f64 / (rows - 1) as f64).collect();
    let f = x.iter().map(|x| f(*x) + noise * rng.random_range(-1.0..1.0)).collect();
    (x, f)
}

fn written((x, f): &(Vec<f64>, Vec<f64>)) -> String {
    let mut contents = String::new();
    x.iter().zip(f).for_each(|(x, f)| writeln!(contents, "{x},{f}").unwrap());
    contents
}

fn table(rng: &mut ChaCha20Rng, is_noisy: bool) -> Option<Brought> {
    let ((f, length), sampling) = (shape(rng), sampling(rng, is_noisy));
    let columns = sampled(rng, f, sampling, (0.0, length));
    TipFunction::table(&columns.0, &columns.1).ok()?;
    let kind = Kind::Table(sampling.0, sampling.1);
    Some(Brought { kind, name: "tip.csv", contents: written(&columns) })
}

fn profile(rng: &mut ChaCha20Rng, is_noisy: bool) -> Brought {
    let ((f, length), sampling) = (shape(rng), sampling(rng, is_noisy));
    let columns = sampled(rng, f, sampling, (-length, length));
    let kind = Kind::Profile(sampling.0, sampling.1);
    Brought { kind, name: "profile.csv", contents: written(&columns) }
}
