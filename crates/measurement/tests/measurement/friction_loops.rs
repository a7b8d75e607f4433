//! Friction loops: numbers put in, and loops of the model, whose steady lag has a closed form.

use crate::noise::normal;
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use stickslip_measurement::{FrictionLoop, LoopError, LoopNumbers};
use stickslip_tip::{Model, Scenario, SupportPath, TipFunction, run};

/// A loop of known numbers: it rises with the slope k to a static peak, falls to the kinetic force within a distance of 3, and
/// goes on with a wave of stick-slip.
struct Known {
    friction: f64,
    peak: f64,
    stiffness: f64,
    offset: f64,
    wave: f64,
    noise: f64,
}

impl Known {
    fn force(&self, x: f64) -> f64 {
        let begin = -self.friction;
        let top = (self.peak - begin) / self.stiffness;
        if x < top {
            return begin + self.stiffness * x;
        }
        let decay = (-(x - top)).exp();
        let slides = self.friction + self.wave * (1.0 - decay) * (1.7 * (x - top)).sin();
        slides + (self.peak - self.friction) * decay
    }

    /// The way back is the way there, turned by half a turn, but for its offset.
    fn measured(&self, rows: usize, length: f64, random: &mut ChaCha8Rng) -> FrictionLoop {
        let x: Vec<f64> = (0..rows).map(|i| length * i as f64 / (rows - 1) as f64).collect();
        let mut read = |force: f64| force + self.offset + self.noise * normal(random);
        let there = x.iter().map(|x| read(self.force(*x))).collect();
        let back = x.iter().map(|x| read(-self.force(length - x))).collect();
        FrictionLoop::new(x, there, back).unwrap()
    }

    /// ∮ F dx by Simpson's rule.
    fn work(&self, length: f64) -> f64 {
        let n = 20_000_u32;
        let step = length / f64::from(n);
        let weight = |i: u32| if i == 0 || i == n { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
        2.0 * (0..=n).map(|i| weight(i) * self.force(step * f64::from(i))).sum::<f64>() * step / 3.0
    }
}

#[test]
fn what_was_put_in_comes_out_within_its_errors() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut held = [0; 5];
    let (all, length) = (200, 100.0);
    for _ in 0..all {
        let friction = random.random_range(2.0..10.0);
        let known = Known {
            friction,
            peak: friction * random.random_range(1.15..1.6),
            stiffness: friction * random.random_range(0.3..0.6),
            offset: random.random_range(-3.0..3.0),
            wave: 0.1 * friction,
            noise: 0.01 * friction,
        };
        let found = known.measured(2000, length, &mut random).numbers().unwrap();
        let LoopNumbers { friction, offset, static_peak, work, stiffness, .. } = found;
        for (count, (estimate, truth)) in held.iter_mut().zip([
            (friction, known.friction),
            (offset, known.offset),
            (static_peak, known.peak),
            (work, known.work(length)),
            (stiffness, known.stiffness),
        ]) {
            *count += i32::from(estimate.holds(truth));
            let scale = if truth > 100.0 { truth } else { known.friction };
            assert!((estimate.value - truth).abs() < 0.06 * scale, "{truth}: {found:?}");
        }
        assert!((found.noise / known.noise - 1.0).abs() < 0.35, "{found:?}");
    }
    eprintln!("of {all}: friction, offset, peak, work, stiffness {held:?}");
    for count in held {
        assert!(count >= all * 88 / 100, "{held:?}");
    }
}

/// Below onset the lag is r + α f(0)/r on either way: on a surface without volume the groove far behind is flat.
#[test]
fn a_loop_of_the_model_has_its_steady_lag() {
    let (alpha, r, length) = (0.5, 1.0, 80.0);
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let lag = r + alpha * tip.value(0.0) / r;
    let mut scenario = Scenario::new(Model::new(tip, alpha, r).unwrap(), 2.0 * length);
    let path = SupportPath::new(vec![0.0, length, 2.0 * length], vec![0.0, length, 0.0]).unwrap();
    scenario.path = Some(path);
    let history = run(&scenario).unwrap().trajectory;
    let support = history.support().clone();
    let at = |t: f64| {
        history.steps().iter().find(|step| step.end() >= t).map(|step| step.lag(&support, t))
    };
    let x: Vec<f64> = (0..401).map(|i| 0.2 * f64::from(i)).collect();
    let there = x.iter().map(|x| at(*x).unwrap()).collect();
    let back = x.iter().map(|x| at(2.0 * length - x).unwrap()).collect();
    let found = FrictionLoop::new(x, there, back).unwrap().numbers().unwrap();
    eprintln!("{found:?} for {lag}");
    assert!((found.friction.value / lag - 1.0).abs() < 0.01, "{found:?} for {lag}");
    assert!(found.offset.value.abs() < 0.02 * lag, "{found:?}");
}

/// Tracks over the same positions in reverse order are the loop itself; the second of other tracks is interpolated, in the part
/// that both have.
#[test]
fn two_tracks_are_a_loop_where_they_overlap() {
    let x: Vec<f64> = (0..200).map(f64::from).collect();
    let there: Vec<f64> = x.iter().map(|x| (x - 5.0).min(5.0) + 0.1 * x.sin()).collect();
    let back: Vec<f64> = x.iter().map(|x| (x - 194.0).max(-5.0)).collect();
    let whole = FrictionLoop::new(x.clone(), there.clone(), back.clone()).unwrap();
    let reversed = |v: &[f64]| v.iter().rev().copied().collect::<Vec<f64>>();
    let track = (x.clone(), there.clone());
    let other = (reversed(&x), reversed(&back));
    assert_eq!(FrictionLoop::of_tracks(track.clone(), other).unwrap(), whole);
    let shifted: Vec<f64> = x.iter().map(|x| x + 0.5).collect();
    let linear: Vec<f64> = shifted.iter().map(|x| 0.3 * x - 1.0).collect();
    let part = FrictionLoop::of_tracks(track, (shifted, linear)).unwrap();
    let [at, _, found] = part.rows();
    assert_eq!((at.len(), at[0]), (199, 1.0));
    assert!(at.iter().zip(found).all(|(x, f)| (0.3 * x - 1.0 - f).abs() < 1e-12));
    let twice = (vec![1.0; 30], vec![0.0; 30]);
    assert_eq!(FrictionLoop::of_tracks((x, there), twice), Err(LoopError::Value(2)));
}

/// Without a static peak the tip slides as soon as the force has risen, here after a quarter of the way and more.
#[test]
fn a_loop_that_rises_long_slides_where_it_has_risen() {
    let x: Vec<f64> = (0..400).map(f64::from).collect();
    for rise in [100.0, 150.0] {
        for noise in [0.0, 0.01] {
            let rough = |x: &f64| noise * (1e4 * (x + 1.0).sin()).sin();
            let there = x.iter().map(|x| (2.0 * x / rise - 1.0).min(1.0) + rough(x)).collect();
            let back = x.iter().map(|x| (1.0 - 2.0 * (399.0 - x) / rise).max(-1.0) + rough(&-x));
            let found = FrictionLoop::new(x.clone(), there, back.collect()).unwrap().numbers();
            let found = found.unwrap();
            assert!((found.friction.value - 1.0).abs() < 0.5 * noise + 1e-9, "{found:?}");
            assert!(found.offset.value.abs() < 0.5 * noise + 1e-9, "{found:?}");
        }
    }
    // Behind a peak that late nothing of the way is left.
    let peaked = |x: f64| if x < 150.0 { x / 75.0 - 1.0 } else { 0.5 };
    let there: Vec<f64> = x.iter().map(|x| peaked(*x)).collect();
    let back = x.iter().map(|x| -peaked(399.0 - x)).collect();
    let refused = FrictionLoop::new(x, there, back).unwrap().numbers();
    assert_eq!(refused, Err(LoopError::Short(150, 400)));
}

#[test]
fn what_is_no_loop_is_refused() {
    let x: Vec<f64> = (0..50).map(f64::from).collect();
    let flat = vec![1.0; 50];
    let made = |there: Vec<f64>, back: Vec<f64>| {
        FrictionLoop::new(x.clone(), there, back).unwrap().numbers()
    };
    assert_eq!(made(flat.clone(), flat.clone()), Err(LoopError::NoSliding));
    // It sticks all the way.
    assert_eq!(made(x.clone(), x.iter().map(|x| x - 60.0).collect()), Err(LoopError::NoSliding));
    assert_eq!(FrictionLoop::new(x.clone(), x.clone(), x[1..].to_vec()), Err(LoopError::Rows(50)));
    let mut twice = x.clone();
    twice[7] = twice[6];
    assert_eq!(FrictionLoop::new(twice, flat.clone(), flat), Err(LoopError::Value(8)));
}
