//! Patterns of rasters of a tip that is free to move across the lines, against figures of a prototype that shares no code with
//! this project (exponentials by Hermite-Gauss layers, direct sums and a grid agree on them).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use super::lines::{footprint, scanned};
use stickslip_raster::{Free, Path, Pattern, Plan, Regime, Written, pattern};
use stickslip_tip::{Model, Wider};

fn written(
    (beta, alpha): (f64, f64),
    wider: Wider,
    stiffness: Option<f64>,
    path: Path,
    size: (f64, usize, f64),
) -> (Written, Pattern) {
    let footprint = footprint(beta, 1.0).0;
    let model = Model::under(wider, footprint.path().clone(), alpha, 1.0).unwrap();
    let plan = Plan::new(footprint, model, path, size.0, size.1, size.2);
    let mut plan = match stiffness {
        Some(stiffness) => plan.with_free(Free::new(stiffness)),
        None => plan,
    };
    plan.law.tolerance = 1e-5;
    let written = pattern(&plan, &scanned(&plan));
    println!("{written:?}");
    let pattern = written.pattern.unwrap();
    (written, pattern)
}

/// κ_y = 1 and a pitch of 2: every second line falls into the trench of the one before.
#[test]
fn lines_far_apart_bunch_in_pairs() {
    let size = (2.0, 40, 40.0);
    let (found, pairs) = written((0.0, 1.0), Wider::default(), Some(1.0), Path::OneWay, size);
    assert_eq!(found.regime, Regime::Bunched);
    let (length, error) = (pairs.wavelength.unwrap(), pairs.wavelength_error.unwrap());
    assert!((length - 4.0).abs() < error && error < 0.5, "{length} {error}");
    assert!(pairs.crest_angle.unwrap() < 0.1 && pairs.crest_angle_error.unwrap() < 8.0);
    assert!(pairs.coherence > 0.999);
}

/// On a zigzag trenches are straight, 6 to 6.4 σ apart.
#[test]
fn zigzag_lines_make_straight_trenches() {
    let size = (1.0, 70, 40.0);
    let (found, trenches) = written((0.0, 0.5), Wider::default(), Some(1.0), Path::Zigzag, size);
    assert_eq!(found.regime, Regime::Bunched);
    let (length, error) = (trenches.wavelength.unwrap(), trenches.wavelength_error.unwrap());
    assert!(length + error > 6.0 && length - error < 6.4 && error < 0.8, "{length} {error}");
    assert!(trenches.crest_angle.unwrap() < trenches.crest_angle_error.unwrap());
}

/// β = 1, α = 1.5, b = 3, pitch 1: crests at 38.8°, 35.9° and 35.1° for κ_y = ∞, 10 and 3, within 2°.
#[test]
fn crests_under_a_depth_limit_stand_at_the_angles_of_the_prototype() {
    let limited = Wider { depth_limit: Some(3.0), ..Wider::default() };
    for (stiffness, angle) in [(None, 38.8), (Some(10.0), 35.9), (Some(3.0), 35.1)] {
        let size = (1.0, 72, 64.0);
        let (found, ripples) = written((1.0, 1.5), limited, stiffness, Path::OneWay, size);
        assert_eq!(found.regime, Regime::Ripples);
        let found = ripples.crest_angle.unwrap();
        assert!((found - angle).abs() < 2.0, "{stiffness:?}: {found} for {angle}");
    }
}
