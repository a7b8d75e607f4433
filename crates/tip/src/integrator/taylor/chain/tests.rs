//! The series beside the definition, from the exponentials themselves.

use super::*;
use num_complex::Complex;

const ORDER: usize = 22;
const ALPHA: f64 = 1.3;

/// (s, w, z)
fn modes() -> Vec<[Complex<f64>; 3]> {
    let c = Complex::new;
    vec![
        [c(-1.9, 0.0), c(0.7, 0.0), c(1.2, 0.0)],
        [c(-1.4, 1.1), c(-0.4, 0.9), c(0.3, 0.5)],
        [c(-2.2, 2.6), c(0.2, -0.3), c(-0.2, 0.1)],
    ]
}

/// The definition: z' = w + (sv - 1/T)z for each exponential, v and the height from all of them. Displacements, and
/// minus heights.
fn by_modes(acting: &Acting, force: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let modes = modes();
    let mut z: Vec<Vec<Complex<f64>>> = modes.iter().map(|m| vec![m[2]]).collect();
    let (mut v, mut d, mut g) = (vec![], vec![0.0], vec![]);
    let mut weight = vec![acting.depth.map_or(1.0, |(weight, _)| weight)];
    v.extend(acting.inertia.map(|(_, velocity)| velocity));
    for k in 0..ORDER {
        let of = |power: i32| -> f64 {
            let terms = modes.iter().zip(&z).map(|(m, z)| (m[1] * m[0].powi(power) * z[k]).re);
            ALPHA * terms.sum::<f64>()
        };
        g.push(of(-1));
        if let Some((_, rate)) = acting.depth.filter(|_| k > 0) {
            let term = |i: usize| rate * i as f64 * g[i] * weight[k - i];
            weight.push((1..=k).map(term).sum::<f64>() / k as f64);
        }
        weight.resize(k + 1, 0.0);
        let extension = match k {
            0 => acting.extension,
            1 => acting.support - d[1],
            _ => -d[k],
        };
        let pull = of(0) + acting.spring * extension + force[k];
        match acting.inertia {
            None => v.push(pull),
            Some((mass, _)) => v.push((pull - v[k]) / (mass * (k + 1) as f64)),
        }
        for (m, z) in modes.iter().zip(&mut z) {
            let carried: Complex<f64> = (0..=k).map(|i| v[i] * z[k - i]).sum();
            let next = m[0] * carried + weight[k] - acting.healing * z[k];
            z.push(next / (k + 1) as f64);
        }
        d.push(v[k] / (k + 1) as f64);
    }
    (d, g)
}

#[test]
fn the_series_is_that_of_the_exponentials() {
    let force: Vec<f64> = (0..ORDER).map(|k| 0.3 / (1.0 + (k * k) as f64)).collect();
    let laws = [
        (0.0, None, None),
        (0.7, None, None),
        (0.4, Some((0.6, 0.9)), None),
        (0.0, None, Some((0.8, 0.3))),
        (0.3, Some((0.5, 0.2)), Some((0.6, -0.4))),
    ];
    for (healing, inertia, depth) in laws {
        let (spring, support, extension) = (1.0, 0.8, 1.7);
        let mut chain = Chain::new();
        // Left over from a step before.
        chain.rows.iter_mut().flatten().for_each(|entry| *entry = 7.0);
        let (mut past, mut of_tip) = ([0.0; ROOM], [0.0; ROOM]);
        for n in 0..=ORDER {
            let power = |m: &[Complex<f64>; 3]| m[1] * m[0].powi(n as i32 - 1);
            past[n] = modes().iter().map(|m| (power(m) * m[2]).re).sum::<f64>();
            of_tip[n] = modes().iter().map(|m| power(m).re).sum::<f64>();
        }
        let alpha = ALPHA;
        let of_tip = &of_tip;
        let acting = Acting { alpha, of_tip, spring, support, healing, inertia, extension, depth };
        chain.start((ORDER, depth.is_some()), ALPHA, &past, &[]);
        chain.force[..ORDER].copy_from_slice(&force);
        let mut plain = chain.clone();
        chain.run(&acting);
        // Compiled for the least of machines: the same bits.
        plain.coefficients(&acting);
        let bits =
            |series: &Series| series.coefficients().iter().map(|c| c.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&plain.displacement), bits(&chain.displacement));
        let (slow, depths) = by_modes(&acting, &force);
        let same = |slow: &[f64], fast: &[f64]| {
            assert_eq!(slow.len(), fast.len());
            let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-11 * a.abs();
            assert!(slow.iter().zip(fast).all(near), "{slow:?} {fast:?}");
        };
        same(&slow, chain.displacement().coefficients());
        if depth.is_some() {
            let depth = chain.height().coefficients().iter().map(|height| -height);
            same(&depths, &depth.collect::<Vec<_>>());
        }
    }
}
