//! A process: messages go in and come out through pipes, under limits on time, memory and what it may say.

use std::io::{Read, Write};
use std::path::Path;
use std::process::Child;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use bossage_translate::external;

/// What the process may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// For one job, and for its start.
    pub time: Duration,
    /// Bytes that it may address.
    pub memory_bytes: u64,
    /// Bytes of one answer.
    pub answer_bytes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            time: Duration::from_secs(120),
            memory_bytes: 16 << 30,
            answer_bytes: 1 << 30,
        }
    }
}

/// Bytes that are kept of what it says on standard error.
const SAID_BYTES: usize = 2000;

/// Why there is no answer. The process is gone then.
#[derive(Debug)]
pub(crate) struct Stopped(pub(crate) String);

/// JSON and data.
pub(crate) type Message = (Vec<u8>, Vec<u8>);

/// A process that answers.
#[derive(Debug)]
pub(crate) struct Process {
    child: Child,
    requests: Option<SyncSender<Vec<u8>>>,
    answers: Receiver<Result<Message, String>>,
    said: Option<JoinHandle<String>>,
    limits: Limits,
}

impl Process {
    /// Starts it. Its first answer says what it is.
    pub(crate) fn start(program: &Path, arguments: &[String], limits: Limits) -> Result<Self, Stopped> {
        let of_tool = external::Limits {
            time: limits.time,
            memory_bytes: limits.memory_bytes,
            output_bytes: SAID_BYTES,
        };
        let mut child = external::start(program, arguments, &of_tool)
            .map_err(|error| Stopped(format!("`{}` could not be started: {error}", program.display())))?;
        let (stdin, stdout, stderr) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        let (requests, to_write) = mpsc::sync_channel::<Vec<u8>>(1);
        thread::spawn(move || {
            let Some(mut pipe) = stdin else { return };
            // A process that reads no more has ended, which its missing answer tells.
            while let Ok(bytes) = to_write.recv() {
                if pipe.write_all(&bytes).is_err() {
                    return;
                }
            }
        });
        let (answered, answers) = mpsc::channel();
        thread::spawn(move || {
            let Some(mut pipe) = stdout else { return };
            loop {
                let message = read(&mut pipe, limits.answer_bytes);
                let is_last = message.is_err();
                if answered.send(message).is_err() || is_last {
                    return;
                }
            }
        });
        let said = thread::spawn(move || stderr.map_or_else(String::new, last_words));
        Ok(Self {
            child,
            requests: Some(requests),
            answers,
            said: Some(said),
            limits,
        })
    }

    /// Sends a job and waits for its answer. After an error the process is gone.
    pub(crate) fn ask(&mut self, json: &[u8], data: &[u8]) -> Result<Message, Stopped> {
        let mut bytes = Vec::with_capacity(8 + json.len() + data.len());
        for length in [json.len(), data.len()] {
            let length = u32::try_from(length)
                .map_err(|_| Stopped("the job has more than 4 GiB of data".to_owned()))?;
            bytes.extend_from_slice(&length.to_le_bytes());
        }
        bytes.extend_from_slice(json);
        bytes.extend_from_slice(data);
        if let Some(requests) = &self.requests {
            // Where nobody takes it the process has ended, which the answer tells.
            let _ = requests.send(bytes);
        }
        self.answer()
    }

    /// Waits for the next answer.
    pub(crate) fn answer(&mut self) -> Result<Message, Stopped> {
        match self.answers.recv_timeout(self.limits.time) {
            Ok(Ok(message)) => Ok(message),
            Ok(Err(problem)) => Err(Stopped(self.ended(&problem))),
            Err(RecvTimeoutError::Timeout) => {
                self.end();
                let seconds = self.limits.time.as_secs_f32();
                Err(Stopped(format!(
                    "its process took longer than {seconds} s and was ended"
                )))
            }
            Err(RecvTimeoutError::Disconnected) => Err(Stopped(self.ended("it says nothing more"))),
        }
    }

    /// What is known of a process that does not answer.
    fn ended(&mut self, problem: &str) -> String {
        // It closes its pipes a moment before it is over.
        let mut status = None;
        for _ in 0..100 {
            status = self.child.try_wait().ok().flatten();
            if status.is_some() {
                break;
            }
            thread::sleep(Duration::from_millis(10));
        }
        self.end();
        let how = status.map_or_else(|| "was ended".to_owned(), |status| format!("ended ({status})"));
        let said = self
            .said
            .take()
            .and_then(|said| said.join().ok())
            .unwrap_or_default();
        format!("its process {how}: {problem}\n{}", said.trim())
            .trim()
            .to_owned()
    }

    fn end(&mut self) {
        self.requests = None;
        external::end(&mut self.child);
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.end();
    }
}

/// Reads one message; an error says why there is none.
fn read(pipe: &mut impl Read, limit: usize) -> Result<Message, String> {
    let mut lengths = [0; 8];
    pipe.read_exact(&mut lengths)
        .map_err(|_| "there is no answer".to_owned())?;
    let [json, data] = [0, 4].map(|at| {
        let word = [lengths[at], lengths[at + 1], lengths[at + 2], lengths[at + 3]];
        u32::from_le_bytes(word) as usize
    });
    if json.saturating_add(data) > limit {
        return Err(format!("its answer has more than {limit} bytes"));
    }
    let mut part = |length| -> Result<Vec<u8>, String> {
        let mut bytes = vec![0; length];
        pipe.read_exact(&mut bytes)
            .map_err(|_| "its answer breaks off".to_owned())?;
        Ok(bytes)
    };
    Ok((part(json)?, part(data)?))
}

/// Reads to the end, so that the process never waits for us, and keeps only the last of it.
fn last_words(mut pipe: impl Read) -> String {
    let mut kept = Vec::new();
    let mut chunk = [0; 4096];
    while let Ok(count @ 1..) = pipe.read(&mut chunk) {
        kept.extend_from_slice(&chunk[..count]);
        let beyond = kept.len().saturating_sub(SAID_BYTES);
        kept.drain(..beyond);
    }
    String::from_utf8_lossy(&kept).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(json: &[u8], data: &[u8]) -> Vec<u8> {
        let mut bytes = (json.len() as u32).to_le_bytes().to_vec();
        bytes.extend_from_slice(&(data.len() as u32).to_le_bytes());
        bytes.extend_from_slice(json);
        bytes.extend_from_slice(data);
        bytes
    }

    #[test]
    fn messages_are_read_one_after_the_other() {
        let bytes = [message(b"{}", b"abc"), message(b"[]", b"")].concat();
        let mut pipe = bytes.as_slice();
        assert_eq!(read(&mut pipe, 100).unwrap(), (b"{}".to_vec(), b"abc".to_vec()));
        assert_eq!(read(&mut pipe, 100).unwrap(), (b"[]".to_vec(), Vec::new()));
        assert_eq!(read(&mut pipe, 100).unwrap_err(), "there is no answer");
    }

    #[test]
    fn what_is_too_long_or_breaks_off_is_no_message() {
        let bytes = message(b"{}", b"abc");
        assert!(
            read(&mut bytes.as_slice(), 4)
                .unwrap_err()
                .contains("more than 4")
        );
        let broken = &bytes[..bytes.len() - 1];
        assert_eq!(read(&mut &*broken, 100).unwrap_err(), "its answer breaks off");
    }

    #[test]
    fn the_last_words_are_kept() {
        let said = [vec![b'x'; 3 * SAID_BYTES], b"end".to_vec()].concat();
        let kept = last_words(said.as_slice());
        assert!(kept.len() == SAID_BYTES && kept.ends_with("xend"));
    }
}
