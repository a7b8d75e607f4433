//! Weights of the visits of a step, and decay of earlier contributions.
//!
//! Visit k of a step of length h has the weight `b_ik w_k` at stage i. The matrix b_ik is hA, or (1 + hA/T)⁻¹hA with the
//! healing time T; `w_k` = e^{-|η_k|/b} under the depth limit b. Earlier contributions have decayed by e^{-c_i h/T}.

use stickslip_tip::Wider;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};
use stickslip_tip::step::{Depth, Matrix, carving, healing, healing_rate};

/// Heights under the tip at the nodes of a step, and its side of the kink of |h|: 1 above 0, -1 below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Heights {
    pub(super) nodes: Stages,
    pub(super) side: f64,
}

/// Weights and decay of one step.
#[derive(Debug, Clone)]
pub(super) struct Carved {
    /// `b_ik` divided by `times`.
    bare: Matrix,
    /// h, or 1 if the surface heals.
    pub(super) times: f64,
    /// ∂`b_ik`/∂h if the surface heals; else it is `bare`.
    bare_rate: Option<Matrix>,
    /// Decay factors of earlier contributions at the nodes.
    pub(super) left: Stages,
    /// Logarithmic derivative of the decay with respect to h.
    pub(super) fading: Stages,
    /// w
    weights: Stages,
    /// ∂w/∂η
    by_height: Stages,
}

impl Carved {
    /// The weights of a step of length h.
    pub(super) fn new(wider: &Wider, h: f64, heights: Option<&Heights>) -> Self {
        let unit = carving(1.0);
        let (bare, times, bare_rate) = match wider.healing_time {
            None => (unit, h, None),
            Some(time) => (healing(h, time), 1.0, Some(healing_rate(h, time))),
        };
        let rate = wider.healing_rate();
        let depth = wider.depth_limit.zip(heights);
        let weigh = |(limit, heights): (f64, &Heights)| {
            let weights = Depth { limit, side: heights.side }.weights(&heights.nodes);
            (weights, weights.map(|w| -heights.side * w / limit))
        };
        let (weights, by_height) = depth.map_or(([1.0; STAGES], [0.0; STAGES]), weigh);
        Self {
            bare,
            times,
            bare_rate,
            left: RADAU.c.map(|c| wider.left_after(h * c)),
            fading: RADAU.c.map(|c| 0.0 - rate * c),
            weights,
            by_height,
        }
    }

    /// `b_ik w_k` divided by [`times`](Self::times).
    pub(super) fn weighted(&self) -> Matrix {
        by_columns(&self.bare, &self.weights)
    }

    /// Weights of the stages k at the end of the step: of the contributions, of their derivatives with respect to h, and
    /// of those with respect to `η_k`.
    pub(super) fn at_end(&self) -> [Stages; 3] {
        let row = |matrix: &Matrix, factors: &Stages| -> Stages {
            std::array::from_fn(|k| matrix[STAGES - 1][k] * factors[k])
        };
        let by_height = row(&self.bare, &self.by_height).map(|b| b * self.times);
        let stays = row(&self.bare, &self.weights);
        let rate = self.bare_rate.as_ref().map_or(stays, |rate| row(rate, &self.weights));
        [stays, rate, by_height]
    }

    /// ∂`b_ik w_k`/∂h if the surface heals; else it is [`weighted`](Self::weighted).
    pub(super) fn rate(&self) -> Option<Matrix> {
        self.bare_rate.as_ref().map(|rate| by_columns(rate, &self.weights))
    }

    /// ∂`b_ik w_k`/∂`η_k`
    pub(super) fn by_height(&self) -> Matrix {
        by_columns(&self.bare, &self.by_height).map(|row| row.map(|b| b * self.times))
    }
}

/// Each column times a factor.
fn by_columns(matrix: &Matrix, factors: &Stages) -> Matrix {
    matrix.map(|row| std::array::from_fn(|k| row[k] * factors[k]))
}
