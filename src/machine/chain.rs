//! A machine's bodies: what its axes carry, one after another from the bed to the workpiece and to the tool.

use super::figure::{Figure, Scene, figure};
use super::{Axis, Carries, Joint, Kinematics, Machine, Position};
use crate::math::angle::turn_about;
use glam::DAffine3;

/// The bodies of a machine, in the machine frame: the bed, then those between it and the workpiece, then those between it and the tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Each axis with its place in [`Position::all`] and the body that carries it; it carries the body of its own number and 1.
    joints: Vec<JointOf>,
    workpiece: usize,
    tool: usize,
}

/// An axis between two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JointOf {
    pub(super) axis: Axis,
    /// Its place in [`Position::all`].
    pub(super) place: usize,
    /// The body that it stands on.
    pub(super) parent: usize,
}

impl Chain {
    /// The bodies of `machine`, which `kinematics` was made of.
    pub fn new(machine: &Machine, kinematics: &Kinematics) -> Self {
        let place = |axis: &Axis| kinematics.axes().iter().position(|other| other.letter == axis.letter);
        let mut joints: Vec<JointOf> = Vec::new();
        let mut last = 0;
        let of_workpiece = machine.axes.iter().rev().filter(|axis| axis.carries == Carries::Workpiece);
        for axis in of_workpiece {
            joints.extend(place(axis).map(|place| JointOf { axis: *axis, place, parent: last }));
            last = joints.len();
        }
        let workpiece = last;
        last = 0;
        for axis in machine.axes.iter().filter(|axis| axis.carries == Carries::Tool) {
            joints.extend(place(axis).map(|place| JointOf { axis: *axis, place, parent: last }));
            last = joints.len();
        }
        Self { joints, workpiece, tool: last }
    }

    /// The number of the body that the workpiece is clamped to; 0, the bed's, if no axis carries it.
    pub fn workpiece(&self) -> usize {
        self.workpiece
    }

    /// The number of the body that holds the tool.
    pub fn tool(&self) -> usize {
        self.tool
    }

    pub(super) fn joints(&self) -> &[JointOf] {
        &self.joints
    }

    /// Where each body has gone from where it is while every axis stands at 0, machine frame, mm.
    pub fn bodies(&self, at: &Position) -> Vec<DAffine3> {
        let positions = at.all();
        let mut bodies = vec![DAffine3::IDENTITY];
        for joint in &self.joints {
            let position = positions[joint.place];
            let motion = match joint.axis.joint {
                Joint::Linear { direction } => DAffine3::from_translation(position * direction.normalize()),
                Joint::Rotary { direction, point } => {
                    let turn = turn_about(direction.normalize(), position);
                    DAffine3 { matrix3: turn, translation: point - turn * point }
                }
            };
            bodies.push(bodies[joint.parent] * motion);
        }
        bodies
    }

    /// What to draw of `machine`, whose chain this is.
    pub fn figure(&self, machine: &Machine, scene: &Scene) -> Figure {
        figure(self, machine, scene)
    }
}

/// A tool to draw, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tool {
    /// From the spindle's nose to the tip.
    pub length: f64,
    /// The cutter's largest radius.
    pub radius: f64,
    /// How far up the cutter goes.
    pub height: f64,
}
