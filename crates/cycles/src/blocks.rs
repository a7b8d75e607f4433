//! Vectors and matrices of the stages of a step.

use nalgebra::{SMatrix, SVector};
use stickslip_tip::collocation::STAGES;

pub(super) type Square = SMatrix<f64, STAGES, STAGES>;
pub(super) type Vector = SVector<f64, STAGES>;
