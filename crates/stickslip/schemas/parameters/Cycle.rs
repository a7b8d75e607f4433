// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f(x) of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "r", description: "Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.", kind: Kind::Number, default: None, is_required: true, symbol: "R", group: "Model" },
        Parameter { name: "alpha", description: "Dimensionless indentation rate α = Γ N a/(σ² k²), (13); 0 or above with a spring.", kind: Kind::Number, default: None, is_required: false, symbol: "A", group: "Model" },
        Parameter { name: "alpha_above", description: "D in α = αc(r) + D, the distance from the critical α (negative below it); dimensionless.", kind: Kind::Number, default: None, is_required: false, symbol: "D", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "tolerance", description: "Largest residual that the equation of motion (18) may have at any time, in kσ/Γ; from 1e-11 to 1e-4.", kind: Kind::Number, default: Some("1e-9"), is_required: false, symbol: "E", group: "Accuracy" },
        Parameter { name: "points", description: "Least number of intervals of the profile, up to 1,000,000; they are uneven in time. Each step of the cycle's mesh, short where the motion is fast, is divided evenly, into at least two.", kind: Kind::Integer, default: Some("400"), is_required: false, symbol: "N", group: "Output" },
    ],
    others: &[],
    names: &[],
}
