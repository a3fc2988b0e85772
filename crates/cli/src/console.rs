//! What goes to the terminal: results to standard output, progress to standard error.
//!
//! Results survive a reader that goes away (`| head`): a closed pipe ends the printing, not the command. Progress is
//! lines and, on a terminal, bars; `--quiet` silences both. Colours are stripped by the streams themselves when the other
//! end is no terminal or `NO_COLOR` is set.

use std::fmt::Display;
use std::io::{self, Write};

use clap::builder::styling::{AnsiColor, Style};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::error::{Error, Result};

/// Where progress goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Console {
    quiet: bool,
}

impl Console {
    pub(crate) const fn new(quiet: bool) -> Self {
        Self { quiet }
    }

    /// A line of progress.
    pub(crate) fn note(self, line: impl Display) {
        if !self.quiet {
            warn(line);
        }
    }

    /// A bar for `length` steps; it draws itself on a terminal only, and clears itself when it is dropped.
    pub(crate) fn bar(self, length: u64, what: &str) -> Bar {
        let target = if self.quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(length), target);
        let style = ProgressStyle::with_template("{prefix:>10} {wide_bar} {pos}/{len} {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_prefix(what.to_owned());
        Bar(bar)
    }
}

/// A progress bar that leaves the terminal as it found it.
#[derive(Debug)]
pub(crate) struct Bar(pub(crate) ProgressBar);

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// Prints a result.
///
/// A closed pipe is no error: whoever read has seen enough.
pub(crate) fn print(text: &str) -> Result<()> {
    let mut out = anstream::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other.map_err(Error::StandardOutput),
    }
}

/// A line on standard error that `--quiet` does not silence. Where standard error is closed, nobody can be told.
pub(crate) fn warn(line: impl Display) {
    let _ = writeln!(anstream::stderr().lock(), "{line}");
}

/// Prints a value as indented JSON.
pub(crate) fn print_json(value: &impl serde::Serialize) -> Result<()> {
    print(&json_text(value)?)
}

/// A value as indented JSON with a final line end.
pub(crate) fn json_text(value: &impl serde::Serialize) -> Result<String> {
    let mut text = serde_json::to_string_pretty(value).map_err(Error::Json)?;
    text.push('\n');
    Ok(text)
}

/// Text in a style, for streams that strip styles by themselves.
fn styled(style: Style, text: impl Display) -> String {
    format!("{style}{text}{style:#}")
}

/// A heading.
pub(crate) fn heading(text: impl Display) -> String {
    styled(Style::new().bold(), text)
}

/// A good verdict.
pub(crate) fn good(text: impl Display) -> String {
    styled(AnsiColor::Green.on_default(), text)
}

/// A bad verdict.
pub(crate) fn bad(text: impl Display) -> String {
    styled(AnsiColor::Red.on_default().bold(), text)
}

/// Neither: skipped, disabled, dropped.
pub(crate) fn faint(text: impl Display) -> String {
    styled(AnsiColor::Yellow.on_default(), text)
}
