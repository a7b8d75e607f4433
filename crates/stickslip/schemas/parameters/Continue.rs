// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f(x) of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "r", description: "Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "R", group: "Model" },
        Parameter { name: "alpha", description: "Dimensionless indentation rate α = Γ N a/(σ² k²), (13); 0 or above with a spring.", kind: Kind::Number, default: None, is_required: false, symbol: "A", group: "Model" },
        Parameter { name: "alpha_above", description: "D in α = αc(r) + D, the distance from the critical α (negative below it); dimensionless.", kind: Kind::Number, default: None, is_required: false, symbol: "D", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "over", description: "The continuation parameter.", kind: Kind::Name(&[("alpha", "α at fixed r"), ("r", "r at fixed α")]), default: None, is_required: true, symbol: "NAME", group: "Branch" },
        Parameter { name: "to", description: "Last value of the continuation parameter; by default the branch ends by another criterion.", kind: Kind::Number, default: None, is_required: false, symbol: "V", group: "Branch" },
        Parameter { name: "switch", description: "Follow the branches of twice the period too, from each period doubling, up to the longest period: each may take minutes.", kind: Kind::Switch, default: Some("false"), is_required: false, symbol: "", group: "Branch" },
        Parameter { name: "longest_period", description: "Largest period, in Γ/k; the branch ends where it is exceeded.", kind: Kind::Number, default: Some("300.0"), is_required: false, symbol: "T", group: "Branch" },
        Parameter { name: "longest_step", description: "Longest step from one cycle to the next, in relative changes of parameter, period and l.", kind: Kind::Number, default: Some("0.05"), is_required: false, symbol: "S", group: "Branch" },
        Parameter { name: "most_points", description: "Largest number of cycles of a branch.", kind: Kind::Integer, default: Some("2000"), is_required: false, symbol: "N", group: "Branch" },
        Parameter { name: "tolerance", description: "Largest residual that the equation of motion (18) may have at any time, in kσ/Γ; from 1e-11 to 1e-4.", kind: Kind::Number, default: Some("1e-9"), is_required: false, symbol: "E", group: "Accuracy" },
    ],
    others: &[],
    names: &[],
}
