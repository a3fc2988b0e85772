//! Static counts of an entry point and all it calls, from the IR.

use serde::{Deserialize, Serialize};

/// How much an entry point does, counted over the text: a loop's body counts once, both arms of a branch count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cost {
    /// Scalar and vector operations: arithmetic, comparisons, conversions, math functions.
    pub ops: u32,
    /// Texture samples and gathers.
    pub samples: u32,
    /// Texture loads and stores.
    pub texture_loads: u32,
    /// Reads and writes of uniform and storage buffers.
    pub buffer_accesses: u32,
    /// `if` and `switch`.
    pub branches: u32,
    /// Loops.
    pub loops: u32,
    /// Function calls.
    pub calls: u32,
}
