//! Runs a program of others with limits on its time, its memory and on what it may say.
//!
//! A program gets a process group of its own, and all of the group is ended when its time is over, so that what it started itself
//! neither goes on nor keeps its pipes open. The limit on memory is on the address space and needs a POSIX shell; on other systems
//! there is none.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// What a program may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// From its start to its end.
    pub time: Duration,
    /// Bytes that it may address.
    pub memory_bytes: u64,
    /// Bytes that are kept of what it says; the rest is read and dropped.
    pub output_bytes: usize,
}

/// How a program ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Whether it ended with exit code 0.
    pub success: bool,
    /// Whether it was ended by a signal instead of by itself.
    pub crashed: bool,
    /// The beginning of what it wrote to standard output, then to standard error.
    pub output: String,
}

/// How a program ended, with what it wrote to standard output kept as it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raw {
    /// Whether it ended with exit code 0.
    pub success: bool,
    /// How it ended, in words.
    pub status: String,
    /// The beginning of what it wrote to standard output, at most [`Limits::output_bytes`].
    pub output: Vec<u8>,
    /// How many bytes more it wrote there.
    pub surplus: usize,
    /// The beginning of what it wrote to standard error.
    pub errors: String,
}

/// What is kept of standard error beside bytes.
const ERROR_BYTES: usize = 4096;

/// Runs a program whose output is bytes.
///
/// # Errors
/// As [`run`].
pub fn run_raw(program: &Path, arguments: &[String], input: &[u8], limits: &Limits) -> Result<Raw, String> {
    let (status, out, err) = spoken(program, arguments, input, limits, ERROR_BYTES)?;
    Ok(Raw {
        success: status.success(),
        status: status.to_string(),
        output: out.bytes,
        surplus: out.dropped,
        errors: err.text(),
    })
}

/// Runs a program on an input that it gets through a pipe.
///
/// # Errors
/// Why there is no outcome: it could not be started, or took too long and was ended.
pub fn run(program: &Path, arguments: &[String], input: &[u8], limits: &Limits) -> Result<Outcome, String> {
    let (status, out, err) = spoken(program, arguments, input, limits, limits.output_bytes)?;
    Ok(outcome(status, out.text() + &err.text()))
}

fn spoken(
    program: &Path,
    arguments: &[String],
    input: &[u8],
    limits: &Limits,
    error_bytes: usize,
) -> Result<(ExitStatus, Kept, Kept), String> {
    let mut child = start(program, arguments, limits)
        .map_err(|error| format!("`{}` could not be started: {error}", program.display()))?;
    let (stdin, stdout, stderr) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
    thread::scope(|scope| {
        scope.spawn(move || {
            // A program that does not read its input closes the pipe; its verdict counts all the same.
            stdin.map(|mut pipe| pipe.write_all(input))
        });
        let out =
            scope.spawn(move || stdout.map_or_else(Kept::default, |pipe| keep(pipe, limits.output_bytes)));
        let err = scope.spawn(move || stderr.map_or_else(Kept::default, |pipe| keep(pipe, error_bytes)));
        let status = wait(&mut child, limits.time);
        let (out, err) = (out.join().unwrap_or_default(), err.join().unwrap_or_default());
        let status = status.map_err(|why| format!("`{}` {why}", program.display()))?;
        Ok((status, out, err))
    })
}

/// Starts it in a process group of its own, under a shell that sets the limit on memory and then becomes the program. All three of its
/// standard streams are pipes. Time and what it says are for the caller to watch, who has to [`end`] it.
///
/// # Errors
/// When it is not there or cannot be started.
#[cfg(unix)]
pub fn start(program: &Path, arguments: &[String], limits: &Limits) -> std::io::Result<Child> {
    use std::os::unix::process::CommandExt;

    // The shell would say in words of its own that there is no such program.
    std::fs::metadata(program)?;
    let kilobytes = limits.memory_bytes / 1024;
    let script = format!("ulimit -c 0; ulimit -v {kilobytes} && exec \"$@\"");
    piped(
        Command::new("/bin/sh")
            .args(["-c", &script, "sh"])
            .arg(program)
            .args(arguments)
            .process_group(0),
    )
}

/// Starts it, without a limit on memory. All three of its standard streams are pipes. Time and what it says are for the caller to
/// watch, who has to [`end`] it.
///
/// # Errors
/// When it is not there or cannot be started.
#[cfg(not(unix))]
pub fn start(program: &Path, arguments: &[String], _: &Limits) -> std::io::Result<Child> {
    piped(Command::new(program).args(arguments))
}

fn piped(command: &mut Command) -> std::io::Result<Child> {
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
}

/// Ends a program and all that it started. Either fails only if it has just ended, which is as good.
pub fn end(child: &mut Child) {
    #[cfg(unix)]
    let _ = Command::new("/bin/sh")
        .args(["-c", "kill -s KILL -- \"-$1\"", "sh", &child.id().to_string()])
        .stderr(Stdio::null())
        .status();
    let _ = child.kill();
    let _ = child.wait();
}

fn outcome(status: ExitStatus, mut output: String) -> Outcome {
    let crashed = status.code().is_none();
    if crashed {
        output.push_str(&format!("\nended by a signal ({status})"));
    }
    Outcome {
        success: status.success(),
        crashed,
        output,
    }
}

/// The beginning of what a program said.
#[derive(Default)]
struct Kept {
    bytes: Vec<u8>,
    dropped: usize,
}

impl Kept {
    fn text(&self) -> String {
        let mut text = String::from_utf8_lossy(&self.bytes).into_owned();
        if self.dropped > 0 {
            text.push_str(&format!("\n… {} more bytes", self.dropped));
        }
        text
    }
}

/// Reads to the end, so that the program never waits for us, but keeps only the beginning.
fn keep(mut pipe: impl Read, limit: usize) -> Kept {
    let mut kept = Kept::default();
    let mut chunk = [0; 1 << 16];
    while let Ok(count @ 1..) = pipe.read(&mut chunk) {
        let room = limit.saturating_sub(kept.bytes.len()).min(count);
        kept.bytes.extend_from_slice(&chunk[..room]);
        kept.dropped += count - room;
    }
    kept
}

/// Waits for the end, ever more patiently, and ends the program when its time is over.
fn wait(child: &mut Child, time_limit: Duration) -> Result<ExitStatus, String> {
    let start = Instant::now();
    let mut pause = Duration::from_micros(200);
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(status),
            Ok(None) if start.elapsed() < time_limit => thread::sleep(pause),
            Ok(None) => {
                end(child);
                return Err(format!(
                    "took longer than {} s and was ended",
                    time_limit.as_secs_f32()
                ));
            }
            Err(error) => return Err(format!("could not be waited for: {error}")),
        }
        pause = (pause * 2).min(Duration::from_millis(10));
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits {
        time: LONG,
        memory_bytes: 1 << 30,
        output_bytes: 1000,
    };

    fn shell(script: &str, input: &[u8], time: Duration) -> Result<Outcome, String> {
        let arguments = ["-c".to_owned(), script.to_owned()];
        run(
            Path::new("/bin/sh"),
            &arguments,
            input,
            &Limits { time, ..LIMITS },
        )
    }

    const LONG: Duration = Duration::from_secs(30);

    #[test]
    fn input_goes_in_and_both_outputs_come_out() {
        let outcome = shell("cat; echo err >&2; exit 3", b"in ", LONG).unwrap();
        assert_eq!(outcome.output, "in err\n");
        assert!(!outcome.success && !outcome.crashed);
    }

    #[test]
    fn a_hang_is_ended() {
        let start = Instant::now();
        let problem = shell("exec sleep 60", b"", Duration::from_millis(50)).unwrap_err();
        assert!(problem.contains("took longer than 0.05 s"), "{problem}");
        assert!(start.elapsed() < LONG);
    }

    #[test]
    fn what_a_program_started_is_ended_with_it() {
        let start = Instant::now();
        let problem = shell("sleep 60 & sleep 60", b"", Duration::from_millis(50)).unwrap_err();
        assert!(problem.contains("took longer"), "{problem}");
        // The grandchild holds the pipes: were it alive, they would be read until it ends.
        assert!(start.elapsed() < LONG);
    }

    #[test]
    fn memory_beyond_the_limit_is_refused() {
        let script = "x=xxxxxxxxxxxxxxxx; while :; do x=$x$x; done";
        let outcome = shell(script, b"", LONG).unwrap();
        assert!(!outcome.success, "{}", outcome.output);
        // Negative control: within the limit the same shell is fine.
        assert!(shell("x=xxxxxxxxxxxxxxxx; x=$x$x", b"", LONG).unwrap().success);
    }

    #[test]
    fn megabytes_of_output_are_cut() {
        let outcome = shell("yes | head -c 3000000", b"", LONG).unwrap();
        assert!(outcome.success);
        assert!(outcome.output.len() < 1100);
        assert!(outcome.output.ends_with("2999000 more bytes"));
    }

    #[test]
    fn a_large_input_that_nobody_reads_does_not_block() {
        let input = vec![b'x'; 4_000_000];
        assert!(shell("exit 0", &input, LONG).unwrap().success);
    }

    #[test]
    fn a_signal_is_a_crash() {
        let outcome = shell("kill -SEGV $$", b"", LONG).unwrap();
        assert!(outcome.crashed && !outcome.success);
    }

    #[test]
    fn a_missing_program_is_said() {
        let problem = run(Path::new("/nowhere/tool"), &[], b"", &LIMITS).unwrap_err();
        assert!(problem.contains("could not be started"));
    }
}
