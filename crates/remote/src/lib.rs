//! Machines in processes of their own: they run the same jobs as a device, one process for a machine and job after job.
//!
//! - [`Kind::Dawn`]: Dawn, the WebGPU of Chromium, whose compiler of WGSL is Tint; the program `dawn` of `./x setup --full`;
//! - [`Kind::OpenGl`]: OpenGL 4.5 core without a display, of the system's own libraries, called by Python.
//!
//! A job that hangs, crashes its process or takes too much memory fails by itself; the next one gets a new process. Which driver is
//! below is chosen by an adapter's name, as the drivers themselves state it; what a kind does not take it refuses with its reason.
//! Text goes in exactly as it is given. Not for measuring time.
//!
//! - [`Remote::open`]: an adapter;
//! - [`Limits`]: what a process may take;
//! - [`lacking`]: what this computer has to have first.

mod answer;
mod compute;
mod groups;
mod kind;
mod lacking;
mod machine;
mod message;
mod process;
mod render;
mod script;

pub use kind::Kind;
pub use lacking::lacking;
pub use machine::Remote;
pub use process::Limits;
