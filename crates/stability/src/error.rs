//! Errors of the linear-stability functions.

use thiserror::Error;

/// An error of a linear-stability function.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum StabilityError {
    /// r must be finite and > 0.
    #[error("r is {0:?}: the dimensionless support velocity (12) must be a finite number > 0")]
    R(f64),
    /// The requested quantity requires a finite α > 0.
    #[error("alpha is {0:?}: the dimensionless indentation rate (13) must be a finite number > 0")]
    Alpha(f64),
    /// κ_y must be finite and > 0, and at least 1e-9 of r: round-off hides a smaller one.
    #[error(
        "the stiffness across is {0:?}: it must be a finite number above 0, in units of that along, and no less than 1e-9 of r"
    )]
    StiffnessAcross(f64),
    /// Growth exponents across the scan were requested for J0 or cos x.
    #[error("growth exponents across the scan are available for sums of Gaussians only")]
    AcrossGaussiansOnly,
    /// No root reaches the imaginary axis, however large α.
    #[error(
        "steady motion with this tip function at r = {r:?} is stable for every alpha: no root reaches the imaginary axis"
    )]
    NoCrossing {
        /// The requested support velocity.
        r: f64,
    },
    /// Steady motion does not lose its stability at any r for this α.
    #[error("no r makes alpha = {alpha:?} critical for this tip function")]
    NoCriticalR {
        /// The requested indentation rate.
        alpha: f64,
    },
    /// The bound on Re λ must be finite.
    #[error("the bound on Re λ is {0:?}: it must be a finite number")]
    Bound(f64),
    /// A root lies on the line along which roots are counted.
    #[error("a root lies on the line Re λ = {re:?}, or too close to it to count: move the bound")]
    RootOnContour {
        /// Re λ of this line.
        re: f64,
    },
    /// α, r and the size of the tip differ so much that the roots cannot be counted or separated in floating point.
    #[error(
        "the roots at alpha = {alpha:?} and r = {r:?} lie too far apart to be counted: for a tip of height and width 1, alpha/r² should be between 1e-50 and 1e14, and r below 1e12"
    )]
    TooFarApart {
        /// The requested indentation rate.
        alpha: f64,
        /// The requested support velocity.
        r: f64,
    },
    /// Fewer roots were found than counted.
    #[error(
        "{counted} roots were counted but {found} found: they lie too close together, move the bound"
    )]
    RootsMissing {
        /// Number of roots by the argument principle.
        counted: usize,
        /// Number of roots by Newton's method.
        found: usize,
    },
    /// The coefficients of the amplitude equation are infinite or vanish.
    #[error("the bifurcation at r = {r:?} is degenerate: its leading order does not decide there")]
    DegenerateOnset {
        /// The requested support velocity.
        r: f64,
    },
    /// The amplitude, center or width of a pulse is invalid.
    #[error(
        "pulse number {index}: amplitude, center and width must be finite and the width, {width:?}, above 0"
    )]
    Pulse {
        /// Number of the pulse, from 1.
        index: usize,
        /// Width of this pulse.
        width: f64,
    },
    /// The pitch is not a positive finite number, or so small that the scan lines within reach are too many to sum.
    #[error(
        "the pitch is {0:?}: the distance of scan lines must be a finite number above 0, and no less than 1e-5 of the reach of the tip across them"
    )]
    Pitch(f64),
    /// The search for a threshold needs too many cells of wave numbers and phases.
    #[error(
        "the threshold of the raster is not certain: {cells} cells of wave numbers and phases did not suffice to rule out a lower one"
    )]
    Uncertified {
        /// Number of cells examined.
        cells: usize,
    },
    /// The threshold of a raster was requested for J0 or cos x.
    #[error(
        "thresholds of rasters are available for sums of Gaussians only: the Fourier transform of this tip function is infinite at the wave number 1, and so is the response of a line to ripples of the lines before it"
    )]
    NoRipples,
    /// The threshold of a zigzag was requested for a healing surface.
    #[error(
        "a zigzag over a healing surface has no threshold of this form: the time since the previous line passed a place varies along the line, so that waves e^(iqx) do not decouple; scan one way, or leave the healing time out"
    )]
    HealingZigzag,
    /// A request to stop: [`stickslip_tip::stop`].
    #[error("stopped before it was found")]
    Stopped,
    /// p ∫e^{-ps}(-f')ds is nowhere positive: nothing can hold the tip.
    #[error("this tip function cannot trap the tip at any alpha")]
    NoTrapping,
    /// A tip without a spring is not dragged.
    #[error(
        "without a spring there is no steady motion behind a support: the tip rests or walks at a speed of its own"
    )]
    NoSupport,
    /// A tip with a spring does not walk.
    #[error("a tip on a spring does not walk: its steady motion is that of the support")]
    Dragged,
    /// In steady motion the height h under the tip is 0, where |h| of the depth limit has a kink.
    #[error(
        "in steady motion the height under this tip is 0, where |h| of the depth limit (61) has a corner: small deviations obey no linear law there, and there are no growth exponents"
    )]
    Corner,
    /// The iteration for the harmonics of |h| did not converge.
    #[error(
        "at the depth limit {limit:?} the harmonics of |h| are too strong for harmonic balance to find the onset of the oscillation: take a larger b"
    )]
    Unsettled {
        /// The depth limit b.
        limit: f64,
    },
    /// The bound is too far left for J0, whose transforms have branch points.
    #[error(
        "for J0 in this model roots can be counted only to the right of its branch points, Re λ ≥ {least:?}, not from {bound:?}"
    )]
    BranchPoints {
        /// The smallest admissible bound: -1/T with the healing time T, or 0 without healing.
        least: f64,
        /// The requested bound.
        bound: f64,
    },
    /// A parameter of the extended model is out of range.
    #[error(transparent)]
    Wider(#[from] stickslip_tip::WiderError),
    /// The quantity is available for the basic model only.
    #[error("{0} is available for the basic model only, without depth limit, healing and inertia")]
    PapersLawOnly(&'static str),
    /// The quantity is available for even footprints only.
    #[error("{0} is available only for a footprint with two equal sides: give one side of it")]
    EvenOnly(&'static str),
    /// The requested limit does not exist, for the reason in the text.
    #[error("{0}")]
    NoLimit(&'static str),
}

impl StabilityError {
    /// An error for an r that is not a positive finite number.
    pub(super) fn unless_positive(r: f64) -> Result<(), Self> {
        if r.is_finite() && r > 0.0 { Ok(()) } else { Err(Self::R(r)) }
    }
}
