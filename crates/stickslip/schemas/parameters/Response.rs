// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f(x) of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "r", description: "Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.", kind: Kind::Number, default: None, is_required: true, symbol: "R", group: "Model" },
        Parameter { name: "alpha", description: "Dimensionless indentation rate α = Γ N a/(σ² k²), (13); 0 or above with a spring.", kind: Kind::Number, default: None, is_required: false, symbol: "A", group: "Model" },
        Parameter { name: "alpha_above", description: "D in α = αc(r) + D, the distance from the critical α (negative below it); dimensionless.", kind: Kind::Number, default: None, is_required: false, symbol: "D", group: "Model" },
        Parameter { name: "until", description: "Time of the last sample, in Γ/k.", kind: Kind::Number, default: None, is_required: true, symbol: "T", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "modes", description: "Least number of modes in the list. It has all modes to the right of a vertical line in the complex plane.", kind: Kind::Integer, default: Some("10"), is_required: false, symbol: "N", group: "Accuracy" },
        Parameter { name: "sample_every", description: "Time between two samples, in Γ/k; by default a 2,000th of the duration of the motion; on the lines of a raster the time in which the support moves a quarter of a width, if that is longer.", kind: Kind::Number, default: None, is_required: false, symbol: "DT", group: "Output" },
        Parameter { name: "sample_at", description: "Times of the samples, in Γ/k, in any order.", kind: Kind::Numbers, default: None, is_required: false, symbol: "T1,T2,…", group: "Output" },
        Parameter { name: "start_position", description: "X, in σ: the samples begin when a run from this start position with a steady start begins, so that both can be compared sample by sample.", kind: Kind::Number, default: Some("14.0"), is_required: false, symbol: "X", group: "Output" },
    ],
    others: &[
        Parameter { name: "pulses", description: "Gaussian pulses of external force.", kind: Kind::Other, default: None, is_required: true, symbol: "", group: "" },
    ],
    names: &[],
}
