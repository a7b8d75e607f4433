//! The history of the tip: the accepted steps, each a polynomial.

use crate::collocation::{RADAU, STAGES, Stages};
use crate::elementary::exp;
use crate::step::healing;
use crate::{Support, Wider};
use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// One accepted step: the stage polynomial of the tip's displacement.
///
/// Positions are stored as the extension of the spring and as displacements, not as x0, so that a tip that has
/// travelled 1e6 widths keeps its last digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Time at the start of the step.
    pub t: f64,
    /// Duration of the step.
    pub h: f64,
    /// Extension R - x0 of the spring at the start of the step, in σ; R = rt at constant velocity, and R = 0 without a
    /// spring.
    pub extension: f64,
    /// x0 minus its value at the start, at the collocation nodes; the last node is the end of the step.
    pub displacement: Stages,
    /// The height of the surface under the tip; `None` without a depth limit (61).
    pub height: Option<Heights>,
}

/// Where the tip is at one time, in σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// R - x0, the extension of the spring.
    pub lag: f64,
    /// Position of the tip.
    pub x0: f64,
    /// rt - r - x0, for a support of constant velocity.
    pub l: Option<f64>,
}

/// The height under the tip at the start of a step and at its nodes, in kσ²/a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heights {
    /// Height at the start of the step.
    pub start: f64,
    /// Heights at the nodes.
    pub nodes: Stages,
}

/// Number of real numbers in a step, including its heights, which are NaN without a depth limit.
pub const STEP_NUMBERS: usize = 4 + 2 * STAGES;

impl Step {
    /// Time at the end of the step.
    pub fn end(&self) -> f64 {
        self.t + self.h
    }

    /// rt - x0 at the end of the step, for support velocity r.
    pub fn extension_at_end(&self, r: f64) -> f64 {
        self.extension + (r * self.h - self.displacement[STAGES - 1])
    }

    /// l(t) = rt - r - x0(t) by the stage polynomial, for support velocity r.
    pub fn l(&self, r: f64, t: f64) -> f64 {
        self.l_after(self.moved(t), r, t)
    }

    /// x0(t) minus its value at the start, by the stage polynomial.
    fn moved(&self, t: f64) -> f64 {
        RADAU.value(&self.displacement, self.part(t))
    }

    fn l_after(&self, moved: f64, r: f64, t: f64) -> f64 {
        self.extension - r + (r * (t - self.t) - moved)
    }

    /// x0(t) by the stage polynomial, for support velocity r.
    pub fn x0(&self, r: f64, t: f64) -> f64 {
        r * t - r - self.l(r, t)
    }

    /// x0'(t), the derivative of the stage polynomial: one order less accurate than x0.
    pub fn velocity(&self, t: f64) -> f64 {
        RADAU.slope(&self.displacement, self.part(t)) / self.h
    }

    /// The elapsed fraction of the step at t.
    fn part(&self, t: f64) -> f64 {
        (t - self.t) / self.h
    }

    /// R(t) - x0(t), the extension of the spring, by the stage polynomial.
    pub fn lag(&self, support: &Support, t: f64) -> f64 {
        self.lag_after(self.moved(t), support, t)
    }

    fn lag_after(&self, moved: f64, support: &Support, t: f64) -> f64 {
        self.extension + (support.advance(self.t, t - self.t) - moved)
    }

    /// The values of [`lag`](Self::lag), [`position`](Self::position) and, for a support of constant velocity,
    /// [`l`](Self::l), from one evaluation of the stage polynomial.
    pub fn place(&self, support: &Support, t: f64) -> Place {
        self.placed(self.moved(t), support, t)
    }

    /// [`place`](Self::place) and [`velocity`](Self::velocity), for less than the two take.
    pub fn place_and_velocity(&self, support: &Support, t: f64) -> (Place, f64) {
        let (moved, slope) = RADAU.value_and_slope(&self.displacement, self.part(t));
        (self.placed(moved, support, t), slope / self.h)
    }

    fn placed(&self, moved: f64, support: &Support, t: f64) -> Place {
        let lag = self.lag_after(moved, support, t);
        match support {
            Support::Moving(r) => {
                let l = self.l_after(moved, *r, t);
                Place { lag, x0: r * t - r - l, l: Some(l) }
            }
            _ => Place { lag, x0: support.position(t) - lag, l: None },
        }
    }

    /// The variable that describes the motion: l; for a support on a path the lag R - x0, without a support x0.
    pub fn followed(&self, support: &Support, t: f64) -> f64 {
        match support {
            Support::Moving(r) => self.l(*r, t),
            Support::Path(_) => self.lag(support, t),
            Support::None => self.position(support, t),
        }
    }

    /// x0(t) by the stage polynomial, for any support.
    pub fn position(&self, support: &Support, t: f64) -> f64 {
        self.place(support, t).x0
    }

    /// The height under the tip at t, by its polynomial; `None` without a depth limit.
    pub fn height(&self, t: f64) -> Option<f64> {
        self.height.map(|height| height.at(self.part(t)))
    }

    /// All data of the step: t, h, extension, displacements and heights.
    pub fn numbers(&self) -> [f64; STEP_NUMBERS] {
        let mut numbers = [f64::NAN; STEP_NUMBERS];
        numbers[..3].copy_from_slice(&[self.t, self.h, self.extension]);
        let (displacement, heights) = numbers[3..].split_at_mut(STAGES);
        displacement.copy_from_slice(&self.displacement);
        if let Some(Heights { start, nodes }) = self.height {
            heights[0] = start;
            heights[1..].copy_from_slice(&nodes);
        }
        numbers
    }

    /// Whether the step is valid: its duration is finite and above 0, and all its numbers are finite.
    pub fn is_sound(&self) -> bool {
        let heights = self.height.into_iter().flat_map(|h| h.nodes.into_iter().chain([h.start]));
        let numbers = [self.t, self.h, self.extension].into_iter().chain(self.displacement);
        self.h > 0.0 && numbers.chain(heights).all(f64::is_finite)
    }

    /// A step from its [`numbers`](Self::numbers).
    pub fn from_numbers([t, h, extension, rest @ ..]: [f64; STEP_NUMBERS]) -> Self {
        let displacement = std::array::from_fn(|i| rest[i]);
        let nodes = std::array::from_fn(|i| rest[1 + STAGES + i]);
        let start = rest[STAGES];
        let height = (!start.is_nan()).then_some(Heights { start, nodes });
        Self { t, h, extension, displacement, height }
    }

    /// Relative indentation rates w at the nodes.
    pub(crate) fn weights(&self, wider: &Wider) -> Stages {
        self.height.map_or([1.0; STAGES], |height| height.nodes.map(|height| wider.weight(height)))
    }

    /// Calls `each` with the moments of the step until t, for sums over the [residence](Trajectory::residence) of the
    /// tip. They are the nodes if the step ends by t and heals little meanwhile, Gauss points otherwise.
    pub fn each_moment(&self, wider: &Wider, t: f64, mut each: impl FnMut(Moment)) {
        let time = wider.healing_time.unwrap_or(f64::INFINITY);
        let passed = t - self.t;
        let is_over = self.end() <= t;
        if is_over && (self.h <= MOST_AT_NODES * time || passed - self.h >= GONE * time) {
            let left = match wider.healing_time {
                None => RADAU.b().map(|b| b * self.h),
                Some(time) => healing(self.h, time)[STAGES - 1],
            };
            let (weights, since) = (self.weights(wider), wider.left_after(t - self.end()));
            for i in 0..STAGES {
                each(Moment { at: At::Node(i), weight: left[i] * weights[i] * since });
            }
            return;
        }
        let to = if is_over { self.h } else { passed };
        let from = (passed - GONE * time).max(0.0);
        let pieces = ((to - from) / (MOST_AT_POINTS * time)).ceil().max(1.0);
        let half = 0.5 * (to - from) / pieces;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most five")]
        for start in (0..pieces as usize).map(|piece| from + 2.0 * half * piece as f64) {
            for (node, weight) in GAUSS.as_node_weight_pairs() {
                let since = start + half * (1.0 + node);
                let tau = since / self.h;
                let indented = self.height.map_or(1.0, |height| wider.weight(height.at(tau)));
                let left = wider.left_after(passed - since);
                each(Moment { at: At::Fraction(tau), weight: half * weight * indented * left });
            }
        }
    }
}

/// A moment of a step with its weight in sums over the motion: the time that it stands for, times the fraction of its
/// imprint that has not healed, times w under a depth limit.
#[derive(Debug, Clone, Copy)]
pub struct Moment {
    at: At,
    /// The weight, in Γ/k.
    pub weight: f64,
}

#[derive(Debug, Clone, Copy)]
enum At {
    Node(usize),
    Fraction(f64),
}

impl Moment {
    /// The value at this moment of a quantity that is 0 at the start of the step and has the values `stages` at its
    /// nodes.
    pub fn value(&self, stages: &Stages) -> f64 {
        match self.at {
            At::Node(i) => stages[i],
            At::Fraction(tau) => RADAU.value(stages, tau),
        }
    }
}

impl Heights {
    /// The height at the fraction τ of the step.
    pub fn at(&self, tau: f64) -> f64 {
        self.start + RADAU.value(&self.rise(), tau)
    }

    /// Increase of the height since the start of the step, at the nodes.
    pub fn rise(&self) -> Stages {
        self.nodes.map(|height| height - self.start)
    }
}

/// The dense output of a run: x0(t) at every t of it, and in two coordinates y0(t). It contains only the data that
/// `surface` needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory<S = Step> {
    support: Support,
    wider: Wider,
    steps: Vec<S>,
}

impl AsRef<Self> for Step {
    fn as_ref(&self) -> &Self {
        self
    }
}

/// Number of points of the Gauss rule on a part of a step. The rule integrates f(x - polynomial) far beyond the
/// accuracy of the polynomial itself.
const POINTS_ON_A_PART: usize = 16;
/// Longest part for this rule, in healing times T. The integral of e^{-t/T} over a part of length βT has a relative
/// error of at most (16!)⁴β³²/(33 (32!)³), 3e-26 for β = 8.
const MOST_AT_POINTS: f64 = 8.0;
/// Longest step for the nodes, in healing times: the corresponding error is at most 6 (5!)⁴β¹¹/(2 (11!)³), 5e-18.
const MOST_AT_NODES: f64 = 0.5;
/// Number of healing times after which an imprint is negligible: e^{-40} is 4e-18.
const GONE: f64 = 40.0;

static GAUSS: LazyLock<GaussLegendre> =
    LazyLock::new(|| GaussLegendre::new(const { NonZeroUsize::new(POINTS_ON_A_PART).unwrap() }));

impl<S: AsRef<Step>> Trajectory<S> {
    /// A trajectory of consecutive steps without gaps, in the extended model and for any motion of the support.
    ///
    /// # Panics
    /// If there are no steps.
    pub fn under(wider: Wider, support: Support, steps: Vec<S>) -> Self {
        assert!(!steps.is_empty(), "a trajectory has at least one step");
        Self { support, wider, steps }
    }

    /// A trajectory whose first step is still to be [added](Self::push).
    pub(crate) fn begun(wider: Wider, support: Support) -> Self {
        Self { support, wider, steps: vec![] }
    }

    /// Adds a step at the end.
    pub(crate) fn push(&mut self, step: S) {
        self.steps.push(step);
    }

    /// The motion of the support.
    pub fn support(&self) -> &Support {
        &self.support
    }

    /// Parameters of the extended model.
    pub fn wider(&self) -> &Wider {
        &self.wider
    }

    /// The steps, in order.
    pub fn steps(&self) -> &[S] {
        &self.steps
    }

    /// Start time.
    pub fn start(&self) -> f64 {
        self.steps[0].as_ref().t
    }

    /// End time.
    pub fn end(&self) -> f64 {
        self.steps[self.steps.len() - 1].as_ref().end()
    }

    /// R(t) - x0(t).
    pub fn lag(&self, t: f64) -> f64 {
        self.step_at(t).as_ref().lag(&self.support, t)
    }

    /// x0(t).
    pub fn x0(&self, t: f64) -> f64 {
        self.step_at(t).as_ref().position(&self.support, t)
    }

    /// As [`Step::followed`].
    pub fn followed(&self, t: f64) -> f64 {
        self.step_at(t).as_ref().followed(&self.support, t)
    }

    /// The height of the surface under the tip; `None` without a depth limit.
    pub fn height(&self, t: f64) -> Option<f64> {
        self.step_at(t).as_ref().height(t)
    }

    /// The step that contains t; the first one for earlier t, the last one for later t.
    pub fn step_at(&self, t: f64) -> &S {
        let after = self.steps.partition_point(|step| step.as_ref().t <= t);
        &self.steps[after.max(1) - 1]
    }
}

impl Trajectory {
    /// A trajectory of consecutive steps without gaps, for support velocity r.
    ///
    /// # Panics
    /// If there are no steps.
    pub fn new(r: f64, steps: Vec<Step>) -> Self {
        Self::under(Wider::default(), Support::Moving(r), steps)
    }

    /// Velocity of the support at the start.
    pub fn r(&self) -> f64 {
        self.support.velocity(self.start())
    }

    /// l(t) = rt - r - x0(t). Outside of the run, the first or last step is extrapolated.
    pub fn l(&self, t: f64) -> f64 {
        self.step_at(t).l(self.r(), t)
    }

    /// x0'(t), the derivative of the stage polynomial: one order less accurate than x0.
    pub fn velocity(&self, t: f64) -> f64 {
        self.step_at(t).velocity(t)
    }

    /// Where the tip was until time t, and for how long: positions and weights such that ∫_{start}^t w(t')
    /// e^{-(t-t')/T} g(x0(t'))dt' = Σ `w_j` g(`x_j`), with w and T of the extended model.
    pub fn residence(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let room = STAGES * self.steps.len();
        let (mut positions, mut weights) = (Vec::with_capacity(room), Vec::with_capacity(room));
        for step in self.steps.iter().take_while(|step| step.t < t) {
            let origin = self.support.position(step.t) - step.extension;
            step.each_moment(&self.wider, t, |moment| {
                positions.push(origin + moment.value(&step.displacement));
                weights.push(moment.weight);
            });
        }
        (positions, weights)
    }

    /// The residence of the whole motion with weights that do not depend on the time of the surface: positions and
    /// weights such that ∫ w(t') e^{(R - x0)/(rT)} g(x0(t'))dt' = e^s Σ `w_j` g(`x_j`), and the exponent s of the
    /// largest factor. At time t the surface behind a support of constant velocity r is then -α e^{-(R(t) - x)/(rT)} ∫
    /// w e^{(R - x0)/(rT)} f(x - x0) e^{-(x - x0)/(rT)} dt'. Without healing all exponentials are 1.
    pub fn residence_unfaded(&self) -> (Vec<f64>, Vec<f64>, f64) {
        let rate = self.wider.fading(self.r());
        let (mut positions, mut weights, mut exponents) = (vec![], vec![], vec![]);
        for step in &self.steps {
            let (start, spent) = (self.support.position(step.t), step.weights(&self.wider));
            let ahead = RADAU.c.map(|c| self.r() * c * step.h);
            let nodes = step.displacement.into_iter().zip(ahead).zip(RADAU.b().iter().zip(spent));
            for ((d, ahead), (b, spent)) in nodes {
                positions.push(start - step.extension + d);
                weights.push(b * step.h * spent);
                exponents.push(rate * (step.extension + ahead - d));
            }
        }
        let largest = exponents.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let factors = exponents.iter().map(|exponent| exp(exponent - largest));
        weights.iter_mut().zip(factors).for_each(|(weight, factor)| *weight *= factor);
        (positions, weights, largest)
    }
}
