//! The child process: takes mutants' ids on standard input, says on standard output what it does and what became of them.
//!
//! One line a message, in JSON. The parent knows by the messages which case is running and until when; it ends a child that does
//! not keep its time, and starts another.

use std::io::{BufRead, Write};
use std::path::Path;
use std::time::Duration;

use bossage_runner::{AdapterSelector, Device};
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::fate::Fate;
use crate::folder::Sources;
use crate::generate;
use crate::ground::{Ground, Step, conformance};

/// What a worker says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Said {
    /// It takes mutants.
    Ready,
    /// It runs a case.
    Step {
        /// The case.
        case: String,
        /// Whether without a fault.
        unmutated: bool,
        /// It should say something again within so many seconds.
        limit_seconds: f64,
    },
    /// What became of the mutant.
    Done(Fate),
    /// It cannot go on.
    Broken(String),
}

/// A device keeps every shader that it ever compiled, so a new one is opened after so many mutants.
const MUTANTS_A_DEVICE: usize = 100;

/// Serves until standard input ends.
///
/// # Errors
/// When standard output is closed.
pub(crate) fn serve(folder: &Path, scenes: bool, adapter: &AdapterSelector) -> std::io::Result<()> {
    match judged(folder, scenes, adapter) {
        Ok(()) => Ok(()),
        Err(Stop::Closed(error)) => Err(error),
        Err(Stop::Broken(error)) => say(&Said::Broken(error.to_string())),
    }
}

enum Stop {
    Closed(std::io::Error),
    Broken(Error),
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Self::Broken(error)
    }
}

impl From<std::io::Error> for Stop {
    fn from(error: std::io::Error) -> Self {
        Self::Closed(error)
    }
}

fn judged(folder: &Path, scenes: bool, adapter: &AdapterSelector) -> Result<(), Stop> {
    let sources = Sources::read(folder)?;
    let mutants = generate::mutants(&sources)?;
    let ground = Ground::new(sources, scenes)?;
    let open = || Device::open(adapter).map_err(Error::Adapter);
    let mut device = open()?;
    say(&Said::Ready)?;
    for (count, line) in std::io::stdin().lock().lines().enumerate() {
        let id = line?;
        if count > 0 && count % MUTANTS_A_DEVICE == 0 {
            device = open()?;
        }
        let found = mutants.iter().find(|mutant| mutant.id == id);
        let mutant = found
            .ok_or_else(|| Error::Worker(format!("was asked for a mutant that it does not know: {id}")))?;
        let mut closed = Ok(());
        let fate = ground.judge(mutant, &device, conformance, &mut |step| {
            closed = say(&step.into())
        })?;
        closed?;
        say(&Said::Done(fate))?;
    }
    Ok(())
}

impl From<Step> for Said {
    fn from(step: Step) -> Self {
        Self::Step {
            case: step.case,
            unmutated: step.unmutated,
            limit_seconds: step.limit.as_secs_f64(),
        }
    }
}

impl Said {
    /// The limit that a step sets.
    pub(crate) fn limit(&self) -> Option<Duration> {
        match self {
            Self::Step { limit_seconds, .. } => Some(Duration::from_secs_f64(*limit_seconds)),
            Self::Ready | Self::Done(_) | Self::Broken(_) => None,
        }
    }
}

fn say(said: &Said) -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    serde_json::to_writer(&mut out, said)?;
    out.write_all(b"\n")?;
    out.flush()
}
