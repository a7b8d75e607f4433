// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "unit", description: "Unit of the positions: m, um, nm, Å, …; that of the data by default.", kind: Kind::Text, default: None, is_required: false, symbol: "UNIT", group: "Data" },
        Parameter { name: "half", description: "The profile is one half of an even one, about position 0. This is the default if it begins at 0 with its apex.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Data" },
        Parameter { name: "terms", description: "Number of Gaussians, where a symmetric pair counts as one; chosen by Schwarz' criterion by default.", kind: Kind::Integer, default: None, is_required: false, symbol: "N", group: "Accuracy" },
        Parameter { name: "r", description: "Dimensionless support velocity at which onset and trapping threshold are computed.", kind: Kind::Number, default: Some("1.0"), is_required: false, symbol: "R", group: "Model" },
        Parameter { name: "resamples", description: "Number of resampled profiles for the intervals; at most 100,000.", kind: Kind::Integer, default: Some("400"), is_required: false, symbol: "N", group: "Accuracy" },
        Parameter { name: "seed", description: "Seed of the random numbers.", kind: Kind::Integer, default: Some("0"), is_required: false, symbol: "N", group: "Accuracy" },
        Parameter { name: "both_sides", description: "Also fit each side of the profile: a moving tip meets the surface with its front side only, so that trace and retrace have different footprints.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Data" },
    ],
    others: &[
        Parameter { name: "centre", description: "Centre of symmetry, in the unit of the positions; fitted by default.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "height_unit", description: "Unit of heights, such as nm or V; by default unknown.", kind: Kind::Text, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "image", description: "An image in place of the profile; the profile is then taken through its middle.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "profile", description: "The measured heights. Documents contain them in the answer instead.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "sigma", description: "σ, in the unit of the positions; computed by default.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "source", description: "Name of the data, such as that of their file.", kind: Kind::Text, default: Some("\"\""), is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
