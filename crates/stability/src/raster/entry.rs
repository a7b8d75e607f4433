//! Entries of the matrix of two lines beside each other: functions of q, times sums over the earlier lines.

use super::patch::Patch;

/// own + Σ_l `lines`_l Λ_l, a function of q on an interval of it but for Λ.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) own: Patch,
    pub(super) lines: Vec<Patch>,
    /// How often h is differentiated in Λ: Σ_j c^j h(jd) w^j, or with h' or h'' in place of h.
    pub(super) order: usize,
}

impl Entry {
    /// A sum of heights of layers, which push the tip along the lines.
    pub(super) fn level(own: Patch, lines: Vec<Patch>) -> Self {
        Self { own, lines, order: 0 }
    }

    /// Given Λ_l of h, h' and h''.
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
