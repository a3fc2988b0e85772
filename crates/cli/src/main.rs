//! The `bossage` binary: everything is in the library, so that tests and tools can use it too.

fn main() -> std::process::ExitCode {
    bossage_cli::drivers::show_own();
    bossage_cli::run(std::env::args_os())
}
