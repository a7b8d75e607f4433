//! The kind of motion at the end of a walker's run: rest, a straight line, a circle, or none of these.

use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use stickslip_tip::walker::WalkerTrajectory;

/// Length of the last part of a run as a fraction of the run, and the number of points at which it is classified.
const LATE: f64 = 0.25;
const POINTS: u32 = 2000;
/// Largest deviation of a line or circle, relative to its length or radius.
const ROUGH: f64 = 1e-3;
/// A particle rests if it moves by less than this, in σ, in the last part.
const STILL: f64 = 1e-6;

/// The motion at the end of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WalkerRegime {
    /// The particle rests.
    Resting,
    /// The particle walks on a straight line at constant speed.
    Straight,
    /// The particle moves on a circle.
    Circling,
    /// The motion is none of these.
    Irregular,
}

/// The circle on which a walker moves at the end of a run.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CircleDocument {
    /// Radius, in σ.
    pub radius: f64,
    /// Mean angular frequency, in k/Γ; above 0 if counterclockwise.
    pub omega: f64,
    /// Center along x, in σ.
    pub center_x: f64,
    /// Center along y, in σ.
    pub center_y: f64,
    /// Largest distance of the particle from the circle, in σ.
    pub deviation: f64,
}

/// The motion in the last quarter of a run: its kind, the mean speed, and the circle if it is one.
pub(super) fn motion(trajectory: &WalkerTrajectory) -> (WalkerRegime, f64, Option<CircleDocument>) {
    let (end, start) = (trajectory.end(), (1.0 - LATE) * trajectory.end());
    let times: Vec<f64> =
        (0..=POINTS).map(|i| start + (end - start) * f64::from(i) / f64::from(POINTS)).collect();
    let points: Vec<[f64; 2]> = times.iter().map(|t| trajectory.position(*t)).collect();
    let speeds = times.iter().map(|t| trajectory.velocity(*t)).map(|[x, y]| x.hypot(y));
    let speed = speeds.sum::<f64>() / times.len() as f64;
    if speed * (end - start) < STILL {
        return (WalkerRegime::Resting, speed, None);
    }
    if is_straight(&points) {
        return (WalkerRegime::Straight, speed, None);
    }
    let circle = circle(&points, end - start);
    let regime = circle.map_or(WalkerRegime::Irregular, |_| WalkerRegime::Circling);
    (regime, speed, circle)
}

/// Whether the points lie on the line from the first to the last, at even distances.
fn is_straight(points: &[[f64; 2]]) -> bool {
    let (first, last) = (points[0], points[points.len() - 1]);
    let way = [last[0] - first[0], last[1] - first[1]];
    let length = way[0].hypot(way[1]);
    let off = |(i, point): (usize, &[f64; 2])| {
        let part = i as f64 / (points.len() - 1) as f64;
        (point[0] - first[0] - part * way[0]).hypot(point[1] - first[1] - part * way[1])
    };
    points.iter().enumerate().map(off).fold(0.0, f64::max) <= ROUGH * length
}

/// The circle through points at even times, if they lie on one and go round at least half of it: least squares of x² + y²
/// = 2ax + 2by + c, which is linear.
fn circle(points: &[[f64; 2]], duration: f64) -> Option<CircleDocument> {
    let count = points.len() as f64;
    let mean = [0, 1].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / count);
    let centered = points.iter().map(|p| [p[0] - mean[0], p[1] - mean[1]]);
    let sum = |of: fn([f64; 2]) -> f64| centered.clone().map(of).sum::<f64>();
    let (xx, xy, yy) = (sum(|[x, _]| x * x), sum(|[x, y]| x * y), sum(|[_, y]| y * y));
    let cubes = [sum(|[x, y]| x * (x * x + y * y)), sum(|[x, y]| y * (x * x + y * y))];
    let determinant = xx * yy - xy * xy;
    let center = [
        0.5 * (cubes[0] * yy - cubes[1] * xy) / determinant,
        0.5 * (cubes[1] * xx - cubes[0] * xy) / determinant,
    ];
    let radius = ((xx + yy) / count + center[0] * center[0] + center[1] * center[1]).sqrt();
    let around = |p: [f64; 2]| [p[0] - center[0], p[1] - center[1]];
    let off = |p: [f64; 2]| {
        let [x, y] = around(p);
        (x.hypot(y) - radius).abs()
    };
    let deviation = centered.clone().map(off).fold(0.0, f64::max);
    let next = centered.clone().skip(1);
    let turned: f64 = centered
        .zip(next)
        .map(|(a, b)| {
            let ([x, y], [u, v]) = (around(a), around(b));
            (x * v - y * u).atan2(x * u + y * v)
        })
        .sum();
    let is_circle = deviation <= ROUGH * radius && turned.abs() >= PI;
    is_circle.then(|| CircleDocument {
        radius,
        omega: turned / duration,
        center_x: mean[0] + center[0],
        center_y: mean[1] + center[1],
        deviation,
    })
}
