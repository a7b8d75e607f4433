//! Steps in two coordinates: by Taylor series, and by collocation where the groove or the spring across is stiff.

mod collocation;
mod saved;
mod series;

use super::chain::{Chain, Curvatures};
use super::earlier::EarlierGrooves;
use super::frame::Layers;
use super::history::Step;
use super::jet::Jet;
use super::layers::Lanes;
use super::part::{Part, Room, Storage, sum};
use super::past::TooFar;
use super::products::Products;
use super::scenario::{PlanarError, PlanarScenario};
use super::spline::Partials;
use super::texture::{Field, Texture};
use crate::integrator::Work;
use crate::integrator::control::Control;
use crate::integrator::corner::Corner;
use crate::integrator::landing::leaves;
use crate::integrator::taylor::plan::Limits;
use crate::integrator::taylor::switch::Switch;
use crate::memory::{FitError, MemoryChoice, Retreat, SteadyPast};
use crate::state::Reader;
use crate::step;
use crate::tip_function::BAND_OF_A_GAUSSIAN;
use crate::{Force, Model, RunError, Scenario, Start, Support, Wider};
use std::collections::VecDeque;
use std::sync::Arc;

/// A tip in motion through a scenario, with bounded memory: its state, and all forces on it.
pub struct PlanarRunning<'a> {
    model: &'a Model,
    /// The memory in use, and the reason if exponentials were considered and are not used.
    storage: Storage,
    instead_of_modes: Option<FitError>,
    /// The products of the footprint with the past of each.
    parts: Vec<Part>,
    products: Arc<Products>,
    /// Stiffness κ_y of the spring across the scan.
    stiffness: f64,
    /// External forces along and across.
    force: [&'a Force; 2],
    support: Support,
    /// The initial surface, except for the groove of steady motion.
    texture: Texture,
    /// The part of the initial surface on which the present step began.
    field: Field,
    /// The grooves of earlier lines, as they were at the start.
    earlier: Option<&'a EarlierGrooves>,
    control: Control,
    chain: Chain,
    limits: Limits,
    /// The kink of |h|, with a depth limit.
    corner: Option<Corner>,
    switch: Switch,
    /// End time of the present series or stages; steps already made but not yet returned lie before it.
    t: f64,
    /// Start and end time of the run.
    start: f64,
    until: f64,
    /// Extension R - x0 of the spring.
    extension: f64,
    y: f64,
    /// Velocity along and across; the former is independent of the force only for a tip with inertia.
    velocity: [f64; 2],
    last: Option<Step>,
    made: VecDeque<Step>,
    work: Work,
    room: Vec<Lanes>,
}

/// Increase of the order for an error smaller by the factor e. The cost of a series is proportional to the third power
/// of its order.
const ORDER_PER_DIGIT: f64 = 0.7;

/// Kick, in widths, above which the tip retreats farther behind its farthest point, as it does with inertia.
const LARGE_KICK: f64 = 0.2;

fn retreat(along: &Scenario) -> Retreat {
    let is_kicked = along.kick.abs() > along.model.tip().widths(LARGE_KICK);
    if is_kicked || along.model.wider().inertia.is_some() { Retreat::Swing } else { Retreat::Small }
}

/// Whether any force other than that of its own groove may drive the tip back.
fn may_go_back(PlanarScenario { along, force_across, .. }: &PlanarScenario) -> bool {
    let is_pushed = [&along.force, force_across].iter().any(|force| force.begins() < f64::INFINITY);
    is_pushed || along.path.is_some() || retreat(along) == Retreat::Swing
}

impl<'a> PlanarRunning<'a> {
    /// Begins a scenario.
    ///
    /// # Errors
    /// A parameter out of range, or an option that is not available in two coordinates.
    pub fn new(scenario: &'a PlanarScenario) -> Result<Self, PlanarError> {
        Self::begun(scenario, None)
    }

    /// Begins a scenario on the surface that earlier scans left.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn over(
        scenario: &'a PlanarScenario,
        earlier: &'a EarlierGrooves,
    ) -> Result<Self, PlanarError> {
        Self::begun(scenario, Some(earlier))
    }

    /// Resumes a run from a state written by [`save`](Self::save). Every later step equals that of the uninterrupted
    /// run, bit for bit.
    ///
    /// # Errors
    /// As [`new`](Self::new); a state that is not one of this scenario.
    pub fn resumed(scenario: &'a PlanarScenario, state: &mut Reader) -> Result<Self, PlanarError> {
        let mut running = Self::new(scenario)?;
        running.restore(state).map_err(RunError::from)?;
        scenario.along.check_saved(running.t(), running.t).map_err(RunError::from)?;
        Ok(running)
    }

    fn begun(
        scenario: &'a PlanarScenario,
        earlier: Option<&'a EarlierGrooves>,
    ) -> Result<Self, PlanarError> {
        scenario.validate()?;
        let goes_back = earlier.is_some() || may_go_back(scenario);
        let modes =
            || Self::with(scenario, Storage::Modes(retreat(&scenario.along), goes_back), earlier);
        let fft = || Self::with(scenario, Storage::Fft, earlier);
        match scenario.along.memory {
            MemoryChoice::Direct => Self::with(scenario, Storage::Direct, earlier),
            MemoryChoice::Fft => fft(),
            MemoryChoice::Modes => modes(),
            MemoryChoice::Auto => match modes() {
                Err(PlanarError::Fit(why @ FitError::NotMet { .. })) => {
                    Ok(Self { instead_of_modes: Some(why), ..fft()? })
                }
                made => made,
            },
        }
    }

    fn with(
        scenario: &'a PlanarScenario,
        storage: Storage,
        earlier: Option<&'a EarlierGrooves>,
    ) -> Result<Self, PlanarError> {
        let along = &scenario.along;
        let model = &along.model;
        let products = scenario.products()?;
        let parts = products.all().iter().map(|product| Part::new(product, storage));
        let control = Control::new(along.tolerance);
        let target = control.target();
        let texture = scenario.texture()?;
        let (x, y) = (along.start_position - along.kick, scenario.kick_across);
        let limits = Limits::new(model.tip().band(), along.tolerance, ORDER_PER_DIGIT);
        let mut integrator = Self {
            storage,
            instead_of_modes: None,
            parts: parts.collect::<Result<_, _>>()?,
            chain: Chain::new(limits.order, products.all().len()),
            limits,
            products,
            switch: Switch::new(model.wider().inertia.is_some()),
            corner: None,
            model,
            stiffness: scenario.stiffness_across,
            force: [&along.force, &scenario.force_across],
            support: along.support(),
            field: texture.field([x, y], [true; 2], target),
            texture,
            earlier,
            control,
            t: along.start_time(),
            start: along.start_time(),
            until: along.until,
            extension: along.start_extension() + along.kick,
            y,
            velocity: [along.velocity_at_start(), 0.0],
            last: None,
            made: VecDeque::new(),
            work: Work::default(),
            room: vec![],
        };
        let (t, x) = (integrator.t, integrator.position());
        let range = (y.min(0.0), y.max(0.0));
        let past = SteadyPast {
            distance: -along.kick,
            velocity: model.r(),
            healing: model.wider().healing_rate(),
            weight: model.steady_weight(),
        };
        for part in &mut integrator.parts {
            part.frame.visit(&mut part.past, t, (x, x), range)?;
            if along.start == Start::Steady {
                part.remember_steady(&past);
            }
        }
        integrator.choose_memories()?;
        integrator.corner = Corner::of(model, integrator.groove_now().height, target);
        Ok(integrator)
    }

    /// The run with a fixed step, by collocation and without error control: for observing the order of convergence.
    #[must_use]
    pub fn with_fixed_step(mut self, h: f64) -> Self {
        self.control.fix(h);
        self
    }

    /// Time reached: the start of the next step.
    pub fn t(&self) -> f64 {
        self.made.front().map_or(self.t, |step| step.along.t)
    }

    /// Numbers of steps, iterations and series so far.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Number of layers so far, and their error.
    pub fn layers(&self) -> Layers {
        let of = |part: &Part| Layers { error: part.error(), ..part.frame.layers() };
        let add = |sum: Layers, part: Layers| Layers {
            most: sum.most + part.most,
            changes: sum.changes + part.changes,
            error: sum.error + part.error,
        };
        let none = Layers { most: 0, changes: 0, error: self.products.error() };
        self.parts.iter().map(of).fold(none, add)
    }

    /// Name of the memory in use, and the reason for it.
    pub fn memory(&self) -> (&'static str, String) {
        let (name, reason) = match (self.storage, self.instead_of_modes) {
            (Storage::Modes(..), _) => ("modes", "exponentials fit f'".into()),
            (Storage::Direct, _) => return ("direct", "requested".into()),
            (Storage::Fft, Some(FitError::NotMet { wanted, .. })) => {
                ("fft", format!("modes do not fit f' to {wanted:.1e}"))
            }
            (Storage::Fft, _) => ("fft", "requested".into()),
        };
        (name, format!("{reason}; up to {} layers", self.layers().most))
    }

    /// Number of real numbers in the memory.
    pub fn memory_size(&self) -> usize {
        self.parts.iter().map(Part::memory_size).sum()
    }

    /// Makes the next step; `None` once the end of the scenario is reached.
    ///
    /// # Errors
    /// The tolerance cannot be met, or the tip retreats beyond the range of the memory.
    pub fn step(&mut self) -> Result<Option<Step>, PlanarError> {
        if self.made.is_empty() && self.t < self.until {
            self.choose_memories()?;
            if !self.step_by_series()? {
                self.step_by_collocation()?;
            }
        }
        let step = self.made.pop_front();
        self.work.steps += u64::from(step.is_some());
        Ok(step)
    }

    /// Chooses the memories that are valid where the tip is.
    fn choose_memories(&mut self) -> Result<(), PlanarError> {
        let t = self.t;
        let too_far = |TooFar { behind, allowed }| PlanarError::Retreat { t, behind, allowed };
        self.parts.iter_mut().try_for_each(|part| part.past.begin()).map_err(too_far)
    }

    /// The present x0.
    fn position(&self) -> f64 {
        self.support.position(self.t) - self.extension
    }

    /// Distance of the tip behind its farthest point.
    fn behind(&self) -> f64 {
        self.parts.iter().map(|part| part.past.behind()).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The lowest displacement from the tip that a step may reach.
    fn lowest(&self, farthest: f64) -> f64 {
        let lowest = self.parts.iter().map(|part| part.past.lowest(farthest));
        lowest.fold(f64::NEG_INFINITY, f64::max)
    }

    fn wider(&self) -> &'a Wider {
        self.model.wider()
    }

    /// Latest end of the next step.
    fn next_end(&self) -> f64 {
        let breaks = self.force.iter().map(|force| force.next_break(self.t));
        breaks.fold(self.support.next_break(self.t).min(self.until), f64::min)
    }

    /// Longest step that does not skip a pulse.
    fn longest_step(&self) -> f64 {
        self.force.iter().map(|force| force.longest_step(self.t)).fold(f64::INFINITY, f64::min)
    }

    /// The length of a motion along the scan whose groove is as fine as that of this motion: the bandwidths of f along
    /// and across differ.
    fn effective(&self, [along, across]: [f64; 2]) -> f64 {
        let ratio = BAND_OF_A_GAUSSIAN / (self.products.width() * self.model.tip().band());
        (along * along + (ratio * across) * (ratio * across)).sqrt()
    }

    /// The largest rate, in k/Γ, at which the tip relaxes in a groove of these curvatures.
    fn fastest(&self, [along, mixed, across]: Curvatures) -> f64 {
        let (along, across) = (1.0 + along, self.stiffness + across);
        let (mean, half) = (0.5 * (along + across), 0.5 * (along - across));
        let Some(mass) = self.wider().inertia else {
            return mean + (half * half + mixed * mixed).sqrt();
        };
        step::fastest(along, Some(mass)).max(across) + mixed.abs()
    }

    /// Adds the visits of a step of length h to the memory: displacements from the tip, of which the last is its new
    /// position, and weights. The layers are adapted to them first.
    fn remember(
        &mut self,
        (along, across): (&[f64], &[f64]),
        weights: &[f64],
        h: f64,
    ) -> Result<(), PlanarError> {
        let (x, y) = (self.position(), self.y);
        let range = |moved: &[f64]| {
            moved.iter().fold((0.0, 0.0), |(a, b): (f64, f64), d| (a.min(*d), b.max(*d)))
        };
        let ((_, farthest), (low, high)) = (range(along), range(across));
        let places = (x + farthest, x + along[along.len() - 1]);
        let left = self.wider().left_after(h);
        for part in &mut self.parts {
            part.frame.visit(&mut part.past, self.t, places, (y + low, y + high))?;
            part.remember((along, across), weights, (y, left), &mut self.room);
        }
        Ok(())
    }

    /// Forces on the tip at its position, along and across, after any jump there.
    fn forces_now(&self) -> [f64; 2] {
        let under = self.groove_now().slope;
        let force = self.force.map(|force| force.value(self.t.next_up()));
        [self.extension + force[0] - under[0], force[1] - self.stiffness * self.y - under[1]]
    }

    /// The surface under the tip.
    fn groove_now(&self) -> Jet {
        let mut room = Room::default();
        let past = sum(&self.parts, |part| part.at(0.0, self.y, &mut room));
        let mut surface = self.initial([self.position(), self.y]).times(self.left(self.t));
        surface.add(-self.model.alpha(), &past);
        surface
    }

    /// The surface at the start of the run, at a position in the present field: the initial one, and grooves of earlier
    /// lines.
    fn initial(&self, at: [f64; 2]) -> Jet {
        let mut surface =
            self.earlier.map_or_else(Jet::default, |grooves| grooves.at(at[0], at[1]));
        if !self.field.is_flat() {
            surface.add(1.0, &Jet::of(&self.texture.jet(&self.field, at)));
        }
        surface
    }

    /// Sets the field that contains the tip, or that it is about to enter.
    fn enter_field(&mut self) {
        if !self.texture.is_flat() {
            let at = [self.position(), self.y];
            let forward = self.velocity.map(|v| v >= 0.0);
            self.field = self.texture.field(at, forward, self.control.target());
        }
    }

    /// Undecayed part of the initial surface, from the start of the run to t.
    fn left(&self, t: f64) -> f64 {
        self.wider().left_after(t - self.start)
    }

    /// Undecayed part of the initial surface under the tip, with derivatives, unless it is flat.
    fn relief_now(&self) -> Option<Partials> {
        if self.field.is_flat() {
            return None;
        }
        let (jet, left) =
            (self.texture.jet(&self.field, [self.position(), self.y]), self.left(self.t));
        Some(jet.map(|row| row.map(|entry| left * entry)))
    }

    /// Fraction of a step at which the tip leaves the field; `None` if it does not. `displacement` contains the
    /// displacements at the fractions `parts`.
    fn leaves_field(
        &self,
        parts: &[f64],
        displacement: [&[f64]; 2],
        at: impl Fn(usize, f64) -> f64,
    ) -> Option<f64> {
        let leaves = |j: usize| {
            let from = [self.position(), self.y][j];
            leaves(&self.field.ends[j], from, (parts, displacement[j]), |part| at(j, part))
        };
        [0, 1].into_iter().filter_map(leaves).reduce(f64::min)
    }

    /// Accepts a step that ends at the present position of the tip.
    fn accept(&mut self, step: Step) {
        self.extension = step.along.extension_at_end(self.support.velocity(self.t));
        (self.t, self.y) = (step.end(), step.y_at_end());
        if let Some(corner) = &mut self.corner {
            corner.arrive(&step.along);
        }
        self.last = Some(step);
        self.made.push_back(step);
    }
}
