//! Every setting of a turning job in one table: unit, range and default. The defaults are the lens of paper 004.

use crate::job::fields::{Field, Group, Kind, Variant, choice, number};

const SHAPE: Field = choice("shape", &["convex", "concave"], "convex");
const BASE: Field = choice("shape", &["flat", "convex", "concave"], "flat");
const CURVED: &[&str] = &["convex", "concave"];
const RADIUS: Field = number("radius_mm", "mm", [0.01, 1e6], 1.0, 100.0);
const BASE_RADIUS: Field = number("radius_mm", "mm", [0.01, 1e6], 1.0, 100.0).when("shape", CURVED);
const CONIC: Field = number("conic", "", [-1000.0, 1000.0], 0.1, -1.0);
const BASE_CONIC: Field = number("conic", "", [-1000.0, 1000.0], 0.1, 0.0).when("shape", CURVED);
const NORM: Field = number("norm_mm", "mm", [0.001, 1e6], 1.0, 30.0);
const TERMS: Field = Field { name: "terms", kind: Kind::Points, when: None };
const GIVEN: &[&str] = &["given"];
const TURN: [f64; 2] = [-360.0, 360.0];

const fn plain(kind: &'static str, fields: &'static [Field]) -> Variant {
    Variant { kind, shapes: &[], fields }
}

const fn group(path: &'static str, variants: &'static [Variant], fields: &'static [Field]) -> Group {
    Group { path, variants, fields }
}

/// Limits of an axis that moves along a line; of the C axis below.
macro_rules! linear_limits {
    ($v:literal, $a:literal, $j:literal) => {
        [
            number($v, "mm/s", [0.001, 1e5], 10.0, 200.0),
            number($a, "mm/s²", [0.001, 1e7], 100.0, 1000.0),
            number($j, "mm/s³", [0.001, 1e9], 1000.0, 100_000.0),
        ]
    };
}
const X_LIMITS: [Field; 3] = linear_limits!("x_mm_per_s", "x_mm_per_s2", "x_mm_per_s3");
const Z_LIMITS: [Field; 3] = linear_limits!("z_mm_per_s", "z_mm_per_s2", "z_mm_per_s3");

/// The objects of a turning specification in the order in which a form shows them.
pub const TURNING_GROUPS: &[Group] = &[
    group(
        "surface",
        &[
            plain(
                "toric",
                &[
                    choice(
                        "shape",
                        &["convex", "concave", "saddle_convex_base", "saddle_concave_base"],
                        "convex",
                    ),
                    number("base_radius_mm", "mm", [0.01, 1e6], 1.0, 40.0),
                    number("rotation_radius_mm", "mm", [-1e6, 1e6], 1.0, 150.0),
                ],
            ),
            plain("sphere", &[SHAPE, RADIUS]),
            plain("conic", &[SHAPE, RADIUS, CONIC]),
            plain(
                "asphere",
                &[SHAPE, RADIUS, CONIC, Field { name: "even", kind: Kind::Numbers, when: None }],
            ),
            plain(
                "biconic",
                &[
                    // Positive where the section bends towards the tool.
                    number("radius_x_mm", "mm", [-1e6, 1e6], 1.0, -190.0),
                    number("radius_y_mm", "mm", [-1e6, 1e6], 1.0, -40.0),
                    number("conic_x", "", [-1000.0, 1000.0], 0.1, 0.0),
                    number("conic_y", "", [-1000.0, 1000.0], 0.1, 0.0),
                ],
            ),
            plain("polynomial", &[BASE, BASE_RADIUS, BASE_CONIC, NORM, TERMS]),
            plain("zernike", &[BASE, BASE_RADIUS, BASE_CONIC, NORM, TERMS]),
            plain(
                "grid",
                &[
                    choice("given", &["heights", "coefficients"], "heights"),
                    number("columns", "", [5.0, 4000.0], 1.0, 5.0),
                    number("spacing_x_mm", "mm", [1e-6, 1e4], 0.1, 1.0),
                    number("spacing_y_mm", "mm", [1e-6, 1e4], 0.1, 1.0),
                    Field { name: "heights_mm", kind: Kind::Numbers, when: None },
                    Field { name: "path", kind: Kind::Text, when: None },
                ],
            ),
        ],
        &[
            number("shift_x_mm", "mm", [-1e4, 1e4], 1.0, 0.0),
            number("shift_y_mm", "mm", [-1e4, 1e4], 1.0, 0.0),
            number("turn_deg", "°", TURN, 5.0, 0.0),
        ],
    ),
    group(
        "aperture",
        &[
            plain("round", &[number("radius_mm", "mm", [0.001, 1e4], 1.0, 30.0)]),
            plain(
                "ellipse",
                &[
                    number("half_x_mm", "mm", [0.001, 1e4], 1.0, 30.0),
                    number("half_y_mm", "mm", [0.001, 1e4], 1.0, 20.0),
                ],
            ),
            plain(
                "rectangle",
                &[
                    number("half_x_mm", "mm", [0.001, 1e4], 1.0, 25.0),
                    number("half_y_mm", "mm", [0.001, 1e4], 1.0, 15.0),
                ],
            ),
        ],
        &[
            number("center_x_mm", "mm", [-1e4, 1e4], 1.0, 0.0),
            number("center_y_mm", "mm", [-1e4, 1e4], 1.0, 0.0),
            number("turn_deg", "°", TURN, 5.0, 0.0),
        ],
    ),
    group(
        "tool",
        &[
            plain(
                "ball",
                &[
                    number("radius_mm", "mm", [0.001, 1000.0], 0.5, 15.0),
                    number("spindle_rpm", "1/min", [1.0, 200_000.0], 500.0, 8000.0),
                ],
            ),
            plain(
                "insert",
                &[
                    number("radius_mm", "mm", [0.001, 1000.0], 0.1, 1.5),
                    number("rake_deg", "°", [-60.0, 40.0], 1.0, 0.0),
                    // Against the cut, where the surface rises along it.
                    number("least_rake_deg", "°", [-80.0, 40.0], 1.0, -45.0),
                    number("clearance_deg", "°", [0.0, 60.0], 1.0, 25.0),
                    number("sweep_deg", "°", [1.0, 90.0], 1.0, 75.0),
                ],
            ),
        ],
        &[],
    ),
    group(
        "guide",
        &[plain("spiral", &[]), plain("circles", &[number("across_deg", "°", [1.0, 360.0], 5.0, 15.0)])],
        &[
            choice("way", &["inward", "outward"], "inward"),
            choice("step", &["given", "chosen"], "given"),
            number("step_mm", "mm", [1e-5, 1e3], 0.1, 0.5).when("step", GIVEN),
            number("lead_in_turns", "", [0.0, 100.0], 1.0, 1.0),
            number("lead_out_turns", "", [0.0, 100.0], 1.0, 1.0),
        ],
    ),
    group(
        "points",
        &[
            plain("angle", &[number("angle_deg", "°", [1e-4, 90.0], 0.5, 3.0).when("spacing", GIVEN)]),
            plain(
                "arc",
                &[
                    number("arc_mm", "mm", [1e-5, 1e3], 0.1, 1.5).when("spacing", GIVEN),
                    number("most_angle_deg", "°", [0.1, 90.0], 5.0, 30.0),
                ],
            ),
            plain(
                "hybrid",
                &[
                    number("arc_mm", "mm", [1e-5, 1e3], 0.1, 1.5).when("spacing", GIVEN),
                    number("switch_mm", "mm", [0.001, 1e4], 1.0, 15.0),
                ],
            ),
        ],
        &[
            choice("spacing", &["given", "chosen"], "given"),
            choice("interpolation", &["linear", "pvt"], "linear"),
        ],
    ),
    group(
        "tolerance",
        &[],
        &[
            number("residue_mm", "mm", [1e-6, 1.0], 0.001, 0.01),
            number("chord_mm", "mm", [1e-7, 1.0], 0.0001, 0.01),
        ],
    ),
    group(
        "speed",
        &[],
        &[
            choice("pace", &["c_speed", "surface_speed"], "c_speed"),
            choice("rate", &["highest", "given"], "highest"),
            number("c_rpm", "1/min", [1e-4, 1e5], 5.0, 30.0).when("rate", GIVEN),
            number("surface_m_per_min", "m/min", [1e-4, 1e5], 5.0, 5.0).when("pace", &["surface_speed"]),
            number("most_rpm", "1/min", [1e-4, 1e5], 10.0, 300.0),
            number("least_rpm", "1/min", [0.0, 1e5], 1.0, 0.0).when("rate", &["highest"]),
        ],
    ),
    group(
        "limits",
        &[],
        &[
            X_LIMITS[0],
            X_LIMITS[1],
            X_LIMITS[2],
            Z_LIMITS[0],
            Z_LIMITS[1],
            Z_LIMITS[2],
            number("c_rpm", "1/min", [0.001, 1e5], 100.0, 1000.0),
            number("c_deg_per_s2", "°/s²", [0.001, 1e8], 1000.0, 20_000.0),
            number("c_deg_per_s3", "°/s³", [0.001, 1e10], 1e5, 1e6),
        ],
    ),
    group(
        "output",
        &[],
        &[
            choice("dialect", &["linuxcnc", "fanuc"], "linuxcnc"),
            choice("feed", &["inverse_time", "per_minute"], "inverse_time"),
            choice("point", &["tip", "center"], "tip"),
            choice("x_word", &["radius", "diameter"], "radius"),
            choice("c_word", &["tool", "part"], "tool"),
            number("decimals_mm", "", [3.0, 9.0], 1.0, 6.0),
            number("decimals_deg", "", [3.0, 9.0], 1.0, 6.0),
            number("tool_number", "", [1.0, 99.0], 1.0, 1.0),
            number("clearance_mm", "mm", [0.01, 1000.0], 1.0, 5.0),
            number("approach_mm_per_min", "mm/min", [0.1, 1e5], 50.0, 200.0),
        ],
    ),
    group(
        "verify",
        &[],
        &[
            Field { name: "enabled", kind: Kind::Flag(true), when: None },
            // Another body than the program was planned for shows what its compensation is worth.
            choice("body", &["own", "ball", "insert"], "own"),
            number("spacing_mm", "mm", [0.001, 100.0], 0.05, 0.2),
            number("fine_mm", "mm", [1e-7, 10.0], 0.01, 0.01),
            number("wide_mm", "mm", [1e-7, 10.0], 0.01, 0.02),
            number("sagitta_chord_mm", "mm", [0.001, 1e4], 1.0, 40.0),
            number("sagitta_mm", "mm", [1e-7, 10.0], 0.01, 0.02),
        ],
    ),
];
