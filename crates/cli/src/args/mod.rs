//! What can be typed: one struct a command, in a file of the command's name.
//!
//! These structs hold no logic. They say which flags exist, what they are for and which values they take; `run` turns
//! them into work. Closed sets of values are enums, so a misspelt one is answered with the nearest real one.

pub(crate) mod bake;
pub(crate) mod check;
pub(crate) mod conform;
pub(crate) mod demo;
pub(crate) mod doctor;
pub(crate) mod emit;
pub(crate) mod plan;
pub(crate) mod render;
pub(crate) mod study;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Surface relief for shaders: a scene in; checked shaders in five languages out, executed and compared with float64.
#[derive(Debug, Parser)]
#[command(name = "bossage", version, max_term_width = 100, after_help = EXIT_CODES)]
pub(crate) struct Cli {
    #[command(flatten)]
    pub(crate) global: Global,
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_CODES: &str = "\
Exit codes:
  0  fine
  1  a check failed
  2  the input or the call is wrong, or an output cannot be written
  3  the environment lacks what was demanded

Example:
  bossage demo";

/// Flags that every command takes.
#[derive(Clone, Debug, Args)]
pub(crate) struct Global {
    /// Take the shader library's sources from this folder instead of the embedded ones
    #[arg(long, value_name = "DIR", global = true)]
    pub(crate) shader_dir: Option<PathBuf>,
    /// Print results only: no progress, no banner (NO_COLOR turns colours off)
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
}

/// The commands, in the order of the road that a scene takes.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// The main job on a bundled scene, end to end: plan, emit, check, render, conform, report
    #[command(after_help = demo::EXAMPLE)]
    Demo(demo::Demo),
    /// Say which effects a scene calls for, which it does not, and why
    #[command(after_help = plan::EXAMPLE)]
    Plan(plan::Plan),
    /// Write a scene's or a shader's code in SPIR-V, HLSL, MSL, GLSL and WGSL, with a manifest
    #[command(after_help = emit::EXAMPLE)]
    Emit(emit::Emit),
    /// Validate, emit every target in memory, ask the external compilers, lint
    #[command(after_help = check::EXAMPLE)]
    Check(check::Check),
    /// Execute the emitted code and compare its numbers with float64 truth
    #[command(after_help = conform::EXAMPLE)]
    Conform(Box<conform::Conform>),
    /// Measure what accuracy costs in time, technique by technique
    #[command(after_help = study::EXAMPLE)]
    Study(Box<study::Study>),
    /// Draw a scene into a PNG
    #[command(after_help = render::EXAMPLE)]
    Render(render::Render),
    /// Bake maps from a height image
    #[command(after_help = bake::EXAMPLE)]
    Bake(bake::Bake),
    /// Say which adapters and external tools are there, and how to get the others
    #[command(after_help = doctor::EXAMPLE)]
    Doctor(doctor::Doctor),
    /// Print a completion script for a shell
    #[command(after_help = COMPLETIONS_EXAMPLE)]
    Completions(Completions),
}

const COMPLETIONS_EXAMPLE: &str = "\
Example:
  bossage completions bash > ~/.local/share/bash-completion/completions/bossage";

/// `bossage completions SHELL`.
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell to complete for
    pub(crate) shell: clap_complete::Shell,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    /// clap checks its own tables (clashing flags, missing names) only when asked.
    #[test]
    fn the_table_of_flags_is_sound() {
        super::Cli::command().debug_assert();
    }

    /// Every command says how it is used, by an example that starts with the command itself.
    #[test]
    fn every_command_has_an_example() {
        for command in super::Cli::command().get_subcommands() {
            let name = command.get_name();
            let help = command
                .get_after_help()
                .map(ToString::to_string)
                .unwrap_or_default();
            assert!(
                help.contains(&format!("  bossage {name}")),
                "{name} shows no example of itself: {help:?}"
            );
        }
    }
}
