//! What the grids are held to. The chain of trust: closed forms judge every grid (`hand_checked`,
//! `steady_state`, `conservation`); the two spectral grids, which share only the stepper, judge each other
//! (`spectral`); the better of them at tight tolerance judges the second-order grids (`order`); and the
//! crate's stepper judges ours (`agreement`). The grids of one coordinate judge those of the plane (`plane`).

mod agreement;
mod by_crate;
mod common;
mod conservation;
mod hand_checked;
mod onset;
mod order;
mod plane;
mod refusals;
mod spectral;
mod steady_state;
