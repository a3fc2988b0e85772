//! For every cell between texel centres: how steep is the steepest way up from any point of it to any other point of the surface?
//!
//! The answer is a bound from above, in heights a texel, over the whole plane that the edge mode makes of the tile. The slope from p
//! in cell C to q in cell D is at most
//! - (highest of D − lowest of C) / (distance of the cells), and
//! - the greatest gradient in the square around C that holds D, since the straight way from p to q lies in it. For
//!   [`Rule::CrossedOnce`] also: how much gradients differ there, since a way that rises to q and falls at q has both.
//!
//! The smallest counts; for the cells around C only the second. A pyramid of maxima is searched from the top, the steepest
//! node first. What cannot exceed the slope that is known already by more than [`SLACK`] is not looked into, its own bound counts.
//! Before a node is looked into, a texel in its middle and the range of its gradients are asked (`Base::surely_less_steep`): on a smooth map they
//! say more than its highest height does (`docs/relief.md` has the times). Slopes below one height a longer side are not told apart.
//!
//! [`Rule::CrossedOnce`] leaves out what surely rises away from C: nodes all of whose gradients point away from all of C.
//!
//! Arithmetic is f32: distances are exact, all else is rounded a few times, for which every slope is raised by 2⁻²⁰ of itself.

use rayon::prelude::*;

use crate::{EdgeMode, HeightField};

mod pyramid;
mod slopes;

use pyramid::{Fold, Node, Pyramid};
use slopes::Slopes;

/// Which points of the surface count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Rule {
    /// All.
    Free,
    /// Those that may fall away from the cell.
    CrossedOnce,
}

/// Squares whose gradients are at hand: their radii, powers of two, and the pyramid's level on which they are kept.
const SQUARES: [(u32, usize); 11] = [
    (1, 0),
    (2, 0),
    (4, 0),
    (8, 0),
    (16, 0),
    (32, 3),
    (64, 3),
    (128, 5),
    (256, 5),
    (512, 7),
    (1024, 7),
];

/// By how much a bound may exceed the slope of the steepest cell found, as a factor. Without it, smooth maps would cost the number of
/// their texels to the power of 3/2: so many cells lie within their own size of the steepest. With it, a search looks into
/// nodes up to 16 times their own width away on each level.
const SLACK: f32 = 1.0 + 1.0 / 16.0;

/// The same for what a node's texel and gradients say, which is told of a slope given and not of the node's own.
const MIDDLE_SLACK: f32 = 1.0 + 1.0 / 64.0;

/// What covers the rounding of a slope, as a share of it.
const ROUNDED: f32 = 1.0 / 1_048_576.0;

/// The same as a factor.
const ROUNDING: f32 = 1.0 + ROUNDED;

/// A field's cells, ready to be searched. Cell (i, j) lies between the centres of texel (i, j) and the next ones.
pub(crate) struct Cells {
    pyramid: Pyramid,
    /// Lowest height of each cell.
    lowest: Vec<f32>,
    /// h₁₁ − h₁₀ − h₀₁ + h₀₀ of each cell, without sign.
    twist: Vec<f32>,
    /// Greatest gradient of each cell.
    gradient: Vec<f32>,
    /// For each of [`SQUARES`]: the bound by the gradients of the cells in it.
    around: [Around; SQUARES.len()],
    /// The tile and those beside it, along each axis.
    folds: [Vec<Fold>; 2],
    edge: EdgeMode,
    rule: Rule,
}

/// Bounds by the gradients around each node of a level.
struct Around {
    level: usize,
    width: u32,
    bounds: Vec<f32>,
}

/// The cell whose ways up are sought.
struct Base<'a> {
    cells: &'a Cells,
    index: usize,
    /// Column and row.
    at: [i32; 2],
    /// From where to where its points stand, along each axis: a border that goes on counts with its first cell.
    reach: [[f32; 2]; 2],
    lowest: f32,
    /// The bounds by the gradients of [`SQUARES`] around it.
    around: [f32; SQUARES.len()],
}

/// A node in one of the tiles.
#[derive(Clone, Copy)]
struct Place {
    level: usize,
    node: [u32; 2],
    folds: [Fold; 2],
}

impl Cells {
    pub(crate) fn new(field: &HeightField, edge: EdgeMode, rule: Rule) -> Self {
        let (pyramid, lowest, twist) = Pyramid::new(field, edge);
        let cells = &pyramid.levels[0].nodes;
        let around = SQUARES.map(|(radius, level)| Around::new(&pyramid, edge, rule, radius, level));
        Self {
            lowest,
            twist,
            gradient: cells.iter().map(|node| slopes::greatest(&node.slopes)).collect(),
            pyramid,
            around,
            folds: [field.width, field.height].map(|side| Fold::all(edge, side)),
            edge,
            rule,
        }
    }

    /// The bound of every cell, row by row; at least one height a longer side.
    pub(crate) fn steepest(&self) -> Vec<f32> {
        let base = &self.pyramid.levels[0];
        let width = base.width as usize;
        let mut slopes = vec![0.0; base.nodes.len()];
        slopes.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            let (mut stack, mut hint) = (Vec::new(), None);
            for (x, slope) in row.iter_mut().enumerate() {
                let base = Base::new(self, [x as i32, y as i32]);
                *slope = base.steepest(&mut stack, &mut hint) * ROUNDING;
            }
        });
        slopes
    }
}

impl Around {
    fn new(pyramid: &Pyramid, edge: EdgeMode, rule: Rule, radius: u32, level: usize) -> Self {
        let level = level.min(pyramid.levels.len() - 1);
        let grid = &pyramid.levels[level];
        let slopes: Vec<Slopes> = grid.nodes.iter().map(|node| node.slopes).collect();
        // On a coarse level a square begins anywhere in its node, and the last node before a seam may be a small one.
        let nodes = if level == 0 {
            radius
        } else {
            radius.div_ceil(1 << level) + 2
        };
        let slopes = slopes::within(slopes, [grid.width, grid.height], edge, nodes);
        let bound = |slopes: &Slopes| match rule {
            Rule::Free => slopes::greatest(slopes),
            Rule::CrossedOnce => slopes::greatest(slopes).min(slopes::difference(slopes)),
        };
        Self {
            level,
            width: grid.width,
            bounds: slopes.iter().map(bound).collect(),
        }
    }

    fn at(&self, [x, y]: [i32; 2]) -> f32 {
        let (x, y) = (x as usize >> self.level, y as usize >> self.level);
        self.bounds[y * self.width as usize + x]
    }
}

impl<'a> Base<'a> {
    fn new(cells: &'a Cells, at: [i32; 2]) -> Self {
        let level = &cells.pyramid.levels[0];
        let index = at[1] as usize * level.width as usize + at[0] as usize;
        let sides = [level.width, level.height];
        let far = 2.0 * sides[0].max(sides[1]) as f32;
        let goes_on = |axis: usize, border: i32| cells.edge != EdgeMode::Wrap && at[axis] == border;
        let reach = [0, 1].map(|axis| {
            let first = if goes_on(axis, 0) { -far } else { at[axis] as f32 };
            let last = if goes_on(axis, sides[axis] as i32 - 1) {
                far
            } else {
                1.0 + at[axis] as f32
            };
            [first, last]
        });
        Self {
            cells,
            index,
            at,
            reach,
            lowest: cells.lowest[index],
            around: std::array::from_fn(|square| cells.around[square].at(at)),
        }
    }

    /// What is known without a search.
    fn own(&self) -> f32 {
        let level = &self.cells.pyramid.levels[0];
        let least = 1.0 / level.width.max(level.height) as f32;
        let own = match self.cells.rule {
            Rule::Free => self.around[0],
            // A way up and over a crest inside one patch, bτ + aτ² with |a| ≤ twist/2: half as steep at the crest as at its start, and the
            // crest lies within the cell's diagonal.
            Rule::CrossedOnce => (0.5 * self.cells.gradient[self.index])
                .min(self.cells.twist[self.index] * std::f32::consts::FRAC_1_SQRT_2),
        };
        own.max(least)
    }

    fn steepest(&self, stack: &mut Vec<(f32, Place)>, hint: &mut Option<Place>) -> f32 {
        let mut found = self.own();
        if let Some(place) = hint.filter(|place| !self.surely_less_steep(place, found * MIDDLE_SLACK)) {
            let bound = self.bound(&place);
            found = found.max(self.sharpened(&place, found * MIDDLE_SLACK, bound));
        }
        let mut passed = 0.0f32;
        stack.clear();
        let top = self.cells.pyramid.levels.len() - 1;
        for fold_y in &self.cells.folds[1] {
            for fold_x in &self.cells.folds[0] {
                let folds = [*fold_x, *fold_y];
                let place = Place {
                    level: top,
                    node: [0, 0],
                    folds,
                };
                stack.push((self.bound(&place), place));
            }
        }
        stack.sort_by(|a, b| a.0.total_cmp(&b.0));
        while let Some((bound, place)) = stack.pop() {
            if bound <= found * SLACK {
                passed = passed.max(bound);
            } else if self.surely_less_steep(&place, found * MIDDLE_SLACK) {
                passed = passed.max(found * MIDDLE_SLACK);
            } else if place.level == 0 {
                found = self.sharpened(&place, found * MIDDLE_SLACK, bound);
                *hint = Some(place);
            } else {
                self.push_below(&place, found, stack);
            }
        }
        found.max(passed)
    }

    /// Pushes the nodes below one that may be steeper than what was found, the steepest last.
    fn push_below(&self, place: &Place, found: f32, stack: &mut Vec<(f32, Place)>) {
        let start = stack.len();
        let level = &self.cells.pyramid.levels[place.level - 1];
        for [dx, dy] in [[0, 0], [1, 0], [0, 1], [1, 1]] {
            let node = [2 * place.node[0] + dx, 2 * place.node[1] + dy];
            if node[0] < level.width && node[1] < level.height {
                let below = Place {
                    level: place.level - 1,
                    node,
                    ..*place
                };
                let bound = self.bound(&below);
                if bound > found {
                    stack.push((bound, below));
                }
            }
        }
        stack[start..].sort_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// No way from the base to any point of the node is steeper; 0 where none counts.
    fn bound(&self, place: &Place) -> f32 {
        let node = self.cells.pyramid.node(place.level, place.node);
        let rise = node.highest - self.lowest;
        if rise <= 0.0 {
            return 0.0;
        }
        let spans = [0, 1].map(|axis| {
            let cells = self.cells.pyramid.span(axis, place.level, place.node[axis]);
            place.folds[axis].span(cells)
        });
        if self.cells.rule == Rule::CrossedOnce
            && (self.is_own(spans) || self.surely_rises(node, place, spans))
        {
            return 0.0;
        }
        let [gap_x, gap_y] = [0, 1].map(|axis| gap(self.at[axis], spans[axis]));
        let distance = (gap_x * gap_x + gap_y * gap_y).sqrt();
        let [far_x, far_y] = [0, 1].map(|axis| farthest(self.at[axis], spans[axis]));
        let gradient = self.gradient_within(far_x.max(far_y));
        if distance == 0.0 {
            gradient
        } else {
            gradient.min(rise / distance)
        }
    }

    /// A slope that no way to a node surely exceeds, the least to within [`MIDDLE_SLACK`]: more than `under`, and not more than `bound`.
    fn sharpened(&self, place: &Place, mut under: f32, bound: f32) -> f32 {
        let mut over = bound;
        while over > under * MIDDLE_SLACK {
            let between = (under * over).sqrt();
            if self.surely_less_steep(place, between) {
                over = between;
            } else {
                under = between;
            }
        }
        over
    }

    /// Whether surely no way from the base to a point of the node is steeper than `slope`, told by a texel and the gradients of each.
    ///
    /// With c and m two texels, D their distance and u the direction from c to m: between a point c + f of the base and a point m + e of
    /// the node the surface rises by h(m) − h(c) + g·e − b·f, for some g and b in their ranges of gradients, and they are
    /// no nearer than D + u·(e − f), lengths being convex. So a way is steeper than σ only if
    /// h(m) − h(c) + (g − σ·u)·e − (b − σ·u)·f > σ·D. Where a steepest way ends on a smooth map, g = σ·u: what is left is of second
    /// order in the node's size, while its highest height over its least distance is of first.
    fn surely_less_steep(&self, place: &Place, slope: f32) -> bool {
        let node = self.cells.pyramid.node(place.level, place.node);
        let own = &self.cells.pyramid.levels[0].nodes[self.index];
        let spans = [0, 1].map(|axis| self.cells.pyramid.span(axis, place.level, place.node[axis]));
        let middle = [0, 1].map(|axis| place.folds[axis].texel(pyramid::middle(spans[axis])));
        let away = [0, 1].map(|axis| (middle[axis] - self.at[axis]) as f32);
        let distance = (away[0] * away[0] + away[1] * away[1]).sqrt();
        if distance == 0.0 {
            return false;
        }
        let (mut beside, mut reach) = (0.0, distance + 2.0);
        for axis in 0..2 {
            let even = slope * away[axis] / distance;
            let [before, behind] = place.folds[axis]
                .span(spans[axis])
                .map(|end| (end - middle[axis]) as f32);
            let [least, greatest] = place.folds[axis].gradient(node.slopes[axis]).map(|g| g - even);
            beside += (greatest * behind).max(least * before);
            beside += (even - own.slopes[axis][0]).max(0.0);
            reach += behind - before;
        }
        let rise = node.middle - own.middle;
        // A few roundings of each part, and of what the gradients are compared with.
        let rounded = ROUNDED * (rise.abs() + beside + slope * reach);
        rise + beside + rounded <= slope * distance
    }

    /// The bound by the gradients of the cells within `radius`, or infinity where that is not at hand.
    fn gradient_within(&self, radius: u32) -> f32 {
        let square = radius.max(1).next_power_of_two().ilog2() as usize;
        self.around.get(square).copied().unwrap_or(f32::INFINITY)
    }

    /// Whether a node is the base itself, whose bound [`own`](Self::own) is.
    fn is_own(&self, spans: [[i32; 2]; 2]) -> bool {
        spans == self.at.map(|cell| [cell, cell + 1])
    }

    /// Whether all gradients of a node point away from all of the base.
    fn surely_rises(&self, node: &Node, place: &Place, spans: [[i32; 2]; 2]) -> bool {
        let least = [0, 1].map(|axis| {
            let [from, to] = self.reach[axis];
            let away = [spans[axis][0] as f32 - to, spans[axis][1] as f32 - from];
            let slope = place.folds[axis].gradient(node.slopes[axis]);
            let products = [
                away[0] * slope[0],
                away[0] * slope[1],
                away[1] * slope[0],
                away[1] * slope[1],
            ];
            products.into_iter().fold(f32::INFINITY, f32::min)
        });
        least[0] + least[1] >= 0.0
    }
}

/// Cells between a cell and a span of them, 0 where they touch or overlap.
fn gap(cell: i32, [start, end]: [i32; 2]) -> f32 {
    (start - cell - 1).max(cell - end).max(0) as f32
}

/// How many cells away the farthest of a span is.
fn farthest(cell: i32, [start, end]: [i32; 2]) -> u32 {
    (cell - start).max(end - 1 - cell).unsigned_abs()
}
