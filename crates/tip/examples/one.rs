//! x
use stickslip_tip::cycle::*;
use stickslip_tip::*;
fn main() {
    let v: Vec<f64> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let m = Model::new(TipFunction::triple_gaussian(v[0], 1.0).unwrap(), v[1], v[2]).unwrap();
    match cycle(&m, 1e-9) {
        Ok(c) => println!("{c:?} res {} steps {}", c.residual(), c.steps()),
        Err(e) => println!("{e}"),
    }
}
