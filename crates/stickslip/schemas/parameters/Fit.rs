// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f(x), with x in σ; by default the triple Gaussian with β = 1. Documents contain the fitted β if it is free.", kind: Kind::Tip, default: None, is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "unit", description: "Unit of lengths, for data without one and for the result; that of the first data by default.", kind: Kind::Text, default: None, is_required: false, symbol: "UNIT", group: "Data" },
        Parameter { name: "robust", description: "Reduce the weight of outliers, by Huber's weights.", kind: Kind::Switch, default: Some("false"), is_required: false, symbol: "", group: "Data" },
        Parameter { name: "scan", description: "Direction in which the tip moved along the positions of ripples and traces; both are tried by default.", kind: Kind::Name(&[("right", "Towards larger positions"), ("left", "Towards smaller positions")]), default: None, is_required: false, symbol: "DIRECTION", group: "Data" },
        Parameter { name: "r", description: "r, dimensionless, if known.", kind: Kind::Number, default: None, is_required: false, symbol: "R", group: "Known" },
        Parameter { name: "alpha", description: "α, dimensionless, if known.", kind: Kind::Number, default: None, is_required: false, symbol: "A", group: "Known" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a, if known.", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Known" },
        Parameter { name: "healing_time", description: "Healing time T of the surface, in Γ/k, if known.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Known" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k, if known.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Known" },
        Parameter { name: "free", description: "Further parameters to fit. α, r and σ are free unless given.", kind: Kind::Names(&[("beta", "Weight β of the side lobes of the triple Gaussian"), ("depth-limit", "Depth limit b"), ("healing-time", "Healing time T"), ("inertia", "Inertia M")]), default: Some("[]"), is_required: false, symbol: "NAME,…", group: "Fitted" },
    ],
    others: &[
        Parameter { name: "data", description: "The measured data sets, at least one. Documents contain them in the answer instead.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "draws", description: "Footprints drawn within the error of a measured one, each a sum of Gaussians with lengths in σ.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "footprints", description: "Number of footprints used to propagate the error of a measured footprint.", kind: Kind::Integer, default: Some("0"), is_required: false, symbol: "", group: "" },
        Parameter { name: "known", description: "Known parameters in documents of older versions.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "width", description: "σ in the unit of the data, if known.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
