//! x
use stickslip_tip::stability::*;
use stickslip_tip::*;
fn main() {
    for b in [-2.0, -1.0, -0.5, 0.0, 0.3, 0.5, 0.7, 0.9, 1.0, 1.2, 1.5, 2.0, 3.0] {
        print!("b={b}: ");
        for r in [0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0] {
            match TipFunction::triple_gaussian(b, 1.0)
                .map_err(|_| ())
                .and_then(|t| onset(&t, r).map_err(|_| ()))
            {
                Ok(o) => print!("{r}:{:.3} ", o.amplitude_squared_slope),
                Err(_) => print!("{r}:- "),
            }
        }
        println!();
    }
    for f in std::env::args().skip(1) {
        let v: Vec<f64> = f.split(',').map(|x| x.parse().unwrap()).collect();
        let g: Vec<Gaussian> =
            v.chunks(3).map(|c| Gaussian { amplitude: c[0], center: c[1], width: c[2] }).collect();
        print!("{f}: ");
        let t = TipFunction::gaussian_sum(g).unwrap();
        for r in [0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0] {
            match onset(&t, r) {
                Ok(o) => print!("{r}:{:.3} ", o.amplitude_squared_slope),
                Err(_) => print!("{r}:- "),
            }
        }
        println!();
    }
}
