//! Circular orbits of walkers: radii, frequencies and growth exponents.
//!
//! On a circle of radius ρ with angular frequency ω, the position a time τ earlier is at the distance 2ρ |sin ωτ/2|, and
//! J0(2ρ sin ωτ/2) = Σ `J_m`(ρ)² cos mωτ (Neumann's addition theorem, m over all integers). With the healing time T, the
//! inertia M, the rotation Ω and the trap K, the forces along the orbit and towards its center balance if
//!
//! ```text
//!     ρ² = -2αT² Σ_{m≥1} m² J_m(ρ)²/(1 + (mωT)²)
//!     0 = M ρω² + F(ρ) + Ω ρω - K ρ,   F = αT Σ_m J_m(ρ) J_m'(ρ)/(1 + (mωT)²)
//! ```
//!
//! The right side of the first equation falls as |ω| rises, and is -αT²ρ²/2 at ω = 0: for -αT² > 2, where a free particle
//! walks, there is one |ω| for each radius. If the memory is long, ωT → ∞, F tends to -αT J0(ρ) J1(ρ), and weak forces keep
//! the particle near the zeros of J0 and J1 only: the orbits are quantised.

use crate::crossings::zeros;
use nalgebra::DMatrix;
use num_complex::Complex64;
use stickslip_tip::eigenvalues;
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::tip_function::bessel_orders;
use stickslip_tip::walker::{WalkerScenario, directions};

/// A circular orbit about the origin, in the units of its [`WalkerScenario`].
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// Radius ρ.
    pub radius: f64,
    /// Angular frequency ω, above 0 if the orbit is counterclockwise.
    pub frequency: f64,
    /// Growth exponents of small deviations, by falling real part; `None` if the memory is too long for them. 0 belongs to
    /// a shift along the orbit, and without a trap ±iω to a shift of its center.
    pub exponents: Option<Vec<Complex64>>,
}

/// Spacing of radii between which sign changes are searched for.
const SPACING: f64 = 0.02;
/// Largest number of angular modes for which exponents are computed.
const MOST_MODES: usize = 160;
/// Error at which the angular modes are truncated.
const ERROR_OF_MODES: f64 = 1e-12;
/// Largest real part of a neutral exponent, in units of 1/T.
const NEUTRAL: f64 = 1e-7;

impl Orbit {
    /// |ρω|
    pub fn speed(&self) -> f64 {
        (self.radius * self.frequency).abs()
    }

    /// Number of exponents right of the imaginary axis; `None` without [`exponents`](Self::exponents).
    pub fn unstable_count(&self, scenario: &WalkerScenario) -> Option<usize> {
        let grows = |z: &&Complex64| z.re * scenario.healing_time > NEUTRAL;
        Some(self.exponents.as_ref()?.iter().filter(grows).count())
    }
}

/// All circular orbits with radii up to `largest`, by rising radius. Without rotation the two senses are alike, and only
/// the counterclockwise orbits are given. Two orbits of one sense whose radii differ by less than 0.02 may both be missed.
/// There are none if a free particle does not walk, -αT² ≤ 2.
pub fn orbits(scenario: &WalkerScenario, largest: f64) -> Vec<Orbit> {
    if scenario.free_speed() <= 0.0 {
        return vec![];
    }
    // Without rotation the mirror image is an orbit too.
    let turns: &[f64] = if scenario.rotation.abs() > 0.0 { &[-1.0, 1.0] } else { &[1.0] };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let count = (largest / SPACING).ceil().max(0.0) as usize;
    let mut found = vec![];
    for turn in turns {
        let balance = |radius: f64| inward(scenario, radius, turn * frequency(scenario, radius));
        let samples: Vec<(f64, f64)> = (1..=count)
            .map(|i| largest * i as f64 / count as f64)
            .map(|radius| (radius, balance(radius)))
            .collect();
        for radius in zeros(balance, &samples) {
            let frequency = turn * frequency(scenario, radius);
            let exponents = exponents(scenario, radius, frequency);
            found.push(Orbit { radius, frequency, exponents });
        }
    }
    sort_by_number(&mut found, |item| item.radius);
    found
}

/// |ω| of motion on a circle, from the balance along it.
fn frequency(scenario: &WalkerScenario, radius: f64) -> f64 {
    let orders = bessel_orders(radius);
    let time = scenario.healing_time;
    let strength = -2.0 * scenario.alpha * time * time / (radius * radius);
    let squares: Vec<(f64, f64)> =
        (1..).zip(&orders[1..]).map(|(m, j)| (f64::from(m).powi(2), j * j)).collect();
    let excess = |q: f64| -> f64 {
        let terms = squares.iter().map(|(square, j)| square * j / (1.0 + square * q));
        strength * terms.sum::<f64>() - 1.0
    };
    // Each term is below j/q.
    let largest = strength * squares.iter().map(|(_, j)| j).sum::<f64>();
    stickslip_tip::roots::zero_between(excess, 0.0, largest).max(0.0).sqrt() / time
}

/// The sum of the forces on the particle, positive if away from the center.
fn inward(scenario: &WalkerScenario, radius: f64, frequency: f64) -> f64 {
    let orders = bessel_orders(radius);
    let at = |m: usize| orders.get(m).copied().unwrap_or(0.0);
    let field = |m: usize| {
        let slope = if m == 0 { -at(1) } else { 0.5 * (at(m - 1) - at(m + 1)) };
        let both = if m == 0 { 1.0 } else { 2.0 };
        let phase = m as f64 * frequency * scenario.healing_time;
        both * at(m) * slope / (1.0 + phase * phase)
    };
    let field: f64 = (0..orders.len()).map(field).sum();
    let speed = radius * frequency;
    let inertia = scenario.inertia.unwrap_or(0.0);
    inertia * speed * frequency
        + scenario.alpha * scenario.healing_time * field
        + scenario.rotation * speed
        - scenario.trap * radius
}

/// The walker in a frame that turns with its orbit. The position X and the velocity V are complex numbers, and the field
/// z(ψ) of `tip::walker` is expanded in angular modes, z = Σ `a_m` e^{imψ}:
///
/// ```text
///     a_m' = δ_m0 - a_m/T + (i/2) (V* a_{m-1} + V a_{m+1}) + iωm a_m,   a_{-m} = (-1)^m a_m*
///     (1 + iΩ) V = P  or  M V' = P - (1 + iΩ + iωM) V,   P = -iα a_1* - K X,   X' = V - iωX
/// ```
struct Turning<'a> {
    scenario: &'a WalkerScenario,
    frequency: f64,
    /// Largest m.
    modes: usize,
}

impl Turning<'_> {
    /// Number of real unknowns: X, V with inertia, a_0, and real and imaginary part of each further mode.
    fn len(&self) -> usize {
        self.first() + 1 + 2 * self.modes
    }

    /// Index of a_0.
    fn first(&self) -> usize {
        if self.scenario.inertia.is_some() { 4 } else { 2 }
    }

    fn mode(&self, state: &[f64], m: usize) -> Complex64 {
        let first = self.first();
        match m {
            0 => state[first].into(),
            m if m <= self.modes => Complex64::new(state[first + 2 * m - 1], state[first + 2 * m]),
            _ => Complex64::ZERO,
        }
    }

    /// The orbit itself: `a_m` = i^m Σ_n `J_{m+n}` `J_n`/(1/T + inω).
    fn orbit(&self, radius: f64) -> Vec<f64> {
        let orders = bessel_orders(radius);
        let order = |n: i64| {
            let size = usize::try_from(n.abs()).ok().and_then(|n| orders.get(n)).copied();
            let sign = if n < 0 && n % 2 != 0 { -1.0 } else { 1.0 };
            sign * size.unwrap_or(0.0)
        };
        let healing = 1.0 / self.scenario.healing_time;
        let reach = i64::try_from(orders.len()).unwrap_or(i64::MAX);
        let mut state = vec![radius, 0.0];
        if self.scenario.inertia.is_some() {
            state.extend([0.0, radius * self.frequency]);
        }
        for m in 0..=i64::try_from(self.modes).unwrap_or(i64::MAX) {
            let term = |n: i64| {
                order(m + n) * order(n) / Complex64::new(healing, n as f64 * self.frequency)
            };
            let quarter = [Complex64::ONE, Complex64::I, -Complex64::ONE, -Complex64::I];
            let mode = quarter[(m % 4) as usize] * (-reach..=reach).map(term).sum::<Complex64>();
            state.push(mode.re);
            if m > 0 {
                state.push(mode.im);
            }
        }
        state
    }

    fn rates(&self, state: &[f64]) -> Vec<f64> {
        let WalkerScenario { alpha, rotation, trap, inertia, healing_time, .. } = *self.scenario;
        let (i, omega) = (Complex64::I, self.frequency);
        let position = Complex64::new(state[0], state[1]);
        let force = -i * alpha * self.mode(state, 1).conj() - trap * position;
        let yields = 1.0 + i * rotation;
        let (velocity, gained) = match inertia {
            None => (force / yields, None),
            Some(mass) => {
                let velocity = Complex64::new(state[2], state[3]);
                (velocity, Some((force - yields * velocity) / mass - i * omega * velocity))
            }
        };
        let moved = velocity - i * omega * position;
        let mut rates = vec![moved.re, moved.im];
        rates.extend(gained.iter().flat_map(|gained| [gained.re, gained.im]));
        for m in 0..=self.modes {
            let (own, above) = (self.mode(state, m), self.mode(state, m + 1));
            let below = if m == 0 { -above.conj() } else { self.mode(state, m - 1) };
            let carried = 0.5 * i * (velocity.conj() * below + velocity * above);
            let turned = i * omega * m as f64 * own;
            let source = if m == 0 { 1.0 } else { 0.0 };
            let rate = source - own / healing_time + carried + turned;
            rates.push(rate.re);
            if m > 0 {
                rates.push(rate.im);
            }
        }
        rates
    }
}

/// The growth exponents of an orbit, by falling real part.
fn exponents(scenario: &WalkerScenario, radius: f64, frequency: f64) -> Option<Vec<Complex64>> {
    let range = radius * frequency.abs() * scenario.healing_time;
    // What the modes from m on do to the first ones goes through them twice.
    let modes = directions(range, ERROR_OF_MODES)? / 2;
    if modes > MOST_MODES {
        return None;
    }
    let turning = Turning { scenario, frequency, modes };
    let orbit = turning.orbit(radius);
    let mut matrix = DMatrix::zeros(turning.len(), turning.len());
    for (column, mut change) in matrix.column_iter_mut().enumerate() {
        // The rates are quadratic in the unknowns, for which central differences are exact.
        let moved = |by: f64| {
            let mut state = orbit.clone();
            state[column] += by;
            turning.rates(&state)
        };
        let pairs = moved(1.0).into_iter().zip(moved(-1.0));
        change.iter_mut().zip(pairs).for_each(|(change, (a, b))| *change = 0.5 * (a - b));
    }
    let mut found = eigenvalues(matrix)?;
    sort_by_number(&mut found, |z| -z.im);
    sort_by_number(&mut found, |z| -z.re);
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An orbit is at rest in the frame that turns with it.
    #[test]
    fn orbits_are_fixed_points_of_the_modes() {
        for (inertia, rotation, trap) in
            [(None, 0.3, 0.0), (Some(0.6), 0.5, 0.0), (Some(0.3), 0.0, 0.2), (None, -0.2, 0.1)]
        {
            let scenario =
                WalkerScenario { inertia, rotation, trap, ..WalkerScenario::new(-3.0, 1.0, 1.0) };
            let found = orbits(&scenario, 12.0);
            assert!(!found.is_empty());
            for orbit in found {
                let turning =
                    Turning { scenario: &scenario, frequency: orbit.frequency, modes: 60 };
                let rates = turning.rates(&turning.orbit(orbit.radius));
                let worst = rates.iter().fold(0.0_f64, |worst, rate| worst.max(rate.abs()));
                println!("{} {}: {worst:e}", orbit.radius, orbit.frequency);
                assert!(worst < 1e-11, "{orbit:?}: {worst:e}");
                let neutral = |z: Complex64| {
                    let all = orbit.exponents.as_ref().unwrap().iter();
                    all.map(|root| (root - z).norm()).fold(f64::INFINITY, f64::min)
                };
                assert!(neutral(Complex64::ZERO) < 1e-7);
                assert!(trap > 0.0 || neutral(Complex64::new(0.0, orbit.frequency)) < 1e-7);
            }
        }
    }
}
