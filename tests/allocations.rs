//! Does a step of the modes memory allocate? Judged by an allocator that counts for the thread that runs the
//! test. The control: a direct sum, whose nodes grow in number as the tip goes on, is seen to allocate.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use allocation_counter::measure;
use stickslip_tip::{MemoryChoice, Model, Running, Scenario, TipFunction};

/// Steps before those that are counted, and these. Nodes are dropped or gathered into bins every 6,000 steps: both spans hold
/// several such times. Room for bins is taken once, when nodes are first gathered.
const SPANS: (usize, usize) = (20_000, 40_000);

/// Allocations in the steps after the warm-up.
fn allocations(
    memory: MemoryChoice,
    (alpha, until): (f64, f64),
    (warm_up, counted): (usize, usize),
) -> u64 {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let model = Model::new(tip, alpha, 1.0).unwrap();
    let scenario = Scenario { kick: 0.05, memory, ..Scenario::new(model, until) };
    let surface = scenario.initial_surface().unwrap();
    let mut running = Running::new(&scenario, &surface).unwrap();
    let mut steps = |count: usize| (0..count).filter(|_| running.step().unwrap().is_some()).count();
    assert_eq!(steps(warm_up), warm_up);
    let mut made = 0;
    let allocated = measure(|| made = steps(counted));
    assert_eq!(made, counted, "the run is long enough");
    allocated.count_total
}

#[test]
fn no_step_with_modes_allocates() {
    assert_eq!(allocations(MemoryChoice::Modes, (1.2, 1e5), SPANS), 0);
    assert_eq!(allocations(MemoryChoice::Modes, (1.62, 1e5), SPANS), 0);
}

#[test]
fn the_counter_does_count() {
    // A tenth as many steps are enough to see it, of which each looks at all nodes within reach.
    let made = allocations(MemoryChoice::Direct, (1.2, 1e5), (600, 2_000));
    println!("{made} allocations");
    assert!(made > 0);
}
