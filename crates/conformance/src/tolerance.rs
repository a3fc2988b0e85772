//! What may stay undecided.
//!
//! No tolerance of an output is written down: it is the acceptance interval that `bossage-bounds` evaluates from the IR of what is
//! run ([`crate::oracle`], [`crate::width`] for how wide they are). What a sampler may lose is part of it. Left are limits of
//! shares.

/// The largest share of outputs of one random case that may be undecided before the case is a warning. Inputs of random cases
/// are drawn from the documented domain, where a hardened function leaves nothing open but isolated ties.
pub const UNDECIDED_LIMIT: f64 = 0.01;

/// The same for pixels whose textures the driver filters: an alpha test near its cutoff, or a highlight near its end, is undecided
/// within the filter's allowance, which is much wider than rounding, so more pixels may be.
pub const UNDECIDED_LIMIT_FILTERED: f64 = 0.03;
