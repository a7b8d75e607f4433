//! Are the bits of a run those of every machine? They are pinned here, from an x86-64 with AVX2, so that a processor or a
//! library that would change them shows; where the integrator itself changes, so do the pins, by what the test prints.
//! `make survive` compares whole documents with those of an older processor, `make test-site` with those of a browser.

use stickslip_tip::planar::{self, PlanarScenario};
use stickslip_tip::{Footprint, MemoryChoice, Model, Run, Scenario, TipFunction, Wider, run};

/// FNV-1a of the numbers of all steps.
fn fingerprint(run: &Run) -> u64 {
    of_numbers(run.trajectory.steps().iter().flat_map(|step| step.numbers()))
}

fn of_numbers(numbers: impl Iterator<Item = f64>) -> u64 {
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

/// Layers across are in wider vectors than all else.
#[test]
fn so_are_those_of_a_run_across_the_scan() {
    let fingerprint = |memory| {
        let along = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let tip = TipFunction::of_footprint(Footprint::separable(along, 0.8).unwrap());
        let model = Model::new(tip, 1.4, 1.0).unwrap();
        let along = Scenario { kick: 0.1, memory, tolerance: 1e-8, ..Scenario::new(model, 60.0) };
        let scenario = PlanarScenario { kick_across: 0.2, ..PlanarScenario::new(along, 0.3) };
        let run = planar::run(&scenario).unwrap();
        assert!(memory == MemoryChoice::Direct || run.layers.changes > 1, "{:?}", run.layers);
        let numbers = |step: &planar::Step| {
            step.along.numbers().into_iter().chain([step.y]).chain(step.across)
        };
        format!("{:#x}", of_numbers(run.trajectory.steps().iter().flat_map(numbers)))
    };
    let memories = [MemoryChoice::Modes, MemoryChoice::Direct];
    assert_eq!(memories.map(fingerprint), ACROSS.map(|bits| format!("{bits:#x}")));
}

const ACROSS: [u64; 2] = [0xdf74_c096_9c97_2b69, 0x8a06_b63c_1c22_71da];
const PLAIN: u64 = 0xb988_d409_2c6a_7e55;
const DIRECT: u64 = 0x2f45_ae7b_8c8f_9319;
const UNDER_WIDER_LAW: u64 = 0x10a0_dda7_d4b9_e848;
