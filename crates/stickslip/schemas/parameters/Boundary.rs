// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f(x) of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "r_range", description: "First and last r, above 0, and the number of values, both ends included.", kind: Kind::Ends, default: None, is_required: true, symbol: "LO:HI:N", group: "Boundary" },
        Parameter { name: "points", description: "Number of values, if the range does not contain it; from 2 to 100,000.", kind: Kind::Integer, default: Some("200"), is_required: false, symbol: "N", group: "Boundary" },
        Parameter { name: "spacing", description: "Spacing of the values of the range.", kind: Kind::Name(&[("linear", "Equal differences"), ("logarithmic", "Equal ratios")]), default: Some("\"linear\""), is_required: false, symbol: "NAME", group: "Boundary" },
    ],
    others: &[],
    names: &[],
}
