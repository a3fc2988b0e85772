//! Budgets that keep every evaluation finite.

/// Budgets of one evaluation. Reaching `operations`, `depth` or `memory` is an error that names the budget; reaching one of the
/// others makes a result *undecided*, which is counted, never guessed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Scalar operations that an invocation may execute on average over its batch, forks of it and what they cost included.
    pub operations: u64,
    /// How often one invocation may both leave and stay in one loop before what the loop writes is given up as unknown.
    pub undecided_exits: u32,
    /// How many array elements or texels an uncertain index may select before the whole array counts as selected.
    pub spread: u32,
    /// How deeply calls and blocks may nest.
    pub depth: u32,
    /// Bytes that the register files and the memory of a run may take together.
    pub memory: u64,
    /// Whether to count operations and fetches for each source span.
    pub count: bool,
    /// Whether to watch for operations that go wrong, which [`crate::lint`] asks for.
    pub watch: bool,
    /// A place in the source, in bytes: operations that begin there are taken for exact, which [`attribution`](fn@crate::attribution) asks for.
    pub exact: Option<std::ops::Range<usize>>,
    /// A place whose results are moved, which [`crate::lint`] asks for to see what follows from them.
    pub nudge: Option<Nudge>,
}

/// One place of the source, and how its sums and products are moved. The lint's own; see `exec/nudge.rs`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nudge {
    /// The span's number.
    pub(crate) span: u32,
    pub(crate) how: Move,
}

/// How results are moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Move {
    /// What vanished is given back a little.
    Restore,
    /// What is left of a sum grows by half a unit in the last place of its largest term.
    Up,
    /// And shrinks by as much.
    Down,
    /// What is left of a sum is nothing.
    Vanish,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            operations: 1 << 20,
            undecided_exits: 128,
            spread: 1024,
            depth: 400,
            memory: 1 << 30,
            count: false,
            watch: false,
            exact: None,
            nudge: None,
        }
    }
}
