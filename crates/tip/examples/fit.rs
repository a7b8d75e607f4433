//! x
use std::time::Instant;
use stickslip_tip::memory::*;
use stickslip_tip::*;
fn main() {
    for b in [1.0, 0.0, 0.5, 0.9] {
        let tip = TipFunction::triple_gaussian(b, 1.0).unwrap();
        for k in 36..=54 {
            let w = 10f64.powf(-(k as f64) / 4.0);
            let s = Instant::now();
            match Fit::new(&tip, w) {
                Ok(f) => println!(
                    "b={b} want {w:.1e}: {} terms (pairs {}) slope {:.1e} maxw {:.1e} minre {:.2} {:.1}ms",
                    f.terms().len(),
                    f.terms().iter().filter(|t| t.exponent.im > 0.0).count(),
                    f.certificate().slope,
                    f.terms().iter().map(|t| t.weight.norm()).fold(0.0, f64::max),
                    f.terms().iter().map(|t| t.exponent.re).fold(-99.0, f64::max),
                    s.elapsed().as_secs_f64() * 1e3
                ),
                Err(e) => println!("{e}"),
            }
        }
    }
}
