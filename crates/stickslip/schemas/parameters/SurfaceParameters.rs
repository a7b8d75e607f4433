// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
    ],
    others: &[
        Parameter { name: "across", description: "Parameters of images.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "alpha", description: "Dimensionless indentation rate α (13).", kind: Kind::Number, default: None, is_required: true, symbol: "", group: "" },
        Parameter { name: "alpha_above", description: "D, if α was given as αc(r) + D; dimensionless.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "far_behind", description: "Whether the initial surface was omitted, (35).", kind: Kind::Switch, default: None, is_required: true, symbol: "", group: "" },
        Parameter { name: "r", description: "Dimensionless support velocity r (12); 0 without a spring.", kind: Kind::Number, default: None, is_required: true, symbol: "", group: "" },
        Parameter { name: "tip", description: "Footprint f.", kind: Kind::Tip, default: None, is_required: true, symbol: "", group: "" },
    ],
    names: &[],
}
