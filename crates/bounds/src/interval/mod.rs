//! The two interval domains: [`Accept`], what an implementation that obeys the WGSL accuracy table may return, and [`Range`],
//! what can come out when inputs range over declared intervals.
//!
//! Both round outward by the same table (`rules.rs`); they differ in what happens beyond the finite numbers. In `Accept` an
//! overflow, an infinity or a NaN makes the result an *indeterminate value*, as the language says, and everything computed from it
//! is indeterminate too. In `Range` infinities stay endpoints and a flag tells that a NaN is possible, so that a later check can
//! say what went wrong and where.
//!
//! Invariant: `lo <= hi`, both of the value's format. Nothing here repairs an interval: an operation that cannot bound its
//! result says so by a flag.

pub(crate) mod arithmetic;
pub(crate) mod bits;
pub(crate) mod domain;
pub(crate) mod functions;
pub(crate) mod integers;
pub(crate) mod narrow;
pub(crate) mod orders;
pub(crate) mod rules;
pub(crate) mod unit;

use crate::width::Width;

/// What an implementation that obeys the accuracy table of WGSL may return.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Accept;

/// What can come out over declared input ranges; infinities and NaN are tracked instead of ending the analysis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range;

/// Why a value is not, or not only, the numbers between its bounds.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct Flags(u8);

impl Flags {
    /// Bounds say all.
    pub const NONE: Self = Self(0);
    /// The language leaves the value open (overflow, division by zero, outside of a stated accuracy).
    pub const INDETERMINATE: Self = Self(1);
    /// A limit of the evaluation was reached; the value is unknown to us.
    pub const UNDECIDED: Self = Self(2);
    /// The value may be NaN (in [`Range`] only).
    pub const NAN: Self = Self(4);
    /// An undecided choice lies on the way (a condition, a step such as `floor`, an index): the bounds are the hull of several
    /// results. They still bound the value, so this flag alone opens nothing.
    pub const FORKED: Self = Self(8);

    /// Both sets.
    #[inline(always)]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What both sets have.
    #[inline(always)]
    pub(crate) const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// True when any flag of `other` is set.
    #[inline(always)]
    pub const fn has(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// True when nothing is flagged that would leave the value open; [`Flags::FORKED`] does not.
    #[inline(always)]
    pub const fn is_none(self) -> bool {
        self.0 & !Self::FORKED.0 == 0
    }
}

impl std::fmt::Debug for Flags {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names = [
            (Self::INDETERMINATE, "indeterminate"),
            (Self::UNDECIDED, "undecided"),
            (Self::NAN, "nan"),
            (Self::FORKED, "forked"),
        ];
        f.write_str("{")?;
        for (flag, name) in names.into_iter().filter(|(flag, _)| self.has(*flag)) {
            f.write_str(if flag == Self::INDETERMINATE { "" } else { " " })?;
            f.write_str(name)?;
        }
        f.write_str("}")
    }
}

/// A set of floats: the numbers from `lo` to `hi`, and what the flags add.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Least member.
    pub lo: f64,
    /// Greatest member.
    pub hi: f64,
    /// What the bounds do not say.
    pub flags: Flags,
}

impl Interval {
    /// The numbers `lo..=hi`.
    #[inline(always)]
    pub const fn new(lo: f64, hi: f64) -> Self {
        Self {
            lo,
            hi,
            flags: Flags::NONE,
        }
    }

    /// One number.
    #[inline(always)]
    pub const fn point(x: f64) -> Self {
        Self::new(x, x)
    }

    /// Anything, for the reason given.
    #[inline(always)]
    pub const fn unknown(flags: Flags) -> Self {
        Self {
            lo: f64::NEG_INFINITY,
            hi: f64::INFINITY,
            flags,
        }
    }

    /// The range a caller declares, which must not be empty.
    ///
    /// # Errors
    /// [`EmptyRange`](crate::Error::EmptyRange) when `lo > hi` or either is NaN.
    pub fn declared(lo: f64, hi: f64) -> crate::Result<Self> {
        if lo <= hi {
            Ok(Self::new(lo, hi))
        } else {
            Err(crate::Error::EmptyRange { lo, hi })
        }
    }

    /// Whether a machine may have returned `x`. An indeterminate or undecided value admits everything, NaN too.
    pub fn contains(&self, x: f64) -> bool {
        let open = self.flags.has(Flags::INDETERMINATE) || self.flags.has(Flags::UNDECIDED);
        open || if x.is_nan() {
            self.flags.has(Flags::NAN)
        } else {
            self.lo <= x && x <= self.hi
        }
    }

    /// The language leaves the value open.
    pub fn is_indeterminate(&self) -> bool {
        self.flags.has(Flags::INDETERMINATE)
    }

    /// A limit of the evaluation was reached on the way to the value.
    pub fn is_undecided(&self) -> bool {
        self.flags.has(Flags::UNDECIDED)
    }

    /// The bounds join several results, because a choice on the way could not be decided.
    pub fn is_forked(&self) -> bool {
        self.flags.has(Flags::FORKED)
    }

    /// The number of steps of the format between the bounds; `None` when the value is open.
    pub fn width_ulps(&self, w: Width) -> Option<f64> {
        let at = self.lo.abs().max(self.hi.abs());
        (self.flags.is_none() && at.is_finite()).then(|| (self.hi - self.lo) / w.ulp(at))
    }

    #[inline(always)]
    pub(crate) fn contains_zero(&self) -> bool {
        self.lo <= 0.0 && self.hi >= 0.0
    }

    #[inline(always)]
    pub(crate) fn flagged(mut self, flags: Flags) -> Self {
        self.flags = self.flags.union(flags);
        self
    }

    /// The least interval that contains both.
    #[inline(always)]
    pub fn hull(self, other: Self) -> Self {
        Self {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
            flags: self.flags.union(other.flags),
        }
    }
}

/// A scalar of an interval domain, untyped: floats as `f64` bounds, integers as order-preserving `u64` bounds, truth values as
/// bounds in {0, 1}.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WideCell {
    pub(crate) lo: u64,
    pub(crate) hi: u64,
    pub(crate) flags: Flags,
}

impl WideCell {
    #[inline(always)]
    pub(crate) fn interval(self) -> Interval {
        Interval {
            lo: f64::from_bits(self.lo),
            hi: f64::from_bits(self.hi),
            flags: self.flags,
        }
    }

    #[inline(always)]
    pub(crate) fn from_interval(x: Interval) -> Self {
        Self {
            lo: x.lo.to_bits(),
            hi: x.hi.to_bits(),
            flags: x.flags,
        }
    }
}
