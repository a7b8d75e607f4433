//! The dimension of each number of a document and of each column of a table.

use super::Dimension;

/// Parts of documents that are not converted: parameters, histories, cost.
pub(super) const DIMENSIONLESS: [&str; 7] =
    ["parameters", "history", "work", "software", "verification", "physical", "floquet"];

/// The dimension of the field `name` in the part `part` of a document; `part` is empty for a column of a table. `None`
/// for fields without a dimension. An error has the dimension of its quantity.
pub fn dimension(part: &str, name: &str) -> Option<Dimension> {
    let quantity = name.strip_suffix("_error");
    of_part(part, name).or_else(|| of_name(name)).or_else(|| quantity.and_then(of_name))
}

/// The dimension of a number whose name alone is ambiguous.
fn of_part(part: &str, name: &str) -> Option<Dimension> {
    Some(match (part, name) {
        ("residue", "re" | "im") => Dimension::LENGTH,
        ("creep_roots", "re" | "im") => Dimension::WAVE_NUMBER,
        ("loops", "work") => Dimension::WORK,
        ("loops" | "holds", "from" | "to") | ("transient", "time") => Dimension::TIME,
        // Of the quantity that they are statistics of.
        (_, "mean" | "least" | "median" | "largest" | "error" | "deviation") => {
            return of_name(part);
        }
        _ => return None,
    })
}

fn of_name(name: &str) -> Option<Dimension> {
    Some(match name {
        "x" | "x0" | "u_x" | "y" | "y0" | "u_y" | "amplitude_y0" | "kick_across" | "l" | "lag"
        | "wavelength" | "wavelength_x" | "amplitude_x0" | "deviation" | "mean_l"
        | "deviation_l" | "slip_distance" | "memory_length" | "pitch" | "width"
        | "start_position" | "kick" | "noise_spacing" | "residue_re" | "residue_im" | "grid"
        | "closed" | "grid_x0" | "closed_x0" | "grid_y0" | "closed_y0" | "radius" | "center_x"
        | "center_y" => Dimension::LENGTH,
        "u" | "height" | "surface_behind" | "amplitude" | "amplitude_u" | "least_depth_limit"
        | "depth_limit" | "noise" | "grid_u" | "closed_u" => Dimension::HEIGHT,
        "t" | "period" | "period_slope" | "origin" | "valid_from" | "healing_time" => {
            Dimension::TIME
        }
        "velocity" | "velocity_y" | "speed" | "free_speed" | "residual" | "start_velocity" => {
            Dimension::VELOCITY
        }
        "omega" | "omega_slope" | "growth_slope" | "re" | "im" | "re_min" | "re_max" | "im_max"
        | "largest_error" | "lambda_re" | "lambda_im" => Dimension::RATE,
        "Omega" | "q" | "kappa" | "rate" | "attracting" | "creep_rates" => Dimension::WAVE_NUMBER,
        "amplitude_squared_slope" => Dimension::AREA,
        "lyapunov" => Dimension::LYAPUNOV,
        "volume" => Dimension::VOLUME,
        "inertia" => Dimension::INERTIA,
        _ => return None,
    })
}
