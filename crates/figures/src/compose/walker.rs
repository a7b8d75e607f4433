//! Figure of a walker: its path with the circular orbits of theory, its speed, and its distance from the origin.

use super::axes::{NATURAL, evenly};
use super::drawn::{Drawn, View};
use super::quantity::Quantity;
use crate::error::FigureError;
use crate::number::short;
use std::f64::consts::TAU;
use stickslip::{CurveDocument, FigureDocument, PanelDocument, StyleName, WalkerDocument};

/// Number of points of a circle.
const POINTS: u32 = 360;

impl Drawn for WalkerDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let samples = &self.samples;
        let (Some(y0), Some(velocity_y)) = (&samples.y0, &samples.velocity_y) else {
            return Err(FigureError::Nothing("the samples have no y0 to draw".into()));
        };
        if samples.t.is_empty() {
            return Err(FigureError::Nothing("there are no samples to draw".into()));
        }
        let farthest = samples.x0.iter().zip(y0).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
        let mut curves = orbits(self, farthest);
        curves.push(CurveDocument::new(StyleName::Line, "path", &samples.x0, y0));
        let mut path = PanelDocument::of_curves(("x₀ (σ)", "y₀ (σ)"), curves);
        path.natural = NATURAL;
        if self.orbits.is_some() {
            let range = Some([-1.1 * farthest, 1.1 * farthest]);
            (path.x_range, path.y_range) = (range, range);
        }
        let against =
            |label: &str, name: &str, x: &[f64], y: &[f64], level: Option<(f64, &str)>| {
                let value: Vec<f64> = x.iter().zip(y).map(|(x, y)| x.hypot(*y)).collect();
                let mut curves =
                    vec![CurveDocument::new(StyleName::Line, name, &samples.t, &value)];
                if let (Some((level, name)), [first, .., last]) = (level, samples.t.as_slice()) {
                    let ends = [*first, *last];
                    curves.push(CurveDocument::new(StyleName::Dashed, name, &ends, &[level; 2]));
                }
                PanelDocument::of_curves(("t (Γ/k)", label), curves)
            };
        let free = Some((self.free_speed, "free walker"));
        let speed = against("|ẋ₀| (kσ/Γ)", "speed", &samples.velocity, velocity_y, free);
        // Beside two thirds for the speed, the path has about equal scales.
        let mut panels = vec![path, PanelDocument { span: 2, ..speed }];
        if self.orbits.is_some() {
            let distance = against("|x₀| (σ)", "distance from the origin", &samples.x0, y0, None);
            panels.push(PanelDocument { span: 3, ..distance });
        }
        let figure = FigureDocument::new("walker", &title(self), vec![], panels);
        Ok(FigureDocument { columns: 3, ..figure })
    }
}

/// The circular orbits within the range of the path.
fn orbits(walker: &WalkerDocument, farthest: f64) -> Vec<CurveDocument> {
    let all = walker.orbits.iter().flatten().filter(|orbit| orbit.radius <= 1.2 * farthest);
    let mut names = ["circular orbits, stable", "circular orbits, unstable"];
    let circle = |radius: f64| -> (Vec<f64>, Vec<f64>) {
        evenly([0.0, TAU], POINTS).map(|angle| (radius * angle.cos(), radius * angle.sin())).unzip()
    };
    all.map(|orbit| {
        let is_unstable = orbit.stable == Some(false);
        // Only the first of each kind is named in the legend.
        let name = std::mem::take(&mut names[usize::from(is_unstable)]);
        let style = if is_unstable { StyleName::Dotted } else { StyleName::Dashed };
        let (x, y) = circle(orbit.radius);
        CurveDocument::new(style, name, &x, &y)
    })
    .collect()
}

fn title(walker: &WalkerDocument) -> String {
    let asked = &walker.parameters;
    let number = |name: &str, value: f64, unit: &'static str| {
        let plain = format!("{}\u{a0}{unit}", short(value));
        format!(", {name} = {}", Quantity::new(value, unit).in_text(&plain))
    };
    let mut title = format!("Walker, α = {}", short(asked.alpha));
    title += &number("T", asked.healing_time, "Γ/k");
    let others = [("M", asked.inertia, "Γ²/k"), ("Ω", asked.rotation, "Γ"), ("K", asked.trap, "k")];
    for (name, value, unit) in others {
        title += &value.map_or(String::new(), |value| number(name, value, unit));
    }
    title
}
