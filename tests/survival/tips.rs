//! Random footprints, as the files that a user brings.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha20Rng;
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

fn table(rng: &mut ChaCha20Rng, is_noisy: bool) -> Option<Brought> {
    let rows = (8.0 * 250_f64.powf(rng.random::<f64>())) as usize;
    let (shape, length) = (rng.random_range(0..5), rng.random_range(4.0..12.0));
    let (lobe, at) = (rng.random_range(-0.3..0.5), rng.random_range(1.0..3.0));
    let f = |x: f64| match shape {
        0 => (-0.5 * x * x).exp(),
        1 => (1.0 + x * x).powi(-4),
        2 => 1.0 / x.cosh(),
        3 => {
            (-0.5 * x * x).exp()
                + lobe * ((-2.0 * (x - at).powi(2)).exp() + (-2.0 * (x + at).powi(2)).exp())
        }
        _ => (1.0 - (x / 3.0).powi(2)).max(0.0).powi(3),
    };
    let x: Vec<f64> = (0..rows).map(|i| length * i as f64 / (rows - 1) as f64).collect();
    let mut f: Vec<f64> = x.iter().map(|x| f(*x)).collect();
    let noise = if is_noisy { 1e-5 * 2000_f64.powf(rng.random::<f64>()) } else { 0.0 };
    if is_noisy {
        f.iter_mut().for_each(|f| *f += noise * rng.random_range(-1.0..1.0));
    }
    TipFunction::table(&x, &f).ok()?;
    let mut contents = String::new();
    x.iter().zip(&f).for_each(|(x, f)| writeln!(contents, "{x},{f}").unwrap());
    Some(Brought { kind: Kind::Table(rows, noise), name: "tip.csv", contents })
}
