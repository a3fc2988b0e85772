//! Sampling: what a coordinate and a level of detail select, as the hull over everything hardware may take for them.

use super::cube::{self, OnFace};
use super::filter::{self, Axis, TooWide, filtered};
use super::lod::{self, Tap};
use super::{Bounds, CompareFunction, Dimension, Filter, Sampler, Texture};
use crate::domain::Truth;
use crate::domain::ops::Compare;
use crate::interval::integers;
use std::ops::RangeInclusive;

/// Bounds of the four channels.
pub(crate) type Channels = [Bounds; 4];

/// What one lane asks of a texture.
pub(crate) struct Request<'a> {
    pub(crate) texture: &'a Texture,
    pub(crate) sampler: &'a Sampler,
    /// Normalised coordinates; a direction for cubes.
    pub(crate) at: [Bounds; 3],
    pub(crate) offset: [i64; 3],
    pub(crate) layers: RangeInclusive<u32>,
    /// Bounds of the depth reference.
    pub(crate) reference: Option<Bounds>,
    pub(crate) limit: u32,
}

impl Request<'_> {
    /// `textureSampleBaseClampToEdge`: coordinates stay half a texel inside.
    pub(crate) fn clamp_to_edge(&mut self) {
        let size = self.texture.size(0);
        for (u, n) in self.at.iter_mut().zip(size) {
            let half = 0.5 / f64::from(n);
            *u = (u.0.clamp(half, 1.0 - half), u.1.clamp(half, 1.0 - half));
        }
    }

    /// Whether every level of detail reads the same: there is one level, and one filter for it.
    pub(crate) fn has_one_level(&self) -> bool {
        self.texture.levels() == 1 && self.sampler.mag == self.sampler.min
    }

    /// What a filter's arithmetic may add along one axis.
    fn allowance(&self, uncertain: bool) -> Option<f64> {
        self.may_differ(uncertain)
            .then(|| self.texture.format().filter_step())
    }

    /// Whether the filter may differ from the ideal one.
    fn may_differ(&self, uncertain: bool) -> bool {
        uncertain && !self.sampler.ideal
    }

    /// The level of detail for a change of the coordinate along x and along y.
    pub(crate) fn level(&self, dx: [Bounds; 3], dy: [Bounds; 3], uncertain: bool) -> Bounds {
        if self.texture.dimension() == Dimension::Cube {
            return self.cube_level(dx, dy, uncertain);
        }
        let n = self.axes();
        let size = self.texture.size(0);
        let scaled = |d: [Bounds; 3]| -> Vec<Bounds> {
            (0..n)
                .map(|k| (d[k].0 * f64::from(size[k]), d[k].1 * f64::from(size[k])))
                .collect()
        };
        lod::from_gradients(&scaled(dx), &scaled(dy), uncertain)
    }

    /// On a cube the direction's change, seen from the centre, over the length of its major component, in texels of a face.
    pub(crate) fn cube_level(&self, dx: [Bounds; 3], dy: [Bounds; 3], uncertain: bool) -> Bounds {
        let half = f64::from(self.texture.size(0)[0]) / 2.0;
        let magnitude = |b: Bounds| {
            (
                if b.0 <= 0.0 && b.1 >= 0.0 {
                    0.0
                } else {
                    b.0.abs().min(b.1.abs())
                },
                b.0.abs().max(b.1.abs()),
            )
        };
        let at = self.at.map(magnitude);
        let major = (
            at[0].0.max(at[1].0).max(at[2].0),
            at[0].1.max(at[1].1).max(at[2].1),
        );
        let scaled = |d: [Bounds; 3]| -> Vec<Bounds> {
            d.map(|b| {
                let ends = [
                    b.0 * half / major.0,
                    b.0 * half / major.1,
                    b.1 * half / major.0,
                    b.1 * half / major.1,
                ];
                (
                    ends.into_iter().fold(f64::INFINITY, f64::min),
                    ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
                )
            })
            .to_vec()
        };
        let (lo, hi) = lod::from_gradients(&scaled(dx), &scaled(dy), uncertain);
        // The projection onto the face can lengthen or shorten a change by up to a factor of two.
        if uncertain { (lo - 1.0, hi + 1.0) } else { (lo, hi) }
    }

    pub(crate) fn axes(&self) -> usize {
        match self.texture.dimension() {
            Dimension::D1 => 1,
            Dimension::D2 => 2,
            Dimension::D3 | Dimension::Cube => 3,
        }
    }

    /// The hull over everything a level of detail may select.
    pub(crate) fn sample(&self, level: Bounds, uncertain: bool) -> Channels {
        if level.1 <= 0.0 && f64::from(self.sampler.lod.0) <= 0.0 && self.layers.start() == self.layers.end()
        {
            return self.one_level(0, *self.layers.start(), self.sampler.mag, uncertain);
        }
        let taps = lod::taps(self.sampler, self.texture.levels(), level);
        let mut total: Option<Channels> = None;
        for tap in taps {
            for layer in self.layers.clone() {
                let value = self.tap(tap, layer, uncertain);
                total = Some(total.map_or(value, |t| filter::hull(t, value)));
            }
        }
        total.unwrap_or([(0.0, 0.0); 4])
    }

    pub(crate) fn tap(&self, tap: Tap, layer: u32, uncertain: bool) -> Channels {
        let lower = self.one_level(tap.level, layer, tap.filter, uncertain);
        if tap.weight == 0.0 || tap.level + 1 >= self.texture.levels() {
            return lower;
        }
        let upper = self.one_level(tap.level + 1, layer, tap.filter, uncertain);
        let step = self.allowance(uncertain).unwrap_or(0.0);
        std::array::from_fn(|c| {
            let (low, high) = filter::lerp(lower[c], upper[c], (tap.weight, tap.weight));
            (low - step, high + step)
        })
    }

    pub(crate) fn one_level(&self, level: usize, layer: u32, filter: Filter, uncertain: bool) -> Channels {
        let result = if self.texture.dimension() == Dimension::Cube {
            self.cube_level_value(level, layer, filter, uncertain)
        } else {
            self.axes_at(level, filter, uncertain).map(|axes| {
                filtered(&axes, self.allowance(uncertain), &mut |at| {
                    self.fetch(level, layer, at)
                })
            })
        };
        result.unwrap_or_else(|_| self.anything(level))
    }

    pub(crate) fn axes_at(
        &self,
        level: usize,
        filter: Filter,
        uncertain: bool,
    ) -> Result<[Axis; 3], TooWide> {
        let size = self.texture.size(level);
        let axis = |k: usize| {
            if k < self.axes() {
                Axis::new(
                    self.at[k],
                    size[k],
                    self.offset[k],
                    filter,
                    self.may_differ(uncertain),
                    self.limit,
                )
            } else {
                Ok(Axis::flat())
            }
        };
        let axes = [axis(0)?, axis(1)?, axis(2)?];
        let cells: usize = axes.iter().map(Axis::len).product();
        if cells > self.limit as usize {
            Err(TooWide)
        } else {
            Ok(axes)
        }
    }

    pub(crate) fn cube_level_value(
        &self,
        level: usize,
        layer: u32,
        filter: Filter,
        uncertain: bool,
    ) -> Result<Channels, TooWide> {
        let mut total: Option<Channels> = None;
        for (face, coordinates) in cube::faces(self.at, uncertain) {
            let value = self.on_face(level, layer, (face, coordinates), filter, uncertain)?;
            total = Some(total.map_or(value, |t| filter::hull(t, value)));
        }
        total.ok_or(TooWide)
    }

    pub(crate) fn on_face(
        &self,
        level: usize,
        layer: u32,
        (face, at): OnFace,
        filter: Filter,
        uncertain: bool,
    ) -> Result<Channels, TooWide> {
        let n = self.texture.size(level)[0];
        let axis = |k: usize| Axis::new(at[k], n, 0, filter, self.may_differ(uncertain), self.limit);
        let axes = [axis(0)?, axis(1)?, Axis::flat()];
        Ok(filtered(&axes, self.allowance(uncertain), &mut |[i, j, _]| {
            self.cube_texel(level, layer, (face, i, j), n, uncertain)
        }))
    }

    pub(crate) fn cube_texel(
        &self,
        level: usize,
        layer: u32,
        (face, i, j): (u32, i64, i64),
        n: u32,
        uncertain: bool,
    ) -> Channels {
        let list = cube::across(face, i, j, n);
        let texels = list
            .iter()
            .map(|&(f, x, y)| self.compared(self.texture.texel(level, [x, y, 0], 6 * layer + f)));
        if self.may_differ(uncertain) {
            return texels.reduce(filter::hull).unwrap_or([(0.0, 0.0); 4]);
        }
        let count = list.len() as f64;
        texels.fold([(0.0, 0.0); 4], |sum, t| {
            std::array::from_fn(|c| (sum[c].0 + t[c].0 / count, sum[c].1 + t[c].1 / count))
        })
    }

    /// A texel by unwrapped index, after the depth comparison.
    pub(crate) fn fetch(&self, level: usize, layer: u32, at: [i64; 3]) -> Channels {
        let size = self.texture.size(level);
        let mut index = [0; 3];
        for k in 0..3 {
            match filter::address(self.sampler.address[k], at[k], size[k]) {
                Some(i) => index[k] = i,
                None => return self.compared(self.sampler.border.map(f64::from)),
            }
        }
        self.compared(self.texture.texel(level, index, layer))
    }

    /// A texel, or 0 or 1 by the sampler's comparison with the reference.
    pub(crate) fn compared(&self, texel: [f64; 4]) -> Channels {
        let (Some(mut reference), Some(function)) = (self.reference, self.sampler.compare) else {
            return texel.map(|x| (x, x));
        };
        if self.texture.format().clamps_reference() {
            reference = (reference.0.clamp(0.0, 1.0), reference.1.clamp(0.0, 1.0));
        }
        let one = match compare(function, reference, texel[0]) {
            Truth::True => (1.0, 1.0),
            Truth::False => (0.0, 0.0),
            Truth::Maybe => (0.0, 1.0),
        };
        [one; 4]
    }

    /// A component of the four texels that bilinear filtering would blend, in WGSL's order.
    pub(crate) fn gather(&self, component: usize, uncertain: bool) -> Channels {
        let mut out: Option<Channels> = None;
        for layer in self.layers.clone() {
            match self.gather_layer(component, layer, uncertain) {
                Ok(value) => out = Some(out.map_or(value, |t| filter::hull(t, value))),
                Err(TooWide) => return [self.anything(0)[component]; 4],
            }
        }
        out.unwrap_or([(0.0, 0.0); 4])
    }

    pub(crate) fn gather_layer(
        &self,
        component: usize,
        layer: u32,
        uncertain: bool,
    ) -> Result<Channels, TooWide> {
        if self.texture.dimension() == Dimension::Cube {
            let n = self.texture.size(0)[0];
            let mut total: Option<Channels> = None;
            for (face, at) in cube::faces(self.at, uncertain) {
                let axis = |k: usize| {
                    Axis::new(
                        at[k],
                        n,
                        0,
                        Filter::Linear,
                        self.may_differ(uncertain),
                        self.limit,
                    )
                };
                let fetch = |i, j| self.cube_texel(0, layer, (face, i, j), n, uncertain)[component];
                let value = four(&axis(0)?, &axis(1)?, &fetch);
                total = Some(total.map_or(value, |t| filter::hull(t, value)));
            }
            return total.ok_or(TooWide);
        }
        let axes = self.axes_at(0, Filter::Linear, uncertain)?;
        Ok(four(&axes[0], &axes[1], &|i, j| {
            self.fetch(0, layer, [i, j, 0])[component]
        }))
    }

    /// Every value of a level, or of a comparison.
    pub(crate) fn anything(&self, level: usize) -> Channels {
        if self.reference.is_some() {
            [(0.0, 1.0); 4]
        } else {
            self.texture.level_bounds(level)
        }
    }
}

/// The four texels of every cell, in the order (min, max), (max, max), (max, min), (min, min).
fn four(x: &Axis, y: &Axis, fetch: &impl Fn(i64, i64) -> Bounds) -> Channels {
    let mut total: Option<Channels> = None;
    for (i, _) in x.cells() {
        for (j, _) in y.cells() {
            let cell = [fetch(i, j + 1), fetch(i + 1, j + 1), fetch(i + 1, j), fetch(i, j)];
            total = Some(total.map_or(cell, |t| filter::hull(t, cell)));
        }
    }
    total.unwrap_or([(0.0, 0.0); 4])
}

fn compare(function: CompareFunction, reference: Bounds, texel: f64) -> Truth {
    let op = match function {
        CompareFunction::Never => return Truth::False,
        CompareFunction::Always => return Truth::True,
        CompareFunction::Less => Compare::Less,
        CompareFunction::Equal => Compare::Equal,
        CompareFunction::LessEqual => Compare::LessEqual,
        CompareFunction::Greater => Compare::Greater,
        CompareFunction::NotEqual => Compare::NotEqual,
        CompareFunction::GreaterEqual => Compare::GreaterEqual,
    };
    integers::compare(op, reference, (texel, texel))
}
