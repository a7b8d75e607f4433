//! The Taylor series of a step, from memory, surface and forces at the position of the tip.

use super::super::Integrator;
use super::chain::Acting;
use crate::memory::{ROOM, SteadyPast};

impl Integrator<'_> {
    /// Computes the series from the present time on; false if there is none.
    pub(super) fn look_ahead(&mut self) -> bool {
        let order = self.taylor.limits.order;
        let mut jet = [0.0; ROOM];
        let known = self.surface.jet_on(&self.stretch, self.position(), &mut jet);
        let Some(count) = known else { return false };
        let steady = self.steady_past();
        let derivatives = &mut self.taylor.derivatives;
        let of_tip = self.memory.derivatives(steady.as_ref(), order + 1, derivatives);
        let Some(of_tip) = of_tip else { return false };
        if let Some(steady) = steady {
            derivatives.farthest = derivatives.farthest.max(-steady.distance);
        }
        if derivatives.farthest > derivatives.retreat {
            // There the exponentials grow: their sum is not the groove, and its sign not the side of the kink.
            return false;
        }
        let age = self.t - self.start;
        let relief = self.model.wider().left_after(age);
        let alpha = self.model.alpha();
        let first = (order, self.corner.is_some());
        jet[..count].iter_mut().for_each(|jet| *jet *= relief);
        self.taylor.chain.start(first, alpha, &derivatives.past, &jet[..count]);
        let depth_now = self.taylor.chain.depth_now();
        let depth = self.corner.as_mut().map(|corner| corner.stand_at(-depth_now));
        if !self.force.series(self.t, &mut self.taylor.chain.force[..order]) {
            return false;
        }
        let wider = self.model.wider();
        let acting = Acting {
            alpha,
            of_tip,
            spring: if wider.spring { 1.0 } else { 0.0 },
            support: self.support.velocity(self.t),
            healing: wider.healing_rate(),
            inertia: wider.inertia.map(|mass| (mass, self.velocity)),
            extension: self.extension,
            depth,
        };
        self.taylor.chain.run(&acting);
        true
    }

    /// The undecayed part of the steady motion before the run; `None` without it, or where the surface ahead is flat.
    fn steady_past(&self) -> Option<SteadyPast> {
        if self.stretch.flat {
            return None;
        }
        let distance = self.position() - self.surface.steady_position()?;
        let wider = self.model.wider();
        let weight = self.taylor.steady_weight * wider.left_after(self.t - self.start);
        let healing = wider.healing_rate();
        Some(SteadyPast { distance, velocity: self.model.r(), healing, weight })
    }
}
