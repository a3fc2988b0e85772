//! A request in a process of its own: what it does to that process is a verdict and ends nothing else.
//!
//! The parent writes the request, listens for one line a job, and ends a child that does not keep its time. A child that ends before its
//! last line has crashed; its last words are the reason.

use std::ffi::OsString;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use super::request::{Request, Said};
use super::{Execution, Executor, Stop};

/// Opening a driver and reading the code.
const START_LIMIT: Duration = Duration::from_secs(60);
/// How much of a child's standard error is kept.
const KEPT: usize = 4000;
/// Reading the rest of what a child said that was ended: a process of its own could keep the pipe open.
const LAST_WORDS_LIMIT: Duration = Duration::from_secs(2);

/// Runs requests in child processes.
#[derive(Clone, Debug)]
pub struct Children {
    /// The program.
    pub program: PathBuf,
    /// Arguments with which it calls [`serve`](super::serve) on its standard input and output.
    pub arguments: Vec<OsString>,
    /// How long one job may take; the first one compiles the code as well.
    pub time_limit: Duration,
}

impl Executor for Children {
    fn execute(&self, request: &Request) -> Execution {
        let mut execution = Execution::default();
        let spoken = Running::start(self, request).and_then(|mut running| {
            let end = running.listen(request.jobs.len(), self.time_limit, &mut execution.done);
            end.map_err(|silence| running.stop(&silence, execution.done.len()))
        });
        match spoken {
            Ok(stopped) => Execution { stopped, ..execution },
            Err(stop) => Execution {
                stopped: Some(stop),
                ..execution
            },
        }
    }
}

/// A child. Dropping it ends it.
struct Running {
    child: Child,
    said: Receiver<String>,
    errors: Option<JoinHandle<String>>,
    over: Receiver<()>,
}

/// Why a child says nothing that makes sense.
enum Silence {
    Ended,
    TimedOut(Duration),
    Noise(String),
}

impl Running {
    fn start(children: &Children, request: &Request) -> Result<Self, Stop> {
        let cannot = |what: &str, error: &dyn std::fmt::Display| {
            Stop::Failed(format!("a process to run it in {what}: {error}"))
        };
        let text = serde_json::to_vec(request).map_err(|e| cannot("cannot be told what to run", &e))?;
        let mut child = Command::new(&children.program)
            .args(&children.arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|e| cannot("cannot be started", &e))?;
        let (sender, said) = channel();
        let (open, over) = channel::<()>();
        let (input, out, err) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        // A child that does not read closes the pipe; that it has ended is noticed when nothing comes back.
        thread::spawn(move || input.map(|mut pipe| pipe.write_all(&text)));
        thread::spawn(move || {
            let lines = out.map(|pipe| BufReader::new(pipe).lines().map_while(Result::ok));
            for line in lines.into_iter().flatten() {
                if sender.send(line).is_err() {
                    return;
                }
            }
        });
        let errors = thread::spawn(move || {
            let kept = err.map_or_else(String::new, keep);
            drop(open);
            kept
        });
        Ok(Self {
            child,
            said,
            errors: Some(errors),
            over,
        })
    }

    /// Hears one line a job. `Ok` is a regular end, early if the child says why.
    fn listen(
        &mut self,
        jobs: usize,
        limit: Duration,
        done: &mut Vec<Vec<Vec<u8>>>,
    ) -> Result<Option<Stop>, Silence> {
        let mut patience = START_LIMIT;
        while done.len() < jobs {
            match self.hear(patience)? {
                Said::Ready => {}
                Said::Done(buffers) => done.push(buffers.into_iter().map(|bytes| bytes.0).collect()),
                Said::Stopped(stop) => return Ok(Some(stop)),
            }
            patience = limit;
        }
        Ok(None)
    }

    fn hear(&self, limit: Duration) -> Result<Said, Silence> {
        let line = self.said.recv_timeout(limit).map_err(|error| match error {
            RecvTimeoutError::Timeout => Silence::TimedOut(limit),
            RecvTimeoutError::Disconnected => Silence::Ended,
        })?;
        serde_json::from_str(&line).map_err(|_| Silence::Noise(line))
    }

    /// What a silence means, after `done` jobs.
    fn stop(&mut self, silence: &Silence, done: usize) -> Stop {
        let at = format!("input {done}");
        Stop::Failed(match silence {
            Silence::TimedOut(limit) => format!(
                "{at}: it did not end within {} s, and its process was ended",
                limit.as_secs_f64()
            ),
            Silence::Ended => format!("{at}: the process that ran it {}", self.end()),
            Silence::Noise(line) => {
                let start: String = line.chars().take(200).collect();
                format!("{at}: the process that ran it said what makes no sense: {start}")
            }
        })
    }

    /// How the process ended, and its last words.
    fn end(&mut self) -> String {
        let _ = self.child.kill();
        let ended = self
            .child
            .wait()
            .map_or_else(|error| error.to_string(), |status| status.to_string());
        // Nothing is sent: the channel closes when all is read.
        let read = !matches!(
            self.over.recv_timeout(LAST_WORDS_LIMIT),
            Err(RecvTimeoutError::Timeout)
        );
        let words = self.errors.take().filter(|_| read).map(JoinHandle::join);
        let words = words.and_then(Result::ok).unwrap_or_default();
        let last = words.lines().rev().find(|line| !line.trim().is_empty());
        format!(
            "crashed ({ended}); its last words: {}",
            last.unwrap_or("none").trim()
        )
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Reads to the end and keeps the last of it.
fn keep(mut from: impl Read) -> String {
    let (mut kept, mut buffer) = (Vec::new(), [0; 1024]);
    while let Ok(length @ 1..) = from.read(&mut buffer) {
        kept.extend_from_slice(&buffer[..length]);
        let surplus = kept.len().saturating_sub(KEPT);
        kept.drain(..surplus);
    }
    String::from_utf8_lossy(&kept).into_owned()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn with_script(script: &str, jobs: usize) -> Execution {
        let children = Children {
            program: PathBuf::from("/bin/sh"),
            arguments: vec!["-c".into(), script.into()],
            time_limit: Duration::from_millis(200),
        };
        let job = super::super::Job {
            buffers: Vec::new(),
            textures: Vec::new(),
            samplers: Vec::new(),
            workgroups: [1; 3],
        };
        children.execute(&Request {
            route: "wgsl".to_owned(),
            adapter: "any".to_owned(),
            name: "shader".to_owned(),
            wgsl: String::new(),
            entry: "main".to_owned(),
            companion: None,
            original: None,
            jobs: vec![job; jobs],
        })
    }

    fn reason(execution: &Execution) -> &str {
        match execution.stopped.as_ref().expect("it stopped") {
            Stop::Failed(reason) | Stop::Lacks(reason) => reason,
        }
    }

    const ONE: &str = r#"echo '"ready"'; echo '{"done":["AAAA"]}'"#;

    #[test]
    fn what_comes_back_is_kept_job_by_job() {
        let execution = with_script(&format!("{ONE}; cat > /dev/null"), 1);
        assert_eq!(execution.done, [[[0, 0, 0]]]);
        assert_eq!(execution.stopped, None);
    }

    #[test]
    fn a_hang_ends_the_process_and_keeps_what_came_before() {
        let execution = with_script(&format!("{ONE}; exec sleep 60"), 2);
        assert_eq!(execution.done.len(), 1);
        assert!(
            reason(&execution).starts_with("input 1: it did not end within 0.2 s"),
            "{execution:?}"
        );
    }

    #[test]
    fn a_crash_is_told_with_its_last_words() {
        let execution = with_script(&format!("{ONE}; echo 'the driver gave up' >&2; kill -SEGV $$"), 2);
        let reason = reason(&execution);
        assert!(
            reason.contains("crashed") && reason.contains("the driver gave up"),
            "{reason}"
        );
    }

    #[test]
    fn refusals_and_noise_are_told_apart() {
        let refused = with_script(r#"echo '{"stopped":{"lacks":"no such thing"}}'"#, 1);
        assert_eq!(refused.stopped, Some(Stop::Lacks("no such thing".to_owned())));
        assert!(reason(&with_script("echo hello", 1)).contains("makes no sense: hello"));
        let children = Children {
            program: PathBuf::from("/nowhere/program"),
            arguments: Vec::new(),
            time_limit: Duration::from_secs(1),
        };
        let empty = Request {
            route: String::new(),
            adapter: String::new(),
            name: String::new(),
            wgsl: String::new(),
            entry: String::new(),
            companion: None,
            original: None,
            jobs: Vec::new(),
        };
        assert!(reason(&children.execute(&empty)).contains("cannot be started"));
    }
}
