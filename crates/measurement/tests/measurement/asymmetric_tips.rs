//! Tips that are not symmetric: which half counts, and what is measured of it.
//!
//! Judge of the motion: the full PDE on a grid (`stickslip_grid`) with the whole, asymmetric f. It knows nothing of halves.

use crate::noise::normal;
use chacha20::ChaCha8Rng;
use rand::SeedableRng;
use stickslip_grid as grid;
use stickslip_measurement::{Profile, Request, sides, tip};
use stickslip_stability::critical;
use stickslip_tip::{Model, Scenario, TipFunction, Wider, run};

/// (1 + b x⁷) exp(-x²/2): smooth, with a bulge of 0.25 on the right and a hollow on the left.
fn f(x: f64) -> f64 {
    (1.0 + 0.009 * x.powi(7)) * (-0.5 * x * x).exp()
}

/// The even footprint of one half.
fn half(sign: f64) -> TipFunction {
    let x: Vec<f64> = (0..261).map(|i| 0.05 * f64::from(i)).collect();
    let values: Vec<f64> = x.iter().map(|x| f(sign * x)).collect();
    TipFunction::table(&x, &values).unwrap()
}

/// Trace (sign 1) and retrace (-1, mirrored): x0 of the PDE with the whole f, and of the leading half alone.
#[test]
fn only_the_leading_half_counts() {
    let mut moved = vec![];
    for sign in [1.0, -1.0] {
        let tip = half(sign);
        let (r, until) = (1.0, 24.0);
        let alpha =
            1.05 * critical(&Wider { spring: true, ..Wider::default() }, &tip, r).unwrap().alpha;
        let mut scenario = Scenario::new(Model::new(tip, alpha, r).unwrap(), until);
        // Ahead of its groove: behind its own position lies what the trailing half has carved.
        scenario.kick = -0.5;
        let trajectory = run(&scenario).unwrap().trajectory;
        let start = trajectory.start();
        let times: Vec<f64> =
            (1..=20).map(|i| start + (until - start) * f64::from(i) / 20.0).collect();
        let own: Vec<f64> = times
            .iter()
            .map(|t| {
                let step = trajectory.steps().iter().find(|step| step.end() >= *t - 1e-12).unwrap();
                step.x0(r, *t)
            })
            .collect();
        assert!(own.windows(2).all(|pair| pair[1] > pair[0]), "it only moves forward");
        let whole = |x: f64| f(sign * x);
        let footprint = grid::Footprint::new(&whole, 13.0).unwrap();
        let wider = grid::Wider::default();
        let begin = grid::Start::steady_under(&wider, (alpha, r), footprint, 14.0, -0.5);
        let problem = grid::Problem::under(wider, (alpha, r), footprint, begin).unwrap();
        let method = grid::Method::Sinc { spacing: 0.3, half_width: 80 };
        let stepping = grid::Stepping::absolute(1e-10);
        let request = grid::Request { times: &times, points: &[] };
        let found = grid::solve(&problem, &method, &stepping, &request).unwrap();
        let off = own.iter().zip(&found.x0).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
        eprintln!("sign {sign}: α = {alpha}, largest difference {off:e}");
        assert!(off < 1e-6, "{off}");
        moved.push((alpha, own[19] - own[0]));
    }
    // The thresholds of the halves differ by a factor of 1.8.
    assert!((moved[0].0 / moved[1].0 - 1.0).abs() > 0.5, "{moved:?}");
}

#[test]
fn both_halves_of_a_measured_profile_are_found() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    // Widths 25 and 40 nm on either side of an apex at 12 nm, on a slope.
    let height = |x: f64| {
        let width = if x > 12.0 { 25.0 } else { 40.0 };
        3.0 + 0.004 * x - 10.0 * (-0.5 * ((x - 12.0) / width).powi(2)).exp()
    };
    let x: Vec<f64> = (0..401).map(|i| f64::from(i) - 200.0).collect();
    let z = x.iter().map(|x| height(*x) + 0.05 * normal(&mut random)).collect();
    let profile = Profile::new(x, z).unwrap();
    let request = Request { resamples: 100, ..Request::default() };
    let found = sides(&profile, &request).unwrap();
    let alpha = |width: f64, sigma: f64| {
        let tip = TipFunction::gaussian(width / sigma).unwrap();
        critical(&Wider { spring: true, ..Wider::default() }, &tip, 1.0).unwrap().alpha
    };
    assert!((found.apex - 12.0).abs() < 2.0, "{}", found.apex);
    let sigma = found.forward.sigma.value;
    assert!(
        (sigma - 32.5).abs() < 1.5 && (found.backward.sigma.value - sigma).abs() < 1e-9,
        "{sigma}"
    );
    for (half, width) in [(&found.forward, 25.0), (&found.backward, 40.0)] {
        let truth = alpha(width, sigma);
        let critical = half.critical_alpha;
        eprintln!("{width}: {critical:?} for {truth}, apex {}", half.apex);
        assert!((critical.value / truth - 1.0).abs() < 0.06, "{critical:?} for {truth}");
        assert!((half.apex + 10.0).abs() < 0.2, "{}", half.apex);
    }
    // Both in one function, as a tip file has them.
    let whole = TipFunction::asymmetric_sum(found.footprint().unwrap()).unwrap();
    assert!((whole.value(0.0) - 1.0).abs() < 1e-12);
    for (half, tip) in [(&found.forward, whole.clone()), (&found.backward, whole.mirrored())] {
        let own = critical(&Wider::default(), &tip, 1.0).unwrap().alpha;
        eprintln!("{own} for {}", half.critical_alpha.value);
        assert!((own / half.critical_alpha.value - 1.0).abs() < 1e-3, "{own}");
    }
    // An even fit hides all of it.
    let even = tip(&profile, &request).unwrap().critical_alpha.value;
    let [forward, backward] = [&found.forward, &found.backward].map(|h| h.critical_alpha.value);
    assert!(forward < even && even < backward || backward < even && even < forward, "{even}");
    assert!(found.asymmetry().abs() > 0.1, "{}", found.asymmetry());
}

/// Pits of the widths 30 ± d on either side: the even fit leaves their difference, and noise alone for d = 0.
#[test]
fn an_even_fit_says_how_much_the_sides_differ() {
    let request = Request { resamples: 0, ..Request::default() };
    let asymmetry = |d: f64, noise: f64, seed: u64| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let height = |x: f64| {
            let width = if x > 5.0 { 30.0 + d } else { 30.0 - d };
            2.0 - 0.01 * x - 10.0 * (-0.5 * ((x - 5.0) / width).powi(2)).exp()
        };
        let x: Vec<f64> = (0..201).map(|i| 1.8 * f64::from(i) - 170.0).collect();
        let z = x.iter().map(|x| height(*x) + noise * normal(&mut random)).collect();
        tip(&Profile::new(x, z).unwrap(), &request).unwrap().asymmetry()
    };
    let false_alarms = (0..20).filter(|seed| asymmetry(0.0, 0.2, *seed).is_some()).count();
    assert_eq!(false_alarms, 0);
    for (d, noise) in [(-4.0, 0.2), (3.0, 0.2)] {
        let found: Vec<f64> = (0..5).filter_map(|seed| asymmetry(d, noise, seed)).collect();
        assert!(found.len() == 5 && found.iter().all(|e| e * d > 0.0), "{d}: {found:?}");
    }
    for d in [4.0, 1.0] {
        let found = asymmetry(d, 0.01, 1).unwrap();
        eprintln!("{d}: {found} for {}", d / 15.0);
        assert!((found / (d / 15.0) - 1.0).abs() < 0.03, "{d}: {found}");
    }
}
