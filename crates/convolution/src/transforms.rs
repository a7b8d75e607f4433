//! Fourier transforms of the cells of a lattice, and back.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

/// The Fourier transform of complex sequences of one length N: `F_k = Σ_n f_n e^{-2πikn/N}`.
#[derive(Clone)]
pub struct Transform(Arc<dyn Fft<f64>>);

impl Transform {
    /// The transform of this length.
    pub fn new(length: usize) -> Self {
        Self(FftPlanner::new().plan_fft_forward(length))
    }

    /// The length N.
    pub fn length(&self) -> usize {
        self.0.len()
    }

    /// Replaces a sequence by its transform.
    ///
    /// # Panics
    /// The sequence has another length.
    pub fn of(&self, sequence: &mut [Complex<f64>]) {
        assert_eq!(sequence.len(), self.length(), "length of a transform");
        self.0.process(sequence);
    }
}

/// Transforms of one length, with the room that they need.
#[derive(Clone)]
pub(crate) struct Transforms {
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    pub(crate) modes: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Transforms {
    pub(crate) fn new(length: usize) -> Self {
        let mut planner = RealFftPlanner::new();
        let forward = planner.plan_fft_forward(length);
        let backward = planner.plan_fft_inverse(length);
        let needed = forward.get_scratch_len().max(backward.get_scratch_len());
        let scratch = vec![Complex::default(); needed];
        Self { modes: forward.make_output_vec(), forward, backward, scratch }
    }

    /// Sets the modes to the transform of these cells, and overwrites the cells.
    pub(crate) fn forward(&mut self, cells: &mut [f64]) {
        self.forward
            .process_with_scratch(cells, &mut self.modes, &mut self.scratch)
            .expect("buffers have the lengths of the plan");
    }

    /// Sets the cells to the inverse transform of the first `kept` modes, and overwrites the modes. Both transforms
    /// together multiply by the length.
    pub(crate) fn backward(&mut self, kept: usize, cells: &mut [f64]) {
        self.modes[kept..].fill(Complex::default());
        // A sum of reals; said so because the transform back refuses anything else here.
        self.modes[0].im = 0.0;
        self.backward
            .process_with_scratch(&mut self.modes, cells, &mut self.scratch)
            .expect("buffers have the lengths of the plan");
    }
}
