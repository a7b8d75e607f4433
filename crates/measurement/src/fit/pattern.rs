//! How ripples repeat: once per slip or, beyond a period doubling, after two; and with the strongest wave of the data,
//! or, where slips are short beside the time between them, after several lengths of it.

/// A way in which ripples repeat.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pattern {
    /// Number of slips in a wavelength.
    pub(super) slips: usize,
    /// The wavelength over that of the strongest wave of the data.
    pub(super) waves: usize,
}

/// The pattern of most ripples.
pub(super) const ONE: Pattern = Pattern { slips: 1, waves: 1 };

impl Pattern {
    /// Step of ln α and ln r in differences. Towards trapping wavelengths change with high powers of α:
    /// at α = 1.9 and r = 1, by 25 % for 1 %, and many of them lie along a track.
    pub(super) fn step(self) -> f64 {
        if self == ONE { 5e-4 } else { 1e-5 }
    }

    /// Residual of (18) of cycles, in kσ/Γ: its effect is far below the noise of any data, and below the differences that
    /// give derivatives.
    pub(super) fn tolerance(self) -> f64 {
        if self == ONE { 1e-6 } else { 1e-9 }
    }
}
