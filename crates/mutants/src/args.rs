//! The command line.

use std::path::{Path, PathBuf};

use clap::Parser;

/// Puts one fault after the other into the shader library and reports which ones conformance misses.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "./x mutants",
    after_help = "Exit codes: 0 every survivor is listed, and of a whole run at least 95 % are caught; 1 otherwise; \
                  2 the call, the library or the list is wrong; 3 no adapter.\n\n\
                  Example: ./x mutants lib/normalise.wesl:normalise"
)]
pub(crate) struct Args {
    /// Only mutants with this in their id (FILE:ITEM:OPERATOR:NUMBER); a whole id selects just that one.
    pub(crate) filter: Option<String>,
    /// Names the mutants, with the line before and after, and runs nothing.
    #[arg(long)]
    pub(crate) list: bool,
    /// How many run at a time; as many as there are cores when left out.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) jobs: Option<u16>,
    /// Writes every mutant with its verdict to a file.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Every N-th mutant, beginning with the I-th.
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub(crate) shard: Option<(usize, usize)>,
    /// So many mutants, drawn by lot.
    #[arg(long, value_name = "N")]
    pub(crate) sample: Option<usize>,
    /// The seed of the lot.
    #[arg(long, value_name = "SEED", default_value_t = 1, requires = "sample")]
    pub(crate) seed: u64,
    /// The shader sources; the repository's when left out.
    #[arg(long, value_name = "DIR")]
    shader_dir: Option<PathBuf>,
    /// The list of equivalent mutants; the repository's when left out.
    #[arg(long, value_name = "FILE")]
    equivalent: Option<PathBuf>,
    /// The adapter, by a part of its name or driver.
    #[arg(long, value_name = "NAME")]
    pub(crate) adapter: Option<String>,
    /// Judges everything anew instead of taking over the verdicts of an earlier run of the same program on the same sources.
    #[arg(long)]
    pub(crate) fresh: bool,
    /// Leaves out the cases that render the examples' scenes: much quicker, and blind to how the surface uses what it uses.
    #[arg(long)]
    pub(crate) without_scenes: bool,
    /// Serves as a child process.
    #[arg(long, hide = true)]
    pub(crate) worker: bool,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

impl Args {
    pub(crate) fn shader_dir(&self) -> PathBuf {
        self.shader_dir
            .clone()
            .unwrap_or_else(|| root().join("../../shaders"))
    }

    pub(crate) fn equivalent(&self) -> PathBuf {
        self.equivalent
            .clone()
            .unwrap_or_else(|| root().join("equivalent.toml"))
    }
}

/// Where verdicts are kept.
pub(crate) fn ledger_folder() -> PathBuf {
    root().join("../../target/mutants")
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parts = text
        .split_once('/')
        .and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    match parts {
        Some((index, count)) if (1..=count).contains(&index) => Ok((index, count)),
        _ => Err("write it as I/N with I from 1 to N, for example 2/4".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::{Args, shard};

    #[test]
    fn the_command_is_well_formed() {
        Args::command().debug_assert();
    }

    #[test]
    fn shards_go_from_one() {
        assert_eq!(shard("2/4"), Ok((2, 4)));
        for bad in ["0/4", "5/4", "1", "a/b", "1/0"] {
            assert!(shard(bad).is_err(), "{bad}");
        }
        assert!(Args::try_parse_from(["mutants", "--jobs", "0"]).is_err());
    }
}
