// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "r", description: "Dimensionless support velocities r = Γ v0/(k σ), (12); above 0.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Model" },
        Parameter { name: "alpha", description: "Dimensionless indentation rates α = Γ N a/(σ² k²), (13); 0 or above.", kind: Kind::Numbers, default: None, is_required: false, symbol: "RANGE", group: "Model" },
        Parameter { name: "alpha_above", description: "Indentation rates as αc(r) + D.", kind: Kind::Numbers, default: None, is_required: false, symbol: "RANGE", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T of the surface, in Γ/k; above 0.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Extended model" },
        Parameter { name: "no_spring", description: "Not available in a sweep: without a spring nothing drags the tip.", kind: Kind::Switch, default: Some("false"), is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "until", description: "Compute at each point a run to this time, in Γ/k, as \"stickslip run\" does, instead of the motion that the tip settles into.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Runs" },
        Parameter { name: "start", description: "Initial condition of the runs; steady by default.", kind: Kind::Name(&[("steady", "The steady state, as after infinitely long motion"), ("flat", "A flat surface, the spring relaxed, the support above the tip"), ("paper", "The initial condition of the paper's simulations: noise of 1e-4 on a grid of 0.05 if no other is given, and the spring stretched by r + alpha/r; the surface is flat for a tip whose f has no volume (beta = 1), else that of steady motion")]), default: None, is_required: false, symbol: "START", group: "Runs" },
        Parameter { name: "start_position", description: "Initial position X of the tip, in σ; 14 by default.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Runs" },
        Parameter { name: "kick", description: "Displacement D: the tip starts at X - D, in σ; 0 by default.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Runs" },
        Parameter { name: "start_velocity", description: "Initial velocity of a tip with inertia, in kσ/Γ; r with a steady start, else 0, by default.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Runs" },
        Parameter { name: "noise", description: "Noise on the initial surface, in kσ²/a: heights uniform in [-A, A] on a grid, interpolated by a cubic spline; by default none, or 1e-4 with the start of the paper.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Runs" },
        Parameter { name: "noise_spacing", description: "Spacing of the noise grid, in σ; 0.1 by default.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Runs" },
        Parameter { name: "seed", description: "Seeds of the noise, whole numbers: 1:100:100 makes an ensemble of a hundred; 1 by default.", kind: Kind::Numbers, default: Some("[]"), is_required: false, symbol: "RANGE", group: "Runs" },
        Parameter { name: "tolerance", description: "Largest residual of the equation of motion (18) on a cycle, in kσ/Γ, or target for the error of a run, in σ; from 1e-11 to 1e-4.", kind: Kind::Number, default: Some("1e-9"), is_required: false, symbol: "E", group: "Accuracy" },
    ],
    others: &[
        Parameter { name: "beta", description: "Side-lobe weights β of the footprints, if given.", kind: Kind::Numbers, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "shard", description: "Part of the points to compute; by default all.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "tips", description: "Footprints f: each width with each β, if they vary.", kind: Kind::Other, default: None, is_required: true, symbol: "", group: "" },
        Parameter { name: "width", description: "Widths of the footprints, in σ, if they vary.", kind: Kind::Numbers, default: None, is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
