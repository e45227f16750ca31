//! Machines: their description, their axes, and the programs that they run.

mod command;
mod cutting;
mod description;
mod drive;
mod examples;
mod kinematics;
mod pole;
mod read_back;
mod show;
mod text;
mod time;
