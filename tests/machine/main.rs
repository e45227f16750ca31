//! Machines: their description, their axes, and the programs that they run.

mod command;
mod description;
mod drive;
mod examples;
mod kinematics;
mod read_back;
mod text;
mod time;
