//! What rasters write: a round Gaussian from below the threshold to lines that stay in their pit, and the triple Gaussian
//! under the depth limit of (61).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use stickslip_raster::{LineRegime, Path, Pattern, Plan, Regime, Scanning, line_regime, pattern};
use stickslip_stability::{Raster, RasterPath};
use stickslip_tip::{Footprint, Model, TipFunction, Wider};

fn round() -> Footprint {
    Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap()
}

fn written(alpha: f64, path: Path, pitch: f64) -> (Regime, Option<Pattern>, Vec<LineRegime>) {
    let model = Model::new(round().path().clone(), alpha, 1.0).unwrap();
    let mut plan = Plan::new(round(), model, path, pitch, 160, 100.0);
    plan.law.tolerance = 1e-6;
    let mut scanning = Scanning::new(&plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    let lines = scanning.into_lines();
    let (regime, found) = pattern(&plan, &lines);
    let each = lines.iter().map(|line| line_regime(&plan, line)).collect();
    (regime, found, each)
}

/// A little above the threshold the crests are those of linear theory, which knows nothing of runs.
#[test]
fn ripples_are_those_that_grow() {
    let critical = Raster::new(&round(), Wider::default(), (1.0, 1.0), 1.0)
        .unwrap()
        .critical(RasterPath::OneWay)
        .unwrap();
    let (regime, found, lines) = written(1.1 * critical.alpha, Path::OneWay, 1.0);
    let found = found.unwrap();
    println!("{regime:?} {found:?}");
    assert_eq!(regime, Regime::Ripples);
    assert!((found.crest_angle - critical.crest_angle.unwrap()).abs() < 5.0);
    assert!((found.q / critical.q - 1.0).abs() < 0.15);
    // From line to line they move the way that theory has it.
    assert!(found.kappa * critical.kappa.unwrap() > 0.0);
    assert!(found.coherence > 0.99 && found.defects == 0);
    assert!(lines[100..].iter().all(|line| *line == LineRegime::StickSlip));
}

#[test]
fn what_is_no_ripple_is_called_otherwise() {
    let (regime, found, lines) = written(0.2, Path::OneWay, 0.5);
    assert_eq!((regime, found), (Regime::Steady, None));
    assert!(lines.iter().all(|line| *line == LineRegime::Steady));
    // What the beginning of each line leaves, the same on all, fades along them.
    let (regime, found, _) = written(1.2, Path::OneWay, 2.0);
    assert_eq!((regime, found), (Regime::Steady, None));
    let (regime, found, _) = written(0.58, Path::OneWay, 0.5);
    assert_eq!(regime, Regime::Pits, "{found:?}");
    let (regime, found, lines) = written(0.9, Path::OneWay, 0.5);
    assert_eq!((regime, found), (Regime::StuckAtTheEdge, None));
    assert_eq!(lines[159], LineRegime::StuckAtTheEdge);
    // Pass after pass the pit at the beginning deepens.
    let (regime, found, lines) = written(0.4, Path::Repeat, 0.0);
    assert_eq!((regime, found), (Regime::StuckAtTheEdge, None));
    assert_ne!(lines[0], LineRegime::StuckAtTheEdge);
}

/// Zigzag lines are ordered too: each follows the one two before, and is shifted against its neighbours by about the phase of
/// linear theory, so that crests stand upright and neighbours differ by its cosine.
#[test]
fn a_zigzag_is_ordered_among_lines_that_go_the_same_way() {
    let critical = Raster::new(&round(), Wider::default(), (1.0, 1.0), 1.0)
        .unwrap()
        .critical(RasterPath::Zigzag)
        .unwrap();
    let (regime, found, _) = written(1.05 * critical.alpha, Path::Zigzag, 1.0);
    let found = found.unwrap();
    println!("{regime:?} {found:?}");
    assert_eq!(regime, Regime::Ripples);
    assert!(found.coherence_same_way.unwrap() > 0.99 && found.crest_angle > 88.0);
    assert!((found.coherence - critical.phase_per_line.cos().abs()).abs() < 0.15);
    assert!((found.q / critical.q - 1.0).abs() < 0.1);
    assert_eq!(written(0.9, Path::OneWay, 1.0).1.unwrap().coherence_same_way, None);
}

/// β = 1, α = 1.5, r = 1, b = 3: the angles of an independent prototype.
#[test]
fn crests_under_a_depth_limit_stand_as_the_prototype_has_them() {
    for (pitch, lines, angle) in
        [(0.25, 200, 28.7), (0.5, 200, 33.8), (1.0, 128, 38.0), (1.5, 128, 41.7)]
    {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let footprint = Footprint::separable(tip.clone(), 1.0).unwrap();
        let wider = Wider { depth_limit: Some(3.0), ..Wider::default() };
        let model = Model::under(wider, tip, 1.5, 1.0).unwrap();
        let mut plan = Plan::new(footprint, model, Path::OneWay, pitch, lines, 100.0);
        plan.law.tolerance = 1e-6;
        let mut scanning = Scanning::new(&plan).unwrap();
        while scanning.next_line().unwrap().is_some() {}
        let found = pattern(&plan, scanning.lines()).1.unwrap();
        println!("{pitch}: {:.1} for {angle}", found.crest_angle);
        assert!((found.crest_angle - angle).abs() < 2.0, "{pitch}: {found:?}");
    }
}
