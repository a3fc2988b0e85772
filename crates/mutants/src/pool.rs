//! The parent of the workers: hands out mutants, keeps the time, and survives what they do not.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use crate::error::Error;
use crate::fate::Fate;
use crate::mutant::Mutant;
use crate::worker::Said;

/// Reading the library and opening the device.
const START_LIMIT: Duration = Duration::from_secs(300);
/// Assembling and validating one mutant.
const PREPARE_LIMIT: Duration = Duration::from_secs(120);
/// Reading the rest of what a worker said that has ended; a process of its own could keep the pipe open.
const LAST_WORDS_LIMIT: Duration = Duration::from_secs(2);
/// How much of a worker's standard error is kept.
const KEPT: usize = 4000;

/// How workers are started.
#[derive(Clone, Debug)]
pub(crate) struct Pool<'a> {
    /// The program that serves as a worker: this one.
    pub(crate) program: PathBuf,
    /// What comes before the worker's own arguments.
    pub(crate) arguments: Vec<PathBuf>,
    /// The folder of the sources, which nobody changes meanwhile.
    pub(crate) folder: &'a Path,
    /// The adapter's name; any when `None`.
    pub(crate) adapter: Option<&'a str>,
    /// Whether the examples' scenes are rendered.
    pub(crate) scenes: bool,
    /// How many at a time, at least one.
    pub(crate) jobs: usize,
}

/// What is left to do. Mutants of one file reach the same cases, so a worker stays with a file while it can.
struct Queue {
    files: Vec<VecDeque<usize>>,
}

impl Queue {
    fn new(mutants: &[Mutant]) -> Self {
        let mut files: Vec<VecDeque<usize>> = Vec::new();
        for (index, mutant) in mutants.iter().enumerate() {
            match files.last_mut() {
                Some(file) if index > 0 && mutants[index - 1].file == mutant.file => file.push_back(index),
                _ => files.push(VecDeque::from([index])),
            }
        }
        Self { files }
    }

    /// The next mutant for a worker that works on `file`; another file where that is done, else the longest rest.
    fn next(&mut self, file: &mut Option<usize>, taken: &mut Vec<bool>) -> Option<usize> {
        taken.resize(self.files.len(), false);
        let own = file.filter(|&at| !self.files[at].is_empty());
        let fresh = || (0..self.files.len()).find(|&at| !taken[at] && !self.files[at].is_empty());
        let longest = || (0..self.files.len()).max_by_key(|&at| self.files[at].len());
        let at = own.or_else(fresh).or_else(longest)?;
        taken[at] = true;
        *file = Some(at);
        self.files[at].pop_front()
    }
}

impl Pool<'_> {
    /// Judges all mutants; `done` hears of each as it ends, in any order.
    pub(crate) fn run(&self, mutants: &[Mutant], done: &mut dyn FnMut(usize, Fate)) -> Result<(), Error> {
        let queue = Mutex::new((Queue::new(mutants), Vec::new()));
        let (sender, receiver) = channel();
        thread::scope(|scope| {
            for _ in 0..self.jobs.min(mutants.len()).max(1) {
                let (sender, queue) = (sender.clone(), &queue);
                scope.spawn(move || self.work(mutants, queue, &sender));
            }
            drop(sender);
            let mut result = Ok(());
            for (index, fate) in receiver {
                match fate {
                    Ok(fate) => done(index, fate),
                    Err(error) if result.is_ok() => {
                        lock(&queue).0.files.iter_mut().for_each(VecDeque::clear);
                        result = Err(error);
                    }
                    Err(_) => {}
                }
            }
            result
        })
    }

    fn work(
        &self,
        mutants: &[Mutant],
        queue: &Mutex<(Queue, Vec<bool>)>,
        sender: &Sender<(usize, Result<Fate, Error>)>,
    ) {
        let (mut worker, mut file) = (None, None);
        loop {
            let next = {
                let mut guard = lock(queue);
                let (queue, taken) = &mut *guard;
                queue.next(&mut file, taken)
            };
            let Some(index) = next else { return };
            let fate = self.fate(&mut worker, &mutants[index]);
            // The receiver outlives the workers.
            if sender.send((index, fate)).is_err() {
                return;
            }
        }
    }

    fn fate(&self, worker: &mut Option<Worker>, mutant: &Mutant) -> Result<Fate, Error> {
        let mut serving = match worker.take() {
            Some(serving) => serving,
            None => Worker::start(self)?,
        };
        let fate = serving.judge(&mutant.id)?;
        match fate {
            Fate::TimedOut { .. } | Fate::Crashed { .. } => {}
            Fate::Invalid { .. } | Fate::Caught { .. } | Fate::Survived { .. } | Fate::Unreached => {
                *worker = Some(serving)
            }
        }
        Ok(fate)
    }
}

/// A child process. Dropping it ends it.
struct Worker {
    child: Child,
    input: Option<ChildStdin>,
    said: Receiver<String>,
    errors: Arc<Mutex<String>>,
    /// Ends when standard error does.
    errors_open: Receiver<()>,
}

impl Worker {
    fn start(pool: &Pool<'_>) -> Result<Self, Error> {
        let failed = |error: std::io::Error| Error::Worker(format!("could not be started: {error}"));
        let threads = (thread::available_parallelism().map_or(1, usize::from) / pool.jobs)
            .max(1)
            .to_string();
        let mut command = Command::new(&pool.program);
        command.args(&pool.arguments);
        command.arg("--worker").arg("--shader-dir").arg(pool.folder);
        if !pool.scenes {
            command.arg("--without-scenes");
        }
        if let Some(adapter) = pool.adapter {
            command.args(["--adapter", adapter]);
        }
        // As many threads in all as there are cores: the oracles' and a software adapter's.
        command
            .env("RAYON_NUM_THREADS", &threads)
            .env("LP_NUM_THREADS", &threads);
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command.spawn().map_err(failed)?;
        let errors = Arc::new(Mutex::new(String::new()));
        let (sender, said) = channel();
        let (open, errors_open) = channel::<()>();
        if let Some(out) = child.stdout.take() {
            thread::spawn(move || {
                let lines = BufReader::new(out).lines().map_while(Result::ok);
                let _ = lines
                    .map(|line| sender.send(line))
                    .take_while(Result::is_ok)
                    .count();
            });
        }
        if let Some(err) = child.stderr.take() {
            let errors = Arc::clone(&errors);
            thread::spawn(move || {
                keep(err, &errors);
                drop(open);
            });
        }
        let input = child.stdin.take();
        let mut worker = Self {
            child,
            input,
            said,
            errors,
            errors_open,
        };
        worker.ready()?;
        Ok(worker)
    }

    fn ready(&mut self) -> Result<(), Error> {
        match self.hear(START_LIMIT) {
            Ok(Said::Ready) => Ok(()),
            Ok(Said::Broken(message)) => Err(Error::Worker(format!("could not begin: {message}"))),
            Ok(other) => Err(Error::Worker(format!("began with {other:?}"))),
            Err(Silence::Ended) => Err(Error::Worker(format!("ended at once: {}", self.last_words()))),
            Err(Silence::TimedOut) => Err(Error::Worker("did not begin in its time".to_owned())),
            Err(Silence::Noise(line)) => Err(noise(&line)),
        }
    }

    fn judge(&mut self, id: &str) -> Result<Fate, Error> {
        let asked = self
            .input
            .as_mut()
            .map(|input| writeln!(input, "{id}").and_then(|()| input.flush()));
        if !matches!(asked, Some(Ok(()))) {
            return Err(Error::Worker(format!(
                "takes no more mutants: {}",
                self.last_words()
            )));
        }
        let (mut limit, mut case, mut unmutated) = (PREPARE_LIMIT, "preparing".to_owned(), false);
        loop {
            match self.hear(limit) {
                Ok(Said::Done(fate)) => return Ok(fate),
                Ok(Said::Broken(message)) => return Err(Error::Worker(format!("cannot go on: {message}"))),
                Ok(Said::Ready) => return Err(Error::Worker("began twice".to_owned())),
                Ok(step @ Said::Step { .. }) => {
                    limit = step.limit().unwrap_or(PREPARE_LIMIT);
                    if let Said::Step {
                        case: name,
                        unmutated: without,
                        ..
                    } = step
                    {
                        (case, unmutated) = (name, without);
                    }
                }
                Err(Silence::Noise(line)) => return Err(noise(&line)),
                Err(Silence::Ended) if unmutated => {
                    return Err(Error::Worker(format!(
                        "ended in {case} without a fault: {}",
                        self.last_words()
                    )));
                }
                Err(Silence::TimedOut) if unmutated => {
                    return Err(Error::Worker(format!(
                        "did not end {case} in its time, without a fault"
                    )));
                }
                Err(Silence::Ended) => {
                    return Ok(Fate::Crashed {
                        case,
                        reason: self.last_words(),
                    });
                }
                Err(Silence::TimedOut) => return Ok(Fate::TimedOut { case }),
            }
        }
    }

    fn hear(&self, limit: Duration) -> Result<Said, Silence> {
        let line = self.said.recv_timeout(limit).map_err(|error| match error {
            RecvTimeoutError::Timeout => Silence::TimedOut,
            RecvTimeoutError::Disconnected => Silence::Ended,
        })?;
        serde_json::from_str(&line).map_err(|_| Silence::Noise(line))
    }

    /// The last line of its standard error.
    fn last_words(&mut self) -> String {
        // After the end, so that nothing is on its way any more.
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = self.errors_open.recv_timeout(LAST_WORDS_LIMIT);
        let errors = lock(&self.errors);
        errors
            .lines()
            .rev()
            .find(|line| !line.trim().is_empty())
            .unwrap_or("it said nothing")
            .trim()
            .to_owned()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        // Without input it would end by itself, but not from within a shader that does not.
        self.input = None;
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Why a worker says nothing that makes sense.
enum Silence {
    Ended,
    TimedOut,
    Noise(String),
}

fn noise(line: &str) -> Error {
    Error::Worker(format!("said what makes no sense: {line}"))
}

/// Reads to the end and keeps the last of it.
fn keep(mut from: impl Read, kept: &Mutex<String>) {
    let mut buffer = [0; 1024];
    while let Ok(length @ 1..) = from.read(&mut buffer) {
        let mut kept = lock(kept);
        kept.push_str(&String::from_utf8_lossy(&buffer[..length]));
        while kept.len() > KEPT {
            let first = kept.chars().next().map_or(1, char::len_utf8);
            kept.drain(..first);
        }
    }
}

/// A poisoned lock holds data that is as good as before.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(all(test, unix))]
mod tests {
    use super::{Pool, Queue};
    use crate::error::Error;
    use crate::fate::Fate;
    use crate::generate::of_file;
    use crate::mutant::Mutant;

    fn two() -> Vec<Mutant> {
        let text = "fn f(a: f32) -> f32 { return a + 1.0; }";
        of_file("a.wesl", text).unwrap().into_iter().take(2).collect()
    }

    /// What becomes of two mutants with a worker that is a script: it says `ready`, and then does `each` for each id.
    fn with_script(each: &str) -> Result<Vec<Fate>, Error> {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("worker");
        let ready = r#"echo '"ready"'"#;
        std::fs::write(&script, format!("{ready}\nwhile read -r id; do\n{each}\ndone\n")).unwrap();
        let pool = Pool {
            program: "sh".into(),
            arguments: vec![script],
            folder: folder.path(),
            adapter: None,
            scenes: true,
            jobs: 1,
        };
        let mut fates = Vec::new();
        pool.run(&two(), &mut |index, fate| fates.push((index, fate)))?;
        fates.sort_by_key(|(index, _)| *index);
        Ok(fates.into_iter().map(|(_, fate)| fate).collect())
    }

    const STEP: &str = r#"echo '{"step":{"case":"dot3/edge","unmutated":false,"limit_seconds":0.2}}'"#;

    #[test]
    fn a_case_that_never_ends_is_ended_and_the_next_mutant_has_its_turn() {
        let case = "dot3/edge".to_owned();
        let fates = with_script(&format!("{STEP}; sleep 60")).unwrap();
        assert_eq!(fates, vec![Fate::TimedOut { case }; 2]);
    }

    #[test]
    fn a_process_that_ends_is_caught_with_its_last_words() {
        let fates = with_script(&format!("{STEP}; echo 'the driver gave up' >&2; exit 3")).unwrap();
        let crashed = Fate::Crashed {
            case: "dot3/edge".to_owned(),
            reason: "the driver gave up".to_owned(),
        };
        assert_eq!(fates, vec![crashed; 2]);
    }

    #[test]
    fn what_fails_without_a_fault_is_an_error() {
        let unmutated = STEP.replace("false", "true");
        for each in [
            format!("{unmutated}; exit 3"),
            format!("{unmutated}; sleep 60"),
            "echo nonsense".to_owned(),
        ] {
            let error = with_script(&each).unwrap_err().to_string();
            assert!(error.starts_with("a worker process "), "{each}: {error}");
        }
        let error = with_script(r#"echo '{"broken":"no adapter"}'"#)
            .unwrap_err()
            .to_string();
        assert!(error.contains("no adapter"), "{error}");
    }

    #[test]
    fn workers_stay_with_their_files_and_help_at_the_end() {
        let text = "fn f(a: f32) -> f32 { return a + 1.0; }";
        let mutants: Vec<_> = ["a.wesl", "b.wesl"]
            .iter()
            .flat_map(|file| of_file(file, text).unwrap())
            .collect();
        let half = mutants.len() / 2;
        let (mut queue, mut taken) = (Queue::new(&mutants), Vec::new());
        let (mut first, mut second) = (None, None);
        assert_eq!(queue.next(&mut first, &mut taken), Some(0));
        assert_eq!(queue.next(&mut second, &mut taken), Some(half));
        assert_eq!(queue.next(&mut first, &mut taken), Some(1));
        // The first file ends; its worker helps with the second.
        let rest: Vec<usize> = std::iter::from_fn(|| queue.next(&mut first, &mut taken)).collect();
        assert_eq!(rest, (2..half).chain(half + 1..mutants.len()).collect::<Vec<_>>());
        assert_eq!(queue.next(&mut second, &mut taken), None);
    }
}
