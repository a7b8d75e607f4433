//! The most efficient grid, for sums of Gaussians: one narrower Gaussian for writing, and one for reading.

use crate::GridError;
use crate::bell::Bell;
use crate::patch::Patch;
use crate::scheme::Scheme;

/// `amplitude` · exp(-(x - `center`)²/2`width`²)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaussian {
    /// a
    pub amplitude: f64,
    /// c
    pub center: f64,
    /// w > 0
    pub width: f64,
}

impl Gaussian {
    /// Checks that there are Gaussians, of finite numbers and widths above 0.
    pub(crate) fn check(all: &[Self]) -> Result<(), GridError> {
        let usable = |g: &Self| {
            g.amplitude.is_finite() && g.center.is_finite() && g.width.is_finite() && g.width > 0.0
        };
        if all.is_empty() || !all.iter().all(usable) { Err(GridError::Gaussians) } else { Ok(()) }
    }
}

/// Every term of f is the convolution of a Gaussian of variance W²/2 (reading; W the smallest width)
/// with one of variance w² - W²/2 (writing), and the convolution may be replaced by a sum over the
/// cells. For W = w = 1:
///
/// exp(-(x-y)²/2) = √(2/π) h Σ_j exp(-(x-x_j)²) exp(-(x_j-y)²) (1 + ε),  |ε| ≤ 2 exp(-π²/2h²).
///
/// Cells contain w_j with w_j' = -α g(x_j - x0), g the sum of the writing Gaussians; then u(x) = u0(x) + h Σ_j G(x -
/// x_j) w_j with the reading Gaussian G. For an error at round-off, samples of u would need interpolation over tens of
/// cells, but w_j only within 6.3 W. h = W π/8.7 gives 7e-17.
pub(crate) struct Theta {
    spacing: f64,
    read: Bell,
    /// 1/(variance of reading)
    read_steepness: f64,
    /// h G(0)
    read_factor: f64,
    write: Vec<(f64, f64, Bell)>,
}

impl Theta {
    /// The scheme with `spacing` in units of the smallest width.
    pub(crate) fn new(gaussians: &[Gaussian], spacing: f64) -> Result<Self, GridError> {
        Gaussian::check(gaussians)?;
        let width = gaussians.iter().fold(f64::INFINITY, |w, g| w.min(g.width));
        Ok(Self::read_by(width, gaussians, spacing))
    }

    /// The scheme that reads with a Gaussian of variance W²/2 for W = `width`, at most the smallest width; `spacing` is in
    /// units of W.
    pub(crate) fn read_by(width: f64, gaussians: &[Gaussian], spacing: f64) -> Self {
        let half = 0.5 * width * width;
        let spacing = spacing * width;
        let write = |g: &Gaussian| {
            let narrowed = (g.width * g.width - half).sqrt();
            (g.amplitude * g.width / narrowed, g.center, Bell::new(narrowed, spacing))
        };
        Self {
            spacing,
            read: Bell::new(half.sqrt(), spacing),
            read_steepness: 1.0 / half,
            read_factor: spacing / (half * std::f64::consts::TAU).sqrt(),
            write: gaussians.iter().map(write).collect(),
        }
    }
}

impl Scheme for Theta {
    fn spacing(&self) -> f64 {
        self.spacing
    }

    fn imprint(&self, tip: f64, out: &mut Patch) {
        let ends = self.write.iter().fold((i64::MAX, i64::MIN), |(first, last), (_, c, bell)| {
            let (nearest, half) = (bell.nearest(tip + c), bell.half_width() as i64);
            (first.min(nearest - half), last.max(nearest + half))
        });
        out.reset(ends.0, (ends.1 + 1 - ends.0) as usize);
        for (amplitude, center, bell) in &self.write {
            bell.add(*amplitude, tip + center, out);
        }
    }

    fn slope_stencil(&self, x: f64, out: &mut Patch) {
        self.height_stencil(x, out);
        // -(x - x_j)/variance, from the nearest cell outwards so that the subtraction is exact there.
        let middle = out.first + self.read.half_width() as i64;
        let off_center = x - middle as f64 * self.spacing;
        let mut cell = -(self.read.half_width() as f64);
        for weight in &mut out.values {
            *weight *= (cell * self.spacing - off_center) * self.read_steepness;
            cell += 1.0;
        }
    }

    fn height_stencil(&self, x: f64, out: &mut Patch) {
        let half = self.read.half_width();
        out.reset(self.read.nearest(x) - half as i64, 2 * half + 1);
        self.read.add(self.read_factor, x, out);
    }
}
