//! The equations for the displacement of the tip at the nodes of one step, and their Newton iteration; with a depth
//! limit also for the heights under the tip.

use super::newton::newton;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::initial_surface::Stretch;
use crate::memory::{Groove, Policy};
use crate::step::{
    Depth, Equations, Factors, Inertia, Known, Law, LimitedFactors, OwnGroove, OwnHeight,
    StageResiduals,
};
use crate::tip_function::Apex;
use crate::{Force, InitialSurface, Model};

/// The [`Equations`] of a step, with the values from memory and surface.
pub(super) struct StageEquations<'a> {
    model: &'a Model,
    apex: &'a Apex,
    surface: &'a InitialSurface,
    stretch: &'a Stretch,
    /// Position of the tip at the start of the step.
    x: f64,
    equations: Equations<'a>,
    depth: Option<Depth>,
    left: Option<Left>,
    rests: bool,
}

/// The data at the start of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Begin {
    pub(super) t: f64,
    pub(super) h: f64,
    /// Position of the tip.
    pub(super) x: f64,
    /// R - x0
    pub(super) extension: f64,
    /// Velocity of the support.
    pub(super) velocity: f64,
    pub(super) depth: Option<Depth>,
    /// Time since the start of the run.
    pub(super) age: f64,
    /// Whether the tip stays at rest by symmetry: all forces on it are 0.
    pub(super) rests: bool,
}

/// Undecayed parts, at the stages, of indentations at the start of the step and at the start of the run.
struct Left {
    past: Stages,
    relief: Stages,
}

/// Displacements, and with a depth limit heights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unknowns {
    pub(super) displacement: Stages,
    pub(super) height: Stages,
}

pub(super) struct Solution {
    pub(super) displacement: Stages,
    /// Heights at the nodes.
    pub(super) height: Option<Stages>,
    /// Effective time of indentation at each node, multiplied by its undecayed part at the end of the step.
    pub(super) spent: Stages,
    /// u_xx at the last node.
    pub(super) curvature_at_end: f64,
}

/// Results of one evaluation of the groove.
#[derive(Default)]
struct Look {
    known: Known,
    own: OwnGroove,
    own_height: OwnHeight,
    missed: StageResiduals,
}

/// The factored Jacobian.
#[expect(clippy::large_enum_variant, reason = "there is one, on the stack")]
enum Jacobian {
    /// Without a depth limit.
    Plain(Factors),
    Limited(LimitedFactors),
}

impl<'a> StageEquations<'a> {
    /// The equations for a step that begins with these data.
    #[inline]
    pub(super) fn new(
        (model, apex): (&'a Model, &'a Apex),
        (surface, stretch): (&'a InitialSurface, &'a Stretch),
        force: &Force,
        begin: Begin,
        inertia: Option<&'a Inertia>,
    ) -> Self {
        let Begin { t, h, x, extension, velocity, depth, age, rests } = begin;
        let (law, wider) = (Law { r: velocity, ..Law::of(model) }, model.wider());
        // At the end of a step the force is its limit from before: it may jump there.
        let last = (t + h).next_down();
        let mut pull = law.pull(extension, h);
        for (pull, c) in pull.iter_mut().zip(RADAU.c) {
            *pull += if rests { 0.0 } else { force.value((t + h * c).min(last)) };
        }
        let equations = Equations::new(law, h, pull, wider.healing_time, inertia);
        let left = wider.healing_time.map(|_| {
            let past = RADAU.c.map(|c| wider.left_after(h * c));
            Left { past, relief: past.map(|left| left * wider.left_after(age)) }
        });
        Self { model, apex, surface, stretch, x, equations, depth, left, rests }
    }

    /// Solves the equations by Newton's iteration from `guess`, to an error below `enough`, and counts the iterations;
    /// `None` if it does not converge. It stops when a displacement exceeds `most`.
    pub(super) fn solve(
        &self,
        memory: &mut Policy,
        guess: Unknowns,
        (enough, most): (f64, f64),
        count: &mut u64,
    ) -> Option<Solution> {
        let Unknowns { mut displacement, mut height } = guess;
        let mut jacobian = None;
        let mut look = Look::default();
        let is_solved = newton((enough, self.surface.rounding(self.x)), count, |is_new| {
            self.look(memory, (&displacement, &height), &mut look);
            if is_new {
                jacobian = self.jacobian(&look, &height);
            }
            let correction = jacobian.as_ref()?.corrections(&look.missed);
            let mut size = largest(&correction.displacement);
            for (d, c) in displacement.iter_mut().zip(correction.displacement) {
                *d -= c;
            }
            if self.depth.is_some() {
                for (height, c) in height.iter_mut().zip(correction.height) {
                    *height -= c;
                    size = size.max(c.abs() / height.abs().max(1.0));
                }
            }
            displacement.iter().all(|d| d.abs() <= most).then_some(size)
        });
        is_solved.then(|| self.solution(displacement, height, &look.known))
    }

    fn solution(&self, displacement: Stages, height: Stages, known: &Known) -> Solution {
        let end = STAGES - 1;
        let mut spent = self.equations.carving()[end];
        if let Some(depth) = &self.depth {
            let weights = depth.weights(&height);
            spent.iter_mut().zip(weights).for_each(|(spent, weight)| *spent *= weight);
        }
        let past = self.model.alpha() * known.past_curvature[end];
        let curvature_at_end = known.relief_curvature[end] - past;
        let height = self.depth.map(|_| height);
        Solution { displacement, height, spent, curvature_at_end }
    }

    /// The factored Jacobian; `None` if it is singular.
    fn jacobian(
        &self,
        Look { known, own, own_height, .. }: &Look,
        height: &Stages,
    ) -> Option<Jacobian> {
        if let Some(depth) = &self.depth {
            let factors = depth.factors(&self.equations, height, known, (own, own_height));
            return factors.map(Jacobian::Limited);
        }
        let (past, relief) = (&known.past_curvature, &known.relief_curvature);
        Factors::of(self.equations.jacobian(past, relief, own)).map(Jacobian::Plain)
    }

    #[inline]
    fn look(&self, memory: &mut Policy, (d, height): (&Stages, &Stages), look: &mut Look) {
        let Look { known, own, own_height, missed } = look;
        self.know(memory, d, known);
        *own = OwnGroove::near(self.apex, self.model.tip(), d);
        if let Some(depth) = &self.depth {
            *own_height = OwnHeight::near(self.apex, self.model.tip(), d);
            *missed = depth.missed(&self.equations, (d, height), known, (own, own_height));
            return;
        }
        let velocity = self.equations.velocity(d, &known.past_slope, &known.relief_slope, own);
        missed.displacement = self.equations.residual(d, &velocity);
    }

    /// Evaluates memory and surface at these displacements.
    #[inline]
    fn know(&self, memory: &mut Policy, d: &Stages, known: &mut Known) {
        let mut groove = Groove::new(&mut known.past_slope, &mut known.past_curvature);
        if self.depth.is_some() {
            groove = groove.with_height(&mut known.past_height);
        }
        memory.groove(d, &mut groove);
        if self.rests {
            known.past_slope.fill(0.0);
        }
        if !self.stretch.flat {
            let relief = known.relief_slope.iter_mut().zip(&mut known.relief_curvature);
            for ((slope, curvature), d) in relief.zip(d) {
                (*slope, *curvature) =
                    self.surface.slope_and_curvature_on(self.stretch, self.x + d);
            }
        }
        if self.depth.is_some() {
            known.relief_height = d.map(|d| self.surface.height_on(self.stretch, self.x + d));
        }
        if let Some(left) = &self.left {
            known.fade(&left.past, &left.relief);
        }
    }
}

impl Jacobian {
    /// Newton's corrections.
    #[inline]
    fn corrections(&self, missed: &StageResiduals) -> StageResiduals {
        match self {
            Self::Plain(factors) => StageResiduals {
                displacement: factors.solve(&missed.displacement),
                height: [0.0; STAGES],
            },
            Self::Limited(factors) => factors.corrections(missed),
        }
    }
}

fn largest(values: &Stages) -> f64 {
    values.iter().fold(0.0, |m: f64, value| m.max(value.abs()))
}
