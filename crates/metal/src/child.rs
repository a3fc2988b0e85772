//! A job in a process of its own, and what it says.

use std::path::Path;

use bossage_runner::Error;
use bossage_translate::external::{Limits, run_raw};

use crate::job::{BEGIN, END, Words};
use crate::machine::NAME;

/// Runs a program on a job whose answer has so many bytes between its first and its last word.
pub(crate) fn answer(
    job: &str,
    program: &Path,
    words: &Words,
    bytes: usize,
    limits: &Limits,
) -> Result<Vec<u8>, Error> {
    let whole = bytes + 8;
    let limits = Limits {
        output_bytes: whole,
        ..*limits
    };
    let raw = run_raw(program, &[], words.as_bytes(), &limits)
        .map_err(|problem| Error::gave_up(job, NAME, problem))?;
    if !raw.success {
        let last = raw.errors.lines().rev().find(|line| !line.trim().is_empty());
        let message = format!(
            "the process that ran it ended by {}; its last words: {}",
            raw.status,
            last.unwrap_or("none")
        );
        return Err(Error::gave_up(job, NAME, message));
    }
    let word = |at: usize| raw.output.get(at..at + 4);
    let is_whole = raw.output.len() == whole
        && raw.surplus == 0
        && word(0) == Some(BEGIN.to_le_bytes().as_slice())
        && word(whole - 4) == Some(END.to_le_bytes().as_slice());
    if !is_whole {
        let given = raw.output.len() + raw.surplus;
        let message = format!("its answer is {given} bytes of noise, {whole} bytes are expected");
        return Err(Error::gave_up(job, NAME, message));
    }
    Ok(raw.output[4..whole - 4].to_vec())
}

#[cfg(all(test, unix))]
mod tests {
    use std::process::Command;
    use std::time::Duration;

    use super::*;

    /// What comes of a program that is this script.
    fn said(script: &str, bytes: usize) -> Result<Vec<u8>, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("program");
        // By another process: a file that this one has open for writing, if only in a child that it is starting, cannot be run.
        let write = "printf '#!/bin/sh\\n%s\\n' \"$1\" > \"$2\" && chmod 755 \"$2\"";
        let written = Command::new("/bin/sh")
            .args(["-c", write, "sh", script])
            .arg(&path)
            .status();
        assert!(written.unwrap().success());
        let limits = Limits {
            time: Duration::from_secs(20),
            memory_bytes: 1 << 30,
            output_bytes: 0,
        };
        answer("job", &path, &Words::job(), bytes, &limits).map_err(|error| error.to_string())
    }

    #[test]
    fn an_answer_is_what_stands_between_its_first_and_its_last_word() {
        assert_eq!(said("cat > /dev/null; printf YAKOabcdENOD", 4).unwrap(), b"abcd");
    }

    #[test]
    fn megabytes_of_output_are_noise_and_are_not_kept() {
        let problem = said("yes | head -c 30000000", 4).unwrap_err();
        assert!(
            problem.contains("30000000 bytes of noise, 12 bytes are expected"),
            "{problem}"
        );
    }

    #[test]
    fn an_answer_that_is_cut_short_or_wrong_is_noise() {
        for script in [
            "printf YAKOab",
            "printf YAKOabcdYAKO",
            "exit 0",
            "printf ENODabcdENOD",
        ] {
            assert!(said(script, 4).unwrap_err().contains("noise"), "{script}");
        }
    }

    #[test]
    fn the_last_words_of_a_process_are_told() {
        let problem = said("echo first >&2; echo 'the end' >&2; exit 3", 4).unwrap_err();
        assert!(
            problem.contains("exit status: 3") && problem.ends_with("the end"),
            "{problem}"
        );
    }
}
