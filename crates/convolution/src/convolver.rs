//! Convolution: transform, multiply, transform back.

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use crate::transforms::Transforms;
use crate::window::Window;
use crate::{Density, Field, Kernel, Plan};

/// A prepared kernel: its transform divided by φ̂², with φ the spreading window of the [crate](crate), and plans of the
/// Fourier transforms.
///
/// **Requirements on the window of cells.** One call uses [`length`](Self::length) consecutive cells of the density,
/// called its window, and no others.
/// - A kernel with reach: at targets at least [`margin`](Plan::margin) inside the window the sum is complete, whether
///   or not sources lie outside. A window centered on `x` allows targets up to `(separation − reach)/2` from `x`.
/// - A kernel without reach: all sources must lie in the window, and each target within `separation` of every source.
///
/// [`first_cell_about`](Self::first_cell_about) centers the window.
pub struct Convolver {
    plan: Plan,
    /// `K̂/(length φ̂²)` up to half the Nyquist wavenumber; zero beyond.
    multiplier: Vec<Complex<f64>>,
    transforms: Transforms,
}

impl Convolver {
    /// Prepares the kernel for separations of source and target up to `separation`.
    ///
    /// # Panics
    /// As [`Plan::new`].
    pub fn new(kernel: &Kernel, separation: f64) -> Self {
        Self::with_plan(kernel, Plan::new(kernel, separation))
    }

    /// Prepares the kernel with a given plan, which determines the accuracy.
    ///
    /// # Panics
    /// The length of the plan is not an even product of 2, 3 and 5.
    pub fn with_plan(kernel: &Kernel, plan: Plan) -> Self {
        let mut transforms = Transforms::new(plan.length);
        transforms.forward(&periodic_samples(kernel, &plan));
        let multiplier = deconvolved(&transforms.modes, plan.length);
        Self { plan, multiplier, transforms }
    }

    /// The plan for this kernel.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The spacing required of the density.
    pub fn spacing(&self) -> f64 {
        self.plan.spacing
    }

    /// Number of cells of the window.
    pub fn length(&self) -> usize {
        self.plan.length
    }

    /// The first cell of the window centered on `position`.
    pub fn first_cell_about(&self, position: f64) -> i64 {
        (position / self.plan.spacing).round() as i64 - self.plan.length as i64 / 2
    }

    /// Convolves the window of `density` that starts at `first_cell`, overwriting `field`.
    ///
    /// Allocates only if the field had a shorter window before.
    ///
    /// # Panics
    /// The spacing of the density differs from that of the plan.
    pub fn convolve(&mut self, density: &Density, first_cell: i64, field: &mut Field) {
        let same = density.spacing().to_bits() == self.plan.spacing.to_bits();
        assert!(same, "density of spacing {}, plan of {}", density.spacing(), self.plan.spacing);
        let cells = field.reset(&self.plan, first_cell);
        density.copy_window(first_cell, cells);
        self.transforms.forward(cells);
        for (mode, factor) in self.transforms.modes.iter_mut().zip(&self.multiplier) {
            *mode *= factor;
        }
        self.transforms.backward(cells);
    }
}

/// Periodic samples of the kernel, tapered if necessary, on the length of the window: two images overlap in each
/// cell.
fn periodic_samples(kernel: &Kernel, plan: &Plan) -> Vec<f64> {
    let image = |cell: i64| {
        let x = cell as f64 * plan.spacing;
        if x.abs() > plan.reach {
            return 0.0;
        }
        (kernel.value)(x) * plan.taper.map_or(1.0, |taper| taper.value(x))
    };
    let length = plan.length as i64;
    (0..length).map(|cell| image(cell) + image(cell - length)).collect()
}

/// Divides by φ̂ once for spreading and once for evaluation, and by the length, the factor of both transforms.
fn deconvolved(spectrum: &[Complex<f64>], length: usize) -> Vec<Complex<f64>> {
    let window = Window::shared();
    let divided = |(mode, k): (usize, &Complex<f64>)| {
        let phi = window.transform(TAU * mode as f64 / length as f64);
        k / (length as f64 * phi * phi)
    };
    spectrum.iter().enumerate().map(divided).collect()
}
