// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "r", description: "Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "R", group: "Model" },
        Parameter { name: "alpha", description: "Dimensionless indentation rate α = Γ N a/(σ² k²), (13); 0 or above.", kind: Kind::Number, default: None, is_required: false, symbol: "A", group: "Model" },
        Parameter { name: "alpha_above", description: "D in α = αc(r) + D, the distance from the critical α (negative below it); dimensionless.", kind: Kind::Number, default: None, is_required: false, symbol: "D", group: "Model" },
    ],
    others: &[
        Parameter { name: "damping", description: "Γ in kg/s.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "indentation_rate", description: "N in m/s.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "slope_force", description: "a in N.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "stiffness", description: "k in N/m.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "tip_width", description: "σ in m.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "velocity", description: "v0 in m/s.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
