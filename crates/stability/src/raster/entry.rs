//! Entries of the matrix N of `determinant.rs`: functions of q, some of them multiplied by sums over the earlier lines.

use super::patch::Patch;

/// own + Σ_l `lines`_l Λ_l, where `own` and `lines` are functions of q on an interval.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) own: Patch,
    pub(super) lines: Vec<Patch>,
    /// Order of the derivative of h in Λ = Σ_j c^j h(jd) w^j.
    pub(super) order: usize,
}

impl Entry {
    /// An entry with Λ of h itself, of order 0.
    pub(super) fn level(own: Patch, lines: Vec<Patch>) -> Self {
        Self { own, lines, order: 0 }
    }

    /// The value of the entry, given Λ_l of h, h' and h''.
    pub(super) fn with(&self, sums: &[Vec<Patch>]) -> Patch {
        self.own + self.felt(sums)
    }

    pub(super) fn felt(&self, sums: &[Vec<Patch>]) -> Patch {
        let sums = sums.get(self.order).map_or(&[][..], Vec::as_slice);
        let each = self.lines.iter().zip(sums);
        each.fold(Patch::constant(0.0), |felt, (line, sum)| felt + *line * *sum)
    }

    pub(super) fn conj(&self) -> Self {
        let lines = self.lines.iter().map(|l| l.conj()).collect();
        Self { own: self.own.conj(), lines, order: self.order }
    }
}
