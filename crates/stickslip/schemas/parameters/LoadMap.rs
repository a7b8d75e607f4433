// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "tip", description: "Footprint f(x) of the tip.", kind: Kind::Tip, default: Some("{\"gaussians\":[{\"amplitude\":1.0,\"center\":0.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":-2.0,\"width\":1.0},{\"amplitude\":-0.5,\"center\":2.0,\"width\":1.0}],\"name\":\"gaussians\"}"), is_required: false, symbol: "NAME", group: "Model" },
        Parameter { name: "depth_limit", description: "Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).", kind: Kind::Number, default: None, is_required: false, symbol: "B", group: "Extended model" },
        Parameter { name: "healing_time", description: "Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "T", group: "Extended model" },
        Parameter { name: "inertia", description: "Inertia M of the tip, in Γ²/k; above 0.", kind: Kind::Number, default: None, is_required: false, symbol: "M", group: "Extended model" },
        Parameter { name: "no_spring", description: "No spring and no support: a particle driven by its own groove. There is no r then, α may be below 0, and the initial surface is flat.", kind: Kind::Switch, default: None, is_required: false, symbol: "", group: "Extended model" },
        Parameter { name: "r_range", description: "First and last r, above 0, and the number of values, both ends included.", kind: Kind::Ends, default: None, is_required: true, symbol: "LO:HI:N", group: "Boundary" },
        Parameter { name: "points", description: "Number of loads, and of velocities; from 2 to 1,000.", kind: Kind::Integer, default: Some("41"), is_required: false, symbol: "N", group: "Boundary" },
        Parameter { name: "r", description: "Dimensionless support velocity r (12) of the measured point; above 0.", kind: Kind::Number, default: None, is_required: true, symbol: "R", group: "Raster" },
        Parameter { name: "load_range", description: "First and last load, in nN, above 0, such as 2nN:20nN: with `r_range`, compute where there are ripples, and their wavelength. There are as many loads as velocities, 41 by default.", kind: Kind::Ends, default: None, is_required: true, symbol: "LO:HI", group: "Load" },
        Parameter { name: "load", description: "Load of the measured point, in nN, such as 10nN; above 0.", kind: Kind::Number, default: None, is_required: true, symbol: "F", group: "Load" },
        Parameter { name: "width_exponent", description: "Exponent s of a contact that grows with the load F, σ ∝ F^s: 1/3 by Hertz; 0 to 0.5. `load_widths` gives a table instead.", kind: Kind::Number, default: Some("0.0"), is_required: false, symbol: "S", group: "Load" },
        Parameter { name: "alpha", description: "α at the load `load`; α is proportional to the load.", kind: Kind::Number, default: None, is_required: true, symbol: "A", group: "Load" },
    ],
    others: &[
        Parameter { name: "load_widths", description: "Table of the width of the contact against the load.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
