//! A sweep asked from Rust: each point is what the question about it alone answers.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use stickslip::{
    Ask, Context, Cycle, Failure, Indentation, RegimeName, Run, SourceName, Sweep, SweepPoint, Tip,
    each_point,
};

/// β = 1 at r = 1: αc = 1.0662.
fn sweep() -> Sweep {
    Sweep {
        tips: vec![Tip::default()],
        r: vec![1.0],
        alpha: Some(vec![0.5, 1.2, 1.5]),
        tolerance: 1e-9,
        ..Sweep::default()
    }
}

#[test]
fn points_of_a_sweep_are_the_cycles_of_their_own_questions() {
    let found = sweep().grid().unwrap().ask(&Context::default()).unwrap();
    assert_eq!(found.points.at(0).regime, Some(RegimeName::Steady));
    for (point, alpha) in found.points.iter().skip(1).zip([1.2, 1.5]) {
        let cycle = Cycle::new(Tip::default(), Indentation::given(alpha), 1.0);
        let cycle = cycle.ask(&Context::default()).unwrap();
        assert_eq!(point.source, Some(SourceName::Cycle));
        let difference = (point.period.unwrap() - cycle.period).abs();
        assert!(difference < 1e-8, "{alpha}: {difference:e}");
    }
}

#[test]
fn points_that_are_runs_end_as_those_runs_and_make_ensembles() {
    let seeds: Vec<f64> = (1..=3).map(f64::from).collect();
    let question = Sweep {
        alpha: Some(vec![1.2]),
        until: Some(80.0),
        noise: vec![1e-3],
        seed: seeds,
        ..sweep()
    };
    let found = question.grid().unwrap().ask(&Context::default()).unwrap();
    let ensembles = found.ensembles.as_ref().unwrap();
    assert_eq!((ensembles.len(), ensembles[0].count), (1, 3));
    let noise = stickslip::Noise { amplitude: 1e-3, spacing: 0.1, seed: 2 };
    let run = Run {
        noise: Some(noise),
        tolerance: 1e-9,
        ..Run::new(Tip::default(), Indentation::given(1.2), 1.0, 80.0)
    };
    let run = run.ask(&Context::default()).unwrap();
    let period = run.oscillation.as_ref().map(|found| found.period);
    assert_eq!(found.points.at(1).regime, Some(run.regime));
    assert_eq!(found.points.at(1).period.map(f64::to_bits), period.map(f64::to_bits));
}

/// Cancelled after its first point, a sweep keeps that point and computes no others.
#[test]
fn a_cancelled_sweep_ends() {
    let grid = Sweep { alpha: Some(vec![0.1; 100]), ..sweep() }.grid().unwrap();
    let flag = Arc::new(AtomicBool::new(false));
    let kept = AtomicUsize::new(0);
    let context = Context::cancelled_by(Arc::clone(&flag));
    let indices: Vec<usize> = (0..100).collect();
    let ended = each_point(&grid, &indices, 1, &context, |_| {
        kept.fetch_add(1, Ordering::Relaxed);
        flag.store(true, Ordering::Relaxed);
        true
    });
    assert_eq!(ended, Err(Failure::Cancelled));
    assert_eq!(kept.load(Ordering::Relaxed), 1);
}

#[test]
fn a_sweep_without_a_meaning_is_rejected_by_name() {
    let refused = |question: Sweep| match question.grid() {
        Err(Failure::Refused(refused)) => refused.parameter.into_owned(),
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(Sweep { r: vec![], ..sweep() }), "r");
    assert_eq!(refused(Sweep { r: vec![1.0, -1.0], ..sweep() }), "r");
    assert_eq!(refused(Sweep { alpha: None, ..sweep() }), "alpha");
    assert_eq!(
        refused(Sweep { seed: vec![1.5], noise: vec![1e-3], until: Some(9.0), ..sweep() }),
        "seed"
    );
    assert_eq!(refused(Sweep { kick: vec![0.1], ..sweep() }), "kick");
    assert_eq!(refused(Sweep { tolerance: 1.0, ..sweep() }), "tolerance");
    assert_eq!(refused(Sweep { depth_limit: vec![3.0, -1.0], ..sweep() }), "depth_limit");
}

/// A point with numbers, further axes and lengths, and one with an error.
fn points() -> [SweepPoint; 2] {
    let settled = SweepPoint {
        at: vec![0.1, -3.0],
        critical_alpha: Some(1.069_036_174_947_265),
        regime: Some(RegimeName::StickSlip),
        source: Some(SourceName::Cycle),
        period: Some(7.25),
        slips: Some(2),
        multiplier: Some(f64::MIN_POSITIVE),
        ..SweepPoint::at(70_000, Some(0.5), 1.0, Some(1.2))
    };
    let failed = SweepPoint {
        error: Some("no αc at r = 1e-9".into()),
        ..SweepPoint::at(3, None, 1e-9, None)
    };
    [settled, failed]
}

#[test]
fn a_point_is_what_its_text_says() {
    for point in points() {
        assert_eq!(SweepPoint::from_text(&point.to_text()), Some(point));
    }
}

/// No text makes it panic.
#[test]
fn a_text_that_was_cut_or_changed_is_that_of_no_point() {
    for text in points().map(|point| point.to_text()) {
        for end in 0..text.len() {
            assert_eq!(SweepPoint::from_text(&text[..end]), None, "{end} of {text}");
        }
        for at in 0..text.len() {
            let mut changed = text.clone().into_bytes();
            changed[at] = b'/';
            // It may be that of another point.
            SweepPoint::from_text(str::from_utf8(&changed).unwrap());
        }
    }
}
