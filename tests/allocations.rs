//! Does a step of the modes memory allocate, and how much does a map keep of a point? Judged by an allocator that counts
//! for the thread that runs the test. The control: a direct sum, whose nodes grow in number as the tip goes on, is seen to
//! allocate.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use allocation_counter::measure;
use stickslip::{
    Document, RegimeName, SourceName, SweepFound, SweepParameters, SweepPoint, SweepPoints,
    arrays_in_units,
};
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

/// A point with a value in each field.
fn full(index: usize) -> SweepPoint {
    let number = |i: u32| Some((f64::from(i) + 0.1).sqrt());
    SweepPoint {
        index,
        width: number(1),
        beta: number(2),
        r: 0.1,
        alpha: number(3),
        at: vec![0.3, -0.0],
        critical_alpha: number(4),
        regime: Some(RegimeName::Snaking),
        source: Some(SourceName::Run),
        period: number(5),
        period_error: number(6),
        wavelength: number(7),
        wavelength_error: number(8),
        amplitude_x0: number(9),
        amplitude_x0_error: number(10),
        amplitude_u: number(11),
        amplitude_u_error: number(12),
        mean_l: number(13),
        deviation_l: number(14),
        slip_distance: number(16),
        slip_distance_error: number(17),
        slips: Some(3),
        multiplier: number(15),
        error: Some("α is none".into()),
    }
}

/// Compared as JSON too, which names every field: with all of them, without any one, with none.
#[test]
fn packed_points_are_unpacked_as_they_were() {
    let value = serde_json::to_value(full(7)).unwrap();
    let each = value.as_object().unwrap();
    let without = |name: &String| {
        let mut less = each.clone();
        less.remove(name);
        serde_json::from_value::<SweepPoint>(less.into()).unwrap()
    };
    let optional = each.keys().filter(|name| !["index", "r"].contains(&name.as_str()));
    let mut points: Vec<SweepPoint> = optional.map(without).collect();
    assert_eq!(points.len(), 22);
    points.extend([full(2), SweepPoint::at(1, None, 1.0, None)]);
    for regime in ["steady", "stick-slip", "trapped", "drifting", "snaking", "transient"] {
        let regime = serde_json::from_value(regime.into()).unwrap();
        points.push(SweepPoint { regime, ..full(3) });
    }
    for source in ["stability", "cycle", "run"] {
        let source = serde_json::from_value(source.into()).unwrap();
        points.push(SweepPoint { source, ..full(4) });
    }
    // Far longer than a piece of the list.
    points.push(SweepPoint { error: Some("why ".repeat(1 << 19)), ..full(5) });
    let mut packed: SweepPoints = points.iter().cloned().collect();
    assert!(packed.iter().eq(points.iter().cloned()));
    let text = serde_json::to_string(&points).unwrap();
    assert_eq!(serde_json::to_string(&packed).unwrap(), text);
    let read: SweepPoints = serde_json::from_str(&text).unwrap();
    assert!(read.iter().eq(points.iter().cloned()));
    packed.sort();
    points.sort_by_key(|point| point.index);
    let order: Vec<usize> = points.iter().map(|point| point.index).collect();
    assert!(packed.indices().eq(order));
    assert_eq!(packed.iter().last(), points.pop());
}

/// A million points fit in 150 MB, cycles everywhere, while they come and while their arrays are written. The control: a
/// list of points takes more than twice as much.
#[test]
fn a_point_of_a_map_takes_at_most_140_bytes() {
    const COUNT: usize = 100_000;
    let cycle = |index| SweepPoint {
        at: vec![],
        error: None,
        width: None,
        mean_l: None,
        deviation_l: None,
        slip_distance: None,
        slip_distance_error: None,
        ..full(index)
    };
    let (parameters, mut rows) = (parameters(COUNT), 0);
    let packed = measure(|| {
        let mut points = SweepPoints::default();
        // As threads finish them.
        (0..COUNT).for_each(|n| points.push(cycle(n ^ 1)));
        points.sort();
        let found = SweepFound { points, ensembles: None, arithmetic: None, crc32: None };
        let document: Document<SweepParameters> = Document::new(parameters, found, vec![]);
        rows = arrays_in_units(&document).map(|(_, array)| array.values.len()).sum();
    });
    assert_eq!(rows, 11 * COUNT);
    let bytes = packed.bytes_max / COUNT as u64;
    println!("{bytes} bytes a point");
    assert!(bytes <= 140, "{bytes}");
    let listed = measure(|| drop((0..COUNT).map(cycle).collect::<Vec<_>>()));
    assert!(listed.bytes_max / COUNT as u64 > 300);
}

fn parameters(count: usize) -> SweepParameters {
    let text = r#"{"tips": [], "r": [1.0], "alpha": [], "beta": null, "alpha_above": null, "tolerance": 1e-9, "shard": null}"#;
    SweepParameters { alpha: Some(vec![1.2; count]), ..serde_json::from_str(text).unwrap() }
}
