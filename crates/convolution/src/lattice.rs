//! Position on the lattice, without loss of accuracy far from the origin.

/// Bits of a spacing's mantissa: with six, rounding down costs at most one part in 32, and `cell · spacing` is exact
/// up to 2⁴⁷ cells.
const SPACING_BITS: i32 = 6;

/// The largest number with [`SPACING_BITS`] significant bits that is not above `limit`.
pub(crate) fn dyadic_at_most(limit: f64) -> f64 {
    let (_, exponent) = libm::frexp(limit);
    let unit = libm::ldexp(1.0, exponent - SPACING_BITS);
    (limit / unit).floor() * unit
}

/// The lattice of points `cell · spacing`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lattice {
    pub(crate) spacing: f64,
    pub(crate) per_unit: f64,
}

impl Lattice {
    pub(crate) fn new(spacing: f64) -> Self {
        Self { spacing, per_unit: 1.0 / spacing }
    }

    /// The cell at or below `position`, and the distance of the position from it, in spacings.
    ///
    /// The offset is computed from `position − cell·spacing`, which is exact for a dyadic spacing, and not from the
    /// fraction of `position/spacing`, which loses a digit for every tenfold distance from the origin. It may leave
    /// [0, 1] by round-off.
    #[inline]
    pub(crate) fn locate(&self, position: f64) -> (i64, f64) {
        let scaled = position * self.per_unit;
        let truncated = scaled as i64;
        let cell = truncated - i64::from(truncated as f64 > scaled);
        let offset = (position - cell as f64 * self.spacing) * self.per_unit;
        (cell, offset)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacings_are_rounded_down_by_less_than_one_part_in_32() {
        for limit in [1e-3, 0.18, 0.25, 1.0, 1.2566, 77.7] {
            let spacing = dyadic_at_most(limit);
            assert!(spacing <= limit && spacing > limit * (1.0 - 1.0 / 32.0), "{limit}: {spacing}");
        }
    }

    #[test]
    fn offsets_keep_every_digit_far_from_the_origin() {
        let lattice = Lattice::new(dyadic_at_most(0.18));
        let small = 0.0625 + 1.0 / 1024.0;
        let far = 3e7 * lattice.spacing;
        let (near_cell, near_offset) = lattice.locate(small);
        let (far_cell, far_offset) = lattice.locate(far + small);
        assert_eq!(far_cell - near_cell, 30_000_000);
        assert_eq!(far_offset.to_bits(), near_offset.to_bits());
    }

    #[test]
    fn negative_positions_lie_above_their_cell() {
        let (cell, offset) = Lattice::new(0.25).locate(-0.0625);
        assert_eq!(cell, -1);
        assert!((offset - 0.75).abs() < 1e-16);
    }
}
