//! Uncertainty of a profile by Efron's bootstrap: fits to profiles made of a fitted curve and of its resampled
//! residuals, for all plausible numbers of Gaussians.

use super::Request;
use super::answers::{Answers, normalised};
use super::hidden;
use super::search::Candidate;
use crate::Profile;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use rand::RngExt;
use rayon::prelude::*;
use stickslip_tip::{Gaussian, stop};

/// The first stream of random numbers for footprints, separate from those for results.
const FOOTPRINTS: u64 = 1 << 32;

/// Input of the resampling.
#[derive(Debug)]
pub(super) struct Resampling<'a> {
    pub(super) profile: &'a Profile,
    pub(super) request: &'a Request,
    /// Plausible sums of Gaussians.
    pub(super) makers: Vec<&'a Candidate>,
    /// Number of effectively independent rows.
    pub(super) effective: f64,
}

impl Resampling<'_> {
    /// For each plausible sum the results of resampled profiles, `count` in total; `None` for a profile without a
    /// result.
    pub(super) fn draw(&self, count: usize) -> Vec<Vec<Option<Answers>>> {
        let each = count.div_ceil(self.makers.len());
        let flag = stop::flag().unwrap_or_default();
        let of = |(k, maker): (usize, &&Candidate)| {
            let one = |i: usize| self.one((k * each + i) as u64, maker);
            (0..each).into_par_iter().map(|i| stop::with_flag(&flag, || one(i))).collect()
        };
        self.makers.iter().enumerate().map(of).collect()
    }

    /// The given number of plausible footprints, each with an undetected Gaussian.
    pub(super) fn footprints(&self, count: usize) -> Vec<Vec<Gaussian>> {
        let flag = stop::flag().unwrap_or_default();
        let one = |i: usize| {
            let maker = self.makers[i % self.makers.len()];
            let (profile, fitted, mut random) = self.fitted(FOOTPRINTS + i as u64, maker)?;
            let more =
                hidden::drawn(&profile, self.request.centre, &fitted, self.effective, &mut random);
            let of = |candidate: &Candidate| {
                let gaussians = normalised(candidate, self.request.sigma)?.0;
                Answers::of(candidate, self.request.sigma, self.request.r).map(|_| gaussians)
            };
            more.as_ref().and_then(of).or_else(|| of(&fitted))
        };
        let draws = (0..count).into_par_iter().map(|i| stop::with_flag(&flag, || one(i)));
        draws.collect::<Vec<_>>().into_iter().flatten().collect()
    }

    fn one(&self, stream: u64, maker: &Candidate) -> Option<Answers> {
        Answers::of(&self.fitted(stream, maker)?.1, self.request.sigma, self.request.r)
    }

    /// The fit to a resampled profile, and the random numbers for later use.
    fn fitted(&self, stream: u64, maker: &Candidate) -> Option<(Profile, Candidate, ChaCha8Rng)> {
        let mut random = ChaCha8Rng::seed_from_u64(self.request.seed);
        random.set_stream(stream);
        let profile = self.drawn(maker, &mut random);
        let fitted = maker.again(&profile, self.request.centre, self.effective)?;
        Some((profile, fitted, random))
    }

    /// A profile with residuals resampled in blocks as long as their correlation.
    fn drawn(&self, maker: &Candidate, random: &mut ChaCha8Rng) -> Profile {
        let rows = self.profile.x().len();
        let block = block(rows, self.effective);
        let freedom = (rows - maker.parameters.min(rows - 1)) as f64;
        let wider = (rows as f64 / freedom).sqrt();
        let mean = maker.residuals.iter().sum::<f64>() / rows as f64;
        let mut drawn: Vec<f64> = vec![];
        while drawn.len() < rows {
            let start = random.random_range(0..rows);
            // Upside down as often as not: noise has no preference that a sum of Gaussians had left.
            let sign = if random.random::<bool>() { wider } else { -wider };
            let residual = |i: usize| sign * (maker.residuals[(start + i) % rows] - mean);
            drawn.extend((0..block).map(residual));
        }
        let heights = self.profile.x().iter().zip(drawn).map(|(x, e)| maker.height(*x) + e);
        self.profile.with(heights.collect())
    }
}

/// Carlstein's (1986) length of blocks for correlated residuals.
fn block(rows: usize, effective: f64) -> usize {
    let share = effective / rows as f64;
    let rho = (1.0 - share) / (1.0 + share);
    let length = (2.0 * rho / (1.0 - rho * rho)).powf(2.0 / 3.0) * (rows as f64).cbrt();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let length = length as usize;
    length.clamp(1, rows.div_ceil(8))
}
