//! Which source lines an error bound comes from.
//!
//! The output's interval is computed again with the operations of one line taken for exact, line after line. What the interval loses
//! in width is what that line *contributes*: "if this line were exact, the bound would be so much narrower". Errors amplify, cancel in
//! hulls and meet in joins, so contributions need not add up to the whole: two lines may each be needed for the same width, or each be
//! hidden behind the other.
//!
//! An operation belongs to the line on which its expression begins. Of what is exact by the rules (moves, comparisons, integers) no line
//! contributes anything. A line under a condition that could go either way without its own error may contribute the whole distance
//! between both results.
//!
//! Limits: the exact function is evaluated at the ends and in the middle of its operands; sums and products that a compiler
//! may reorder across lines keep the errors of the other orders.

use std::collections::BTreeSet;
use std::ops::Range;

use rayon::prelude::*;

use crate::compile::program::Program;
use crate::error::Result;
use crate::interval::Interval;
use crate::limits::Limits;

/// One line's part in a bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Contribution {
    /// Line, from 1.
    pub line: usize,
    /// Width of the output's interval if this line were exact.
    pub width_without: f64,
    /// The width that the bound would lose, as a share of all of it: 0 to 1.
    pub share: f64,
}

/// Where an output's error bound comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribution {
    /// The output's interval.
    pub interval: Interval,
    /// Lines with operations, in order.
    pub lines: Vec<Contribution>,
}

/// Attributes the bound of one output to the lines of the text that the program was read from. `evaluate` computes its interval within the
/// given limits; it is called once for the whole and once a line. `None` where the interval says nothing, or is one number: then
/// there is no width to attribute.
///
/// # Errors
/// As `evaluate`.
pub fn attribution(
    program: &Program,
    text: &str,
    limits: &Limits,
    evaluate: impl Fn(&Limits) -> Result<Interval> + Sync,
) -> Result<Option<Attribution>> {
    let interval = evaluate(limits)?;
    let width = interval.hi - interval.lo;
    if !interval.flags.is_none() || !width.is_finite() || width <= 0.0 {
        return Ok(None);
    }
    let lines: Vec<(usize, Range<usize>)> = lines(program, text);
    let one = |(line, range): &(usize, Range<usize>)| {
        let limits = Limits {
            exact: Some(range.clone()),
            ..limits.clone()
        };
        let without = evaluate(&limits)?;
        let width_without = without.hi - without.lo;
        Ok(Contribution {
            line: *line,
            width_without,
            share: (1.0 - width_without / width).clamp(0.0, 1.0),
        })
    };
    Ok(Some(Attribution {
        interval,
        lines: lines.par_iter().map(one).collect::<Result<_>>()?,
    }))
}

/// The lines on which instructions begin, with their bytes.
fn lines(program: &Program, text: &str) -> Vec<(usize, Range<usize>)> {
    let starts: BTreeSet<usize> = program
        .code
        .spans
        .iter()
        .filter_map(|span| Some(span.to_range()?.start))
        .collect();
    let mut out = Vec::new();
    let mut begin = 0;
    for (number, line) in text.split_inclusive('\n').enumerate() {
        let range = begin..begin + line.len();
        begin = range.end;
        if starts.range(range.clone()).next().is_some() {
            out.push((number + 1, range));
        }
    }
    out
}
