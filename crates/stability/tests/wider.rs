//! Linear theory under the wider law: onset, its limits, and walking.
//!
//! Judged by the figures of two prototypes that solve the equations in time (a spectral grid and direct sums), by
//! the paper's law in the limit, by counting roots, and by closed forms for J0 and cos x.

use num_complex::Complex64;
use stickslip_stability::{
    OnsetKind, StabilityError, creep, critical, critical_under, least_depth_limit, leading_roots,
    memory_length, roots, unstable_count, walk, walking_alpha, walking_speeds,
};
use stickslip_tip::{Model, TipFunction, Wider};

fn triple(beta: f64) -> TipFunction {
    TipFunction::triple_gaussian(beta, 1.0).expect("a valid tip")
}

fn limited(b: f64) -> Wider {
    Wider { depth_limit: Some(b), ..Wider::default() }
}

fn healing(time: f64) -> Wider {
    Wider { healing_time: Some(time), ..Wider::default() }
}

fn heavy(mass: f64) -> Wider {
    Wider { inertia: Some(mass), ..Wider::default() }
}

fn free(inertia: Option<f64>, healing_time: Option<f64>) -> Wider {
    Wider { inertia, healing_time, depth_limit: None, spring: false }
}

fn model(wider: Wider, tip: &TipFunction, alpha: f64, r: f64) -> Model {
    Model::under(wider, tip.clone(), alpha, r).expect("a valid model")
}

#[test]
fn onset_has_the_digits_of_the_prototypes() {
    let cases = [
        (limited(20.0), 0.0, 2.300070),
        (limited(5.0), 0.0, 5.197881),
        (healing(10.0), 1.0, 1.340504),
        (healing(10.0), 0.0, 2.403020),
    ];
    for (wider, beta, alpha) in cases {
        let found = critical_under(&wider, &triple(beta), 1.0).unwrap();
        assert!((found.critical.alpha - alpha).abs() < 6e-7, "{found:?} {alpha}");
        assert_eq!(found.kind, OnsetKind::Smooth);
    }
}

#[test]
fn limits_have_the_digits_of_the_prototypes() {
    let b = least_depth_limit(&Wider::default(), &triple(0.0), 1.0).unwrap();
    assert!((b - 1.671049).abs() < 6e-7, "{b}");
    for (beta, length) in [(0.0, 0.860935), (1.0, 0.758028)] {
        let found = memory_length(&triple(beta)).unwrap();
        assert!((found - length).abs() < 6e-7, "{found} {length}");
    }
}

/// Laws of every combination.
fn laws() -> Vec<Wider> {
    let mut laws = vec![];
    for depth_limit in [None, Some(20.0), Some(4.0)] {
        for healing_time in [None, Some(30.0), Some(4.0)] {
            for inertia in [None, Some(0.2), Some(8.0)] {
                laws.push(Wider { depth_limit, healing_time, inertia, spring: true });
            }
        }
    }
    laws
}

#[test]
fn below_onset_no_root_is_unstable_and_above_it_a_pair_is() {
    let mut found = 0;
    for tip in [triple(0.0), triple(0.4), triple(1.0), TipFunction::Bessel] {
        for wider in laws() {
            for r in [0.3, 1.0, 4.0] {
                let Ok(onset) = critical_under(&wider, &tip, r) else { continue };
                if onset.kind == OnsetKind::NonSmooth {
                    continue;
                }
                let alpha = onset.critical.alpha;
                let count = |part: f64| unstable_count(&model(wider, &tip, part * alpha, r));
                for (part, wanted) in [(0.2, 0), (0.7, 0), (0.999, 0), (1.001, 2)] {
                    assert_eq!(count(part), Ok(wanted), "{wider:?} {tip:?} {r} {part} {onset:?}");
                }
                found += 1;
            }
        }
    }
    println!("{found} onsets");
    assert!(found > 200, "{found}");
}

#[test]
fn where_no_onset_is_found_nothing_is_unstable() {
    let mut stable = 0;
    for tip in [triple(0.0), triple(0.4)] {
        for b in [0.3, 1.0, 3.0] {
            for time in [None, Some(0.5), Some(2.0), Some(20.0)] {
                for inertia in [None, Some(1.0)] {
                    for r in [0.3, 1.0, 4.0] {
                        let wider =
                            Wider { depth_limit: Some(b), healing_time: time, inertia, spring: true };
                        if critical_under(&wider, &tip, r).is_ok() {
                            continue;
                        }
                        stable += 1;
                        for alpha in [0.3, 3.0, 30.0, 1e3, 1e5] {
                            let count = unstable_count(&model(wider, &tip, alpha, r));
                            assert_eq!(count, Ok(0), "{wider:?} {tip:?} {r} {alpha}");
                        }
                    }
                }
            }
        }
    }
    println!("{stable} stable");
    assert!(stable > 20);
}

#[test]
fn the_least_depth_limit_parts_stable_from_unstable() {
    for tip in [triple(0.0), triple(0.4)] {
        for base in [Wider::default(), healing(6.0), heavy(0.5), heavy(20.0)] {
            for r in [0.3, 1.0, 4.0] {
                let b = least_depth_limit(&base, &tip, r).unwrap();
                let at = |part: f64| {
                    critical_under(&Wider { depth_limit: Some(part * b), ..base }, &tip, r)
                };
                assert!(at(1.001).is_ok(), "{base:?} {r} {b}");
                assert!(at(0.999).is_err(), "{base:?} {r} {b} {:?}", at(0.999));
            }
        }
    }
}

#[test]
fn the_memory_length_parts_stable_from_unstable_at_every_r_and_mass() {
    for tip in [triple(0.0), triple(1.0)] {
        let length = memory_length(&tip).unwrap();
        for r in [0.3, 1.0, 4.0] {
            for inertia in [None, Some(2.0)] {
                let at = |part: f64| {
                    let wider = Wider { inertia, ..healing(part * length / r) };
                    critical_under(&wider, &tip, r)
                };
                assert!(at(1.001).is_ok(), "{r} {inertia:?}");
                assert!(matches!(at(0.999), Err(StabilityError::NoCrossing { .. })), "{r}");
            }
        }
    }
}

/// The error of αc against the paper's, for a parameter made smaller by tens.
#[test]
fn onset_converges_to_the_papers_as_each_extension_fades() {
    for (beta, r) in [(0.0, 1.0), (0.4, 0.3)] {
        let tip = triple(beta);
        let paper = critical(&tip, r).unwrap().alpha;
        let laws: [fn(f64) -> Wider; 3] =
            [|e| limited(1.0 / e), |e| healing(1.0 / e), heavy];
        for law in laws {
            let error = |e: f64| critical_under(&law(e), &tip, r).unwrap().critical.alpha - paper;
            for e in [1e-3, 1e-4, 1e-5] {
                let order = (error(e) / error(0.1 * e)).log10();
                assert!((order - 1.0).abs() < 0.05, "{beta} {r} {e} {order}");
            }
        }
        let none = critical_under(&Wider::default(), &tip, r).unwrap();
        assert!((none.critical.alpha / paper - 1.0).abs() < 1e-13, "{none:?} {paper}");
        assert!((none.weight - 1.0).abs() < 1e-15);
    }
}

#[test]
fn roots_converge_to_the_papers_as_each_extension_fades() {
    let tip = triple(0.4);
    let paper = leading_roots(&model(Wider::default(), &tip, 1.3, 1.0), 6).unwrap().roots;
    let laws: [fn(f64) -> Wider; 3] = [|e| limited(1.0 / e), |e| healing(1.0 / e), heavy];
    for law in laws {
        let error = |e: f64| {
            let found = leading_roots(&model(law(e), &tip, 1.3, 1.0), 6).unwrap();
            assert!(found.certificate.is_complete());
            (0..6).map(|i| (found.roots[i] - paper[i]).norm()).fold(0.0, f64::max)
        };
        for e in [1e-4, 1e-5] {
            let order = (error(e) / error(0.1 * e)).log10();
            assert!((order - 1.0).abs() < 0.02, "{e} {order}");
        }
        assert!(error(1e-4) > 1e-6, "negative control");
    }
}

/// f, f' and f'' of the triple Gaussian far out into the tails that e^{-py} brings up for Re p < 0.
fn triple_by_hand(beta: f64, y: f64) -> [f64; 3] {
    let lobes = [(1.0, 0.0), (-0.5 * beta, -2.0), (-0.5 * beta, 2.0)];
    lobes.iter().fold([0.0; 3], |sum, (height, center)| {
        let z = y - center;
        let value = height * (-0.5 * z * z).exp();
        [sum[0] + value, sum[1] - z * value, sum[2] + (z * z - 1.0) * value]
    })
}

/// D with every transform by Simpson's rule on f, f', f'' over the reach, as it is before it is multiplied out.
fn slow(model: &Model, beta: f64, lambda: Complex64) -> Complex64 {
    let (wider, r) = (model.wider(), model.r());
    let s = model.fading();
    let (h, panels) = (0.0025, 6000);
    let integral = |f: &dyn Fn(f64) -> f64, p: Complex64| -> Complex64 {
        let term = |i: i32| {
            let weight = if i == 0 || i == panels { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            let y = h * f64::from(i);
            (-p * y).exp() * (weight * h / 3.0 * f(y))
        };
        (0..=panels).map(term).sum()
    };
    let [value, slope, curvature] = [0, 1, 2].map(|n: usize| move |y: f64| triple_by_hand(beta, y)[n]);
    let a = model.alpha() * model.steady_weight() / r;
    let (p, rest) = (lambda + s, Complex64::new(s, 0.0));
    let bare = lambda * lambda * (r * r * wider.inertia.unwrap_or(0.0)) + lambda * r + 1.0;
    let groove = (integral(&curvature, p) - integral(&curvature, rest)) * a;
    let limit = a / wider.depth_limit.unwrap_or(f64::INFINITY);
    let (here, still) = (integral(&slope, p), integral(&slope, rest));
    bare + groove + here * (still - here) * (a * limit) / (integral(&value, p) * limit + 1.0)
}

#[test]
fn roots_solve_the_equation_that_was_not_multiplied_out() {
    for wider in laws() {
        for (beta, alpha, r) in [(0.4, 2.0, 1.0), (0.0, 0.6, 0.4), (0.9, 9.0, 2.0)] {
            let model = model(wider, &triple(beta), alpha, r);
            let found = leading_roots(&model, 5).unwrap();
            assert!(found.certificate.is_complete() && found.roots.len() >= 5);
            for root in &found.roots {
                let z = root / r;
                let step = 1e-4;
                let slope = (slow(&model, beta, z + step) - slow(&model, beta, z - step)) / (2.0 * step);
                let error = (slow(&model, beta, z) / slope).norm() * r;
                assert!(error < 1e-9 * (1.0 + root.norm()), "{wider:?} {beta} {root} {error:e}");
            }
        }
    }
}

#[test]
fn what_has_no_linear_theory_is_refused() {
    let corner = model(limited(5.0), &triple(1.0), 1.0, 1.0);
    assert_eq!(unstable_count(&corner), Err(StabilityError::Corner));
    assert_eq!(leading_roots(&corner, 3).err(), Some(StabilityError::Corner));
    let walker = model(free(None, Some(1.0)), &triple(0.0), -3.0, 0.0);
    assert_eq!(roots(&walker, 0.0).err(), Some(StabilityError::NoSupport));
    let lone = critical_under(walker.wider(), walker.tip(), 1.0);
    assert_eq!(lone.err(), Some(StabilityError::NoSupport));
    let held = model(healing(5.0), &triple(0.0), 3.0, 1.0);
    assert!(matches!(creep(&held), Err(StabilityError::PapersLawOnly(_))));
    assert_eq!(walking_speeds(&held), Err(StabilityError::Dragged));
    let waves = model(healing(5.0), &TipFunction::Bessel, 1.0, 1.0);
    assert!(matches!(roots(&waves, -1.0), Err(StabilityError::BranchPoints { .. })));
    assert!(roots(&waves, -0.1).is_ok());
}

#[test]
fn a_walk_over_waves_has_the_speed_of_walking_droplets() {
    // Oza, Rosales and Bush (2013), in one dimension: v² = (2B - 1 - √(1+4B))/2.
    for b in [2.01, 2.5, 3.0, 8.0, 50.0_f64] {
        let walker = model(free(None, Some(1.0)), &TipFunction::Bessel, -b, 0.0);
        let speeds = walking_speeds(&walker).unwrap();
        let exact = (0.5 * (2.0 * b - 1.0 - (1.0 + 4.0 * b).sqrt())).sqrt();
        assert_eq!(speeds.len(), 1, "{b}");
        assert!((speeds[0] - exact).abs() < 1e-13 * exact.max(1.0), "{b} {} {exact}", speeds[0]);
    }
    let threshold = walking_alpha(&TipFunction::Bessel, 1.0);
    assert!((threshold + 2.0).abs() < 1e-14);
    let below = model(free(None, Some(1.0)), &TipFunction::Bessel, -1.99, 0.0);
    assert!(walking_speeds(&below).unwrap().is_empty());
}

#[test]
fn walking_begins_where_the_curvature_says_for_every_footprint() {
    for tip in [triple(0.0), triple(0.7), TipFunction::Bessel, TipFunction::Cosine] {
        for (time, mass) in [(1.0, None), (3.0, Some(0.5))] {
            let alpha = walking_alpha(&tip, time);
            let speeds =
                |part: f64| walking_speeds(&model(free(mass, Some(time)), &tip, part * alpha, 0.0));
            assert!(speeds(0.999).unwrap().is_empty(), "{tip:?}");
            let walks = speeds(1.001).unwrap();
            assert_eq!(walks.len(), 1, "{tip:?} {walks:?}");
            assert!(walks[0] < 0.1, "{tip:?} {walks:?}");
        }
    }
}

/// λ³ + (σ+b+1)λ² + b(σ+ρ)λ + 2bσ(ρ-1) = 0 at the fixed points of the Lorenz system, b = 1.
#[test]
fn a_walk_over_a_cosine_has_the_roots_of_the_lorenz_system() {
    for (sigma, rho) in [(10.0, 28.0), (10.0, 5.0), (4.0, 60.0)] {
        let walker = model(free(Some(1.0 / sigma), Some(1.0)), &TipFunction::Cosine, -rho, 0.0);
        let speeds = walking_speeds(&walker).unwrap();
        assert_eq!(speeds.len(), 1);
        assert!((speeds[0] - f64::sqrt(rho - 1.0)).abs() < 1e-12 * rho);
        let walk = walk(&walker, speeds[0], 4).unwrap();
        assert!(walk.spectrum.certificate.is_complete());
        assert_eq!(walk.spectrum.roots.len(), 4);
        let lorenz: Vec<_> = walk.spectrum.roots.iter().filter(|z| z.norm() > 0.0).collect();
        assert_eq!(lorenz.len(), 3, "and the shift of the whole walk: {:?}", walk.spectrum.roots);
        for z in lorenz {
            let terms =
                [z * z * z, z * z * (sigma + 2.0), z * (sigma + rho), (2.0 * sigma * (rho - 1.0)).into()];
            let size: f64 = terms.iter().map(|t| t.norm()).sum();
            assert!(terms.iter().sum::<Complex64>().norm() < 1e-12 * size, "{sigma} {rho} {z}");
        }
    }
}

#[test]
fn the_lorenz_walk_loses_its_stability_where_the_lorenz_system_does() {
    let sigma = 10.0;
    let hopf = sigma * (sigma + 4.0) / (sigma - 2.0);
    for (part, count) in [(0.999, 0), (1.001, 2)] {
        let rho = part * hopf;
        let walker = model(free(Some(1.0 / sigma), Some(1.0)), &TipFunction::Cosine, -rho, 0.0);
        let speed = walking_speeds(&walker).unwrap()[0];
        let walk = walk(&walker, speed, 4).unwrap();
        assert_eq!(walk.unstable_count(), count, "{rho} {:?}", walk.spectrum.roots);
    }
}
