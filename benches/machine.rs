//! The claim: a million cutter locations to a program in at most two seconds of one core.

use divan::Bencher;
use glam::DVec3;
use stepover::cutter::Cutter;
use stepover::job::machines::machine;
use stepover::machine::{Following, Kinematics, drive};
use stepover::post::multiaxis::{Dialect, Layout, MachineProgram, write};
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};

fn main() {
    divan::main();
}

/// A million locations 0.1 mm apart, to and fro over waves, the tool leaning to all sides.
fn path() -> Toolpath {
    let step = |k: u32| {
        let (row, t) = (k / 1000, f64::from(k % 1000) / 999.0);
        let t = if row.is_multiple_of(2) { t } else { 1.0 - t };
        let (x, y) = (100.0 * t - 50.0, 0.1 * f64::from(row) - 50.0);
        let axis = DVec3::new(0.3 * libm::sin(0.1 * x), 0.1 + 0.2 * libm::cos(0.07 * y), 1.0).normalize();
        let tip = DVec3::new(x, y, 4.0 * libm::cos(0.1 * x) * libm::sin(0.05 * y));
        let (rate, role) = if k == 0 { (Rate::Rapid, Role::Link) } else { (Rate::Feed(3000.0), Role::Cut) };
        Move { to: ClPoint { tip, axis }, rate, role }
    };
    Toolpath { moves: (0..1_000_000).map(step).collect() }
}

const MACHINES: [(&str, &str); 3] = [
    ("table_table_ac", include_str!("../examples/machines/table_table_ac.json")),
    ("head_table_bc", include_str!("../examples/machines/head_table_bc.json")),
    ("head_head_ab", include_str!("../examples/machines/head_head_ab.json")),
];

fn posted(bencher: Bencher, name: &str, dialect: Dialect) {
    let (_, text) = MACHINES.iter().find(|(called, _)| *called == name).expect("a machine");
    let machine = machine(text).expect("a machine");
    let kinematics = Kinematics::new(&machine, 100.0).expect("a tool that fits");
    let toolpath = path();
    bencher.bench(|| {
        let path = drive(&kinematics, &toolpath, &[], &Following::new(dialect.control())).expect("a motion");
        assert!(path.moves.len() >= toolpath.moves.len());
        let program = MachineProgram {
            part: "waves",
            machine: &machine.name,
            kinematics: &kinematics,
            cutter: Cutter::ball(6.0, 30.0).expect("a cutter"),
            tool: 1,
            spindle_rpm: Some(12_000.0),
            coolant: true,
            path: &path,
        };
        write(&program, dialect, &Layout::default()).expect("a program")
    });
}

#[divan::bench(args = MACHINES.map(|(name, _)| name), sample_count = 3, sample_size = 1)]
fn a_million_locations_as_axes(bencher: Bencher, machine: &str) {
    posted(bencher, machine, Dialect::LinuxCnc);
}

#[divan::bench(args = [Dialect::FanucTip.name(), Dialect::Heidenhain.name()], sample_count = 3, sample_size = 1)]
fn a_million_locations_as_tips(bencher: Bencher, dialect: &str) {
    posted(bencher, "table_table_ac", Dialect::named(dialect).expect("a dialect"));
}
