// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "alpha", description: "α, below 0 for a particle that its field drives.", kind: Kind::Number, default: None, is_required: true, symbol: "A", group: "Model" },
        Parameter { name: "until", description: "Time at which the run ends, in Γ/k; it starts at 0.", kind: Kind::Number, default: None, is_required: true, symbol: "T", group: "Model" },
        Parameter { name: "healing_time", description: "T, the time in which the field decays by a factor e, in Γ/k; above 0.", kind: Kind::Number, default: Some("1.0"), is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the particle, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "start", description: "Initial condition. Steady, the default: as after an infinitely long straight walk along x, or on a circular orbit with --rotation or --trap. Flat: no field, so that a pulse must set the particle in motion.", kind: Kind::Name(&[("steady", "The steady state, as after infinitely long motion"), ("flat", "A flat surface, the spring relaxed, the support above the tip"), ("paper", "The initial condition of the paper's simulations: noise of 1e-4 on a grid of 0.05 if no other is given, and the spring stretched by r + alpha/r; the surface is flat for a tip whose f has no volume (beta = 1), else that of steady motion")]), default: None, is_required: false, symbol: "START", group: "Start" },
        Parameter { name: "start_position", description: "X, in σ: the particle starts at (X, 0), or on the circular orbit whose radius is nearest to |X|. By default X is 0, and the orbit is the smallest one that is stable.", kind: Kind::Number, default: None, is_required: false, symbol: "X", group: "Start" },
        Parameter { name: "kick", description: "D: the particle, but not its field, is displaced by -D along x, in σ.", kind: Kind::Number, default: Some("0.0"), is_required: false, symbol: "D", group: "Start" },
        Parameter { name: "start_velocity", description: "Initial velocity along x of a particle with inertia on a flat field, in kσ/Γ; 0 by default.", kind: Kind::Number, default: None, is_required: false, symbol: "V", group: "Start" },
        Parameter { name: "kick_across", description: "Displacement of the particle, but not of its field, along y, in σ.", kind: Kind::Number, default: Some("0.0"), is_required: false, symbol: "D", group: "Across the scan" },
        Parameter { name: "tolerance", description: "Target for the error of the position per unit of time, in σ; from 1e-13 to 1e-2.", kind: Kind::Number, default: Some("1e-9"), is_required: false, symbol: "E", group: "Accuracy" },
        Parameter { name: "sample_every", description: "Time between two samples, in Γ/k; by default a 2,000th of the duration of the motion; on the lines of a raster the time in which the support moves a quarter of a width, if that is longer.", kind: Kind::Number, default: None, is_required: false, symbol: "DT", group: "Output" },
        Parameter { name: "sample_at", description: "Times of the samples, in Γ/k, in any order.", kind: Kind::Numbers, default: None, is_required: false, symbol: "T1,T2,…", group: "Output" },
        Parameter { name: "walker", description: "Compute a walker: a particle in the plane without a spring, driven by its own field, with the footprint J0(|x|). It is free, in a rotating frame, or in a trap.", kind: Kind::Switch, default: Some("true"), is_required: false, symbol: "", group: "Walker" },
        Parameter { name: "rotation", description: "Ω of a walker in a rotating frame: the Coriolis force -Ω ẑ × x' acts on it. In units of Γ.", kind: Kind::Number, default: None, is_required: false, symbol: "OMEGA", group: "Walker" },
        Parameter { name: "trap", description: "K of a walker in a harmonic trap about the origin, in units of k; 0 or above.", kind: Kind::Number, default: None, is_required: false, symbol: "K", group: "Walker" },
        Parameter { name: "largest_radius", description: "Largest radius of the circular orbits that are listed, in σ; above 0 and at most 200.", kind: Kind::Number, default: Some("30.0"), is_required: false, symbol: "RADIUS", group: "Walker" },
    ],
    others: &[
        Parameter { name: "pulses", description: "Gaussian pulses of external force along x.", kind: Kind::Other, default: Some("[]"), is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
