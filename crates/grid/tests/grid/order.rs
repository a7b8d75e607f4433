//! The second-order grids against the spectral one, over Δx = 0.1 … 0.00625.

use crate::common::{FINE, distance, main_case, observed_orders, spectral};
use stickslip_grid::{GridError, Method, Stepping};

const SPACINGS: [f64; 5] = [0.1, 0.05, 0.025, 0.0125, 0.00625];

/// Largest errors of x0 over 20 time units and of u at the end, on each spacing.
fn errors(method: impl Fn(f64) -> Method) -> Result<[Vec<f64>; 2], GridError> {
    let case = main_case(20.0);
    let exact = case.run(&spectral(FINE), &Stepping::absolute(1e-12))?;
    let mut errors = [Vec::new(), Vec::new()];
    for spacing in SPACINGS {
        // Steps of 0.04 as in the paper: their own error is 1e-8, far below the grids'.
        let run = case.run(&method(spacing), &Stepping::fixed(0.04))?;
        errors[0].push(distance(&run.x0, &exact.x0));
        errors[1].push(distance(&run.u, &exact.u));
    }
    Ok(errors)
}

fn assert_second_order([x0, u]: &[Vec<f64>; 2]) {
    for (what, errors) in [("x0", x0), ("u", u)] {
        let orders = observed_orders(errors);
        let second = orders.iter().all(|p| (1.8..=2.2).contains(p));
        assert!(second, "{what}: orders {orders:.3?}, errors {errors:?}");
    }
}

#[test]
fn the_windowed_grid_is_of_second_order() -> Result<(), GridError> {
    let errors = errors(|spacing| Method::Windowed { spacing })?;
    println!(
        "windowed: x0 {:.3?}, u {:.3?}",
        observed_orders(&errors[0]),
        observed_orders(&errors[1])
    );
    assert_second_order(&errors);
    Ok(())
}

#[test]
fn the_uniform_grid_is_of_second_order() -> Result<(), GridError> {
    let errors = errors(|spacing| Method::Uniform { spacing, from: 3.0, to: 46.0 })?;
    println!(
        "uniform: x0 {:.3?}, u {:.3?}",
        observed_orders(&errors[0]),
        observed_orders(&errors[1])
    );
    assert_second_order(&errors);
    Ok(())
}
