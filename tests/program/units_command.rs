//! `units`, judged by the definitions (12), (13) and (23) worked out by hand.

use super::stability_commands::{close, document, triple};
use stickslip_stability::critical;
use stickslip_tip::Wider;

pub(super) const GIVEN: &str =
    "--damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN";

#[test]
fn units_go_there_and_back() {
    let there = document(&format!("units {GIVEN} --indentation-rate 240nm/s --velocity 1um/s"));
    // (12), (13) and (23) by hand: Γv0/(kσ) = 1e-9/1e-9, ΓNa/(σ²k²) = 1.2e-18/1e-18.
    close(&there["r"], 1.0, 1e-14);
    close(&there["alpha"], 1.2, 1e-14);
    close(&there["lag"]["metres"], 20e-9 * (1.0 + 1.2 * triple().value(0.0)), 1e-14);
    close(&there["scales"]["time"], 0.02, 1e-14);
    let at = critical(&Wider::default(), &triple(), 1.0).unwrap();
    close(&there["critical"]["indentation_rate"], 200e-9 * at.alpha, 1e-13);
    close(&there["critical"]["period"], 0.02 * at.period, 1e-13);
    assert_eq!(there["stable"], false);

    let back = document(&format!("units {GIVEN} --alpha 1.2 --r 1"));
    close(&back["physical"]["indentation_rate"], 240e-9, 1e-13);
    close(&back["physical"]["velocity"], 1e-6, 1e-13);
    assert!(back["parameters"]["velocity"].is_null());
    // The critical velocity, put in, is critical.
    let velocity = there["critical"]["velocity"].as_f64().unwrap();
    let slow = document(&format!("units {GIVEN} --N 240nm/s --v0 {velocity:e}m/s"));
    close(
        &slow["alpha"],
        critical(&Wider::default(), &triple(), slow["r"].as_f64().unwrap()).unwrap().alpha,
        1e-11,
    );
    // Short names are the same, and one number may stand for one quantity.
    let short =
        "units --gamma 1e-3kg/s --k 0.05N/m --sigma 2e-8m --a 5e-9N --v0 1e-6m/s --alpha 1.2";
    close(&document(short)["physical"]["indentation_rate"], 240e-9, 1e-13);
}
