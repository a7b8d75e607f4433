//! The definition: a sum over the history within reach.

use super::Memory;
use crate::TipFunction;
use crate::collocation::{STAGES, Stages};
use crate::state::{Damaged, Reader, State};

/// Sums f' and f'' over every remembered node within reach of the tip: the oracle for the others.
///
/// A step costs as much as there are nodes within reach, and a look at every block of one step.
#[derive(Debug, Clone)]
pub struct Direct {
    tip: TipFunction,
    reach: f64,
    /// Position of the tip, relative to an origin that follows it.
    position: f64,
    blocks: Vec<Block>,
}

/// The nodes of one step, and their range.
#[derive(Debug, Clone)]
struct Block {
    low: f64,
    high: f64,
    position: Stages,
    weight: Stages,
}

/// The origin moves by this much at a time. Positions stay small, so that their differences keep
/// full precision however far the tip travels; subtracting a power of two from them is exact.
const ORIGIN_STEP: f64 = 64.0;

impl Direct {
    /// Nothing remembered yet.
    #[must_use]
    pub fn new(tip: TipFunction) -> Self {
        let reach = tip.reach().unwrap_or(f64::INFINITY);
        Self { tip, reach, position: 0.0, blocks: vec![] }
    }

    /// Number of remembered nodes within reach of the tip.
    #[must_use]
    pub fn nodes_within_reach(&self) -> usize {
        let seen = |b: &&Block| self.sees(b, self.position, self.position);
        STAGES * self.blocks.iter().filter(seen).count()
    }

    /// Number of remembered steps.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.blocks.len()
    }

    /// All that is remembered: displacements from where the tip stands now, and times spent there.
    pub fn past(&self) -> impl Iterator<Item = (f64, f64)> {
        let nodes =
            |b: &Block| std::array::from_fn::<_, STAGES, _>(|i| (b.position[i], b.weight[i]));
        self.blocks.iter().flat_map(nodes).map(|(x, weight)| (x - self.position, weight))
    }

    /// Whether any node of the block may be within reach of any point of [low, high].
    fn sees(&self, block: &Block, low: f64, high: f64) -> bool {
        block.high >= low - self.reach && block.low <= high + self.reach
    }
}

impl Memory for Direct {
    fn groove(&mut self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        let x = at.map(|at| self.position + at);
        let (low, high) = range(&x);
        (*slope, *curvature) = ([0.0; STAGES], [0.0; STAGES]);
        for block in self.blocks.iter().filter(|block| self.sees(block, low, high)) {
            for (position, weight) in block.position.iter().zip(&block.weight) {
                for i in 0..STAGES {
                    let (f1, f2) = self.tip.slope_and_curvature(x[i] - position);
                    slope[i] += weight * f1;
                    curvature[i] += weight * f2;
                }
            }
        }
    }

    fn remember(&mut self, position: &Stages, weight: &Stages) {
        let position = position.map(|p| self.position + p);
        self.blocks.push(Block::of(position, *weight));
        self.position = position[STAGES - 1];
        if self.position.abs() > 2.0 * ORIGIN_STEP {
            let shift = ORIGIN_STEP.copysign(self.position);
            self.position -= shift;
            for block in &mut self.blocks {
                block.low -= shift;
                block.high -= shift;
                block.position.iter_mut().for_each(|p| *p -= shift);
            }
        }
    }

    fn name(&self) -> &'static str {
        "direct"
    }

    fn save(&self, state: &mut State) {
        state.number(self.position);
        state.count(self.blocks.len() as u64);
        for block in &self.blocks {
            block.position.iter().chain(&block.weight).for_each(|number| state.number(*number));
        }
    }

    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.position = state.within(4.0 * ORIGIN_STEP)?;
        let blocks = state.length(2 * STAGES)?;
        self.blocks = (0..blocks).map(|_| Block::restored(state)).collect::<Result<_, _>>()?;
        Ok(())
    }
}

impl Block {
    fn of(position: Stages, weight: Stages) -> Self {
        let (low, high) = range(&position);
        Self { low, high, position, weight }
    }

    fn restored(state: &mut Reader) -> Result<Self, Damaged> {
        let (mut position, mut weight) = (Stages::default(), Stages::default());
        for number in position.iter_mut().chain(&mut weight) {
            *number = state.finite()?;
        }
        Ok(Self::of(position, weight))
    }
}

fn range(values: &Stages) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)))
}
