//! The machines that come with this program.

use super::spec::machine;
use serde_json::{Value, json};

/// The name of each machine's file, and its text.
pub const SHIPPED: [(&str, &str); 6] = [
    ("table_table_ac", include_str!("../../../examples/machines/table_table_ac.json")),
    ("table_table_bc", include_str!("../../../examples/machines/table_table_bc.json")),
    ("head_table_bc", include_str!("../../../examples/machines/head_table_bc.json")),
    ("head_head_ab", include_str!("../../../examples/machines/head_head_ab.json")),
    ("head_head_ac", include_str!("../../../examples/machines/head_head_ac.json")),
    ("three_axis", include_str!("../../../examples/machines/three_axis.json")),
];

/// As a JSON list of `{id, name, text}`.
pub fn shipped_json() -> String {
    let shown = |(id, text): &(&str, &str)| {
        let name = machine(text).map_or_else(|_| (*id).to_owned(), |machine| machine.name);
        json!({ "id": id, "name": name, "text": text })
    };
    Value::from(SHIPPED.iter().map(shown).collect::<Vec<_>>()).to_string()
}
