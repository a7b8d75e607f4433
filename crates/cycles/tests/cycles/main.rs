//! What cycles are held to: linearised runs, and runs under the wider law.

mod multipliers;
mod wider;
