//! x
use std::time::Instant;
use stickslip_tip::cycle::*;
use stickslip_tip::stability::critical;
use stickslip_tip::*;
fn main() {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let ac = critical(&tip, 1.0).unwrap().alpha;
    let m = Model::new(tip, ac + 0.01, 1.0).unwrap();
    let s = Instant::now();
    for _ in 0..2000 {
        std::hint::black_box(cycle(&m, 1e-9).unwrap());
    }
    println!("{:.3} ms", s.elapsed().as_secs_f64() / 2.0);
}
