//! Linear theory under the wider law.

use stickslip_stability::critical_under;
use stickslip_tip::{TipFunction, Wider};

fn triple(beta: f64) -> TipFunction {
    TipFunction::triple_gaussian(beta, 1.0).expect("a valid tip")
}

fn limited(b: f64) -> Wider {
    Wider { depth_limit: Some(b), ..Wider::default() }
}

fn healing(time: f64) -> Wider {
    Wider { healing_time: Some(time), ..Wider::default() }
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
        assert!((found.critical.alpha - alpha).abs() < 1e-6, "{found:?} {alpha}");
    }
}
