//! The dialects.

use super::format::Meaning::{
    End, InverseTime, MachineCoordinates, Nothing, PathOff, PathOn, PathOnWithLength, PerMinute, RapidOnce,
    Straight,
};
use super::format::{Feed, Format, Meaning, Motion, Rapid, Words};
use crate::machine::Control;

/// Whose language, and how it states the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dialect {
    /// LinuxCNC with trivial kinematics: all axes, inverse time (G93).
    LinuxCnc,
    /// Fanuc: all axes, inverse time (G93).
    Fanuc,
    /// Fanuc with tool centre point control (G43.4): the tip and the rotary axes, with the workpiece's frame as programming frame.
    FanucTip,
    /// Haas with tool centre point control (G234): the tip and the rotary axes.
    Haas,
    /// Siemens 840D: all axes, inverse time (G93).
    Siemens,
    /// Siemens 840D with TRAORI: the tip and the tool's direction (A3, B3, C3) in the workpiece's frame (ORIWKS).
    SiemensVector,
    /// Heidenhain iTNC 530 and TNC 640 with M128: LN blocks of the tip and the tool's direction (TX, TY, TZ).
    Heidenhain,
    /// Grbl on three axes: feed a minute.
    Grbl,
}

impl Dialect {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::LinuxCnc,
        Self::Fanuc,
        Self::FanucTip,
        Self::Haas,
        Self::Siemens,
        Self::SiemensVector,
        Self::Heidenhain,
        Self::Grbl,
    ];

    /// A word that stays the same.
    pub fn name(self) -> &'static str {
        self.format().name
    }

    /// The dialect called so.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|dialect| dialect.name() == name)
    }

    /// What the control makes of a block, for [`crate::machine::drive`].
    pub fn control(self) -> Control {
        self.format().control
    }

    pub(super) fn format(self) -> &'static Format {
        match self {
            Self::LinuxCnc => &LINUXCNC,
            Self::Fanuc => &FANUC,
            Self::FanucTip => &FANUC_TIP,
            Self::Haas => &HAAS,
            Self::Siemens => &SIEMENS,
            Self::SiemensVector => &SIEMENS_VECTOR,
            Self::Heidenhain => &HEIDENHAIN,
            Self::Grbl => &GRBL,
        }
    }
}

const fn modal(code: &'static str) -> Motion {
    Motion { code, modal: true, end: "" }
}

/// What switches the machine and not the path.
const MACHINE: Words = &[
    ("M", Some(2.0), End),
    ("M", Some(30.0), End),
    ("M", Some(3.0), Nothing),
    ("M", Some(5.0), Nothing),
    ("M", Some(6.0), Nothing),
    ("M", Some(8.0), Nothing),
    ("M", Some(9.0), Nothing),
    ("N", None, Nothing),
    ("S", None, Nothing),
    ("T", None, Nothing),
];

/// What dialects of ISO 6983 share.
const CODES: Words = &[
    ("G", Some(0.0), Meaning::Rapid),
    ("G", Some(1.0), Straight),
    ("G", Some(94.0), PerMinute),
    ("G", Some(17.0), Nothing),
    ("G", Some(40.0), Nothing),
    ("G", Some(54.0), Nothing),
    ("G", Some(90.0), Nothing),
];

/// What those share that are near to RS-274.
const RS274: Words = &[
    ("G", Some(49.0), PathOff),
    ("G", Some(53.0), MachineCoordinates),
    ("G", Some(21.0), Nothing),
    ("G", Some(80.0), Nothing),
];

/// Of the Siemens dialects.
const SINUMERIK: Words =
    &[("SUPA", None, MachineCoordinates), ("RTLION", None, Nothing), ("G", Some(71.0), Nothing)];

/// Feed as inverse time.
const TIMED: Words = &[("G", Some(93.0), InverseTime)];

/// The tool's length by its place in a table.
const TABLE: Words = &[("H", None, Nothing)];

const LINUXCNC: Format = Format {
    name: "linuxcnc",
    control: Control::Axes,
    feed: Feed::InverseTime,
    remark: ["(", ")"],
    vector: [""; 3],
    counted: false,
    plus: false,
    rapid: Rapid::Straight(modal("G0")),
    straight: modal("G1"),
    opening: &[
        "%",
        "({part})",
        "({machine}, CUTTER D{d} R{r}, {length} MM FROM SPINDLE NOSE TO TIP)",
        "(G54 IS THE WORKPIECE ZERO: {offset} MACHINE COORDINATES)",
        "G21 G90 G94 G17 G40 G49 G80 G54",
        "G64 P0.001",
        "G53 G0 Z{top}",
        "T{tool} M6",
        "S{rpm} M3",
        "{coolant}",
    ],
    // The length by number: the program was made for it, and needs no entry in a table.
    approach: &["G0 {rotary}", "G0 {xy}", "G43.1 Z{length}", "G0 {first}", "G93"],
    closing: &["G94", "G49", "G53 G0 Z{top}", "M9", "M5", "M30", "%"],
    words: &[
        MACHINE,
        CODES,
        RS274,
        TIMED,
        &[("G", Some(43.1), PathOnWithLength), ("G", Some(64.0), Nothing), ("P", None, Nothing)],
    ],
    passed: &["%"],
};

const FANUC_OPENING: &[&str] = &[
    "%",
    "O0001 ({part})",
    "({machine}, CUTTER D{d} R{r}, H{tool} = {length} MM FROM SPINDLE NOSE TO TIP)",
    "(G54 IS THE WORKPIECE ZERO: {offset} MACHINE COORDINATES)",
    "G21 G90 G94 G17 G40 G49 G80 G54",
    "G53 G0 Z{top}",
    "T{tool} M6",
    "S{rpm} M3",
    "{coolant}",
];

const FANUC: Format = Format {
    name: "fanuc",
    rapid: Rapid::AtFeed,
    opening: FANUC_OPENING,
    approach: &["G0 {rotary}", "G0 {xy}", "G43 H{tool} {first}", "G93"],
    words: &[MACHINE, CODES, RS274, TIMED, TABLE, &[("G", Some(43.0), PathOn)]],
    passed: &["%", "O"],
    ..LINUXCNC
};

const FANUC_TIP: Format = Format {
    name: "fanuc_tip",
    control: Control::Tip,
    feed: Feed::PerMinute,
    approach: &["G0 {rotary}", "G0 {xy}", "G43.4 H{tool} {first}"],
    closing: &["G49", "G53 G0 Z{top}", "M9", "M5", "M30", "%"],
    words: &[MACHINE, CODES, RS274, TABLE, &[("G", Some(43.4), PathOn)]],
    ..FANUC
};

/// The order of approach is that of the example in Haas' mill operator's manual, under G234.
const HAAS: Format = Format {
    name: "haas",
    approach: &["G0 {rotary}", "G0 {xy}", "G234 H{tool} {first}"],
    words: &[MACHINE, CODES, RS274, TABLE, &[("G", Some(234.0), PathOn)]],
    ..FANUC_TIP
};

const SIEMENS: Format = Format {
    name: "siemens",
    remark: ["; ", ""],
    opening: &[
        "; {part}",
        "; {machine}, CUTTER D{d} R{r}, D1 = {length} MM FROM SPINDLE NOSE TO TIP",
        "; G54 IS THE WORKPIECE ZERO: {offset} MACHINE COORDINATES",
        "G71 G90 G94 G17 G40 G54",
        // Rapid moves go straight too.
        "RTLION",
        "T{tool} M6",
        "D0",
        "SUPA G0 Z{top}",
        "S{rpm} M3",
        "{coolant}",
    ],
    approach: &["G0 {rotary}", "G0 {xy}", "D1", "G0 {first}", "G93"],
    closing: &["G94", "D0", "SUPA G0 Z{top}", "M9", "M5", "M30"],
    words: &[MACHINE, CODES, SINUMERIK, TIMED, &[("D", Some(0.0), PathOff), ("D", Some(1.0), PathOn)]],
    passed: &["%"],
    ..LINUXCNC
};

/// Source: Siemens, SINUMERIK 840D sl, Job Planning, section 7.2 (TRAORI, A3 B3 C3, ORIWKS).
const SIEMENS_VECTOR: Format = Format {
    name: "siemens_vector",
    control: Control::Vector,
    feed: Feed::PerMinute,
    vector: ["A3=", "B3=", "C3="],
    approach: &["G0 {rotary}", "G0 {xy}", "D1", "TRAORI", "G54", "ORIWKS", "ORIVECT", "G0 {first}"],
    closing: &["TRAFOOF", "D0", "SUPA G0 Z{top}", "M9", "M5", "M30"],
    words: &[
        MACHINE,
        CODES,
        SINUMERIK,
        &[
            ("TRAORI", None, PathOn),
            ("TRAFOOF", None, PathOff),
            ("ORIWKS", None, Nothing),
            ("ORIVECT", None, Nothing),
            ("D", None, Nothing),
        ],
    ],
    ..SIEMENS
};

/// Source: Heidenhain, TNC 640 user's manual, Klartext programming, "Three-dimensional tool compensation" and M128.
const HEIDENHAIN: Format = Format {
    name: "heidenhain",
    control: Control::Vector,
    feed: Feed::PerMinute,
    remark: ["; ", ""],
    vector: ["TX", "TY", "TZ"],
    counted: true,
    plus: true,
    rapid: Rapid::Straight(Motion { code: "LN", modal: false, end: " FMAX" }),
    straight: Motion { code: "LN", modal: false, end: "" },
    opening: &[
        "BEGIN PGM {file} MM",
        "; {part}",
        "; {machine}, CUTTER D{d} R{r}, TOOL {tool}: {length} MM FROM SPINDLE NOSE TO TIP",
        "; THE PRESET IS THE WORKPIECE ZERO: {offset} MACHINE COORDINATES",
        "TOOL CALL {tool} Z{speed}",
        "L Z{top} R0 FMAX M91",
        "M3 ; {rpm} RPM",
        "{coolant}",
    ],
    approach: &["L {rotary} R0 FMAX", "L {xy} R0 FMAX", "M128", "LN {first} FMAX"],
    closing: &["M129", "L Z{top} R0 FMAX M91", "M9", "M5", "M30", "END PGM {file} MM"],
    words: &[
        MACHINE,
        &[
            ("L", None, Straight),
            ("LN", None, Straight),
            ("FMAX", None, RapidOnce),
            ("M", Some(128.0), PathOn),
            ("M", Some(129.0), PathOff),
            ("M", Some(91.0), MachineCoordinates),
            ("R", Some(0.0), Nothing),
        ],
    ],
    passed: &["BEGIN PGM", "END PGM", "TOOL CALL"],
};

const GRBL: Format = Format {
    name: "grbl",
    feed: Feed::PerMinute,
    opening: &[
        "({part})",
        "({machine}, CUTTER D{d} R{r}, {length} MM FROM SPINDLE NOSE TO TIP)",
        "(G54 IS THE WORKPIECE ZERO: {offset} MACHINE COORDINATES)",
        "G21 G90 G94 G17 G40 G49 G54",
        "G53 G0 Z{top}",
        "S{rpm} M3",
        "{coolant}",
    ],
    approach: &["G0 {xy}", "G43.1 Z{length}", "G0 {first}"],
    closing: &["G49", "G53 G0 Z{top}", "M9", "M5", "M30"],
    ..LINUXCNC
};
