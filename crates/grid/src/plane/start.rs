//! Initial conditions in the plane: time, position and surface.

use super::product::{self, Product};
use crate::Wider;
use crate::footprint::Tail;

/// t1, (x0, y0) at t1 and the surface u0(x,y) with its gradient.
pub struct PlaneStart<'a> {
    /// Start time t1.
    pub time: f64,
    /// x0 and y0 at t1.
    pub position: [f64; 2],
    surface: Box<dyn Fn([f64; 2]) -> [f64; 3] + 'a>,
}

impl<'a> PlaneStart<'a> {
    /// A general initial condition; `surface` returns u0 with its derivatives in x and y.
    pub fn new(time: f64, position: [f64; 2], surface: impl Fn([f64; 2]) -> [f64; 3] + 'a) -> Self {
        Self { time, position, surface: Box::new(surface) }
    }

    /// A flat surface.
    pub fn flat(time: f64, position: [f64; 2]) -> Self {
        Self::new(time, position, |_| [0.0; 3])
    }

    /// Steady motion on the line y = 0 for infinite time up to the position X:
    ///
    /// u0(x, y) = -(α w0/r) Σ h(y) ∫_0^∞ g(x - X + y') e^{-y'/(rT)}dy'
    ///
    /// with w0 the weight at this depth. The spring is stretched by r plus the slope under the tip. The start is at the
    /// time at which R = rt stretches it so far, or at 0 on a path.
    pub fn steady(
        wider: &Wider,
        (alpha, r): (f64, f64),
        products: &'a [Product],
        position: f64,
    ) -> Self {
        let fading = wider.healing_time.map_or(0.0, |time| 1.0 / (r * time));
        let reach = product::reach(products)[0];
        let along = |product: &'a Product| {
            let g = |x: f64| product::value(&product.along, x);
            (product, Tail::new(g, reach, fading))
        };
        let terms: Vec<_> = products.iter().map(along).collect();
        let jet = move |density: f64, [x, y]: [f64; 2]| {
            let mut jet = [0.0; 3];
            for (product, tail) in &terms {
                let (h, slope) =
                    (product::value(&product.across, y), product::slope(&product.across, y));
                let (g, groove) = (product::value(&product.along, x), tail.at(x));
                let part = [-groove * h, (g - fading * groove) * h, -groove * slope];
                (0..3).for_each(|i| jet[i] += density * part[i]);
            }
            jet
        };
        let depth = jet(alpha / r, [0.0; 2])[0];
        let density = alpha / r * wider.steady_weight(depth);
        let lag = r + jet(density, [0.0; 2])[1];
        let time = if wider.path.is_some() { 0.0 } else { (position + lag) / r };
        let surface = move |[x, y]: [f64; 2]| jet(density, [x - position, y]);
        Self::new(time, [position, 0.0], surface)
    }

    /// The same initial condition with the tip displaced, but not the surface.
    #[must_use]
    pub fn displaced(self, by: [f64; 2]) -> Self {
        let [x, y] = self.position;
        Self { position: [x + by[0], y + by[1]], ..self }
    }

    /// u0 and its derivatives in x and y.
    pub fn surface(&self, at: [f64; 2]) -> [f64; 3] {
        (self.surface)(at)
    }
}
