//! Figures of oscillations slightly beyond onset, which are limit cycles here; the paper simulates until transients decay.

use super::parts::{Failed, curve, failed, figure as empty, line_of_best_fit, spaced};
use super::tips::{Tip, beta_1, figure_of_both};
use stickslip::{FigureDocument, PanelDocument, StyleName};
use stickslip_cycles::{Cycle, DEFAULT_TOLERANCE, cycle};
use stickslip_stability::onset;
use stickslip_tip::Model;

/// Number of points of the lines of best fit.
pub(super) const FITTED: usize = 4;

/// Amplitudes and wavelengths along a line of parameters that begins at a critical point.
#[derive(Debug, Default)]
pub(super) struct Onset {
    /// Distance from the critical point.
    pub(super) distance: Vec<f64>,
    /// Half peak-to-peak of the surface far behind the tip, squared.
    pub(super) u_squared: Vec<f64>,
    /// Half peak-to-peak of the oscillation of x0 about its steady advance, squared.
    pub(super) x0_squared: Vec<f64>,
    pub(super) wavelength: Vec<f64>,
}

impl Onset {
    /// The oscillations at these distances; `model` varies α or r.
    pub(super) fn along(
        distances: &[f64],
        model: impl Fn(f64) -> Result<Model, Failed>,
    ) -> Result<Self, Failed> {
        let mut onset = Self::default();
        for distance in distances {
            let found = solved(&model(*distance)?)?;
            onset.distance.push(*distance);
            onset.u_squared.push(found.amplitude_u().powi(2));
            onset.x0_squared.push(found.amplitude_x0().powi(2));
            onset.wavelength.push(found.wavelength());
        }
        Ok(onset)
    }

    /// The oscillations above αc at r = 1.
    pub(super) fn above(tip: &Tip, distances: &[f64]) -> Result<Self, Failed> {
        let critical = tip.critical(1.0)?;
        Self::along(distances, |distance| tip.model(critical.alpha + distance, 1.0))
    }

    /// Intercept and slope of the fit to the points next to the critical one.
    pub(super) fn fit(&self, values: &[f64]) -> (f64, f64) {
        line_of_best_fit(&self.distance[..FITTED], &values[..FITTED])
    }
}

/// The limit cycle.
pub(super) fn solved(model: &Model) -> Result<Cycle, Failed> {
    cycle(model, DEFAULT_TOLERANCE).map_err(failed("the limit cycle"))
}

/// α - αc of the cycles, and of steady motion below.
pub(super) fn distances() -> Vec<f64> {
    spaced(0.01, 0.1, 0.01)
}
const BELOW: [f64; 2] = [-0.02, -0.01];

fn critical_alpha(tip: &Tip) -> Result<f64, Failed> {
    Ok(tip.critical(1.0)?.alpha)
}

/// Fig. 2: squares of the amplitudes of u and x0 against α - αc.
pub(super) fn fig2() -> Result<FigureDocument, Failed> {
    let title = "Fig. 2: squared amplitudes of the surface and of the tip, r = 1";
    let (tips, mut document) = figure_of_both(("fig2", title), critical_alpha)?;
    document.remarks.push(
        "amplitudes are half peak-to-peak, of the limit cycles themselves instead of long runs"
            .into(),
    );
    for tip in &tips {
        let at = tip.critical(1.0)?;
        let found = Onset::above(tip, &distances())?;
        let heading = format!("{}, α_c = {:.3}", tip.name, at.alpha);
        document.panels.push(amplitudes(&heading, "α − α_c", &found, &BELOW));
        let leading = onset(&tip.function, 1.0).map_err(failed("the onset"))?;
        document.remarks.push(format!(
            "{}: the line of x0 has slope {:.4}, the theory of the bifurcation at α → αc {:.4}",
            tip.name,
            found.fit(&found.x0_squared).1,
            leading.amplitude_squared_slope
        ));
    }
    Ok(document)
}

/// Squared amplitudes against the distance from the critical point, with the lines through the nearest points, and
/// zeros for steady motion.
pub(super) fn amplitudes(
    heading: &str,
    x_label: &str,
    found: &Onset,
    steady: &[f64],
) -> PanelDocument {
    let mut panel = PanelDocument::new(heading, (x_label, "amplitude²"));
    let zeros = vec![0.0; steady.len()];
    let all_x: Vec<f64> = steady.iter().chain(&found.distance).copied().collect();
    let columns = [
        (&found.u_squared, StyleName::Dots, StyleName::Line, "of u(x, ·), in units of (kσ²/a)²"),
        (&found.x0_squared, StyleName::Triangles, StyleName::Dashed, "of x₀(t), in units of σ²"),
    ];
    let far = found.distance[found.distance.len() - 1];
    for (values, marks, line, name) in columns {
        let (intercept, slope) = found.fit(values);
        // From where it is 0.
        let ends = [-intercept / slope, far];
        let fitted = ends.map(|x| intercept + slope * x);
        let all_y: Vec<f64> = zeros.iter().chain(values.iter()).copied().collect();
        panel.curves.push(curve(marks, name, &all_x, &all_y));
        panel.curves.push(curve(line, &format!("fit to the first {FITTED}"), &ends, &fitted));
    }
    panel
}

/// Fig. 3: the wavelength against α - αc.
pub(super) fn fig3() -> Result<FigureDocument, Failed> {
    let title = "Fig. 3: wavelength of the surface, r = 1";
    let (tips, mut document) = figure_of_both(("fig3", title), critical_alpha)?;
    for tip in &tips {
        let at = tip.critical(1.0)?;
        let found = Onset::above(tip, &distances())?;
        let (intercept, slope) = found.fit(&found.wavelength);
        let ends = [0.0, found.distance[found.distance.len() - 1]];
        let heading = format!("{}, α_c = {:.3}, 2πr/ω = {:.4}", tip.name, at.alpha, at.wavelength);
        let mut panel = PanelDocument::new(&heading, ("α − α_c", "L (σ)"));
        panel.curves = vec![
            curve(StyleName::Dots, "L", &found.distance, &found.wavelength),
            curve(
                StyleName::Line,
                &format!("fit to the first {FITTED}"),
                &ends,
                &ends.map(|x| intercept + slope * x),
            ),
            curve(StyleName::Triangles, "2πr/ω at α_c", &[0.0], &[at.wavelength]),
        ];
        document.panels.push(panel);
    }
    Ok(document)
}

const ALPHA: f64 = 1.0;
const STEADY: [f64; 2] = [0.01, 0.02];

/// Fig. 5: squares of the amplitudes of u and x0 against r - rc.
pub(super) fn fig5() -> Result<FigureDocument, Failed> {
    let tip = beta_1()?;
    let critical = tip.critical_r(ALPHA)?;
    let title = "Fig. 5: squared amplitudes of the surface and of the tip, α = 1";
    let mut document = empty("fig5", title, &[tip.model(ALPHA, critical.r)?]);
    document.remarks.push(
        "the paper quotes 6.59 as the period at r → rc; it is the wavelength there, the period is 6.87 \
         (docs/findings/corrections.md, 5)"
            .into(),
    );
    let distances: Vec<f64> = spaced(0.01, 0.1, 0.01).iter().map(|d| -d).collect();
    let found = Onset::along(&distances, |distance| tip.model(ALPHA, critical.r + distance))?;
    let heading = format!("{}, r_c = {:.4}", tip.name, critical.r);
    document.panels.push(amplitudes(&heading, "r − r_c", &found, &STEADY));
    Ok(document)
}
