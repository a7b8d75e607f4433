//! Ripples and lateral forces of known motions, as an instrument tells them.
//!
//! Judge: motions and surfaces of the full PDE (`stickslip_grid`), which shares no code with the cycles that are fitted.

use crate::noise::normal;
use chacha20::ChaCha8Rng;
use rand::RngExt;
use stickslip_grid as grid;
use stickslip_measurement::{Data, Track};
use stickslip_stability::critical;
use stickslip_tip::{TipFunction, Wider};

/// A motion of the triple Gaussian in some law, α/αc above its onset.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Truth {
    pub(crate) over: f64,
    pub(crate) r: f64,
    pub(crate) width: f64,
    pub(crate) beta: f64,
    pub(crate) wider: Wider,
}

/// What the grid makes of it: heights over positions, lags over the way of the support, in σ.
pub(crate) struct Made {
    pub(crate) x: Vec<f64>,
    pub(crate) u: Vec<f64>,
    pub(crate) way: Vec<f64>,
    pub(crate) lag: Vec<f64>,
}

/// Settled after so many σ of the way.
const SETTLED: f64 = 400.0;
/// σ of the way that are looked at.
const LENGTH: f64 = 40.0;

impl Truth {
    pub(crate) fn drawn(random: &mut ChaCha8Rng) -> Self {
        Self {
            over: random.random_range(1.08..1.25),
            r: random.random_range(0.7..1.4),
            width: random.random_range(15.0..50.0),
            beta: 1.0,
            wider: Wider { spring: true, ..Wider::default() },
        }
    }

    fn tip(&self) -> TipFunction {
        TipFunction::triple_gaussian(self.beta, 1.0).unwrap()
    }

    pub(crate) fn alpha(&self) -> f64 {
        let tip = self.tip();
        self.over * critical(&self.wider, &tip, self.r).unwrap().alpha
    }

    pub(crate) fn made(&self, points: usize) -> Made {
        let (bell, beta) = (|x: f64| (-0.5 * x * x).exp(), self.beta);
        let f = move |x: f64| bell(x) - 0.5 * beta * (bell(x - 2.0) + bell(x + 2.0));
        let footprint = grid::Footprint::new(&f, 11.0).unwrap();
        let Wider { depth_limit, healing_time, inertia, .. } = self.wider;
        let inertia = inertia.map(|mass| (mass, self.r));
        let wider = grid::Wider { depth_limit, healing_time, inertia, ..grid::Wider::default() };
        let (alpha, r) = (self.alpha(), self.r);
        let start = grid::Start::steady_under(&wider, (alpha, r), footprint, 0.0, 0.5);
        let problem = grid::Problem::under(wider, (alpha, r), footprint, start).unwrap();
        let g = |amplitude, center| grid::Gaussian { amplitude, center, width: 1.0 };
        let gaussians = vec![g(1.0, 0.0), g(-0.5 * beta, -2.0), g(-0.5 * beta, 2.0)];
        let method = grid::Method::Spectral { gaussians, spacing: 0.36 };
        // The tip is out of the reach of what is looked at.
        let last = SETTLED + LENGTH - 2.0 * r - 4.0 * alpha / r - 14.0;
        let along = |from: f64, i: usize| from + LENGTH * i as f64 / (points - 1) as f64;
        let x: Vec<f64> = (0..points).map(|i| along(last - LENGTH, i)).collect();
        let way: Vec<f64> = (0..points).map(|i| along(SETTLED, i)).collect();
        let times: Vec<f64> = way.iter().map(|way| way / r).collect();
        let request = grid::Request { times: &times, points: &x };
        let run =
            grid::solve(&problem, &method, &grid::Stepping::absolute(1e-6), &request).unwrap();
        let lag = way.iter().zip(&run.x0).map(|(way, x0)| way - x0).collect();
        Made { x, u: run.u, way, lag }
    }

    /// The wavelength of the ripple, from where it rises through its mean.
    pub(crate) fn wavelength(&self) -> f64 {
        let Made { x, u, .. } = self.made(2000);
        let mean = u.iter().sum::<f64>() / u.len() as f64;
        let rises: Vec<f64> = (1..u.len())
            .filter(|i| u[i - 1] < mean && u[*i] >= mean)
            .map(|i| x[i - 1] + (x[i] - x[i - 1]) * (mean - u[i - 1]) / (u[i] - u[i - 1]))
            .collect();
        (rises[rises.len() - 1] - rises[0]) / (rises.len() - 1) as f64
    }
}

/// A track in nm with noise, a slope and an offset, `size` times the values.
fn track(
    (x, y): (&[f64], &[f64]),
    (width, size, gain): (f64, f64, f64),
    noise: f64,
    random: &mut ChaCha8Rng,
) -> Track {
    let mean = y.iter().sum::<f64>() / y.len() as f64;
    let amplitude = y.iter().fold(0.0, |m: f64, v| m.max((v - mean).abs()));
    let (offset, slope) = (random.random_range(-3.0..3.0), random.random_range(-0.01..0.01));
    let ground = |x: f64| amplitude * (offset + slope * x);
    let first = x[0];
    let told = x
        .iter()
        .zip(y)
        .map(|(x, y)| size * (y + ground(x - first) + amplitude * noise * normal(random)));
    let told = told.collect();
    Track::new(x.iter().map(|x| width * (x - first)).collect(), told, Some(gain))
}

pub(crate) fn ripple(truth: &Truth, noise: f64, random: &mut ChaCha8Rng) -> Data {
    let (made, gain) = (truth.made(300), 0.02);
    let size = gain * truth.width * truth.width;
    Data::Ripple(track((&made.x, &made.u), (truth.width, size, gain), noise, random))
}

pub(crate) fn friction(truth: &Truth, noise: f64, random: &mut ChaCha8Rng) -> Data {
    let (made, gain) = (truth.made(300), 0.2);
    let scale = (truth.width, gain * truth.width, gain);
    Data::Friction(track((&made.way, &made.lag), scale, noise, random))
}

/// Forwards, then backwards: the mirrored motion, at another place of its wave.
pub(crate) fn friction_loop(truth: &Truth, noise: f64, random: &mut ChaCha8Rng) -> Data {
    let (made, gain) = (truth.made(400), 0.2);
    let (there, back) = (&made.lag[..300], &made.lag[100..]);
    let scale = (truth.width, gain * truth.width, gain);
    let both: Vec<f64> = there.iter().copied().chain(back.iter().rev().map(|lag| -lag)).collect();
    let way: Vec<f64> = [&made.way[..300], &made.way[..300]].concat();
    let told = track((&way, &both), scale, noise, random);
    let (x, y) = (told.x[..300].to_vec(), told.y[..300].to_vec());
    Data::Loop(Track::new(x, y, told.gain), told.y[300..].to_vec())
}
