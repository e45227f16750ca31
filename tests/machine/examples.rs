//! The machines that are shipped.

use stepover::job::machines::machine;
use stepover::machine::{Kinematics, Machine};

/// Name and text of each.
pub(crate) const TEXTS: [(&str, &str); 6] = [
    ("table_table_ac", include_str!("../../examples/machines/table_table_ac.json")),
    ("table_table_bc", include_str!("../../examples/machines/table_table_bc.json")),
    ("head_table_bc", include_str!("../../examples/machines/head_table_bc.json")),
    ("head_head_ab", include_str!("../../examples/machines/head_head_ab.json")),
    ("head_head_ac", include_str!("../../examples/machines/head_head_ac.json")),
    ("three_axis", include_str!("../../examples/machines/three_axis.json")),
];

/// The machine called so.
pub(crate) fn example(name: &str) -> Machine {
    let (_, text) = TEXTS.iter().find(|(called, _)| *called == name).expect("a shipped machine");
    machine(text).unwrap()
}

/// Every machine with a 120 mm tool.
pub(crate) fn all() -> Vec<(&'static str, Kinematics)> {
    TEXTS.map(|(name, text)| (name, Kinematics::new(&machine(text).unwrap(), 120.0).unwrap())).into()
}

/// Those with rotary axes.
pub(crate) fn five_axis() -> Vec<(&'static str, Kinematics)> {
    all().into_iter().filter(|(_, machine)| machine.axes().len() == 5).collect()
}
