//! Parts (shards) of a grid that are computed separately.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Part `index` of `of`: the points whose index is `index` - 1 modulo `of`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShardDocument {
    /// Index of the part, from 1 to `of`.
    pub index: usize,
    /// Number of parts.
    pub of: usize,
}

impl ShardDocument {
    /// The single part of a grid that is not divided.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// Whether the point with this index belongs to this part.
    #[must_use]
    pub fn has(self, index: usize) -> bool {
        index.checked_rem(self.of).is_some_and(|rest| rest + 1 == self.index)
    }

    /// The indices of the points in this part, for the given total number.
    pub fn indices(self, points: usize) -> impl Iterator<Item = usize> + use<> {
        (self.index.saturating_sub(1)..points).step_by(self.of.max(1))
    }
}
