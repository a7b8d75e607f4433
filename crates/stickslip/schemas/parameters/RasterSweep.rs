// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "r", description: "Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.", kind: Kind::Number, default: None, is_required: true, symbol: "R", group: "Model" },
        Parameter { name: "alpha", description: "Dimensionless indentation rates α (13).", kind: Kind::Numbers, default: None, is_required: true, symbol: "RANGE", group: "Model" },
        Parameter { name: "width_y", description: "V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's Gaussians.", kind: Kind::Number, default: None, is_required: false, symbol: "V", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "stiffness_across", description: "κ_y, the spring constant across the lines over that along them; above 0. Without it the tip cannot leave its line.", kind: Kind::Number, default: None, is_required: false, symbol: "K", group: "Across the scan" },
        Parameter { name: "pitch", description: "Distances of the lines, in σ.", kind: Kind::Numbers, default: None, is_required: true, symbol: "RANGE", group: "Scan" },
        Parameter { name: "lines", description: "Number of lines of each raster.", kind: Kind::Integer, default: None, is_required: true, symbol: "N", group: "Scan" },
        Parameter { name: "length", description: "X: distance that the support moves along each line, in σ.", kind: Kind::Number, default: None, is_required: true, symbol: "X", group: "Scan" },
        Parameter { name: "path", description: "The path of the support from one line to the next.", kind: Kind::Name(&[("one-way", "Every line runs in the same direction from x = 0, with the spring relaxed"), ("zigzag", "The support turns back at the end of a line and moves on by one pitch; the tip keeps its position"), ("repeat", "The same line is scanned again from x = 0, with the spring relaxed")]), default: Some("\"one-way\""), is_required: false, symbol: "PATH", group: "Scan" },
        Parameter { name: "tolerance", description: "Target for the error of x0 on each line, in σ; from 1e-13 to 1e-2.", kind: Kind::Number, default: Some("1e-6"), is_required: false, symbol: "E", group: "Accuracy" },
    ],
    others: &[
        Parameter { name: "shard", description: "Part of the points in this document; by default all.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
