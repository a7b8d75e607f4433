// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f(x) of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "r", description: "Dimensionless support velocity r = Γ v0/(k σ), (12); above 0. Optional with `solve_for` \"r\": r is then the critical one.", kind: Kind::Number, default: None, is_required: false, symbol: "R", group: "Model" },
        Parameter { name: "alpha", description: "Dimensionless indentation rate α = Γ N a/(σ² k²), (13); 0 or above with a spring.", kind: Kind::Number, default: None, is_required: false, symbol: "A", group: "Model" },
        Parameter { name: "alpha_above", description: "D in α = αc(r) + D, the distance from the critical α (negative below it); dimensionless.", kind: Kind::Number, default: None, is_required: false, symbol: "D", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "solve_for", description: "Parameter for which the critical point is solved, α or r, at the given value of the other.", kind: Kind::Name(&[("alpha", "αc at a given r"), ("r", "rc at a given α")]), default: Some("\"alpha\""), is_required: false, symbol: "NAME", group: "Critical point" },
        Parameter { name: "stiffness_across", description: "κ_y, the spring constant across the scan over that along it, above 0, for a tip that is free to move across: compute the onset of snaking of a line, and of bunching of many. Without it the tip cannot leave its line.", kind: Kind::Number, default: None, is_required: false, symbol: "K", group: "Across the scan" },
        Parameter { name: "width_y", description: "V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's Gaussians.", kind: Kind::Number, default: None, is_required: false, symbol: "V", group: "Across the scan" },
        Parameter { name: "roots", description: "Least number of growth exponents in the list; 10 if no bound is given. The list has all exponents to the right of a vertical line in the complex plane.", kind: Kind::Integer, default: None, is_required: false, symbol: "N", group: "Growth exponents" },
        Parameter { name: "re_above", description: "Lower bound on real parts, in k/Γ: list all growth exponents at or above it, instead of a number of them.", kind: Kind::Number, default: None, is_required: false, symbol: "BOUND", group: "Growth exponents" },
    ],
    others: &[
        Parameter { name: "at_critical_point", description: "Whether α and r are those of the critical point, because one of them was not given.", kind: Kind::Switch, default: Some("false"), is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
