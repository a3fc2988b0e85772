//! A pyramid over the cells of a field: highest heights and ranges of slopes; and the copies of a tile around it.

use super::slopes::{self, Slopes};
use crate::{EdgeMode, HeightField};

/// What is known of some cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// Their highest height.
    pub(super) highest: f32,
    /// The height of the texel in their middle.
    pub(super) middle: f32,
    /// Their slopes.
    pub(super) slopes: Slopes,
}

/// One level: a grid of nodes.
pub(super) struct Level {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) nodes: Vec<Node>,
}

/// Cells first, then nodes of 2 × 2 each, up to one node.
pub(super) struct Pyramid {
    pub(super) levels: Vec<Level>,
}

impl Node {
    /// Of both; the middle is left for whoever knows how many there are.
    fn join(self, other: Self) -> Self {
        Self {
            highest: self.highest.max(other.highest),
            middle: self.middle,
            slopes: slopes::hull(&self.slopes, &other.slopes),
        }
    }
}

impl Pyramid {
    /// Also answers the lowest height and the twist, without sign, of every cell.
    pub(super) fn new(field: &HeightField, edge: EdgeMode) -> (Self, Vec<f32>, Vec<f32>) {
        let count = field.texels.len();
        let (mut nodes, mut lowest, mut twist) = (
            Vec::with_capacity(count),
            Vec::with_capacity(count),
            Vec::with_capacity(count),
        );
        for y in 0..field.height {
            for x in 0..field.width {
                let [[h00, h10], [h01, h11]] = corners(field, edge, x, y);
                let along_x = [h10 - h00, h11 - h01];
                let along_y = [h01 - h00, h11 - h10];
                nodes.push(Node {
                    highest: h00.max(h10).max(h01).max(h11),
                    middle: h00,
                    slopes: [
                        range(along_x, edge != EdgeMode::Wrap && x == 0),
                        range(along_y, edge != EdgeMode::Wrap && y == 0),
                    ],
                });
                lowest.push(h00.min(h10).min(h01).min(h11));
                twist.push((along_x[1] - along_x[0]).abs());
            }
        }
        let mut levels = vec![Level {
            width: field.width,
            height: field.height,
            nodes,
        }];
        while let Some(last) = levels.last().filter(|last| last.nodes.len() > 1) {
            let above = last.above(field, levels.len());
            levels.push(above);
        }
        (Self { levels }, lowest, twist)
    }

    pub(super) fn node(&self, level: usize, [x, y]: [u32; 2]) -> &Node {
        let level = &self.levels[level];
        &level.nodes[y as usize * level.width as usize + x as usize]
    }

    /// The cells of a node along an axis: first, and one behind the last.
    pub(super) fn span(&self, axis: usize, level: usize, node: u32) -> [i32; 2] {
        let side = if axis == 0 {
            self.levels[0].width
        } else {
            self.levels[0].height
        };
        span(level, node, side).map(|cell| cell as i32)
    }
}

/// The cells of a node along a side of so many: first, and one behind the last.
fn span(level: usize, node: u32, side: u32) -> [u32; 2] {
    [node << level, ((node + 1) << level).min(side)]
}

/// The texel in the middle of a span of cells.
pub(super) fn middle<T>([start, end]: [T; 2]) -> T
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Div<Output = T> + From<u8>,
{
    (start + end) / T::from(2)
}

impl Level {
    /// The next level, which is the so manieth of the field.
    fn above(&self, field: &HeightField, level: usize) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let node = |x: u32, y: u32| self.nodes[y as usize * self.width as usize + x as usize];
        let join = |x: u32, y: u32| {
            let (right, below) = ((2 * x + 1).min(self.width - 1), (2 * y + 1).min(self.height - 1));
            let top = node(2 * x, 2 * y).join(node(right, 2 * y));
            let all = top.join(node(2 * x, below)).join(node(right, below));
            let [x, y] =
                [(x, field.width), (y, field.height)].map(|(node, side)| middle(span(level, node, side)));
            Node {
                middle: field.texel(x, y),
                ..all
            }
        };
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Self {
            width,
            height,
            nodes: places.map(|(x, y)| join(x, y)).collect(),
        }
    }
}

/// The heights at a cell's corners, row by row.
fn corners(field: &HeightField, edge: EdgeMode, x: u32, y: u32) -> [[f32; 2]; 2] {
    let right = edge.resolve(i64::from(x) + 1, field.width);
    let below = edge.resolve(i64::from(y) + 1, field.height);
    [y, below].map(|y| [x, right].map(|x| field.texel(x, y)))
}

/// Least and greatest of two slopes. Before the first cell of a border that goes on lies level ground, at heights of the cell's own
/// edge: its slope counts here.
fn range([a, b]: [f32; 2], level_before: bool) -> [f32; 2] {
    let (least, greatest) = (a.min(b), a.max(b));
    if level_before {
        [least.min(0.0), greatest.max(0.0)]
    } else {
        [least, greatest]
    }
}

/// Where a copy of the tile's cells lies along one axis. Copies further away than the next ones hold nothing that is not nearer.
#[derive(Debug, Clone, Copy)]
pub(super) enum Fold {
    /// Cell c at c + this.
    Shifted(i32),
    /// Cell c at this − c, turned round.
    Mirrored(i32),
}

impl Fold {
    /// The tile itself, and its neighbours.
    pub(super) fn all(edge: EdgeMode, side: u32) -> Vec<Self> {
        let n = side as i32;
        match edge {
            EdgeMode::Wrap => vec![Self::Shifted(0), Self::Shifted(-n), Self::Shifted(n)],
            // The border texel occurs twice: cell −1 − k is cell k − 1, and cell n + k is cell n − 2 − k.
            EdgeMode::Mirror => vec![Self::Shifted(0), Self::Mirrored(-2), Self::Mirrored(2 * n - 2)],
            EdgeMode::Clamp => vec![Self::Shifted(0)],
        }
    }

    /// Where a span of cells lies: first, and one behind the last.
    pub(super) fn span(self, [start, end]: [i32; 2]) -> [i32; 2] {
        match self {
            Self::Shifted(by) => [start + by, end + by],
            Self::Mirrored(around) => [around - end + 1, around - start + 1],
        }
    }

    /// Where a texel lies.
    pub(super) fn texel(self, texel: i32) -> i32 {
        match self {
            Self::Shifted(by) => texel + by,
            Self::Mirrored(around) => around - texel + 1,
        }
    }

    /// A range of slopes as it is there.
    pub(super) fn gradient(self, [least, greatest]: [f32; 2]) -> [f32; 2] {
        match self {
            Self::Shifted(_) => [least, greatest],
            Self::Mirrored(_) => [-greatest, -least],
        }
    }
}
