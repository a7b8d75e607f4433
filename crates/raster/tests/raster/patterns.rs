//! What rasters write: a round Gaussian from below the threshold to lines that stay in their pit, and the triple Gaussian
//! under the depth limit of (61).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use stickslip_raster::{
    Doubt, LineRegime, Path, Pattern, Plan, Regime, Scanning, Written, line_regime, pattern,
};
use stickslip_stability::{Raster, RasterCritical, RasterPath};
use stickslip_tip::{Footprint, Model, TipFunction, Wider};

fn round() -> Footprint {
    Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap()
}

fn under(
    (footprint, wider): (Footprint, Wider),
    (alpha, r): (f64, f64),
    path: Path,
    (pitch, lines, length): (f64, usize, f64),
) -> (Written, Vec<LineRegime>) {
    let model = Model::under(wider, footprint.path().clone(), alpha, r).unwrap();
    let mut plan = Plan::new(footprint, model, path, pitch, lines, length);
    plan.law.tolerance = 1e-6;
    let mut scanning = Scanning::new(&plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    let lines = scanning.into_lines();
    let written = pattern(&plan, &lines);
    println!("α {alpha} r {r} pitch {pitch}: {written:?}");
    let each = lines.iter().map(|line| line_regime(&plan, line)).collect();
    (written, each)
}

fn written(alpha: f64, path: Path, pitch: f64) -> (Written, Vec<LineRegime>) {
    under((round(), Wider::default()), (alpha, 1.0), path, (pitch, 160, 100.0))
}

fn angle(found: &Pattern) -> (f64, f64) {
    (found.crest_angle.unwrap(), found.crest_angle_error.unwrap())
}

/// Of round tips a width apart at r = 1.
fn threshold(path: RasterPath) -> RasterCritical {
    let raster = Raster::new(&round(), Wider::default(), (1.0, 1.0), 1.0).unwrap();
    raster.critical(path).unwrap()
}

/// A little above the threshold the crests are those of linear theory, which knows nothing of runs.
#[test]
fn ripples_are_those_that_grow() {
    let critical = threshold(RasterPath::OneWay);
    let (found, lines) = written(1.1 * critical.alpha, Path::OneWay, 1.0);
    assert_eq!(found.regime, Regime::Ripples);
    let found = found.pattern.unwrap();
    assert!((angle(&found).0 - critical.crest_angle.unwrap()).abs() < 5.0);
    assert!((found.q.unwrap() / critical.q - 1.0).abs() < 0.15);
    // From line to line they move the way that theory has it.
    assert!(found.kappa.unwrap() * critical.kappa.unwrap() > 0.0);
    assert!(found.coherence > 0.99 && found.coherence_error.unwrap() < 0.01 && found.defects == 0);
    assert!(lines[100..].iter().all(|line| *line == LineRegime::StickSlip));
}

/// The angles of docs/findings/README.md of lines that go one way, in units of the threshold: with errors of some degrees, and none is
/// left out.
#[test]
fn clear_ripples_have_an_angle() {
    for (pitch, critical, over, expected) in [
        (0.5, 0.418_787, 1.05, 48.3),
        (0.5, 0.418_787, 1.1, 45.7),
        (0.5, 0.418_787, 1.2, 46.0),
        (1.0, 0.805_167, 1.05, 51.8),
        (1.0, 0.805_167, 1.1, 51.7),
        (1.0, 0.805_167, 1.2, 50.0),
        (1.0, 0.805_167, 1.3, 60.5),
    ] {
        let law = (over * critical, 1.0);
        let (found, _) = under((round(), Wider::default()), law, Path::OneWay, (pitch, 300, 100.0));
        assert_eq!(found.regime, Regime::Ripples, "{pitch} {over}");
        let found = found.pattern.unwrap();
        let (angle, error) = angle(&found);
        assert!((angle - expected).abs() < 1.0 && error < 8.0, "{pitch} {over}: {angle} ± {error}");
        assert!(error < 3.0 || over > 1.15 || pitch < 1.0, "{pitch} {over}: {error}");
    }
}

#[test]
fn what_is_no_ripple_is_called_otherwise() {
    let (found, lines) = written(0.2, Path::OneWay, 0.5);
    assert_eq!(found, Written { regime: Regime::Steady, pattern: None, doubts: vec![] });
    assert!(lines.iter().all(|line| *line == LineRegime::Steady));
    // A tip that carves nothing.
    let (found, _) = written(0.0, Path::OneWay, 0.5);
    assert_eq!(found, Written { regime: Regime::Steady, pattern: None, doubts: vec![] });
    let (found, _) = written(0.66, Path::OneWay, 0.5);
    assert_eq!(found.regime, Regime::Pits);
    let (found, lines) = written(0.9, Path::OneWay, 0.5);
    assert_eq!((found.regime, found.pattern), (Regime::StuckAtTheEdge, None));
    assert_eq!(lines[159], LineRegime::StuckAtTheEdge);
    // Pass after pass the pit at the beginning deepens.
    let (found, lines) = written(0.4, Path::Repeat, 0.0);
    assert_eq!((found.regime, found.pattern), (Regime::StuckAtTheEdge, None));
    assert_ne!(lines[0], LineRegime::StuckAtTheEdge);
}

/// What begins at the edge where lines begin, the same on all, is no ripple where it fades along them, and none where less than
/// two waves of it fit on them: at 15 % of the threshold, at r = 4, its wavelength was once that of the window.
#[test]
fn marks_of_the_edge_are_no_ripples() {
    let (found, _) = written(1.2, Path::OneWay, 2.0);
    assert_eq!((found.regime, found.pattern), (Regime::Steady, None));
    let fast = |length| {
        let law = (1.6, 4.0);
        under((round(), Wider::default()), law, Path::OneWay, (1.0, 96, length)).0
    };
    for length in [40.0, 60.0, 90.0] {
        let found = fast(length);
        assert_eq!((found.regime, found.pattern), (Regime::Steady, None), "{length}");
    }
    // The pit at the edge differs from line to line, and so do its marks: 8 % below the threshold.
    for lines in [128, 256] {
        let size = (0.6, lines, 80.0);
        let (found, _) = under((round(), Wider::default()), (0.46, 1.0), Path::OneWay, size);
        assert_eq!((found.regime, found.pattern), (Regime::Steady, None), "{lines}");
    }
}

/// With twice and four times the lines angle and wavelength stay within their errors, or are not told; the examples that did not.
#[test]
fn a_pattern_does_not_depend_on_how_many_lines_there_are() {
    let of =
        |lines| under((round(), Wider::default()), (0.5, 1.0), Path::OneWay, (0.5, lines, 60.0)).0;
    for lines in [64, 96, 128, 256] {
        let found = of(lines);
        assert_eq!(found.regime, Regime::Ripples, "{lines}");
        if let Some(angle) = found.pattern.unwrap().crest_angle {
            assert!((angle - 46.0).abs() < 2.0, "{lines}: {angle}");
        } else {
            // Columns as strong as ripples stand at 90°.
            let is_rivals =
                |doubt: &Doubt| matches!(doubt, Doubt::Rivals(waves) if waves.len() > 1);
            assert!(found.doubts.iter().any(is_rivals), "{found:?}");
        }
    }
    // Half of the first lines stay in the pit: said, and no pattern made of it.
    let wider = Wider { inertia: Some(1.0), ..Wider::default() };
    let (found, _) = under((round(), wider), (4.62, 4.0), Path::OneWay, (0.5, 96, 60.0));
    assert_eq!(found.pattern, None);
    assert!(matches!(found.doubts[0], Doubt::Stuck { lines: 46, of: 96 }), "{found:?}");
    // Ripples that fade from line to line on a tip without volume are no pits.
    let tip = Footprint::separable(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.0).unwrap();
    let wider = Wider { depth_limit: Some(3.0), ..Wider::default() };
    let (found, _) = under((tip, wider), (0.5, 1.0), Path::OneWay, (1.0, 128, 80.0));
    assert_ne!(found.regime, Regime::Pits);
    assert!(found.doubts.iter().any(|doubt| matches!(doubt, Doubt::Changing(_))), "{found:?}");
}

/// An upright wave with 2.6 times the power of one of lines in antiphase, whose slopes are the steeper ones: the angle of
/// neither is reported.
#[test]
fn waves_that_compete_have_no_angle() {
    let wider = Wider { inertia: Some(1.0), ..Wider::default() };
    let (found, _) = under((round(), wider), (0.546, 0.25), Path::Zigzag, (2.0, 96, 80.0));
    assert_eq!(found.regime, Regime::Ripples);
    assert!(found.pattern.unwrap().crest_angle.is_none(), "{found:?}");
}

/// Zigzag lines are ordered too: each follows the one two before, and is shifted against its neighbours by about the phase of
/// linear theory, so that crests stand upright and neighbours differ by its cosine.
#[test]
fn a_zigzag_is_ordered_among_lines_that_go_the_same_way() {
    let critical = threshold(RasterPath::Zigzag);
    let (found, _) = written(1.05 * critical.alpha, Path::Zigzag, 1.0);
    assert_eq!(found.regime, Regime::Ripples);
    let found = found.pattern.unwrap();
    assert!(found.coherence_same_way.unwrap() > 0.99 && angle(&found).0 > 88.0);
    assert!((found.coherence - critical.phase_per_line.cos().abs()).abs() < 0.15);
    assert!(found.q.is_none_or(|q| (q / critical.q - 1.0).abs() < 0.1));
    let one_way = written(0.9, Path::OneWay, 1.0).0.pattern.unwrap();
    assert_eq!(one_way.coherence_same_way, None);
}

/// β = 1, α = 1.5, r = 1, b = 3: the angles of an independent prototype. At a pitch of 0.25 columns are five times as strong as
/// oblique crests, which have the steeper slopes: no angle.
#[test]
fn crests_under_a_depth_limit_stand_as_the_prototype_has_them() {
    for (pitch, lines, expected) in
        [(0.25, 200, None), (0.5, 200, Some(33.8)), (1.0, 128, Some(38.0)), (1.5, 128, Some(41.7))]
    {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let footprint = Footprint::separable(tip, 1.0).unwrap();
        let wider = Wider { depth_limit: Some(3.0), ..Wider::default() };
        let size = (pitch, lines, 100.0);
        let (found, _) = under((footprint, wider), (1.5, 1.0), Path::OneWay, size);
        let found = found.pattern.unwrap();
        match expected {
            Some(expected) => {
                let (angle, error) = angle(&found);
                assert!((angle - expected).abs() < 2.0 && error < 6.0, "{pitch}: {found:?}");
            }
            None => assert!(found.crest_angle.is_none(), "{found:?}"),
        }
    }
}
