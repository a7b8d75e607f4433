//! Fast sums against the definition.

use crate::common::{
    Case, GAUSS_SLOPE, J0, J1, TOLERANCE, TRIPLE, TRIPLE_SLOPE, accept, magnitude, peak, uniform,
    worst,
};
use stickslip_convolution::{Convolver, Density, Field, Plan, direct_sum, sum};

/// Errors of the sum and of its derivative over all sources in one window.
fn errors(case: Case, sources: &[f64], weights: &[f64], targets: &[f64]) -> (f64, f64) {
    let (value, slope) = (case.value(), case.slope());
    let (kernel, derivative) = (case.with(&value), case.with(&slope));
    let mut convolver = Convolver::new(&kernel, 470.0);
    let mut density = Density::new(convolver.spacing());
    sources.iter().zip(weights).for_each(|(&y, &w)| density.add(y, w));
    let mut field = Field::new();
    convolver.convolve(&density, convolver.first_cell_about(228.5), &mut field);
    let (found, found_slope): (Vec<f64>, Vec<f64>) =
        targets.iter().map(|&x| field.value_and_derivative(x)).unzip();
    let scale = magnitude(weights);
    let expected = direct_sum(&kernel, sources, weights, targets);
    let expected_slope = direct_sum(&derivative, sources, weights, targets);
    (
        worst(&found, &expected, scale * peak(&value, case.width)),
        worst(&found_slope, &expected_slope, scale * peak(&slope, case.width)),
    )
}

#[test]
fn fast_sums_and_their_derivatives_agree_with_the_definition() {
    for case in [GAUSS_SLOPE, TRIPLE, TRIPLE_SLOPE, J0, J1] {
        for width in [0.1, 1.0, 5.0] {
            let sources = uniform(1, 3000, -3.0, 460.0);
            let weights = uniform(2, 3000, -1.0, 1.0);
            let targets = uniform(3, 300, -3.0, 460.0);
            let (value, slope) = errors(case.of_width(width), &sources, &weights, &targets);
            accept(&format!("{} of width {width}", case.name), value, TOLERANCE);
            accept("its derivative", slope, TOLERANCE);
        }
    }
}

/// One source keeps no cancelling company: the error is that of the kernel as reproduced.
#[test]
fn a_single_source_gives_the_kernel_itself_with_its_sign() {
    for case in [GAUSS_SLOPE, TRIPLE, TRIPLE_SLOPE, J0, J1] {
        let targets = uniform(4, 2000, 190.0, 250.0);
        let (value, slope) = errors(case, &[217.3], &[1.0], &targets);
        accept(case.name, value, TOLERANCE);
        accept("its derivative", slope, TOLERANCE);
    }
}

#[test]
fn bessel_functions_are_summed_over_separations_of_a_thousand() {
    for case in [J0, J1] {
        let value = case.value();
        let kernel = case.with(&value);
        let (sources, targets) = (uniform(5, 3000, 0.0, 1000.0), uniform(6, 300, 0.0, 1000.0));
        let weights = uniform(7, 3000, 0.0, 1.0);
        let found = sum(&kernel, &sources, &weights, &targets);
        let expected = direct_sum(&kernel, &sources, &weights, &targets);
        accept(case.name, worst(&found, &expected, magnitude(&weights)), TOLERANCE);
    }
}

/// The wider the taper the less it adds to the band: here its edge is nearly that of J0 itself.
#[test]
fn bessel_functions_keep_their_accuracy_over_separations_of_a_hundred_thousand() {
    let value = J0.value();
    let kernel = J0.with(&value);
    let sources = uniform(14, 300, 0.0, 1e5);
    let found = sum(&kernel, &sources, &[1.0; 300], &sources);
    let expected = direct_sum(&kernel, &sources, &[1.0; 300], &sources);
    accept("J0", worst(&found, &expected, 300.0), TOLERANCE);
}

#[test]
fn a_million_sources_at_one_place_count_a_million_times() {
    let value = TRIPLE_SLOPE.value();
    let kernel = TRIPLE_SLOPE.with(&value);
    let sources = vec![0.7; 1_000_000];
    let weights = vec![0.1; 1_000_000];
    let targets = uniform(8, 300, -9.0, 10.0);
    let found = sum(&kernel, &sources, &weights, &targets);
    // Negative control: plain sums drift, every addition being rounded to the same side.
    let plain: f64 = weights.iter().sum();
    assert!((plain / 1e5 - 1.0).abs() > 10.0 * TOLERANCE);
    // One source with the exact sum of the weights: 0.1 is 0.1 + 5.6e-18.
    let expected = direct_sum(&kernel, &sources[..1], &[100_000.0], &targets);
    accept("cluster", worst(&found, &expected, 1e5 * peak(&value, 1.0)), TOLERANCE);
}

#[test]
fn far_from_the_origin_nothing_is_lost() {
    let value = TRIPLE_SLOPE.value();
    let kernel = TRIPLE_SLOPE.with(&value);
    let sources = uniform(9, 100, 1e9, 1e9 + 50.0);
    let weights = uniform(10, 100, -1.0, 1.0);
    let found = sum(&kernel, &sources, &weights, &sources);
    let expected = direct_sum(&kernel, &sources, &weights, &sources);
    let scale = magnitude(&weights) * peak(&value, 1.0);
    accept("at 1e9", worst(&found, &expected, scale), TOLERANCE);
}

#[test]
fn sums_without_company_are_zero() {
    let value = TRIPLE.value();
    let kernel = TRIPLE.with(&value);
    let zero = |sources: &[f64], targets: &[f64]| {
        let found = sum(&kernel, sources, &vec![1.0; sources.len()], targets);
        found.len() == targets.len() && magnitude(&found) < 1e-300
    };
    assert!(zero(&[], &[]));
    assert!(zero(&[1.0], &[]));
    assert!(zero(&[], &[1.0, 2.0]));
    assert!(zero(&[0.0, 1e15], &[-1e15, 100.0]));
}

/// Negative control: the same test fails by seven digits when one choice of the plan is undone.
#[test]
fn a_coarser_lattice_or_a_shorter_window_is_noticed() {
    let value = TRIPLE_SLOPE.value();
    let kernel = TRIPLE_SLOPE.with(&value);
    let sources = uniform(11, 500, 0.0, 30.0);
    let weights = uniform(12, 500, -1.0, 1.0);
    let error = |plan: Plan, targets: &[f64]| {
        let mut convolver = Convolver::with_plan(&kernel, plan);
        let mut density = Density::new(convolver.spacing());
        sources.iter().zip(&weights).for_each(|(&y, &w)| density.add(y, w));
        let mut field = Field::new();
        convolver.convolve(&density, convolver.first_cell_about(15.0), &mut field);
        let found: Vec<f64> = targets.iter().map(|&x| field.value(x)).collect();
        let expected = direct_sum(&kernel, &sources, &weights, targets);
        worst(&found, &expected, magnitude(&weights))
    };
    let good = Plan::new(&kernel, 30.0);
    let targets = uniform(13, 100, 3.0, 27.0);
    accept("as planned", error(good, &targets), TOLERANCE);
    let coarse = Plan { spacing: 2.0 * good.spacing, ..good };
    assert!(error(coarse, &targets) > 1e-6);
    let wrapped = Plan { length: 180, ..good };
    assert!((30.0..33.0).contains(&(180.0 * good.spacing)));
    assert!(error(wrapped, &targets) > 1e-6);
}

/// Negative control: a taper that starts too early is seen at the largest separations.
#[test]
fn a_taper_within_the_separation_is_noticed() {
    let value = J1.value();
    let kernel = J1.with(&value);
    let good = Plan::new(&kernel, 100.0);
    let error = |plan: Plan| {
        let mut convolver = Convolver::with_plan(&kernel, plan);
        let mut density = Density::new(convolver.spacing());
        density.add(0.0, 1.0);
        let mut field = Field::new();
        convolver.convolve(&density, convolver.first_cell_about(50.0), &mut field);
        (field.value(99.0) - value(99.0)).abs()
    };
    accept("tapered beyond", error(good), TOLERANCE);
    let taper = good.taper.map(|t| stickslip_convolution::Taper { center: 100.0, ..t });
    assert!(error(Plan { taper, ..good }) > 1e-3);
}
