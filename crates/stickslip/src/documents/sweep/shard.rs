//! Which points of a grid are computed here.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Part `index` of `of`: the points whose index is `index` - 1 modulo `of`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShardDocument {
    /// From 1 to `of`.
    pub index: usize,
    /// Number of parts.
    pub of: usize,
}

impl ShardDocument {
    /// The one part of what is not divided.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// Whether the point of this index is one of this part.
    #[must_use]
    pub fn has(self, index: usize) -> bool {
        index.checked_rem(self.of).is_some_and(|rest| rest + 1 == self.index)
    }

    /// The indices of this part of so many points.
    pub fn indices(self, points: usize) -> impl Iterator<Item = usize> + use<> {
        (self.index.saturating_sub(1)..points).step_by(self.of.max(1))
    }
}
