//! Critical points, and numbers from formulas.

use super::printed::number;
use crate::parts::{Failed, failed};
use crate::tips::{Tip, beta_0, beta_1};
use stickslip::NumberDocument;
use stickslip_stability::{critical, unstable_count};
use stickslip_tip::{InitialSurface, Model, TipFunction, Wider};

const OTHER_TIP: &str = "the printed number is that of exp(-x²)";

/// Section V: αc, ω and L of both tips, rc and related numbers.
pub(super) fn stability() -> Result<Vec<NumberDocument>, Failed> {
    let case = "β = 1, r = 1";
    let at = beta_1()?.critical(1.0)?;
    let mut all = vec![
        number("αc", case, "V, Fig. 1, VII", "1.069").beside(at.alpha),
        number("ω", case, "V", "0.943").beside(at.omega),
        number("T = 2π/ω", case, "V", "6.665").beside(at.period),
        number("L = 2πr/ω", case, "V, Fig. 3", "6.665").beside(at.wavelength),
        number("α − αc at which stability is lost", case, "V", "1.069").corrected(
            first_unstable(&beta_1()?, at.alpha)? - at.alpha,
            9,
            "stable for α < αc is meant",
        ),
    ];
    all.extend(beta_zero()?);
    let at = beta_1()?.critical_r(1.0)?;
    let case = "β = 1, α = 1";
    all.extend([
        number("rc", case, "V, Fig. 5", "0.96").beside(at.r),
        number("ω", case, "V", "0.915").beside(at.omega),
        number("T at r → rc", case, "V", "6.59").corrected(
            at.period,
            5,
            "2π (0.96)/0.915 is the wavelength",
        ),
        number("L at r → rc", case, "V, as T", "6.59").beside(at.wavelength),
    ]);
    Ok(all)
}

/// The numbers for β = 0: with the tip for which they are correct, and with the tip that the paper names.
fn beta_zero() -> Result<Vec<NumberDocument>, Failed> {
    let narrow = beta_0()?;
    let at = narrow.critical(1.0)?;
    let case = "exp(-x²), r = 1";
    let rounded = "2π/0.934; with more digits of ω it is 6.725";
    let mut all = vec![
        number("αc", case, "V, Fig. 2", "1.608").beside(at.alpha),
        number("ω", case, "V", "0.934").beside(at.omega),
        number("T = 2π/ω", case, "V", "6.727").corrected(at.period, 4, rounded),
        number("L = 2πr/ω", case, "V, Fig. 3", "6.727").corrected(at.wavelength, 4, rounded),
        number("α − αc at which stability is lost", case, "V", "1.608").corrected(
            first_unstable(&narrow, at.alpha)? - at.alpha,
            9,
            "stable for α < αc is meant",
        ),
    ];
    let wide = TipFunction::triple_gaussian(0.0, 1.0).map_err(failed("the tip"))?;
    let at = critical(&Wider::default(), &wide, 1.0).map_err(failed("the critical point"))?;
    let case = "(48) with β = 0, r = 1";
    all.extend([
        number("αc", case, "V, Fig. 2", "1.608").corrected(at.alpha, 3, OTHER_TIP),
        number("ω", case, "V", "0.934").corrected(at.omega, 3, OTHER_TIP),
        number("L = 2πr/ω", case, "V, Fig. 3", "6.727").corrected(at.wavelength, 3, OTHER_TIP),
    ]);
    Ok(all)
}

/// The α at which a root gets a positive real part, by bisection of an interval around `critical`: from the number of
/// such roots, without the formula for αc.
fn first_unstable(tip: &Tip, critical: f64) -> Result<f64, Failed> {
    let (mut stable, mut unstable) = (0.9 * critical, 1.1 * critical);
    while unstable - stable > 1e-6 {
        let middle = 0.5 * (stable + unstable);
        let count = unstable_count(&tip.model(middle, 1.0)?);
        let count = count.map_err(failed("the roots"))?;
        if count == 0 { stable = middle } else { unstable = middle }
    }
    Ok(0.5 * (stable + unstable))
}

/// Numbers that follow from formulas of the paper.
pub(super) fn formulas() -> Result<Vec<NumberDocument>, Failed> {
    let tip = beta_1()?;
    let volume_rate = TipFunction::gaussian(1.0).map_err(failed("the tip"))?;
    let model = tip.model(1.0, 1.0)?;
    let mut all = vec![
        number("αc/r of Gnecco et al.", "k = 1.406 N/(σ v0)", "VII", "0.7112").beside(1.0 / 1.406),
        number("f(0)", "β = 1", "II, IV.A", "1").corrected(
            tip.function.value(0.0),
            2,
            "1 - exp(-2) for the triple Gaussian",
        ),
        number("l0 r/α", "β = 1", "(21), (22), (23)", "1").corrected(
            model.steady_l() * model.r() / model.alpha(),
            2,
            "f(0) is missing",
        ),
        number("rate of compression, in α (1-β)", "β = 0", "(49)", "1").corrected(
            volume_rate.integral(),
            8,
            "√(2π) is missing",
        ),
        number("us", "β = 1", "(25)", "0").beside(model.steady_surface_behind()),
        number("largest |u(x, t1)| of (24), in α/r", "β = 1", "V, Fig. 1", "0").corrected(
            largest_steady(&model),
            13,
            "0 far behind and ahead, not under the tip",
        ),
    ];
    all.extend(bessel()?);
    Ok(all)
}

/// The largest height of the steady surface, over α/r.
fn largest_steady(model: &Model) -> f64 {
    let surface = InitialSurface::steady(model, 0.0);
    let heights = (-800..=800).map(|i| surface.height(0.01 * f64::from(i)).abs());
    heights.fold(0.0, f64::max) * model.r() / model.alpha()
}

/// The formulas of section IV.C, evaluated at r = 1 and 2.
fn bessel() -> Result<Vec<NumberDocument>, Failed> {
    let mut all = vec![];
    for (r, alpha, omega) in [(1.0, "1", "0.786151"), (2.0, "4", "0.624811")] {
        let at = critical(&Wider::default(), &TipFunction::Bessel, r)
            .map_err(failed("the critical point"))?;
        let case = format!("f = J0, r = {r}");
        all.push(number("αc = r²", &case, "IV.C", alpha).beside(at.alpha));
        all.push(number("Ω by (47)", &case, "(47)", omega).beside(at.omega / r));
        // At r = 1 the two are the same.
        if r > 1.0 {
            let why = "(47) gives Ω = ω/r";
            all.push(number("ω by (47)", &case, "(46), (47)", omega).corrected(at.omega, 6, why));
        }
    }
    Ok(all)
}
