//! Do intervals hold the truth where they are given, and are they left out where the model is wrong?
//!
//! Judge: ripples and lags of the full PDE (`stickslip_grid`), which shares no code with the cycles that are fitted. Noise is
//! made here: white, of first order in the rows, or a running mean.

use crate::carved::{Made, Truth};
use crate::noise::normal;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use rand::RngExt;
use stickslip_measurement::{
    Data, Fit, FitError, FitRequest, Name, Profile, Request, Scan, Shape, Track, Values, fit, tip,
};
use stickslip_tip::{TipFunction, Wider};

/// What is drawn in a class of fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Class {
    White,
    Correlated,
    Mirrored,
    Footprint,
    Noise,
    Doubled,
    Growing,
    Wider,
}

impl Class {
    const ALL: [Self; 8] = [
        Self::White,
        Self::Correlated,
        Self::Mirrored,
        Self::Footprint,
        Self::Noise,
        Self::Doubled,
        Self::Growing,
        Self::Wider,
    ];

    /// Whether a cycle of the basic model is what was measured.
    fn is_modelled(self) -> bool {
        matches!(self, Self::White | Self::Correlated | Self::Mirrored | Self::Footprint)
    }
}

const ROWS: usize = 400;

/// Noise of variance 1: white, of first order, or a running mean of white noise.
fn noise(is_white: bool, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut white = || normal(random);
    if is_white {
        return (0..ROWS).map(|_| white()).collect();
    }
    let many: Vec<f64> = (0..ROWS + 400).map(|_| white()).collect();
    if random.random::<bool>() {
        let rho: f64 = random.random_range(0.5..0.93);
        let mut last = 0.0;
        let step = |new: &f64| {
            last = rho * last + (1.0 - rho * rho).sqrt() * new;
            last
        };
        many.iter().map(step).skip(400).collect()
    } else {
        let width = random.random_range(3..16);
        let sum = |rows: &[f64]| rows.iter().sum::<f64>() / (width as f64).sqrt();
        many.windows(width).map(sum).take(ROWS).collect()
    }
}

/// Of one fit.
struct Drawn {
    truth: Truth,
    data: Data,
    request: FitRequest,
    /// Without noise.
    exact: Vec<f64>,
    /// Standard deviation of the noise.
    noise: f64,
}

fn truth(class: Class, random: &mut ChaCha8Rng) -> Truth {
    let mut truth = Truth { r: random.random_range(0.6..1.5), ..Truth::drawn(random) };
    truth.over = match class {
        Class::Doubled => random.random_range(1.47..1.6),
        Class::Growing => random.random_range(1.02..1.05),
        _ => random.random_range(1.08..1.28),
    };
    if class == Class::Wider {
        let depth_limit = Some(random.random_range(2.0..8.0));
        truth.wider = Wider { depth_limit, ..truth.wider };
        // Of the paper's law, and of a wider one, onset moves.
        truth.over = random.random_range(1.1..1.3);
    }
    truth
}

/// Of a run that has not settled: the ripple grows along the track.
fn growing(made: &mut Made, random: &mut ChaCha8Rng) {
    let mean = made.u.iter().sum::<f64>() / made.u.len() as f64;
    let last = made.x[made.x.len() - 1];
    let rate = random.random_range(0.005..0.02);
    for (x, u) in made.x.iter().zip(&mut made.u) {
        *u = mean + (*u - mean) * (rate * (x - last)).exp();
    }
}

fn drawn(class: Class, seed: u64) -> Drawn {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let truth = truth(class, &mut random);
    let mut made = truth.made(ROWS);
    if class == Class::Growing {
        growing(&mut made, &mut random);
    }
    let mean = made.u.iter().sum::<f64>() / made.u.len() as f64;
    let amplitude = made.u.iter().fold(0.0, |m: f64, u| m.max((u - mean).abs()));
    let is_correlated = match class {
        Class::White | Class::Wider | Class::Doubled | Class::Growing => false,
        Class::Correlated => true,
        _ => random.random::<bool>(),
    };
    let part = random.random_range(0.01..0.05);
    let size = 0.02 * truth.width * truth.width;
    let (offset, slope) = (random.random_range(-3.0..3.0), random.random_range(-1.0..1.0));
    let heights = made.x.iter().zip(&made.u).map(|(x, u)| {
        let ripple = if class == Class::Noise { 0.0 } else { u - mean };
        size * (ripple + amplitude * (offset + slope * (x - made.x[0]) / 40.0))
    });
    let exact: Vec<f64> = heights.collect();
    let noise: Vec<f64> =
        noise(!is_correlated, &mut random).iter().map(|e| size * amplitude * part * e).collect();
    let left = class == Class::Mirrored || class != Class::White && random.random::<bool>();
    let sign = if left { -1.0 } else { 1.0 };
    let x = made.x.iter().map(|x| sign * truth.width * (x - made.x[0])).collect();
    let y = exact.iter().zip(&noise).map(|(y, e)| y + e).collect();
    let mut shape = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let mut footprints = vec![];
    if class == Class::Footprint {
        (shape, footprints) = measured(&mut random);
    }
    let request = FitRequest {
        shape: Shape::Known(shape),
        known: Values::default(),
        free: vec![],
        robust: false,
        scan: None,
        footprints,
    };
    let data = Data::Ripple(Track::new(x, y, None));
    // Ascending positions, as the fit gives them back.
    let exact = if left { exact.into_iter().rev().collect() } else { exact };
    Drawn { truth, data, request, exact, noise: size * amplitude * part }
}

/// The triple Gaussian as a noisy profile has it, in the σ of that measurement.
fn measured(random: &mut ChaCha8Rng) -> (TipFunction, Vec<TipFunction>) {
    let bell = |x: f64| (-0.5 * x * x).exp();
    let noise = random.random_range(0.003..0.02);
    let x: Vec<f64> = (0..200).map(|i| 0.06 * f64::from(i) - 6.2).collect();
    let f = |x: &f64| {
        let f = bell(*x) - 0.5 * (bell(x - 2.0) + bell(x + 2.0));
        f + 0.01 * x + noise * normal(random)
    };
    let f = x.iter().map(f).collect();
    let request = Request { sigma: Some(1.0), resamples: 60, ..Request::default() };
    let found = tip(&Profile::new(x, f).unwrap(), &request).unwrap();
    let of =
        |gaussians: Vec<stickslip_tip::Gaussian>| TipFunction::gaussian_sum(gaussians).unwrap();
    (of(found.gaussians), found.draws.into_iter().map(of).collect())
}

#[derive(Default)]
struct Table {
    fits: usize,
    given: usize,
    held: [usize; 3],
    remarked: usize,
    refused: usize,
    /// Wrong by three errors of the data, and without a word.
    wrong: usize,
    silent: usize,
    /// A depth limit explains the data as well; α is missed without that being said.
    limited: usize,
    unsaid: usize,
    /// The direction given is not that of the scan.
    turned: usize,
}

impl Table {
    fn count(&mut self, class: Class, drawn: &Drawn, found: &Result<Fit, FitError>) -> String {
        self.fits += 1;
        let found = match found {
            Ok(found) => found,
            Err(error) => {
                self.refused += 1;
                self.wrong += usize::from(!class.is_modelled());
                return error.to_string();
            }
        };
        // A measured footprint has f(0) = 1, and α is that much smaller: the triple Gaussian has f(0) = 1 - e^-2.
        let apex = if class == Class::Footprint { 1.0 - (-2_f64).exp() } else { 1.0 };
        let truths = [apex * drawn.truth.alpha(), drawn.truth.r, drawn.truth.width];
        let names = [Name::Alpha, Name::R, Name::Width];
        let mut line = String::new();
        self.given += usize::from(found.explained);
        for (k, (name, truth)) in names.into_iter().zip(truths).enumerate() {
            let estimate = found.numbers.iter().find(|n| n.name == name).unwrap().estimate;
            let held = estimate.holds(truth);
            self.held[k] += usize::from(held && found.explained);
            let word = if held { "" } else { " MISSED" };
            line += &format!(
                "{} {:.4} [{:.4}, {:.4}] for {truth:.4}{word}; ",
                name.word(),
                estimate.value,
                estimate.low,
                estimate.high
            );
        }
        // Ripples of unknown gain all have the remark on a depth limit: it is a word on that alone.
        let of_a_limit = usize::from(found.with_depth_limit.is_some() && class != Class::Wider);
        let is_remarked = found.remarks.len() > of_a_limit || !found.explained;
        if let Some(law) = &found.with_depth_limit {
            let at = names.map(|name| law.values.get(name).unwrap_or(f64::NAN));
            line += &format!("with a depth limit {at:.4?}, behind by {:.1}; ", law.behind);
        }
        self.limited += usize::from(found.with_depth_limit.is_some());
        let is_open = found.numbers.iter().all(|n| !n.estimate.relative().is_finite());
        let is_missed = found.explained && !found.numbers[0].estimate.holds(truths[0]);
        self.unsaid += usize::from(is_missed && found.with_depth_limit.is_none() && !is_open);
        self.remarked += usize::from(is_remarked);
        let off = found.parts[0].model.iter().zip(&drawn.exact);
        let off = off.map(|(m, e)| (m - e).abs()).fold(0.0, f64::max);
        let error = drawn.noise / found.parts[0].judged.wavelengths.unwrap_or(1.0).sqrt();
        if !class.is_modelled() && off > 3.0 * error {
            self.wrong += 1;
            self.silent += usize::from(found.explained && !is_remarked);
        }
        let Data::Ripple(track) = &drawn.data else { panic!("a ripple") };
        let scan = if track.x[1] > track.x[0] { Scan::Right } else { Scan::Left };
        let told = found.parts[0].scan == Some(scan)
            || found.alternatives.iter().any(|other| other.scans == [scan]);
        self.turned += usize::from(class.is_modelled() && !told);
        let judged = found.parts[0].judged;
        format!(
            "{line}off by {:.1} errors, {} {:.1e} {:.1e} {:.1e} of {:.0} rows",
            off / error,
            if found.explained { "explained" } else { "not explained" },
            judged.misfit.unwrap_or(f64::NAN),
            judged.doubling.unwrap_or(f64::NAN),
            judged.drift.unwrap_or(f64::NAN),
            judged.effective.unwrap_or(f64::NAN),
        )
    }

    fn close(&self, class: Class) {
        let share = |n: usize, of: usize| 100.0 * n as f64 / of.max(1) as f64;
        println!(
            "{class:?}: {} fits, {} refused, {} given intervals, held α {:.1} r {:.1} σ {:.1} %; wrong {}, of which silent {}; turned \
             round {}; remarked {}; with a depth limit {}, missed without one {}",
            self.fits,
            self.refused,
            self.given,
            share(self.held[0], self.given),
            share(self.held[1], self.given),
            share(self.held[2], self.given),
            self.wrong,
            self.silent,
            self.turned,
            self.remarked,
            self.limited,
            self.unsaid
        );
    }
}

fn campaign(class: Class, sets: u64, from: u64) -> Table {
    let mut table = Table::default();
    for i in from..from + sets {
        let drawn = drawn(class, 7000 + 1000 * class as u64 + i);
        let found = fit(std::slice::from_ref(&drawn.data), &drawn.request);
        println!("{class:?} {i}: {}", table.count(class, &drawn, &found));
    }
    table.close(class);
    table
}

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|v| v.parse().ok())
}

/// `make survive`; SETS, FROM and CLASS look closer.
#[test]
#[ignore = "minutes: make survive"]
fn intervals_are_given_where_they_hold_and_nowhere_else() {
    let (sets, from) = (number("SETS").unwrap_or(63), number("FROM").unwrap_or(0));
    let only = number("CLASS").map(|class| class as usize);
    for (k, class) in Class::ALL.into_iter().enumerate() {
        if only.is_none_or(|only| only == k) {
            campaign(class, sets, from);
        }
    }
}

/// A few of each class. On commit cd9d12b noise had intervals, doubled and growing ripples no word of warning, and every
/// mirrored ripple numbers of another motion.
#[test]
fn a_few_of_each_class_are_judged() {
    let (mut given, mut held, mut modelled) = (0, 0, 0);
    for (class, sets) in [(Class::White, 3), (Class::Correlated, 3), (Class::Mirrored, 3)] {
        let table = campaign(class, sets, 100);
        assert_eq!((table.refused, table.turned), (0, 0), "{class:?}");
        given += table.given;
        held += table.held[0];
        modelled += table.fits;
    }
    // Binomial with 95 %: at least 7 of 9 in 99.2 % of such sets; the seeds are fixed.
    assert!(modelled - given <= 1 && given - held <= 2, "{held} of {given} of {modelled}");
    let noise = campaign(Class::Noise, 6, 100);
    assert_eq!(noise.refused, noise.fits, "intervals for noise");
    for (class, sets) in [(Class::Doubled, 4), (Class::Growing, 3), (Class::Wider, 2)] {
        let table = campaign(class, sets, 100);
        assert_eq!(table.silent, 0, "{class:?}: {} wrong", table.wrong);
    }
    let wider = campaign(Class::Wider, 8, 700);
    assert!(wider.limited >= 5 && wider.unsaid <= 1, "{} {}", wider.limited, wider.unsaid);
    let growing = campaign(Class::Growing, 2, 200);
    assert!(growing.wrong > 0 || growing.given < growing.fits, "growth is seen");
}

/// Ripples alone do not tell a surface that saturates from one that does not; with their gain they do.
#[test]
fn a_depth_limit_is_named_where_the_data_do_not_exclude_it() {
    let Drawn { truth, data, request, .. } = drawn(Class::White, 7710);
    let alone = fit(std::slice::from_ref(&data), &request).unwrap();
    let limited = alone.with_depth_limit.expect("the shape alone does not exclude it");
    assert!(limited.values.get(Name::DepthLimit).is_some() && limited.behind < 4.0, "{limited:?}");
    assert!(alone.remarks.iter().any(|remark| remark.contains("depth limit")));
    let Data::Ripple(track) = data else { panic!("a ripple") };
    let known = Data::Ripple(Track { gain: Some(0.02), ..track });
    let known = fit(&[known], &request).unwrap();
    assert!(known.with_depth_limit.is_none(), "{:?}", known.with_depth_limit);
    let alpha = known.numbers.iter().find(|n| n.name == Name::Alpha).unwrap().estimate;
    assert!((alpha.value / truth.alpha()).ln().abs() < 0.1, "{alpha:?}");
}

/// The error of a measured footprint is carried along: without it an interval is narrower.
#[test]
fn the_error_of_a_footprint_widens_intervals() {
    let drawn = drawn(Class::Footprint, 42);
    assert!(!drawn.request.footprints.is_empty());
    let data = std::slice::from_ref(&drawn.data);
    let with = fit(data, &drawn.request).unwrap();
    let without = fit(data, &FitRequest { footprints: vec![], ..drawn.request }).unwrap();
    for (with, without) in with.numbers.iter().zip(&without.numbers) {
        let length = |n: &stickslip_measurement::FittedNumber| n.estimate.high - n.estimate.low;
        assert!(length(with) > length(without), "{with:?} {without:?}");
    }
}

/// The same rows three times over say nothing of their errors, nor of two numbers.
#[test]
fn rows_at_one_place_are_no_series() {
    let request = FitRequest {
        shape: Shape::Known(TipFunction::triple_gaussian(1.0, 1.0).unwrap()),
        known: Values::default(),
        free: vec![],
        robust: false,
        scan: None,
        footprints: vec![],
    };
    let onsets = Data::Onsets { velocity: vec![1.0; 3], load: vec![2.0; 3] };
    let refused = fit(&[onsets], &request).unwrap_err().to_string();
    assert!(refused.contains("different"), "{refused}");
    // Exact rows at enough places: values, and no intervals.
    let at = |r: f64| {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        stickslip_stability::critical(&Wider::default(), &tip, r).unwrap().alpha / 0.5
    };
    let velocity = vec![0.4, 0.6, 0.8, 1.0];
    let load = velocity.iter().map(|v| at(*v)).collect();
    let exact = fit(&[Data::Onsets { velocity, load }], &request).unwrap();
    assert!(!exact.explained && exact.remarks.iter().any(|r| r.contains("exactly")), "{exact:?}");
    assert!((exact.numbers[0].estimate.value / 0.5 - 1.0).abs() < 1e-5, "{exact:?}");
}

/// 100,000 rows are fitted as their means are, in seconds.
#[test]
fn many_rows_take_no_longer_than_a_few_thousand() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let truth = Truth { over: 1.2, r: 1.0, width: 20.0, ..Truth::drawn(&mut random) };
    let made = truth.made(ROWS);
    // Between the rows of the grid a cubic of neighbours: its error is far below the noise.
    let between = |at: f64| {
        let i = (at.floor() as usize).clamp(1, ROWS - 3);
        let s = at - i as f64;
        let u = |k: usize| made.u[i + k - 1];
        let lagrange = [
            -s * (s - 1.0) * (s - 2.0) / 6.0,
            (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
            -(s + 1.0) * s * (s - 2.0) / 2.0,
            (s + 1.0) * s * (s - 1.0) / 6.0,
        ];
        (0..4).map(|k| lagrange[k] * u(k)).sum::<f64>()
    };
    let rows = 100_000;
    let part = |i: usize| (ROWS - 1) as f64 * i as f64 / (rows - 1) as f64;
    let x = (0..rows).map(|i| 20.0 * 40.0 * i as f64 / (rows - 1) as f64).collect();
    let y = (0..rows).map(|i| between(part(i)) + 0.2 * normal(&mut random)).collect();
    let shape = Shape::Known(TipFunction::triple_gaussian(1.0, 1.0).unwrap());
    let request = FitRequest {
        shape,
        known: Values::default(),
        free: vec![],
        robust: false,
        scan: Some(Scan::Right),
        footprints: vec![],
    };
    let found = fit(&[Data::Ripple(Track::new(x, y, None))], &request).unwrap();
    assert!(found.rows <= 2048 && found.explained, "{} {:?}", found.rows, found.remarks);
    for (name, truth) in [(Name::Alpha, truth.alpha()), (Name::R, 1.0), (Name::Width, 20.0)] {
        let estimate = found.numbers.iter().find(|n| n.name == name).unwrap().estimate;
        assert!((estimate.value / truth).ln().abs() < 0.1, "{} {estimate:?}", name.word());
    }
}
