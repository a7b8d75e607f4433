// Made by `make reference`: do not edit.
Declared {
    options: &[
        Parameter { name: "unit", description: "Unit of the positions: m, um, nm, …; that of the data by default.", kind: Kind::Text, default: None, is_required: false, symbol: "UNIT", group: "Data" },
        Parameter { name: "force_unit", description: "Unit of the forces: N, nN, V, …; that of the data by default.", kind: Kind::Text, default: None, is_required: false, symbol: "UNIT", group: "Data" },
    ],
    others: &[
        Parameter { name: "retrace", description: "Forces of the retrace.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "sensitivity", description: "Force, in N, that corresponds to 1 in the data, if `force_unit` is no unit of force.", kind: Kind::Number, default: None, is_required: false, symbol: "", group: "" },
        Parameter { name: "source", description: "Name of the data, such as that of their files.", kind: Kind::Text, default: Some("\"\""), is_required: false, symbol: "", group: "" },
        Parameter { name: "trace", description: "Forces of the trace. Documents contain the loop in the answer.", kind: Kind::Other, default: None, is_required: false, symbol: "", group: "" },
    ],
    names: &[],
}
