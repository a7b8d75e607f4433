//! Heights h(jd) of earlier lines at the y of the present line, and the sums Σ_j h(jd) w^j of them on intervals of the phase of
//! w = e^{iθ}.

use super::patch::Patch;
use crate::StabilityError;
use num_complex::Complex64;
use stickslip_tip::{Across, Footprint};

/// Differences of orders below this one bound the sums away from θ = 0.
const ORDERS: usize = 4;

/// Σ_i h_i w^{i+first}, where h_i are the heights of earlier lines at the y of the present line.
#[derive(Debug, Clone)]
pub(super) struct Sequence {
    heights: Vec<f64>,
    first: usize,
    /// Σ|Δ^k h|, which bounds |sum| |1-w|^k, by summation by parts.
    sizes: [f64; ORDERS],
    /// Σ|Δ^k (i + first)² h|, which bounds the second derivative in the same way.
    seconds: [f64; ORDERS],
}

impl Sequence {
    pub(super) fn new(heights: Vec<f64>, first: usize) -> Self {
        let squares =
            heights.iter().enumerate().map(|(i, h)| h * ((i + first) as f64).powi(2)).collect();
        let (sizes, seconds) = (differences(heights.clone()), differences(squares));
        Self { heights, first, sizes, seconds }
    }

    pub(super) fn len(&self) -> usize {
        self.heights.len()
    }

    /// Σ|h|
    pub(super) fn total(&self) -> f64 {
        self.sizes[0]
    }

    /// The sum and its derivative with respect to θ.
    pub(super) fn at(&self, theta: f64) -> (Complex64, Complex64) {
        let w = Complex64::from_polar(1.0, theta);
        let (mut sum, mut slope) = (Complex64::ZERO, Complex64::ZERO);
        for h in self.heights.iter().rev() {
            slope = slope * w + sum;
            sum = sum * w + h;
        }
        let shift = Complex64::from_polar(1.0, theta * self.first as f64);
        let derivative = (slope * w + sum * self.first as f64) * shift * Complex64::I;
        (sum * shift, derivative)
    }

    /// The sum for |θ - centre| ≤ `half`.
    pub(super) fn patch(&self, centre: f64, half: f64) -> Patch {
        let (value, slope) = self.at(centre);
        let slope = slope * half;
        let apart = distance_to_1(centre, half);
        let bound = |sums: &[f64; ORDERS]| {
            let mut power = 1.0;
            sums.iter().fold(f64::INFINITY, |least, sum| {
                let here = sum / power;
                power *= apart;
                least.min(here)
            })
        };
        let tangent = 0.5 * half * half * bound(&self.seconds);
        let anything = bound(&self.sizes) + value.norm() + slope.norm();
        Patch { value, along: [Complex64::ZERO, slope], rest: tangent.min(anything) }
    }
}

/// Lower bound of |1 - e^{iθ}| for |θ - centre| ≤ half.
fn distance_to_1(centre: f64, half: f64) -> f64 {
    let turns = std::f64::consts::TAU;
    let off = (centre - turns * (centre / turns).round()).abs() - half;
    // Beyond π it comes nearer to the next turn.
    let off = if off + 2.0 * half > std::f64::consts::PI {
        off.min(turns - (off + 2.0 * half))
    } else {
        off
    };
    2.0 * (0.5 * off.max(0.0)).sin()
}

/// Σ|Δ^k h|, with zeros before and after h.
fn differences(mut h: Vec<f64>) -> [f64; ORDERS] {
    let mut sums = [0.0; ORDERS];
    for sum in &mut sums {
        *sum = h.iter().map(|h| h.abs()).sum();
        h.push(0.0);
        for i in (1..h.len()).rev() {
            h[i] -= h[i - 1];
        }
    }
    sums
}

/// Values of h_l(jd) below this fraction of the largest are left out.
const NEGLIGIBLE: f64 = 1e-17;
/// Largest number of lines in a sum: if more are needed the pitch is an error.
const MOST_LINES: usize = 1_000_000;

/// c^j h_l(jd) of each layer for j = 1, 2, …, as far as it is not negligible, with h_l or its derivative of this order.
pub(super) fn heights(
    footprint: &Footprint,
    (pitch, left): (f64, f64),
    order: usize,
) -> Result<Vec<Vec<f64>>, StabilityError> {
    let widest = footprint.layers().iter().map(|layer| layer.across);
    let reach = widest.map(|h| h.center + 9.0 * h.width).fold(0.0, f64::max);
    let lines = (reach / pitch).ceil();
    if !(pitch.is_finite() && pitch > 0.0 && lines < MOST_LINES as f64) {
        return Err(StabilityError::Pitch(pitch));
    }
    let layers = footprint.layers().iter();
    let heights = layers.map(|layer| {
        let mut kept = 1.0;
        let height = |j: usize| {
            kept *= left;
            kept * derivative(&layer.across, pitch * j as f64, order)
        };
        let Across { center, width } = layer.across;
        let largest = layer.across.value(center) / width.powi(order as i32);
        let mut heights: Vec<f64> = (1..=lines as usize).map(height).collect();
        let last = heights.iter().rposition(|h| h.abs() >= NEGLIGIBLE * largest);
        heights.truncate(last.map_or(0, |last| last + 1));
        heights
    });
    Ok(heights.collect())
}

/// h, h' or h''.
fn derivative(across: &Across, y: f64, order: usize) -> f64 {
    let Across { center, width } = *across;
    let term = |center: f64| {
        let z = (y - center) / width;
        let bell = (-0.5 * z * z).exp();
        if order == 1 { -z * bell / width } else { (z * z - 1.0) * bell / (width * width) }
    };
    match order {
        0 => across.value(y),
        _ if center > 0.0 => term(center) + term(-center),
        _ => term(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sum written out, at many phases of many intervals.
    #[test]
    fn sums_are_within_their_patches() {
        for (pitch, first) in [(1.0, 1), (0.2, 1), (0.03, 0)] {
            let heights: Vec<f64> = (0..)
                .map(|i| f64::from(i) * pitch)
                .take_while(|y| *y < 9.0)
                .map(|y| (1.0 - 0.4 * y * y) * (-0.5 * y * y).exp())
                .collect();
            let exact = |theta: f64| -> Complex64 {
                let each = heights.iter().enumerate();
                each.map(|(i, h)| Complex64::from_polar(*h, theta * (i + first) as f64)).sum()
            };
            let sequence = Sequence::new(heights.clone(), first);
            for i in -40..=40 {
                for half in [1e-3, 0.02, 0.3, 3.2] {
                    let centre = 0.0785 * f64::from(i);
                    let patch = sequence.patch(centre, half);
                    for k in -5..=5 {
                        let y = 0.2 * f64::from(k);
                        let said = patch.value + patch.along[1] * y;
                        let off = (exact(centre + y * half) - said).norm();
                        assert!(off <= patch.rest + 1e-12, "{pitch} {centre} {half}: {off}");
                    }
                }
            }
        }
    }
}
