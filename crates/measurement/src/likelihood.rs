//! The ends of intervals by profile likelihood.

/// Largest number of points of a profile on either side.
const MOST_POINTS: usize = 7;
/// Tolerance of the root at the end of an interval.
const MET: f64 = 0.02;

/// The offset at which `root` reaches `wanted`, and the points evaluated on the way there. The root is 0 at an offset of 0.
/// The search starts from a guess; the offset is `None` if it is not below `most`.
pub(crate) fn crossing(
    root: impl Fn(f64) -> Option<f64>,
    wanted: f64,
    (guess, most): (f64, f64),
) -> (Option<f64>, Vec<(f64, f64)>) {
    let side = guess.signum();
    let mut offset = guess;
    // Below it too little is left, above it too much.
    let (mut inside, mut outside): ((f64, f64), Option<(f64, f64)>) = ((0.0, 0.0), None);
    let mut points = vec![];
    for _ in 0..MOST_POINTS {
        let root = root(offset).unwrap_or(f64::INFINITY);
        if root.is_finite() {
            points.push((offset, root));
        }
        if (root - wanted).abs() < MET * wanted {
            return (Some(offset), points);
        }
        if root < wanted {
            if offset.abs() >= most {
                return (None, points);
            }
            inside = (offset, root);
        } else {
            outside = Some((offset, root));
        }
        offset = match outside {
            Some((far, root)) if root.is_finite() => {
                let part = (wanted - inside.1) / (root - inside.1);
                inside.0 + part.clamp(0.05, 0.95) * (far - inside.0)
            }
            Some((far, _)) => 0.5 * (inside.0 + far),
            None => {
                let further = wanted / inside.1.max(0.2 * wanted) * 1.05;
                side * (offset.abs() * further).min(most)
            }
        };
    }
    (outside.map(|_| offset), points)
}
