//! Does a step of the modes memory allocate? Judged by an allocator that counts for the thread that runs the
//! test. The control: a direct sum, whose nodes grow in number as the tip goes on, is seen to allocate.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use allocation_counter::measure;
use stickslip_tip::{MemoryChoice, Model, Running, Scenario, TipFunction};

/// Nodes are gathered into bins every 2,700 steps: both spans hold several such times.
const WARM_UP: usize = 6_000;
const COUNTED: usize = 20_000;

/// Allocations in the steps after the warm-up.
fn allocations(memory: MemoryChoice, alpha: f64, until: f64) -> u64 {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let model = Model::new(tip, alpha, 1.0).unwrap();
    let scenario = Scenario { kick: 0.05, memory, ..Scenario::new(model, until) };
    let surface = scenario.initial_surface().unwrap();
    let mut running = Running::new(&scenario, &surface).unwrap();
    let mut steps = |count: usize| (0..count).filter(|_| running.step().unwrap().is_some()).count();
    assert_eq!(steps(WARM_UP), WARM_UP);
    let mut made = 0;
    let counted = measure(|| made = steps(COUNTED));
    assert_eq!(made, COUNTED, "the run is long enough");
    counted.count_total
}

#[test]
fn no_step_with_modes_allocates() {
    assert_eq!(allocations(MemoryChoice::Modes, 1.2, 1e5), 0);
    assert_eq!(allocations(MemoryChoice::Modes, 1.62, 1e5), 0);
}

#[test]
fn the_counter_does_count() {
    assert!(allocations(MemoryChoice::Direct, 1.2, 1e5) > 0);
}
