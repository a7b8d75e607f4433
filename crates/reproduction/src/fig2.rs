//! Fig. 2: squares of the amplitudes of u and x0 against α - αc.

use super::onset::{FITTED, Onset};
use super::parts::{curve, failed, figure as empty, panel, spaced};
use super::tips::{BETA_0, beta_0, beta_1};
use crate::failed::Failed;
use stickslip::{FigureDocument, PanelDocument, StyleName};
use stickslip_stability::onset;

/// α - αc of the cycles, and of steady motion below.
pub(super) fn distances() -> Vec<f64> {
    spaced(0.01, 0.1, 0.01)
}
const BELOW: [f64; 2] = [-0.02, -0.01];

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let tips = [beta_1()?, beta_0()?];
    let critical = [tips[0].critical(1.0)?, tips[1].critical(1.0)?];
    let models = [tips[0].model(critical[0].alpha, 1.0)?, tips[1].model(critical[1].alpha, 1.0)?];
    let title = "Fig. 2: squared amplitudes of the surface and of the tip, r = 1";
    let mut document = empty("fig2", title, &models);
    document.remarks.push(BETA_0.into());
    document.remarks.push(
        "amplitudes are half peak-to-peak, of the limit cycles themselves instead of long runs"
            .into(),
    );
    for (tip, at) in tips.iter().zip(critical) {
        let found = Onset::above(tip, &distances())?;
        let heading = format!("{}, α_c = {:.3}", tip.name, at.alpha);
        document.panels.push(amplitudes(&heading, "α − α_c", &found, &BELOW));
        let leading = onset(&tip.function, 1.0).map_err(|error| failed("the onset", &error))?;
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
    let mut panel = panel(heading, (x_label, "amplitude²"));
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
