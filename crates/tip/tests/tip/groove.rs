//! Is the groove right, its height too, whichever sum tells it? Judged by closed forms: a tip that stands, one
//! that has passed at constant speed, and f itself by Gauss quadrature over a motion known beforehand.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;
use stickslip_tip::memory::{Groove, Policy, Retreat};
use stickslip_tip::{MemoryChoice, STAGES, TipFunction, nodes_and_weights};

const CHOICES: [MemoryChoice; 4] =
    [MemoryChoice::Auto, MemoryChoice::Direct, MemoryChoice::Fft, MemoryChoice::Modes];

/// Points that are no multiple of a step's stages in number.
const AT: [f64; 8] = [-0.2, -0.1, 0.0, 0.3, 0.7, 1.1, 1.6, 2.3];

fn footprints() -> Vec<TipFunction> {
    let x: Vec<f64> = (0..40).map(|i| 0.2 * f64::from(i)).collect();
    let f: Vec<f64> = x.iter().map(|x| (1.0 - 0.2 * x * x) * (-x * x / 2.0).exp()).collect();
    vec![
        TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
        TipFunction::triple_gaussian(0.5, 2.0).unwrap(),
        TipFunction::gaussian(0.8).unwrap(),
        TipFunction::table(&x, &f).unwrap(),
        TipFunction::Bessel,
    ]
}

/// Every memory of every footprint, but for modes of J0, which there are none of.
fn each(judge: impl Fn(&TipFunction, MemoryChoice, &mut Policy)) {
    for tip in footprints() {
        for choice in CHOICES {
            let Ok(mut memory) = Policy::new(choice, tip.clone(), 1e-10, Retreat::Small) else {
                assert_eq!((choice, &tip), (MemoryChoice::Modes, &TipFunction::Bessel));
                continue;
            };
            judge(&tip, choice, &mut memory);
        }
    }
}

/// What a sum may miss: round-off, but for a sum of exponentials that fit f' to 1e-10 (and its integral, twice
/// over a path of many widths, to less).
fn allowed(choice: MemoryChoice) -> f64 {
    match choice {
        MemoryChoice::Direct | MemoryChoice::Fft => 1e-11,
        MemoryChoice::Auto | MemoryChoice::Modes => 3e-8,
    }
}

/// Heights, slopes and curvatures.
fn told(memory: &mut Policy, at: &[f64]) -> [Vec<f64>; 3] {
    let [mut height, mut slope, mut curvature] = [(); 3].map(|()| vec![f64::NAN; at.len()]);
    memory.groove(at, &mut Groove::new(&mut slope, &mut curvature).with_height(&mut height));
    [height, slope, curvature]
}

#[test]
fn a_tip_that_stands_deepens_its_own_shape() {
    each(|tip, choice, memory| {
        for _ in 0..40 {
            memory.remember(&[0.0; STAGES], &nodes_and_weights().1);
        }
        let [height, slope, curvature] = told(memory, &AT);
        for (i, x) in AT.into_iter().enumerate() {
            let (f1, f2) = tip.slope_and_curvature(x);
            assert!(
                (height[i] - 40.0 * tip.value(x)).abs() < allowed(choice),
                "{tip:?} {choice:?} {x}"
            );
            assert!((slope[i] - 40.0 * f1).abs() < allowed(choice), "{tip:?} {choice:?} {x}");
            assert!(
                (curvature[i] - 40.0 * f2).abs() < 10.0 * allowed(choice),
                "{tip:?} {choice:?} {x}"
            );
        }
    });
}

#[test]
fn a_tip_that_passes_at_constant_speed_leaves_the_integral_of_its_shape() {
    each(|tip, choice, memory| {
        let ((c, b), step, v) = (nodes_and_weights(), 0.4, 2.0);
        let steps = 150;
        for _ in 0..steps {
            memory.remember(&c.map(|c| step * c), &b.map(|b| step / v * b));
        }
        let length = step * f64::from(steps);
        let [height, slope, curvature] = told(memory, &AT);
        for (i, x) in AT.into_iter().enumerate() {
            let (here, there) = (x, x + length);
            let exact = (tip.tail(here) - tip.tail(there)) / v;
            assert!(
                (height[i] - exact).abs() < allowed(choice),
                "{tip:?} {choice:?} {x} {}",
                height[i] - exact
            );
            let exact = (tip.value(there) - tip.value(here)) / v;
            assert!((slope[i] - exact).abs() < allowed(choice), "{tip:?} {choice:?} {x}");
            let exact = (tip.slope(there) - tip.slope(here)) / v;
            assert!((curvature[i] - exact).abs() < allowed(choice), "{tip:?} {choice:?} {x}");
        }
    });
}

/// x0(t) = 0.9 t + 0.6 sin 2t, at times backwards: modes hand over to `fft` and take back again.
#[test]
fn a_tip_that_comes_and_goes_is_the_quadrature_over_its_motion() {
    let x0 = |t: f64| 0.9 * t + 0.6 * (2.0 * t).sin();
    let rule = GaussLegendre::new(NonZeroUsize::new(16).unwrap());
    let (h, steps) = (0.05, 900);
    let end = h * f64::from(steps);
    each(|tip, choice, memory| {
        let (c, b) = nodes_and_weights();
        for n in 0..steps {
            let t = h * f64::from(n);
            memory.remember(&c.map(|c| x0(t + h * c) - x0(t)), &b.map(|b| h * b));
        }
        let [height, slope, _] = told(memory, &AT);
        for (i, x) in AT.into_iter().enumerate() {
            let integral = |f: &dyn Fn(f64) -> f64| -> f64 {
                let panel = |n: i32| {
                    let then = |node: f64| h * (f64::from(n) + 0.5 * (1.0 + node));
                    let nodes = rule.as_node_weight_pairs().iter();
                    nodes.map(|(y, w)| 0.5 * h * w * f(x0(end) + x - x0(then(*y)))).sum::<f64>()
                };
                (0..steps).map(panel).sum()
            };
            let exact = integral(&|xi| tip.value(xi));
            assert!(
                (height[i] - exact).abs() < allowed(choice),
                "{tip:?} {choice:?} {x} {}",
                height[i] - exact
            );
            let exact = integral(&|xi| tip.slope(xi));
            assert!((slope[i] - exact).abs() < allowed(choice), "{tip:?} {choice:?} {x}");
        }
    });
}

/// Points in any number, visits in any number: the same groove.
#[test]
fn slices_may_be_of_any_length() {
    each(|tip, choice, memory| {
        let way: Vec<f64> = (1..=77).map(|i| 0.03 * f64::from(i)).collect();
        memory.remember(&way, &[0.1; 77]);
        let mut other = Policy::new(choice, tip.clone(), 1e-10, Retreat::Small).unwrap();
        way.iter().for_each(|_| other.remember(&[0.03], &[0.1]));
        memory.remember(&[], &[]);
        let together = told(memory, &AT);
        for (i, x) in AT.into_iter().enumerate() {
            let alone = told(&mut other, &[x]);
            for (a, b) in together.iter().zip(alone) {
                assert!(
                    (a[i] - b[0]).abs() < allowed(choice),
                    "{tip:?} {choice:?} {x}: {} {}",
                    a[i],
                    b[0]
                );
            }
        }
    });
}

/// Those who ask for no height are told what they would be told otherwise, to the last bit.
#[test]
fn asking_for_heights_changes_nothing_else() {
    each(|tip, choice, memory| {
        let mut silent = Policy::new(choice, tip.clone(), 1e-10, Retreat::Small).unwrap();
        let (c, b) = nodes_and_weights();
        for n in 0..300 {
            let length = if n % 20 < 14 { 0.3 } else { -0.25 };
            for memory in [&mut *memory, &mut silent] {
                memory.remember(&c.map(|c| length * c), &b);
            }
            let [_, slope, curvature] = told(memory, &AT);
            let (mut s, mut k) = ([0.0; AT.len()], [0.0; AT.len()]);
            silent.groove(&AT, &mut Groove::new(&mut s, &mut k));
            let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&slope), bits(&s), "{tip:?} {choice:?} {n}");
            assert_eq!(bits(&curvature), bits(&k), "{tip:?} {choice:?} {n}");
        }
    });
}
