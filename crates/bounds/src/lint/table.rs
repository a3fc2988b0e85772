//! Value numbers: what is known to be one and the same number, and how it was made.
//!
//! Two scalars with one number are equal whenever both exist. So a guard on a vector's length holds for the length that `normalize`
//! computes again, and relations such as "no component exceeds the largest component" follow from how numbers were made.

use crate::domain::ops::{BoolBinary, Compare, FloatBinary, FloatTernary, FloatUnary, IntBinary, IntUnary};
use crate::kind::{IntType, Kind};
use std::collections::{BTreeSet, HashMap};

/// A value number.
pub(super) type Vn = u32;

/// How a value came about.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Def {
    /// A dimension of the input box.
    Input(u32),
    Constant(Kind, u64),
    Unary(FloatUnary, Vn),
    Binary(FloatBinary, Vn, Vn),
    Ternary(FloatTernary, [Vn; 3]),
    Sum(Vec<Vn>),
    Compare(Compare, Vn, Vn),
    Not(Vn),
    Bool(BoolBinary, Vn, Vn),
    Pure(Pure, Vec<Vn>),
    /// Nothing but where it comes from; the first number keeps it apart from all others.
    Opaque(u32, Vec<Vn>),
}

/// Operations whose result depends on nothing but their arguments, and of which no relation is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Pure {
    IntUnary(IntUnary, IntType),
    IntBinary(IntBinary, IntType),
    Select,
    Convert(Kind, Kind),
    ToBits(Kind),
    FromBits(Kind),
    Ldexp,
    FrexpExponent,
    IsNan,
    IsInf,
}

/// All values of one walk.
#[derive(Default)]
pub(super) struct Table {
    defs: Vec<Def>,
    pub(super) kinds: Vec<Kind>,
    index: HashMap<Def, Vn>,
    /// Inputs that together are a unit vector.
    pub(super) units: Vec<Vec<Vn>>,
}

impl Table {
    /// The number of a value made in that way.
    pub(super) fn number(&mut self, kind: Kind, def: Def) -> Vn {
        let def = match def {
            // Both orders of arguments give one result.
            Def::Binary(
                op @ (FloatBinary::Add | FloatBinary::Multiply | FloatBinary::Min | FloatBinary::Max),
                a,
                b,
            ) if b < a => Def::Binary(op, b, a),
            other => other,
        };
        if let Some(&vn) = self.index.get(&def) {
            return vn;
        }
        let vn = self.defs.len() as Vn;
        self.index.insert(def.clone(), vn);
        self.defs.push(def);
        self.kinds.push(kind);
        vn
    }

    /// A value like no other.
    pub(super) fn opaque(&mut self, kind: Kind, parents: Vec<Vn>) -> Vn {
        let unique = self.defs.len() as u32;
        self.number(kind, Def::Opaque(unique, parents))
    }

    pub(super) fn def(&self, vn: Vn) -> &Def {
        &self.defs[vn as usize]
    }

    /// The value made in that way, if there is one.
    pub(super) fn find(&self, def: &Def) -> Option<Vn> {
        self.index.get(def).copied()
    }

    /// All values that are the larger of two, with those two.
    pub(super) fn maxima(&self) -> impl Iterator<Item = Vn> {
        let defs = self.defs.iter().zip(0..);
        defs.filter(|(def, _)| matches!(def, Def::Binary(FloatBinary::Max, ..)))
            .map(|(_, vn)| vn)
    }

    /// The values of which one is the maximum.
    pub(super) fn candidates(&self, vn: Vn) -> Vec<Vn> {
        match self.def(vn) {
            Def::Binary(FloatBinary::Max, a, b) => {
                let mut both = self.candidates(*a);
                both.extend(self.candidates(*b));
                both
            }
            _ => vec![vn],
        }
    }

    /// The value without magnitudes and signs around it.
    pub(super) fn bare(&self, mut vn: Vn) -> Vn {
        while let Def::Unary(FloatUnary::Abs | FloatUnary::Negate, inner) = self.def(vn) {
            vn = *inner;
        }
        vn
    }

    /// The dimensions of the input that a value depends on.
    pub(super) fn inputs_of(&self, vn: Vn) -> BTreeSet<u32> {
        let dimension = |vn: Vn| match self.def(vn) {
            Def::Input(n) => Some(*n),
            _ => None,
        };
        self.sources(vn).into_iter().filter_map(dimension).collect()
    }

    /// All values that a value depends on, and itself.
    pub(super) fn sources(&self, vn: Vn) -> BTreeSet<Vn> {
        let (mut seen, mut todo) = (BTreeSet::new(), vec![vn]);
        while let Some(vn) = todo.pop() {
            if !seen.insert(vn) {
                continue;
            }
            match self.def(vn) {
                Def::Input(_) | Def::Constant(..) => {}
                Def::Unary(_, a) | Def::Not(a) => todo.push(*a),
                Def::Binary(_, a, b) | Def::Compare(_, a, b) | Def::Bool(_, a, b) => todo.extend([a, b]),
                Def::Ternary(_, args) => todo.extend(args),
                Def::Sum(list) | Def::Pure(_, list) | Def::Opaque(_, list) => todo.extend(list),
            }
        }
        seen
    }
}
