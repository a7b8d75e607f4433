//! x
use std::ops::ControlFlow;
use std::time::Instant;
use stickslip_tip::cycle::*;
use stickslip_tip::*;
fn show(b: &Branch) {
    for (i, p) in b.points.iter().enumerate() {
        if i % 4 == 0 {
            println!(
                "{:.6} {:.3} T={:.6} A={:.6} {} lead {:.4}{:+.4}i",
                p.alpha, p.r, p.period, p.amplitude_x0, p.stable, p.leading.re, p.leading.im
            );
        }
    }
    println!("END {:?} {}", b.end, b.points.len());
    for s in &b.special {
        println!("{:?} alpha={:.12} r={:.12} T={:.9}", s.kind, s.alpha, s.r, s.period);
    }
}
fn main() {
    let g = |a, w| Gaussian { amplitude: a, center: 0.0, width: w };
    let tip = TipFunction::gaussian_sum(vec![g(1.0, 1.0), g(1.0, 3.0)]).unwrap();
    let c = Continuation { to: 20.0, ..Continuation::default() };
    let s = Instant::now();
    let b = c.from_onset(&tip, 1.0, |_| ControlFlow::Continue(())).unwrap();
    println!("{:?}", s.elapsed());
    show(&b);
    let t2 = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let c2 = cycle(&Model::new(t2.clone(), 1.3, 1.0).unwrap(), 1e-9).unwrap();
    let back = Continuation { to: 0.5, ..Continuation::default() };
    show(&back.from_cycle(&c2, |_| ControlFlow::Continue(())).unwrap());
    let r = Continuation { over: Parameter::R, to: 0.3, ..Continuation::default() };
    show(&r.from_onset(&t2, 1.0, |_| ControlFlow::Continue(())).unwrap());
    let r = Continuation { over: Parameter::R, to: 2.0, ..Continuation::default() };
    show(&r.from_cycle(&c2, |_| ControlFlow::Continue(())).unwrap());
}
