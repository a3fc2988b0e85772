//! The `bossage-mutants` binary: everything is in the library.

fn main() -> std::process::ExitCode {
    bossage_mutants::run(std::env::args_os())
}
