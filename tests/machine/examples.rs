//! The machines that are shipped.

use stepover::job::JobError;
use stepover::job::machines::{self, PostOptions, Posted, machine};
use stepover::machine::{Kinematics, Machine};
use stepover::monitor::Stage;
use stepover::post::Program;

/// Name and text of each.
pub(crate) const TEXTS: [(&str, &str); 6] = machines::SHIPPED;

/// The program of `program` without contacts.
pub(crate) fn post_program(
    program: &Program,
    machine: &Machine,
    options: &PostOptions,
) -> Result<Posted, JobError> {
    machines::post_program(program.clone(), &[], machine, options, &Stage::silent())
}

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
