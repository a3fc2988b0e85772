//! Choosing inputs: seeded, at the edges of the ranges or anywhere in them.
//!
//! Floats are rounded to their format, so that what is chosen is what a machine gets; ends that the format does not have count as
//! the nearest that it has. Edges are the ends of a
//! range and the hard numbers within it: zeros, the least normal number, ±1, powers of two beyond which squares overflow or
//! vanish; of unit vectors the axes and diagonals; and, for any vector, the value or the opposite of another input of its
//! length, since opposite and parallel vectors are where formulas break.

use super::{Group, Inputs, TextureInput, Values};
use crate::kind::Kind;

/// One choice of all inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// A value for each of [`Inputs::scalars`].
    pub values: Vec<f64>,
    /// Four channels for each texel, for each of [`Inputs::textures`].
    pub texels: Vec<Vec<f64>>,
}

/// How values are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Anywhere in the range; half of the numbers spread over the magnitudes instead of evenly.
    Random,
    /// Hard values, and now and then a random one.
    Edge,
    /// Values that have to do with each other: vectors that are multiples of earlier ones, up to rounding, and unit vectors at any distance
    /// from an axis or a diagonal.
    Related,
}

/// A source of random numbers (SplitMix64, Steele, Lea and Flood 2014): equal seeds give equal choices on every machine.
#[derive(Clone, Debug)]
pub struct Seed(u64);

impl Seed {
    /// Starts a sequence.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in [0, 1).
    pub fn fraction(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number below `n`, which is not zero.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n.max(1) as u64) as usize
    }
}

impl Inputs {
    /// Chooses all inputs.
    pub fn sample(&self, seed: &mut Seed, style: Style) -> Point {
        let mut point = Point {
            values: vec![0.0; self.scalars.len()],
            texels: self
                .textures
                .iter()
                .map(|texture| texels(texture, seed, style))
                .collect(),
        };
        for at in 0..self.groups.len() {
            self.choose(&mut point, at, seed, style);
        }
        point
    }

    /// Chooses the values of one group anew.
    pub fn choose(&self, point: &mut Point, at: usize, seed: &mut Seed, style: Style) {
        let group = &self.groups[at];
        if style == Style::Edge && seed.below(4) == 0 && self.like_another(point, at, seed) {
            return;
        }
        if style == Style::Related && seed.below(2) == 0 && self.multiple_of_another(point, at, seed) {
            return;
        }
        match &group.values {
            Values::Unit => {
                let v = unit(group.scalars.len(), seed, style);
                point.values[group.scalars.clone()].copy_from_slice(&v);
            }
            Values::OneOf(list) => {
                for k in group.scalars.clone() {
                    point.values[k] = list[seed.below(list.len())];
                }
            }
            Values::Between(bounds) => self.between(point, group, bounds, seed, style),
        }
    }

    fn between(
        &self,
        point: &mut Point,
        group: &Group,
        bounds: &[(f64, f64)],
        seed: &mut Seed,
        style: Style,
    ) {
        // Zero in all components at once, which single choices rarely give.
        let nothing =
            style == Style::Edge && seed.below(4) == 0 && bounds.iter().all(|b| b.0 <= 0.0 && b.1 >= 0.0);
        for (k, &bounds) in group.scalars.clone().zip(bounds) {
            let kind = self.scalars[k].kind;
            point.values[k] = if nothing {
                0.0
            } else {
                number(kind, bounds, seed, style)
            };
        }
    }

    /// An earlier input of the same length and type.
    fn another(&self, at: usize, seed: &mut Seed) -> Option<&Group> {
        let group = &self.groups[at];
        let earlier: Vec<&Group> = self.groups[..at]
            .iter()
            .filter(|other| {
                other.scalars.len() == group.scalars.len()
                    && self.scalars[other.scalars.start].kind == self.scalars[group.scalars.start].kind
            })
            .collect();
        (!earlier.is_empty()).then(|| earlier[seed.below(earlier.len())])
    }

    /// Takes over another input of the same length, or its opposite, if the range allows it.
    fn like_another(&self, point: &mut Point, at: usize, seed: &mut Seed) -> bool {
        let group = &self.groups[at];
        let Some(other) = self.another(at, seed) else {
            return false;
        };
        let sign = if seed.below(2) == 0 { 1.0 } else { -1.0 };
        let values: Vec<f64> = point.values[other.scalars.clone()]
            .iter()
            .map(|x| x * sign)
            .collect();
        if !group.admits(&values) {
            return false;
        }
        point.values[group.scalars.clone()].copy_from_slice(&values);
        true
    }

    /// Takes a multiple of another input of the same length, each component rounded and perhaps a few steps off, if the range allows it.
    fn multiple_of_another(&self, point: &mut Point, at: usize, seed: &mut Seed) -> bool {
        let group = &self.groups[at];
        let Some(other) = self.another(at, seed) else {
            return false;
        };
        let Kind::Float(w) = self.scalars[group.scalars.start].kind else {
            return false;
        };
        let sign = if seed.below(2) == 0 { 1.0 } else { -1.0 };
        let factor = match group.values {
            Values::Between(_) => sign * (4.0 * seed.fraction() - 2.0).exp2(),
            Values::Unit | Values::OneOf(_) => sign,
        };
        let steps = if seed.below(2) == 0 { 2 } else { 0 };
        let mut value = |x: &f64| {
            let mut x = w.round(x * factor);
            for _ in 0..seed.below(steps + 1) {
                x = if seed.below(2) == 0 {
                    w.next_up(x)
                } else {
                    w.next_down(x)
                };
            }
            x
        };
        let values: Vec<f64> = point.values[other.scalars.clone()]
            .iter()
            .map(&mut value)
            .collect();
        let admitted = group.admits(&values);
        if admitted {
            point.values[group.scalars.clone()].copy_from_slice(&values);
        }
        admitted
    }

    /// A point half-way between two, up to rounding; `None` where no such point is in the ranges.
    pub fn between_points(&self, a: &Point, b: &Point) -> Option<Point> {
        let mut middle = a.clone();
        for group in &self.groups {
            for k in group.scalars.clone() {
                let x = a.values[k] + (b.values[k] - a.values[k]) / 2.0;
                middle.values[k] = match self.scalars[k].kind {
                    Kind::Float(w) => w.round(x),
                    Kind::Int(_) | Kind::Bool => a.values[k],
                };
            }
            let values = &mut middle.values[group.scalars.clone()];
            match group.values {
                Values::Between(_) => {}
                Values::Unit => {
                    let unit = normalised(values);
                    values.copy_from_slice(&unit);
                }
                Values::OneOf(_) => values.copy_from_slice(&a.values[group.scalars.clone()]),
            }
        }
        self.admits(&middle).then_some(middle)
    }

    /// Three neighbours of a fragment that make a quad of it: each a little way towards another random choice.
    pub fn quad(&self, point: &Point, seed: &mut Seed) -> [Point; 4] {
        let mut neighbour = |share: f64| {
            let other = self.sample(seed, Style::Random);
            let mut out = point.clone();
            for group in &self.groups {
                let mixed: Vec<f64> = group
                    .scalars
                    .clone()
                    .map(|k| match self.scalars[k].kind {
                        Kind::Float(w) => {
                            w.round(point.values[k] + (other.values[k] - point.values[k]) * share)
                        }
                        Kind::Int(_) | Kind::Bool => point.values[k],
                    })
                    .collect();
                let mixed = match group.values {
                    Values::Unit => normalised(&mixed),
                    Values::Between(_) => mixed,
                    Values::OneOf(_) => continue,
                };
                out.values[group.scalars.clone()].copy_from_slice(&mixed);
            }
            out
        };
        let (x, y, diagonal) = (
            neighbour(1.0 / 64.0),
            neighbour(1.0 / 64.0),
            neighbour(1.0 / 64.0),
        );
        [point.clone(), x, y, diagonal]
    }

    /// Brings a point into its ranges: what lies outside becomes the nearest that lies within, a vector of length one is normalised.
    pub fn mend(&self, point: &mut Point) {
        for group in &self.groups {
            let kinds: Vec<Kind> = group.scalars.clone().map(|k| self.scalars[k].kind).collect();
            let values = &mut point.values[group.scalars.clone()];
            if group.admits(values)
                && values
                    .iter()
                    .zip(&kinds)
                    .all(|(x, kind)| fitted(*kind, *x, *x, *x) == *x)
            {
                continue;
            }
            match &group.values {
                Values::Unit => {
                    let unit = normalised(values);
                    values.copy_from_slice(&unit);
                }
                Values::Between(bounds) => {
                    for ((x, (lo, hi)), kind) in values.iter_mut().zip(bounds).zip(kinds) {
                        *x = fitted(kind, if x.is_nan() { *lo } else { *x }, *lo, *hi);
                    }
                }
                Values::OneOf(list) => {
                    for x in values {
                        let nearest = list
                            .iter()
                            .min_by(|a, b| (*a - *x).abs().total_cmp(&(*b - *x).abs()));
                        *x = nearest.copied().unwrap_or(*x);
                    }
                }
            }
        }
    }

    /// Whether a point lies in the declared and inferred ranges.
    pub fn admits(&self, point: &Point) -> bool {
        self.groups
            .iter()
            .all(|group| group.admits(&point.values[group.scalars.clone()]))
    }
}

impl Group {
    /// Whether the group may have these values.
    pub fn admits(&self, values: &[f64]) -> bool {
        match &self.values {
            Values::Between(bounds) => values
                .iter()
                .zip(bounds)
                .all(|(x, b)| b.0.min(f64::from(b.0 as f32)) <= *x && *x <= b.1.max(f64::from(b.1 as f32))),
            Values::OneOf(list) => values.iter().all(|x| list.contains(x)),
            // Components are rounded to f32: each is off by 2^-24 of its share at most.
            Values::Unit => (values.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-6,
        }
    }
}

fn texels(texture: &TextureInput, seed: &mut Seed, style: Style) -> Vec<f64> {
    let kind = texture.format.kind();
    let mut one: [f64; 4] = texture.channels.map(|bounds| number(kind, bounds, seed, style));
    if style == Style::Edge && seed.below(4) == 0 {
        // One number in all channels: a half in each is the zero vector of a decoded normal.
        one = texture.channels.map(|(lo, hi)| fitted(kind, one[0], lo, hi));
    }
    // A flat texture, one of unrelated texels, and mixtures.
    let flat = seed.below(3);
    (0..texture.texel_count())
        .flat_map(|_| {
            let random = texture.channels.map(|bounds| number(kind, bounds, seed, style));
            if flat == 0 || (flat == 1 && seed.below(2) == 0) {
                one
            } else {
                random
            }
        })
        .collect()
}

/// Numbers at which formulas break, whatever the range.
const HARD: &[f64] = &[
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    128.0,
    1.1754943508222875e-38,
    -1.1754943508222875e-38,
    1e-45,
    1e-30,
    1e-23,
    -1e-23,
    1e-12,
    -1e-12,
    1e-6,
    -1e-6,
    1e-3,
    1e9,
    1e19,
    2e19,
    -2e19,
    1e30,
    3e38,
];

fn number(kind: Kind, (lo, hi): (f64, f64), seed: &mut Seed, style: Style) -> f64 {
    let x = if style == Style::Edge && seed.below(8) != 0 {
        match seed.below(4) {
            0 => lo,
            1 => hi,
            _ => HARD[seed.below(HARD.len())],
        }
    } else if seed.below(2) == 0 {
        lo + (hi - lo) * seed.fraction()
    } else {
        spread(lo, hi, seed)
    };
    fitted(kind, x, lo, hi)
}

/// A number whose magnitude, not itself, is spread evenly: from 2^-40 of the larger end up to it.
fn spread(lo: f64, hi: f64, seed: &mut Seed) -> f64 {
    let most = lo.abs().max(hi.abs());
    let magnitude = most * (-40.0 * seed.fraction()).exp2();
    let negative = lo < 0.0 && (hi <= 0.0 || seed.below(2) == 0);
    if negative { -magnitude } else { magnitude }
}

/// The nearest number of the type within the bounds.
fn fitted(kind: Kind, x: f64, lo: f64, hi: f64) -> f64 {
    let x = x.clamp(lo, hi);
    match kind {
        Kind::Float(w) => {
            // Both ends as the format has them, so that a range within one step still holds a number.
            w.round(x).clamp(w.round(lo), w.round(hi))
        }
        Kind::Int(_) => x.round().clamp(lo.ceil(), hi.floor().max(lo.ceil())),
        Kind::Bool => x.round(),
    }
}

/// A unit vector: an axis, a diagonal of some components, or any direction.
fn unit(n: usize, seed: &mut Seed, style: Style) -> Vec<f64> {
    if style == Style::Related && seed.below(4) != 0 {
        return beside(n, seed);
    }
    let mut v: Vec<f64> = if style == Style::Edge && seed.below(4) != 0 {
        (0..n).map(|_| seed.below(3) as f64 - 1.0).collect()
    } else {
        (0..n).map(|_| gaussian(seed)).collect()
    };
    if style == Style::Edge && seed.below(4) == 0 {
        // Near an axis or a diagonal, but not on it.
        let k = seed.below(n);
        v[k] += [1e-7, -1e-7, 1e-4, -1e-4, 1e-20][seed.below(5)];
    }
    normalised(&v)
}

/// A unit vector beside an axis or a diagonal: at a distance of which the magnitude is spread evenly, down to one step.
fn beside(n: usize, seed: &mut Seed) -> Vec<f64> {
    let mut v: Vec<f64> = if seed.below(2) == 0 {
        let axis = seed.below(n);
        let side = if seed.below(2) == 0 { 1.0 } else { -1.0 };
        (0..n).map(|k| if k == axis { side } else { 0.0 }).collect()
    } else {
        (0..n)
            .map(|_| if seed.below(2) == 0 { 1.0 } else { -1.0 })
            .collect()
    };
    let distance = (-25.0 * seed.fraction()).exp2();
    v.iter_mut().for_each(|x| *x += distance * gaussian(seed));
    normalised(&v)
}

/// The unit vector in `f32`; the first axis for the zero vector.
fn normalised(v: &[f64]) -> Vec<f64> {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length == 0.0 {
        return (0..v.len()).map(|k| if k == 0 { 1.0 } else { 0.0 }).collect();
    }
    v.iter().map(|x| f64::from((x / length) as f32)).collect()
}

fn gaussian(seed: &mut Seed) -> f64 {
    (0..6).map(|_| seed.fraction() - 0.5).sum()
}
