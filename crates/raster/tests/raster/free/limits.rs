//! Stiff springs, interrupted rasters, tips far off their lines, and refusals.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use super::lines::{footprint, scanned};
use stickslip_raster::{Area, Free, Line, Path, Plan, RasterError, Scanned, Scanning, volume};
use stickslip_tip::Model;
use stickslip_tip::planar::PlanarError;

fn plan(stiffness: f64, path: Path) -> Plan {
    let (footprint, _) = footprint(0.0, 1.0);
    let model = Model::new(footprint.path().clone(), 0.5, 1.0).unwrap();
    Plan::new(footprint, model, path, 0.5, 6, 14.0).with_free(Free::new(stiffness))
}

/// The rasters of a tip that is held on its lines are the limit of stiff springs, at first order in 1/κ_y.
#[test]
fn stiff_springs_hold_the_tip_at_first_order() {
    for path in [Path::OneWay, Path::Zigzag] {
        let held = scanned(&Plan { free: None, ..plan(1.0, path) });
        let apart = |stiffness: f64| {
            let lines = scanned(&plan(stiffness, path));
            let of = |(a, b): (&Line, &Line)| {
                let at = (0..70).map(|i| 0.2 * f64::from(i));
                at.map(|t| (a.x0(t) - b.x0(t)).abs()).fold(0.0, f64::max)
            };
            lines.iter().zip(&held).map(of).fold(0.0, f64::max)
        };
        let apart = [250.0, 500.0, 1000.0].map(apart);
        let orders = [apart[0] / apart[1], apart[1] / apart[2]].map(f64::log2);
        println!("{path:?}: {apart:?}, {orders:?}");
        assert!(apart[2] < 1e-2 && apart[2] > 1e-7, "{apart:?}");
        assert!((orders[1] - 1.0).abs() < 0.03, "{orders:?}");
        assert!((orders[1] - 1.0).abs() < (orders[0] - 1.0).abs(), "{orders:?}");
    }
}

/// Resumed after any line, all later lines are the same to the last bit.
#[test]
fn a_free_raster_that_is_resumed_is_the_same() {
    for path in [Path::OneWay, Path::Zigzag, Path::Repeat] {
        let plan = plan(0.8, path);
        let whole = scanned(&plan);
        for n in [0, 1, 3, 6] {
            let mut again = Scanning::resumed(&plan, whole[..n].to_vec()).unwrap();
            while again.next_line().unwrap().is_some() {}
            for (a, b) in again.lines().iter().zip(&whole) {
                assert!(a.planar_steps().eq(b.planar_steps()), "{path:?} {n}");
            }
        }
    }
}

/// A tip so far off its line that the surface is needed farther away than at first prepared: the lines do not depend on the
/// distance that is prepared, whether it grows on the way or is there from the start.
#[test]
fn a_tip_far_off_its_line_is_followed() {
    let far = Free { kick: 12.0, ..Free::new(0.04) };
    let plan = plan(1.0, Path::Zigzag).with_free(far);
    let lines = scanned(&plan);
    let off = |line: &Line| line.y0(0.0) - line.track().y;
    assert!(off(&lines[1]) > 5.0 && off(&lines[3]) > 2.0, "{}", off(&lines[1]));
    // The last line by itself begins with all rows of the first five.
    let mut again = Scanning::resumed(&plan, lines[..5].to_vec()).unwrap();
    again.next_line().unwrap().unwrap();
    assert!(again.lines()[5].planar_steps().eq(lines[5].planar_steps()));
}

/// The volume by adding up the surface, on points so dense that the sum is exact, and by the law.
#[test]
fn free_lines_take_away_the_same_volume() {
    let plan = plan(0.6, Path::OneWay);
    let lines = scanned(&plan);
    let points = |count: i32, from: f64| (0..count).map(|i| 0.3 * f64::from(i) + from).collect();
    let (x, y): (Vec<f64>, Vec<f64>) = (points(140, -14.0), points(90, -13.0));
    let added = 0.09 * Scanned::new(&plan, &lines).heights(&x, &y).sum();
    let by_law = -0.5 * 14.0 * plan.footprint.integral() * 6.0;
    assert!((added - by_law).abs() < 1e-10, "{added} for {by_law}");
    assert!((volume(&plan, &lines) - by_law).abs() < 1e-10);
}

#[test]
fn free_rasters_that_cannot_be_are_refused() {
    let refused = |plan: &Plan| Scanning::new(plan).map(|_| ()).unwrap_err();
    let of = |error: RasterError| match error {
        RasterError::Free { line: 1, error } => error,
        other => panic!("{other}"),
    };
    for stiffness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = of(refused(&plan(stiffness, Path::OneWay)));
        assert!(matches!(error, PlanarError::Stiffness(_)), "{error}");
    }
    // Lines far apart share no rows.
    let mut large = plan(1.0, Path::OneWay);
    large.area = Area::Rectangle { pitch: 30.0, lines: 3000, length: 1000.0 };
    assert!(matches!(refused(&large), RasterError::Memory { .. }));
    assert!(Scanning::new(&Plan { free: None, ..large }).is_ok());
    let kicked = plan(1.0, Path::OneWay).with_free(Free { kick: f64::NAN, ..Free::new(1.0) });
    assert!(matches!(of(refused(&kicked)), PlanarError::Kick(_)));
}
