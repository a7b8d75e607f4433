//! Are the bits of a run those of every machine? They are pinned here, from an x86-64 with AVX2, so that a processor or a
//! library that would change them shows; where the integrator itself changes, so do the pins, by what the test prints.
//! `make survive` compares whole documents with those of an older processor, `make test-site` with those of a browser.

use stickslip_tip::{MemoryChoice, Model, Run, Scenario, TipFunction, Wider, run};

/// FNV-1a of the numbers of all steps.
fn fingerprint(run: &Run) -> u64 {
    let numbers = run.trajectory.steps().iter().flat_map(|step| step.numbers());
    let bytes = numbers.flat_map(|number| number.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[test]
fn the_bits_of_a_run_are_those_of_every_machine() {
    let wider = Wider { depth_limit: Some(5.0), healing_time: Some(9.0), ..Wider::default() };
    let cases = [
        (Wider::default(), MemoryChoice::Modes, 1e-9, PLAIN),
        (Wider::default(), MemoryChoice::Direct, 1e-6, DIRECT),
        (wider, MemoryChoice::Modes, 1e-6, UNDER_WIDER_LAW),
    ];
    let told = cases.map(|(wider, memory, tolerance, _)| {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let model = Model::under(wider, tip, 1.9, 1.0).unwrap();
        let scenario = Scenario { kick: 0.1, memory, tolerance, ..Scenario::new(model, 40.0) };
        fingerprint(&run(&scenario).unwrap())
    });
    assert_eq!(told.map(|bits| format!("{bits:#x}")), cases.map(|case| format!("{:#x}", case.3)));
}

const PLAIN: u64 = 0xd78d_97db_a148_17f9;
const DIRECT: u64 = 0x2f45_ae7b_8c8f_9319;
const UNDER_WIDER_LAW: u64 = 0x777e_59dc_867b_c51a;
