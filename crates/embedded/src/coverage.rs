//! Which pixels a convex polygon covers: exact integer arithmetic, by the top-left rule.
//!
//! Corners are snapped to 1/256 of a pixel, rows run downwards. A pixel is covered when its centre lies inside, or on a left
//! edge, or on a top edge (horizontal, with the inside below). Of two polygons that share an edge, exactly one covers a centre
//! on it. A polygon is a fan of triangles; what several of them cover counts once.
//!
//! Range. Corners lie within 2²⁴ units of the origin (the guard band sees to it), edge functions within 2⁵¹: no overflow.

/// Units of a pixel.
pub(crate) const UNITS: i64 = 256;

/// A corner in units, y downwards.
pub(crate) type Corner = [i64; 2];

/// The quads of a polygon: masks of 2 × 2 pixels in rows, bit x + 2·y for each.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Coverage {
    left: u32,
    top: u32,
    columns: u32,
    masks: Vec<u8>,
}

/// A corner of a polygon in clip space (w > 0), in units.
pub(crate) fn snap([x, y, _, w]: [f64; 4], width: u32, height: u32) -> Corner {
    let window_x = (x / w + 1.0) * 0.5 * f64::from(width);
    let window_y = (1.0 - y / w) * 0.5 * f64::from(height);
    [window_x, window_y].map(|pixels| (pixels * UNITS as f64).round_ties_even() as i64)
}

impl Coverage {
    /// What a polygon covers of a picture; `None` where it covers nothing.
    pub(crate) fn of(polygon: &[Corner], width: u32, height: u32) -> Option<Self> {
        let (columns, rows) = (bounds(polygon, 0, width)?, bounds(polygon, 1, height)?);
        let (left, top) = (columns.0 / 2, rows.0 / 2);
        let across = columns.1 / 2 - left + 1;
        let down = rows.1 / 2 - top + 1;
        let mut coverage = Self {
            left,
            top,
            columns: across,
            masks: vec![0; across as usize * down as usize],
        };
        let (first, rest) = polygon.split_first()?;
        for pair in rest.windows(2) {
            coverage.add([*first, pair[0], pair[1]], columns, rows);
        }
        coverage.masks.iter().any(|mask| *mask != 0).then_some(coverage)
    }

    /// The quads that have a covered pixel: the upper left pixel of each, and its mask.
    pub(crate) fn quads(&self) -> impl Iterator<Item = ([u32; 2], u8)> + '_ {
        (0..)
            .zip(&self.masks)
            .filter(|(_, mask)| **mask != 0)
            .map(|(at, mask): (u32, &u8)| {
                let (x, y) = (at % self.columns, at / self.columns);
                ([2 * (self.left + x), 2 * (self.top + y)], *mask)
            })
    }

    fn add(&mut self, [a, b, c]: [Corner; 3], columns: (u32, u32), rows: (u32, u32)) {
        let area = Edge::new(a, b).at(c[0], c[1]);
        let edges = match area.signum() {
            1 => [Edge::new(a, b), Edge::new(b, c), Edge::new(c, a)],
            -1 => [Edge::new(a, c), Edge::new(c, b), Edge::new(b, a)],
            _ => return,
        };
        for y in rows.0..=rows.1 {
            if let Some((first, last)) = span(&edges, y, columns) {
                (first..=last).for_each(|x| self.mark(x, y));
            }
        }
    }

    fn mark(&mut self, x: u32, y: u32) {
        let at = (y / 2 - self.top) * self.columns + (x / 2 - self.left);
        self.masks[at as usize] |= 1 << (x % 2 + 2 * (y % 2));
    }
}

/// The first and the last pixel whose centre lies within the polygon's bounds along an axis.
fn bounds(polygon: &[Corner], axis: usize, side: u32) -> Option<(u32, u32)> {
    let along = polygon.iter().map(|corner| corner[axis]);
    let (low, high) = (along.clone().min()?, along.max()?);
    let first = (low - UNITS / 2 + UNITS - 1).div_euclid(UNITS).max(0);
    let last = (high - UNITS / 2).div_euclid(UNITS).min(i64::from(side) - 1);
    (first <= last).then_some((first as u32, last as u32))
}

/// The pixels of a row that all edges leave.
fn span(edges: &[Edge; 3], y: u32, columns: (u32, u32)) -> Option<(u32, u32)> {
    let (mut first, mut last) = (i64::from(columns.0), i64::from(columns.1));
    for edge in edges {
        // inside(x) = start + step · x ≥ 0, at the centres of the row's pixels.
        let start = edge.at(UNITS / 2, i64::from(y) * UNITS + UNITS / 2) - i64::from(!edge.is_top_left());
        let step = edge.dx * UNITS;
        match step.signum() {
            1 => first = first.max(-start.div_euclid(step)),
            -1 => last = last.min(start.div_euclid(-step)),
            _ if start < 0 => return None,
            _ => {}
        }
    }
    (first <= last).then_some((first as u32, last as u32))
}

/// An edge whose function is positive inside.
#[derive(Clone, Copy, Debug)]
struct Edge {
    from: Corner,
    /// What the function gains a unit along x and along y.
    dx: i64,
    dy: i64,
}

impl Edge {
    fn new(from: Corner, to: Corner) -> Self {
        Self {
            from,
            dx: from[1] - to[1],
            dy: to[0] - from[0],
        }
    }

    fn at(&self, x: i64, y: i64) -> i64 {
        self.dx * (x - self.from[0]) + self.dy * (y - self.from[1])
    }

    /// Left: the inside lies towards +x. Top: horizontal, and the inside lies below, towards +y.
    fn is_top_left(&self) -> bool {
        self.dx > 0 || (self.dx == 0 && self.dy > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 16;

    /// How often each pixel is covered by these polygons, corners in 1/4 pixels.
    fn counts(polygons: &[&[[i64; 2]]]) -> Vec<u32> {
        let mut counts = vec![0; (SIDE * SIDE) as usize];
        for polygon in polygons {
            let units: Vec<Corner> = polygon.iter().map(|c| c.map(|q| q * UNITS / 4)).collect();
            let Some(coverage) = Coverage::of(&units, SIDE, SIDE) else {
                continue;
            };
            for ([x, y], mask) in coverage.quads() {
                for bit in (0..4).filter(|bit| mask & (1 << bit) != 0) {
                    counts[((y + bit / 2) * SIDE + x + bit % 2) as usize] += 1;
                }
            }
        }
        counts
    }

    #[test]
    fn a_rectangle_on_pixel_centres_takes_its_left_and_top_edge_alone() {
        // From the centre of pixel (1, 2) to the centre of pixel (5, 4): columns 1 to 4, rows 2 and 3.
        let corners: &[[i64; 2]] = &[[6, 10], [22, 10], [22, 18], [6, 18]];
        let counted = counts(&[corners]);
        for y in 0..SIDE {
            for x in 0..SIDE {
                let inside = (1..5).contains(&x) && (2..4).contains(&y);
                assert_eq!(counted[(y * SIDE + x) as usize], u32::from(inside), "{x}, {y}");
            }
        }
        let reversed: Vec<[i64; 2]> = corners.iter().rev().copied().collect();
        assert_eq!(counts(&[&reversed]), counted, "the direction makes no difference");
    }

    #[test]
    fn counts_of_known_triangles() {
        let count = |corners: &[[i64; 2]]| counts(&[corners]).iter().sum::<u32>();
        // The lower left half of 16 × 16: the diagonal goes through centres and is a right edge there.
        assert_eq!(count(&[[0, 0], [0, 64], [64, 64]]), 15 * 16 / 2);
        // The upper right half, to which the diagonal is a left edge.
        assert_eq!(count(&[[0, 0], [64, 64], [64, 0]]), 16 * 17 / 2);
        // Half a pixel around one centre, and none.
        assert_eq!(count(&[[5, 5], [7, 5], [6, 8]]), 1);
        assert_eq!(count(&[[4, 4], [5, 4], [4, 5]]), 0);
        // Without area, and outside.
        assert_eq!(count(&[[0, 0], [32, 32], [64, 64]]), 0);
        assert_eq!(count(&[[-40, 0], [-8, 0], [-8, 32]]), 0);
    }

    /// Seeded numbers without a dependency: the generator of Knuth's MMIX.
    fn numbers(seed: u64) -> impl FnMut(i64) -> i64 {
        let mut state = seed;
        move |range| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i64 % range
        }
    }

    /// A grid whose inner points are moved about, cut into triangles: corners in 1/4 pixels, so that many edges go through
    /// centres.
    fn mesh(seed: u64) -> Vec<[[i64; 2]; 3]> {
        let mut next = numbers(seed);
        let side = 5;
        let mut points = Vec::new();
        for (i, j) in (0..side).flat_map(|j| (0..side).map(move |i| (i, j))) {
            let inner = |k: i64| k > 0 && k < side - 1;
            let mut moved = |k: i64, moves: bool| 16 * k + if moves { next(9) - 4 } else { 0 };
            points.push([moved(i, inner(i)), moved(j, inner(j))]);
        }
        let at = |i: i64, j: i64| points[(j * side + i) as usize];
        let mut triangles = Vec::new();
        for (i, j) in (0..side - 1).flat_map(|j| (0..side - 1).map(move |i| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [c, d, a]]);
        }
        triangles
    }

    #[test]
    fn a_mesh_covers_every_pixel_exactly_once() {
        for seed in 0..500 {
            let triangles = mesh(seed);
            let polygons: Vec<&[[i64; 2]]> = triangles.iter().map(|t| t.as_slice()).collect();
            assert_eq!(counts(&polygons), vec![1; (SIDE * SIDE) as usize], "seed {seed}");
        }
    }

    /// Negative control of the test above: with closed edges, meshes cover pixels twice.
    #[test]
    fn without_the_rule_pixels_on_edges_count_twice() {
        let closed = |triangle: &[[i64; 2]; 3], x: i64, y: i64| {
            let [a, b, c] = *triangle;
            [Edge::new(a, b), Edge::new(b, c), Edge::new(c, a)]
                .iter()
                .all(|edge| edge.at(x, y) >= 0)
        };
        let twice = (0..20).any(|seed| {
            let triangles = mesh(seed);
            let centres = (0..i64::from(SIDE)).flat_map(|y| (0..i64::from(SIDE)).map(move |x| (x, y)));
            centres.into_iter().any(|(x, y)| {
                triangles
                    .iter()
                    .filter(|t| closed(t, 4 * x + 2, 4 * y + 2))
                    .count()
                    > 1
            })
        });
        assert!(twice);
    }

    #[test]
    fn snapping_rounds_to_the_nearest_unit_and_turns_y_round() {
        assert_eq!(snap([-1.0, 1.0, 0.0, 1.0], 64, 32), [0, 0]);
        assert_eq!(snap([2.0, -2.0, 0.0, 2.0], 64, 32), [64 * UNITS, 32 * UNITS]);
        let eighth_of_a_unit = 2.0 / (64.0 * UNITS as f64) / 8.0;
        assert_eq!(snap([-1.0 + eighth_of_a_unit, 1.0, 0.0, 1.0], 64, 32), [0, 0]);
        assert_eq!(
            snap([-1.0 + 7.0 * eighth_of_a_unit, 1.0, 0.0, 1.0], 64, 32),
            [1, 0]
        );
    }
}
