// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f(x,y), or f(x), with lengths in σ; by default the triple Gaussian with β = 1.", kind: Kind::Tip, default: None, is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "width_y", description: "V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's Gaussians.", kind: Kind::Number, default: None, is_required: false, symbol: "V", group: "Model" },
        Parameter { name: "unit", description: "Unit of lengths; that of the image by default.", kind: Kind::Text, default: None, is_required: false, symbol: "UNIT", group: "Data" },
        Parameter { name: "scan", description: "Direction in which the tip moved along the lines when it made the ripples; both are tried by default.", kind: Kind::Name(&[("right", "Towards larger positions"), ("left", "Towards smaller positions")]), default: None, is_required: false, symbol: "DIRECTION", group: "Data" },
        Parameter { name: "slow_scan", description: "Direction in which the lines of an image followed each other; both are tried by default.", kind: Kind::Name(&[("up", "Towards larger y"), ("down", "Towards smaller y")]), default: None, is_required: false, symbol: "DIRECTION", group: "Data" },
        Parameter { name: "r", description: "r, dimensionless, if known.", kind: Kind::Number, default: None, is_required: false, symbol: "R", group: "Known" },
        Parameter { name: "alpha", description: "α, dimensionless, if known.", kind: Kind::Number, default: None, is_required: false, symbol: "A", group: "Known" },
        Parameter { name: "stiffness_across", description: "κ_y, the spring constant across the lines of an image over that along them, if known; above 0. By default the tip cannot leave its lines.", kind: Kind::Number, default: None, is_required: false, symbol: "K", group: "Known" },
        Parameter { name: "free_stiffness_across", description: "Estimate κ_y from an image, for which α or r must be known.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Fitted" },
    ],
    others: &[
        Parameter { name: "force_gain", description: "k, if known: lateral forces in their unit are k times deflections in the unit of the image.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "height_unit", description: "Unit of heights, such as nm or V; by default unknown.", kind: Kind::Text, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "image", description: "Measured heights. Documents contain them, levelled, in the answer.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "lateral_image", description: "Lateral forces, or deflections of the lever, on the lines that made the ripples, at the same positions: positive where the tip hangs back from the support towards smaller x.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "lateral_unit", description: "Unit of the lateral image, such as N or nm: of a force, or of the deflection of the lever.", kind: Kind::Text, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "pitch", description: "Distance of the scan lines that made the ripples, in the unit of the image; by default the distance of its rows.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "retrace_image", description: "Heights of the same area on the way back, at the same positions; both are fitted together.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "source", description: "Name of the image, such as that of its file.", kind: Kind::Text, default: Some("\"\""), is_required: false, symbol: "", group: "" },
        Parameter { name: "width", description: "σ in the unit of the image.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "width_interval", description: "95 % interval of σ, in the unit of the image: its error is added to those of α and r. By default σ is exact.", kind: Kind::Ends, default: None, is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
