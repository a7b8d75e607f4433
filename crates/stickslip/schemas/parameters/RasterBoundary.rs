// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "points", description: "Number of values, if the range does not contain it; from 2 to 100,000.", kind: Kind::Integer, default: Some("200"), is_required: false, symbol: "N", group: "Boundary" },
        Parameter { name: "spacing", description: "Spacing of the values of the range.", kind: Kind::Name(&[("linear", "Equal differences"), ("logarithmic", "Equal ratios")]), default: Some("\"linear\""), is_required: false, symbol: "NAME", group: "Boundary" },
        Parameter { name: "pitch_range", description: "First and last distance of neighbouring scan lines, in σ, and the number of values: for each, the α at which ripples begin to grow from line to line, and the angle of their crests.", kind: Kind::Ends, default: None, is_required: true, symbol: "LO:HI:N", group: "Raster" },
        Parameter { name: "r", description: "Dimensionless support velocity r (12) of the lines; above 0.", kind: Kind::Number, default: None, is_required: true, symbol: "R", group: "Raster" },
        Parameter { name: "width_y", description: "V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's Gaussians.", kind: Kind::Number, default: None, is_required: false, symbol: "V", group: "Raster" },
        Parameter { name: "length", description: "X, the distance that the support moves along each line, in σ; needed for a surface that heals, and only then.", kind: Kind::Number, default: None, is_required: false, symbol: "X", group: "Raster" },
        Parameter { name: "stiffness_across", description: "κ_y, the spring constant across the scan over that along it, above 0, for a tip that is free to move across: also analyse bunching and snaking of the lines. Without it the tip cannot leave its lines.", kind: Kind::Number, default: None, is_required: false, symbol: "K", group: "Raster" },
    ],
    others: &[],
    names: &[],
}
