//! Every setting of a specification in one table: unit, range and default. Validation, the schema for forms, and the
//! defaults of what a specification leaves out all read it.

/// One setting.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// Its key in the specification.
    pub name: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// The choice beside it, and the words of it with which it counts; forms hide it else. Nothing if it always counts.
    pub when: Option<(&'static str, &'static [&'static str])>,
}

impl Field {
    pub(super) const fn when(self, choice: &'static str, words: &'static [&'static str]) -> Self {
        Self { when: Some((choice, words)), ..self }
    }
}

/// What a setting holds.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// A number from `min` to `max`.
    Number {
        /// Unit, as a person reads it.
        unit: &'static str,
        /// Least value.
        min: f64,
        /// Largest value.
        max: f64,
        /// A step that a form offers.
        step: f64,
        /// Used where the specification says nothing.
        default: f64,
    },
    /// One of a few words.
    Choice {
        /// The words.
        options: &'static [&'static str],
        /// Used where the specification says nothing.
        default: &'static str,
    },
    /// Yes or no; the default.
    Flag(bool),
    /// Points in space, mm, as a list of `[x, y, z]`; none where the specification says nothing.
    Points,
    /// A list of numbers; none where the specification says nothing.
    #[cfg(feature = "turning")]
    Numbers,
    /// A line of text; empty where the specification says nothing.
    #[cfg(feature = "turning")]
    Text,
}

/// One form of an object with a `kind` key.
#[derive(Debug, Clone, Copy)]
pub struct Variant {
    /// The value of `kind`.
    pub kind: &'static str,
    /// The shapes that it fits: `surface`, `mesh`; empty for all.
    pub shapes: &'static [&'static str],
    /// Its own settings.
    pub fields: &'static [Field],
}

/// Strategies that the page's first module only names: whoever chooses one of them loads the second.
pub(super) const SECOND: [&str; 4] = ["constant_scallop", "flow", "potential_field", "auto"];

/// One object of the specification.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// Its key in the specification.
    pub path: &'static str,
    /// Its forms, the first being the default; empty where it has no `kind`.
    pub variants: &'static [Variant],
    /// Settings that all forms share.
    pub fields: &'static [Field],
}

pub(super) const fn number(
    name: &'static str,
    unit: &'static str,
    range: [f64; 2],
    step: f64,
    default: f64,
) -> Field {
    Field { name, kind: Kind::Number { unit, min: range[0], max: range[1], step, default }, when: None }
}

pub(super) const fn choice(
    name: &'static str,
    options: &'static [&'static str],
    default: &'static str,
) -> Field {
    Field { name, kind: Kind::Choice { options, default }, when: None }
}

const DIAMETER: Field = number("diameter_mm", "mm", [0.1, 200.0], 0.5, 10.0);
const CORNER: Field = number("corner_radius_mm", "mm", [0.0, 100.0], 0.1, 2.0);
const HEIGHT: Field = number("height_mm", "mm", [0.1, 500.0], 1.0, 40.0);

/// Lead: the paper of 2013 and common practice keep a few degrees so that the flat bottom does not drag.
const LEAD: Field = number("lead_deg", "°", [0.0, 80.0], 0.5, 8.0).when("rule", &["fixed"]);
const YAW: Field = number("yaw_deg", "°", [-180.0, 180.0], 1.0, 0.0).when("rule", &["fixed"]);
/// Where the lead is chosen, the bounds are [`crate::posture::Limits`].
const CHOSEN: &[&str] = &["matched", "widest", "two_contacts"];
const RULE: Field = choice("rule", &["fixed", "matched", "widest", "two_contacts"], "fixed");
const LEAST_LEAD: Field = number("least_lead_deg", "°", [0.1, 45.0], 0.5, 2.0).when("rule", CHOSEN);
const MOST_LEAD: Field = number("most_lead_deg", "°", [1.0, 80.0], 1.0, 45.0).when("rule", CHOSEN);
const MOST_YAW: Field = number("most_yaw_deg", "°", [0.0, 80.0], 5.0, 30.0).when("rule", &["widest"]);
const TURN_ALONG: Field = number("turn_along_deg_per_mm", "°/mm", [0.1, 90.0], 0.5, 4.0).when("rule", CHOSEN);
const TURN_ACROSS: Field =
    number("turn_across_deg_per_mm", "°/mm", [0.1, 90.0], 0.5, 8.0).when("rule", CHOSEN);
const POINTS: Field =
    Field { name: "start_points_mm", kind: Kind::Points, when: Some(("start", &["curve"])) };
const ORDER: Field = choice("order", &["zigzag", "zig", "climb", "conventional"], "zigzag");

/// How the cutter leans on a surface, and the order of its passes.
const LEANING: [Field; 9] =
    [RULE, LEAD, YAW, LEAST_LEAD, MOST_LEAD, MOST_YAW, TURN_ALONG, TURN_ACROSS, ORDER];

/// A strategy's `own` settings, and those behind them: `ALL` are nine more.
const fn then_leaning<const OWN: usize, const ALL: usize>(own: [Field; OWN]) -> [Field; ALL] {
    let mut all = [ORDER; ALL];
    let mut k = 0;
    while k < ALL {
        all[k] = if k < OWN { own[k] } else { LEANING[k - OWN] };
        k += 1;
    }
    all
}

/// The objects of a specification in the order in which a form shows them.
pub const GROUPS: &[Group] = &[
    Group {
        path: "cutter",
        variants: &[
            Variant { kind: "bull_nose", shapes: &[], fields: &[DIAMETER, CORNER, HEIGHT] },
            Variant { kind: "ball", shapes: &[], fields: &[DIAMETER, HEIGHT] },
            Variant { kind: "flat", shapes: &[], fields: &[DIAMETER, HEIGHT] },
            Variant {
                kind: "tapered",
                shapes: &[],
                fields: &[DIAMETER, CORNER, number("taper_deg", "°", [-45.0, 60.0], 0.5, 5.0), HEIGHT],
            },
            Variant {
                kind: "conical",
                shapes: &[],
                fields: &[DIAMETER, CORNER, number("bottom_deg", "°", [0.0, 80.0], 0.5, 10.0), HEIGHT],
            },
        ],
        fields: &[],
    },
    Group {
        path: "holder",
        variants: &[],
        fields: &[
            choice("shape", &["none", "cylinder"], "none"),
            number("stickout_mm", "mm", [1.0, 1000.0], 1.0, 60.0).when("shape", &["cylinder"]),
            number("diameter_mm", "mm", [1.0, 500.0], 1.0, 40.0).when("shape", &["cylinder"]),
            number("height_mm", "mm", [1.0, 1000.0], 5.0, 80.0).when("shape", &["cylinder"]),
        ],
    },
    Group {
        path: "strategy",
        variants: &[
            Variant {
                kind: "iso_parametric",
                shapes: &["surface"],
                fields: &then_leaning::<1, 10>([choice("along", &["u", "v"], "u")]),
            },
            Variant {
                kind: "iso_planar",
                shapes: &["surface"],
                fields: &then_leaning::<1, 10>([number("angle_deg", "°", [-180.0, 180.0], 5.0, 0.0)]),
            },
            Variant {
                kind: "constant_scallop",
                shapes: &["surface"],
                fields: &then_leaning::<4, 13>([
                    choice(
                        "start",
                        &["u_low", "u_high", "v_low", "v_high", "u_line", "v_line", "section", "curve"],
                        "v_low",
                    ),
                    number("start_percent", "%", [0.0, 100.0], 5.0, 50.0)
                        .when("start", &["u_line", "v_line"]),
                    POINTS,
                    number("angle_deg", "°", [-180.0, 180.0], 5.0, 0.0).when("start", &["section"]),
                ]),
            },
            Variant {
                kind: "flow",
                shapes: &["surface"],
                fields: &then_leaning::<1, 10>([choice("families", &["one", "several"], "one")]),
            },
            Variant {
                kind: "potential_field",
                shapes: &["surface"],
                fields: &then_leaning::<1, 10>([number(
                    "least_efficiency_percent",
                    "%",
                    [50.0, 100.0],
                    1.0,
                    90.0,
                )]),
            },
            Variant {
                kind: "auto",
                shapes: &[],
                fields: &then_leaning::<1, 10>([choice("objective", &["time", "length"], "time")]),
            },
            Variant {
                kind: "raster",
                shapes: &["mesh"],
                fields: &[number("angle_deg", "°", [-180.0, 180.0], 5.0, 0.0), ORDER],
            },
        ],
        fields: &[],
    },
    Group {
        path: "tolerance",
        variants: &[],
        fields: &[
            number("scallop_mm", "mm", [0.0001, 5.0], 0.005, 0.01),
            // Off: strips are exact, and what is planned is what is left.
            number("safety", "", [0.1, 1.0], 0.05, 1.0),
            number("chord_mm", "mm", [0.0001, 1.0], 0.0005, 0.001),
        ],
    },
    Group {
        path: "links",
        variants: &[],
        fields: &[
            number("lift_mm", "mm", [0.1, 100.0], 0.5, 2.0),
            number("clearance_mm", "mm", [0.1, 500.0], 1.0, 10.0),
            choice("fixture", &["none", "plane"], "none"),
            number("fixture_z_mm", "mm", [-5000.0, 5000.0], 1.0, 0.0).when("fixture", &["plane"]),
        ],
    },
    Group {
        path: "feeds",
        variants: &[],
        fields: &[
            number("cut_mm_per_min", "mm/min", [1.0, 60_000.0], 100.0, 1500.0),
            number("plunge_mm_per_min", "mm/min", [1.0, 60_000.0], 50.0, 300.0),
            number("rapid_mm_per_min", "mm/min", [1.0, 200_000.0], 1000.0, 20_000.0),
            number("spindle_rpm", "1/min", [1.0, 200_000.0], 500.0, 12_000.0),
        ],
    },
    Group {
        path: "verify",
        variants: &[],
        fields: &[
            Field { name: "enabled", kind: Kind::Flag(true), when: None },
            number("spacing_mm", "mm", [0.005, 10.0], 0.05, 0.25),
        ],
    },
];
