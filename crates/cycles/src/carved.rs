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
    /// h, or 1 if the surface heals: `b_ik` is in units of it.
    pub(super) times: f64,
    /// `None` for those of a surface that neither heals nor has a depth limit: most cycles have hundreds of such steps.
    wide: Option<Box<Wide>>,
}

/// Weights and decay in the extended model.
#[derive(Debug, Clone)]
struct Wide {
    /// `b_ik` and ∂`b_ik`/∂h if the surface heals; else `b_ik` is h times the matrix of a unit step.
    healing: Option<[Matrix; 2]>,
    left: Stages,
    fading: Stages,
    /// w
    weights: Stages,
    /// ∂w/∂η
    by_height: Stages,
}

static PLAIN: Wide = Wide {
    healing: None,
    left: [1.0; STAGES],
    fading: [0.0; STAGES],
    weights: [1.0; STAGES],
    by_height: [0.0; STAGES],
};

impl Carved {
    /// The weights of a step of length h.
    pub(super) fn new(wider: &Wider, h: f64, heights: Option<&Heights>) -> Self {
        let healing = wider.healing_time.map(|time| [healing(h, time), healing_rate(h, time)]);
        let rate = wider.healing_rate();
        let depth = wider.depth_limit.zip(heights);
        if healing.is_none() && depth.is_none() {
            return Self { times: h, wide: None };
        }
        let weigh = |(limit, heights): (f64, &Heights)| {
            let weights = Depth { limit, side: heights.side }.weights(&heights.nodes);
            (weights, weights.map(|w| -heights.side * w / limit))
        };
        let (weights, by_height) = depth.map_or(([1.0; STAGES], [0.0; STAGES]), weigh);
        let times = if healing.is_some() { 1.0 } else { h };
        let left = RADAU.c.map(|c| wider.left_after(h * c));
        let fading = RADAU.c.map(|c| 0.0 - rate * c);
        let wide = Wide { healing, left, fading, weights, by_height };
        Self { times, wide: Some(Box::new(wide)) }
    }

    fn wide(&self) -> &Wide {
        self.wide.as_deref().unwrap_or(&PLAIN)
    }

    /// Decay factors of earlier contributions at the nodes.
    pub(super) fn left(&self) -> &Stages {
        &self.wide().left
    }

    /// Logarithmic derivative of the decay with respect to h.
    pub(super) fn fading(&self) -> &Stages {
        &self.wide().fading
    }

    /// `b_ik` divided by [`times`](Self::times).
    fn bare(&self) -> Matrix {
        self.wide().healing.as_ref().map_or_else(|| carving(1.0), |healing| healing[0])
    }

    /// `b_ik w_k` divided by [`times`](Self::times).
    pub(super) fn weighted(&self) -> Matrix {
        by_columns(&self.bare(), &self.wide().weights)
    }

    /// Weights of the stages k at the end of the step: of the contributions, of their derivatives with respect to h, and
    /// of those with respect to `η_k`.
    pub(super) fn at_end(&self) -> [Stages; 3] {
        let row = |matrix: &Matrix, factors: &Stages| -> Stages {
            std::array::from_fn(|k| matrix[STAGES - 1][k] * factors[k])
        };
        let (bare, Wide { healing, weights, by_height, .. }) = (self.bare(), self.wide());
        let by_height = row(&bare, by_height).map(|b| b * self.times);
        let stays = row(&bare, weights);
        let rate = healing.as_ref().map_or(stays, |healing| row(&healing[1], weights));
        [stays, rate, by_height]
    }

    /// ∂`b_ik w_k`/∂h if the surface heals; else it is [`weighted`](Self::weighted).
    pub(super) fn rate(&self) -> Option<Matrix> {
        let Wide { healing, weights, .. } = self.wide();
        healing.as_ref().map(|healing| by_columns(&healing[1], weights))
    }

    /// ∂`b_ik w_k`/∂`η_k`
    pub(super) fn by_height(&self) -> Matrix {
        by_columns(&self.bare(), &self.wide().by_height).map(|row| row.map(|b| b * self.times))
    }
}

/// Each column times a factor.
fn by_columns(matrix: &Matrix, factors: &Stages) -> Matrix {
    matrix.map(|row| std::array::from_fn(|k| row[k] * factors[k]))
}
