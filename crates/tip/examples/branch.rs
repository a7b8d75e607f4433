//! x
use std::ops::ControlFlow;
use std::time::Instant;
use stickslip_tip::cycle::*;
use stickslip_tip::*;
fn show(b: &Branch) {
    for (i, p) in b.points.iter().enumerate() {
        if i % 1 == 0 {
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
    let v: Vec<f64> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let tip = TipFunction::triple_gaussian(v[0], 1.0).unwrap();
    let c = Continuation { to: v[2], ..Continuation::default() };
    let s = Instant::now();
    let b = c.from_onset(&tip, v[1], |_| ControlFlow::Continue(())).unwrap();
    println!("{:?}", s.elapsed());
    show(&b);
    for sp in b.special.iter().filter(|s| s.kind == SpecialKind::PeriodDoubling) {
        println!("SWITCH at {}", sp.alpha);
        match c.switched(sp, |_| ControlFlow::Continue(())) {
            Ok(b) => show(&b),
            Err(e) => println!("{e}"),
        }
    }
}
