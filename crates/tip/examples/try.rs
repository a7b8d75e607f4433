use std::time::Instant;
use stickslip_tip::cycle::*;
use stickslip_tip::stability::critical;
use stickslip_tip::*;
fn main() {
    let tip = |b: f64| TipFunction::triple_gaussian(b, 1.0).unwrap();
    let ac = critical(&tip(1.0), 1.0).unwrap().alpha;
    for (b, a, r) in [
        (1.0, ac + 0.01, 1.0),
        (1.0, ac + 0.01, 1.0),
        (1.0, ac + 1e-6, 1.0),
        (1.0, ac + 0.05, 1.0),
        (1.0, 1.2, 1.0),
        (1.0, 1.4, 1.0),
        (1.0, 1.62, 1.0),
        (1.0, 1.9, 1.0),
        (1.0, 2.0, 1.0),
        (0.0, 2.6, 1.0),
        (0.9, 0.05, 0.1),
        (1.0, 1.0, 0.9),
        (1.0, ac - 0.01, 1.0),
        (1.0, 2.2, 1.0),
        (0.5, 10.0, 3.0),
    ] {
        let m = Model::new(tip(b), a, r).unwrap();
        let mut best = f64::INFINITY;
        let mut c = None;
        for _ in 0..5 {
            let s = Instant::now();
            c = Some(cycle(&m, 1e-9));
            best = best.min(s.elapsed().as_secs_f64());
        }
        match c.unwrap() {
            Ok(c) => println!(
                "b={b} a={a:.6} r={r}: T={:.12} A={:.12} Au={:.12} steps={} it={} res={:.1e} slips={} mult={:.6?} n={} triv={:.1e} {:.2}ms",
                c.period(),
                c.amplitude_x0(),
                c.amplitude_u(),
                c.steps(),
                c.iterations(),
                c.residual(),
                c.slips(),
                c.nontrivial_multipliers().take(3).map(|m| (m.re, m.im)).collect::<Vec<_>>(),
                c.multipliers().len(),
                c.multipliers().iter().map(|m| (m - 1.0).norm()).fold(9.0, f64::min),
                best * 1e3
            ),
            Err(e) => println!("b={b} a={a} r={r}: {e} {:.2}ms", best * 1e3),
        }
    }
}
