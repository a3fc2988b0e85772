//! The `bossage` binary: everything is in the library, so that tests and tools can use it too.

use std::process::ExitCode;

/// Bytes of stack, taken only as far as they are used. Compilers walk an expression as deeply as it is nested, and a sum of tens of
/// thousands of terms is nested as deeply as it is long: more than the usual 8 MiB.
const STACK: usize = 1 << 30;

fn main() -> ExitCode {
    bossage_cli::drivers::show_own();
    let deep = std::thread::Builder::new().stack_size(STACK);
    match deep.spawn(|| bossage_cli::run(std::env::args_os())) {
        // What a panic says it has said by now.
        Ok(running) => running.join().unwrap_or(ExitCode::from(101)),
        Err(_) => bossage_cli::run(std::env::args_os()),
    }
}
