//! The density that grows, is cut into windows, and changes its origin.

use crate::common::{J0, TOLERANCE, TRIPLE_SLOPE, accept, magnitude, peak, uniform, worst};
use stickslip_convolution::{Convolver, Density, Field, direct_sum};

const MARGIN: f64 = 4.0;

/// A tip that goes forward from −3 to 460 with excursions backward, beyond −3 at first.
fn path() -> Vec<f64> {
    let step = |i: u32| {
        let t = f64::from(i) / 4000.0;
        -3.0 + 463.0 * t + 12.0 * (200.0 * t).sin()
    };
    (0..4000).map(step).collect()
}

fn filled(spacing: f64, sources: &[f64]) -> Density {
    let mut density = Density::new(spacing);
    sources.iter().for_each(|&y| density.add(y, 0.25));
    density
}

#[test]
fn a_window_about_the_tip_sees_all_that_matters_of_a_long_memory() {
    let (value, slope) = (TRIPLE_SLOPE.value(), TRIPLE_SLOPE.slope());
    let (kernel, derivative) = (TRIPLE_SLOPE.with(&value), TRIPLE_SLOPE.with(&slope));
    let mut convolver = Convolver::new(&kernel, 10.6 + 2.0 * MARGIN);
    let mut density = Density::new(convolver.spacing());
    let mut field = Field::new();
    let sources = path();
    let (mut value_error, mut slope_error) = (0.0_f64, 0.0_f64);
    for (i, &tip) in sources.iter().enumerate() {
        density.add(tip, 0.25);
        if i % 40 != 0 {
            continue;
        }
        convolver.convolve(&density, convolver.first_cell_about(tip), &mut field);
        let targets = uniform(i as u64, 3, tip - 0.99 * MARGIN, tip + 0.99 * MARGIN);
        assert!(targets.iter().all(|x| field.range().contains(x)));
        let (found, found_slope): (Vec<f64>, Vec<f64>) =
            targets.iter().map(|&x| field.value_and_derivative(x)).unzip();
        let (past, weights) = (&sources[..=i], vec![0.25; i + 1]);
        let scale = magnitude(&weights);
        let expected = direct_sum(&kernel, past, &weights, &targets);
        let expected_slope = direct_sum(&derivative, past, &weights, &targets);
        value_error = value_error.max(worst(&found, &expected, scale * peak(&value, 1.0)));
        slope_error =
            slope_error.max(worst(&found_slope, &expected_slope, scale * peak(&slope, 1.0)));
    }
    accept("memory", value_error, TOLERANCE);
    accept("its derivative", slope_error, TOLERANCE);
}

#[test]
fn a_centered_window_has_the_promised_room_for_targets() {
    let value = TRIPLE_SLOPE.value();
    let kernel = TRIPLE_SLOPE.with(&value);
    let mut field = Field::new();
    for room in uniform(24, 100, 0.0, 40.0) {
        let mut convolver = Convolver::new(&kernel, 10.6 + 2.0 * room);
        let density = Density::new(convolver.spacing());
        convolver.convolve(&density, convolver.first_cell_about(7.0 * room), &mut field);
        assert!(field.range().contains(&(6.0 * room)) && field.range().contains(&(8.0 * room)));
    }
}

/// Whatever lies outside the window, cut in two at its ends or folded back, stays unseen in the
/// field's range, up to its very ends; beyond them it shows.
#[test]
fn sources_at_the_ends_of_the_window_do_not_reach_the_field_range() {
    let value = TRIPLE_SLOPE.value();
    let kernel = TRIPLE_SLOPE.with(&value);
    let mut convolver = Convolver::new(&kernel, 10.6 + 2.0 * MARGIN);
    let window = convolver.length() as f64 * convolver.spacing();
    let mut sources = uniform(20, 2000, -0.5 * window - 3.0, -0.5 * window + 3.0);
    sources.extend(uniform(21, 2000, 0.5 * window - 3.0, 0.5 * window + 3.0));
    let density = filled(convolver.spacing(), &sources);
    let mut field = Field::new();
    convolver.convolve(&density, convolver.first_cell_about(0.0), &mut field);
    let (low, high) = field.range().into_inner();
    let error = |x: f64| {
        let expected = direct_sum(&kernel, &sources, &vec![0.25; 4000], &[x]);
        (field.value(x) - expected[0]).abs() / 1000.0
    };
    let inside = (0..=100).map(|i| error(low + (high - low) * f64::from(i) / 100.0));
    accept("inside the range", inside.fold(0.0, f64::max), TOLERANCE);
    assert!(error(high + 10.6 + 15.0 * convolver.spacing()) > 1e-9);
}

#[test]
fn growth_backward_and_forward_gives_the_same_cells() {
    let sources = path();
    let mut backward = sources.clone();
    backward.reverse();
    let (one, other) = (filled(0.25, &sources), filled(0.25, &backward));
    assert_eq!(one.range(), other.range());
    let read = |density: &Density| {
        let mut cells = vec![f64::NAN; 4000];
        density.copy_window(-1000, &mut cells);
        cells
    };
    let (one, other) = (read(&one), read(&other));
    let largest = one.iter().copied().fold(0.0, f64::max);
    assert!(largest > 1.0);
    // Compensated: the order of the sources shows in the last digit at most.
    assert!(worst(&one, &other, largest) <= 2.3e-16);
}

#[test]
fn windows_beyond_the_density_are_zero() {
    let density = filled(0.25, &path());
    for first_cell in [-5000, 5000] {
        let mut cells = [f64::NAN; 100];
        density.copy_window(first_cell, &mut cells);
        assert!(magnitude(&cells) < 1e-300);
    }
    let mut cells = [f64::NAN; 100];
    Density::new(0.25).copy_window(-50, &mut cells);
    assert!(magnitude(&cells) < 1e-300);
}

/// About all sources, about a few of them, and beyond them.
#[test]
fn room_for_sources_changes_nothing() {
    let sources = path();
    let without = filled(0.25, &sources);
    for room in [(-20.0, 480.0), (100.0, 130.0), (900.0, 910.0), (2.0, 1.0)] {
        let mut density = Density::new(0.25);
        density.reserve(room);
        assert!(density.range().is_empty());
        sources.iter().for_each(|&y| density.add(y, 0.25));
        assert!(density.parts() == without.parts(), "{room:?}");
    }
}

#[test]
fn a_moved_origin_changes_nothing() {
    let value = TRIPLE_SLOPE.value();
    let mut convolver = Convolver::new(&TRIPLE_SLOPE.with(&value), 20.0);
    let shift = 1237;
    let distance = shift as f64 * convolver.spacing();
    // On a grid of 2⁻³⁰, so that positions themselves survive the subtraction.
    let rounded = |x: f64| (x * 2.0_f64.powi(30)).round() / 2.0_f64.powi(30);
    let sources: Vec<f64> = uniform(22, 1000, 200.0, 260.0).into_iter().map(rounded).collect();
    let (mut moved, kept) =
        (filled(convolver.spacing(), &sources[..500]), filled(convolver.spacing(), &sources));
    moved.rebase(shift);
    sources[500..].iter().for_each(|y| moved.add(y - distance, 0.25));
    let (mut field, mut field_kept) = (Field::new(), Field::new());
    let first = convolver.first_cell_about(230.0);
    convolver.convolve(&kept, first, &mut field_kept);
    convolver.convolve(&moved, first - shift, &mut field);
    let mut rebased = field_kept.clone();
    rebased.rebase(shift);
    for x in [228.0, 230.25, 231.5] {
        let (expected, found) = (field_kept.value(x), field.value(x - distance));
        assert!((expected - found).abs() <= 1e-15 * 250.0);
        assert!((expected - rebased.value(x - distance)).abs() <= 1e-15 * 250.0);
    }
}

/// Buffers come back dirty and of the wrong length: the result is the same to the last bit.
#[test]
fn a_used_field_gives_the_same_sum_as_a_new_one() {
    let (value, other) = (TRIPLE_SLOPE.value(), J0.value());
    let mut convolver = Convolver::new(&TRIPLE_SLOPE.with(&value), 20.0);
    let mut long = Convolver::new(&J0.with(&other), 500.0);
    let sources = path();
    let density = filled(convolver.spacing(), &sources);
    let mut poison = filled(long.spacing(), &sources);
    poison.add(100.0, f64::NAN);
    let (mut new, mut used) = (Field::new(), Field::new());
    let first = convolver.first_cell_about(100.0);
    convolver.convolve(&density, first, &mut new);
    long.convolve(&poison, long.first_cell_about(100.0), &mut used);
    convolver.convolve(&density, first, &mut used);
    for x in uniform(23, 50, 98.0, 102.0) {
        assert_eq!(new.value(x).to_bits(), used.value(x).to_bits());
    }
}

#[test]
#[should_panic(expected = "outside the window")]
fn a_target_outside_the_window_is_refused() {
    let value = TRIPLE_SLOPE.value();
    let mut convolver = Convolver::new(&TRIPLE_SLOPE.with(&value), 20.0);
    let mut field = Field::new();
    convolver.convolve(&Density::new(convolver.spacing()), 0, &mut field);
    field.value(-0.1);
}

#[test]
#[should_panic(expected = "density of spacing")]
fn a_density_of_another_spacing_is_refused() {
    let value = TRIPLE_SLOPE.value();
    let mut convolver = Convolver::new(&TRIPLE_SLOPE.with(&value), 20.0);
    convolver.convolve(&Density::new(0.5), 0, &mut Field::new());
}

#[test]
#[should_panic(expected = "a source is NaN")]
fn a_source_that_is_no_number_is_refused() {
    let value = TRIPLE_SLOPE.value();
    stickslip_convolution::sum(&TRIPLE_SLOPE.with(&value), &[1.0, f64::NAN], &[1.0, 1.0], &[1.5]);
}

#[test]
fn fields_are_read_by_many_threads_and_convolvers_move_between_them() {
    fn shared<T: Send + Sync>() {}
    shared::<Field>();
    shared::<Density>();
    shared::<Convolver>();
}
