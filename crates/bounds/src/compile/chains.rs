//! Sums and products of several terms, which a compiler may compute in another order than they are written in.
//!
//! WGSL allows reassociation: (a + b) + c as a + (b + c), (a − b) + c as (a + c) − b, and products likewise; drivers do it, to make
//! fused multiply-adds or to fold constants. So each sum and product remembers its terms, through parentheses, `let` and the straight
//! line of stores to a variable, and becomes a [`Chain`] where there are more than two.
//!
//! Limits. Terms are followed within one function, not through calls, and not across control flow. Quotients stay as written, and
//! nothing is multiplied out. A sum of more than [`MAX_TERMS`] or a product of more than [`MAX_FACTORS`] is one term of what follows.

use super::builder::{Builder, Frame};
use super::code::{Chain, Op, Row, Term};
use crate::domain::ops::FloatBinary;
use crate::error::Result;
use crate::kind::Kind;
use crate::width::Width;
use std::collections::HashMap;

/// The most terms that a sum is followed through.
pub(crate) const MAX_TERMS: usize = 16;
/// The most factors that a product is followed through.
const MAX_FACTORS: usize = 4;

/// What is known of rows that hold sums or products.
#[derive(Default)]
pub(crate) struct Chains {
    sums: HashMap<Row, Vec<Term>>,
    products: HashMap<Row, Vec<Term>>,
}

impl Chains {
    /// Remembers a sum of terms, such as a dot product's.
    pub(crate) fn sum_of(&mut self, row: Row, terms: &[Row]) {
        let terms = terms.iter().map(|&row| Term { row, negative: false }).collect();
        self.sums.insert(row, terms);
    }

    /// Remembers that one row is the other with its sign changed.
    pub(crate) fn negated(&mut self, row: Row, of: Row) {
        let terms = terms(&self.sums, of, true);
        self.sums.insert(row, terms);
    }

    /// The terms of `a op b`, if it is a sum or a product.
    fn joined(&self, op: FloatBinary, a: Row, b: Row) -> Option<(Vec<Term>, usize)> {
        let both =
            |of: &HashMap<Row, Vec<Term>>, negative| [terms(of, a, false), terms(of, b, negative)].concat();
        match op {
            FloatBinary::Add => Some((both(&self.sums, false), MAX_TERMS)),
            FloatBinary::Subtract => Some((both(&self.sums, true), MAX_TERMS)),
            FloatBinary::Multiply => Some((both(&self.products, false), MAX_FACTORS)),
            FloatBinary::Divide
            | FloatBinary::Remainder
            | FloatBinary::Min
            | FloatBinary::Max
            | FloatBinary::Atan2
            | FloatBinary::Pow
            | FloatBinary::Step => None,
        }
    }

    fn insert(&mut self, op: FloatBinary, row: Row, terms: Vec<Term>) {
        if op == FloatBinary::Multiply {
            self.products.insert(row, terms);
        } else {
            self.sums.insert(row, terms);
        }
    }
}

/// The terms of a row, itself where it is none.
fn terms(of: &HashMap<Row, Vec<Term>>, row: Row, negative: bool) -> Vec<Term> {
    let own = [Term { row, negative: false }];
    let list = of.get(&row).map_or(own.as_slice(), Vec::as_slice);
    let sign = |term: &Term| Term {
        row: term.row,
        negative: term.negative != negative,
    };
    list.iter().map(sign).collect()
}

impl<'m> Builder<'m> {
    /// `a op b`, as a chain where its terms may be taken in another order.
    pub(crate) fn reorderable(
        &mut self,
        frame: &mut Frame<'m>,
        op: FloatBinary,
        w: Width,
        a: Row,
        b: Row,
    ) -> Result<Row> {
        let k = Kind::Float(w);
        let joined = self.chains.joined(op, a, b);
        let row = match &joined {
            Some((terms, most)) if terms.len() > 2 && terms.len() <= *most => {
                let terms = terms.clone();
                self.emit(frame, k, |dst| {
                    Op::Chain(Box::new(Chain {
                        op,
                        w,
                        dst,
                        a,
                        b,
                        terms,
                    }))
                })?
            }
            Some(_) | None => self.emit(frame, k, |dst| Op::FloatBinary { op, w, dst, a, b })?,
        };
        if let Some((terms, most)) = joined
            && terms.len() <= most
        {
            self.chains.insert(op, row, terms);
        }
        Ok(row)
    }
}
