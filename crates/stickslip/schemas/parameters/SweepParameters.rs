// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
    ],
    others: &[
        Parameter { name: "alpha", description: "Dimensionless indentation rates α (13), if given as such.", kind: Kind::Numbers, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "alpha_above", description: "D, if the indentation rates were given as αc(r) + D.", kind: Kind::Numbers, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "axes", description: "Further parameters that vary.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "beta", description: "Side-lobe weights β of the footprints, if given.", kind: Kind::Numbers, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "r", description: "Dimensionless support velocities r (12).", kind: Kind::Numbers, default: None, is_required: true, symbol: "", group: "" },
        Parameter { name: "run", description: "Parameters of the runs, if each point is a run from its own initial condition.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "shard", description: "Part of the points in this document; by default all.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "tips", description: "Footprints f: each width with each β, if they vary.", kind: Kind::Other, default: None, is_required: true, symbol: "", group: "" },
        Parameter { name: "tolerance", description: "Largest residual of (18) on a cycle, in kσ/Γ, or target for the error of a run, in σ.", kind: Kind::Number, default: None, is_required: true, symbol: "", group: "" },
        Parameter { name: "width", description: "Widths of the footprints, in σ, if several were given.", kind: Kind::Numbers, default: None, is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
