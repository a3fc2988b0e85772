//! `normal_mips`: the mip chain of a normal map: each level the box filter of the one before, then normalised.
//!
//! Source: the fourth article leaves it to `glGenerateMipmap`, which averages the bytes and normalises nothing. Here the chain
//! keeps the **averages**; [`naive`] makes the unit normals of them.
//!
//! Sides halve, rounding down. Odd sides weigh by overlap: a texel averages exactly the stretch that it covers, so no texel
//! counts more than another. Domain: decoded normals, of any length.
//!
//! Known loss of the naive rule: the average of normals that differ is shorter than 1, and that length is what says how rough
//! the surface was (Toksvig 2005). Normalising throws it away; [`Level::length`] has it.

use glam::DVec3;

use crate::vector::{SMALLEST_NORMAL_F32, normalize};

/// One level: averages of decoded normals, not normalised.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row by row.
    pub texels: Vec<DVec3>,
}

impl Level {
    /// The average at a texel.
    ///
    /// # Panics
    /// When it lies outside.
    #[must_use]
    pub fn mean(&self, x: u32, y: u32) -> DVec3 {
        self.texels[y as usize * self.width as usize + x as usize]
    }

    /// The average's length: 1 where all normals agree (and are unit vectors), less where they differ.
    #[must_use]
    pub fn length(&self, x: u32, y: u32) -> f64 {
        self.mean(x, y).length()
    }

    /// The next smaller level.
    #[must_use]
    pub fn next(&self) -> Level {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let cell = |i: u32, from: u32, to: u32| {
            let scale = f64::from(from) / f64::from(to);
            (f64::from(i) * scale, f64::from(i + 1) * scale)
        };
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let texels =
            places.map(|(x, y)| self.average(cell(x, self.width, width), cell(y, self.height, height)));
        Level {
            width,
            height,
            texels: texels.collect(),
        }
    }

    /// The mean over a rectangle in texels, each texel a constant square.
    fn average(&self, columns: (f64, f64), rows: (f64, f64)) -> DVec3 {
        let overlap =
            |i: u32, (low, high): (f64, f64)| (high.min(f64::from(i) + 1.0) - low.max(f64::from(i))).max(0.0);
        let touched = |(low, high): (f64, f64), side: u32| low as u32..(high.ceil() as u32).min(side);
        let mut sum = DVec3::ZERO;
        for y in touched(rows, self.height) {
            for x in touched(columns, self.width) {
                sum += overlap(x, columns) * overlap(y, rows) * self.mean(x, y);
            }
        }
        sum / ((columns.1 - columns.0) * (rows.1 - rows.0))
    }
}

/// All levels down to 1 × 1, the base first.
#[must_use]
pub fn chain(base: Level) -> Vec<Level> {
    let mut levels = vec![base];
    while let Some(last) = levels.last().filter(|level| level.width > 1 || level.height > 1) {
        levels.push(last.next());
    }
    levels
}

/// The shares of the texels 2i, 2i + 1 and 2i + 2 of a row of `from` texels in texel i of the next level, by overlap: they sum
/// to 1. An index beyond the level counts as its last.
#[must_use]
pub fn shares(index: u32, from: u32) -> [f64; 3] {
    let to = (from / 2).max(1);
    let stretch = f64::from(from) / f64::from(to);
    let first = f64::from(index.min(to - 1));
    let (start, end) = (first * stretch, (first + 1.0) * stretch);
    [0.0, 1.0, 2.0].map(|step| {
        let texel = 2.0 * first + step;
        (end.min(texel + 1.0) - start.max(texel)).max(0.0) / stretch
    })
}

/// The normal of an average, unit; (0, 0, 1) where the average has no direction.
#[must_use]
pub fn naive(mean: DVec3) -> DVec3 {
    if mean.abs().max_element() < SMALLEST_NORMAL_F32 {
        DVec3::Z
    } else {
        normalize(mean)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{Level, chain, naive, shares};

    fn row(texels: &[DVec3]) -> Level {
        Level {
            width: texels.len() as u32,
            height: 1,
            texels: texels.to_vec(),
        }
    }

    #[test]
    fn sides_and_flat_maps() {
        let flat = Level {
            width: 13,
            height: 5,
            texels: vec![DVec3::Z; 65],
        };
        let levels = chain(flat);
        assert_eq!(
            levels.iter().map(|l| (l.width, l.height)).collect::<Vec<_>>(),
            [(13, 5), (6, 2), (3, 1), (1, 1)]
        );
        // Nine weights of few roundings each: below 32·2^-53.
        assert!(
            levels
                .iter()
                .flat_map(|l| &l.texels)
                .all(|n| (*n - DVec3::Z).length() < 4e-15)
        );
    }

    #[test]
    fn odd_sides_weigh_by_overlap() {
        // 5 texels over 2: (1, 1, ½) and (½, 1, 1), times 2/5.
        let ramp: Vec<DVec3> = (0..5).map(|i| DVec3::splat(f64::from(10 * (i + 1)))).collect();
        let next = row(&ramp).next();
        assert!((next.mean(0, 0).x - 18.0).abs() < 1e-13 && (next.mean(1, 0).x - 42.0).abs() < 1e-13);
    }

    #[test]
    fn shares_are_the_weights_of_the_average() {
        assert_eq!((shares(0, 1), shares(3, 8)), ([1.0, 0.0, 0.0], [0.5, 0.5, 0.0]));
        for (from, to) in [(3, 1), (5, 2), (7, 3), (64, 32), (101, 50)] {
            for index in 0..to {
                // A texel's weight is what an image that is 1 there and 0 elsewhere averages to.
                let weight = |texel: u32| {
                    let texels: Vec<DVec3> = (0..from)
                        .map(|i| DVec3::splat(f64::from(u8::from(i == texel))))
                        .collect();
                    row(&texels).next().mean(index, 0).x
                };
                let [a, b, c] = shares(index, from);
                assert!((a + b + c - 1.0).abs() < 1e-12, "{from} {index}");
                for (step, share) in [a, b, c].into_iter().enumerate() {
                    let texel = 2 * index + step as u32;
                    // Products of up to 101 with a few roundings of 2^-53.
                    assert!(
                        texel >= from || (share - weight(texel)).abs() < 1e-13,
                        "{from} {index} {step}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_length_says_how_far_normals_differ() {
        // ±θ about z: the mean is cos θ long and straight up.
        let (sin, cos) = 0.5_f64.sin_cos();
        let next = row(&[DVec3::new(sin, 0.0, cos), DVec3::new(-sin, 0.0, cos)]).next();
        assert!((next.length(0, 0) - cos).abs() < 1e-15);
        assert_eq!(naive(next.mean(0, 0)), DVec3::Z);
    }

    #[test]
    fn witness_normalising_forgets_the_roughness() {
        // Two surfaces, one rough and one smooth, end in the same normal.
        let rough = row(&[DVec3::new(0.8, 0.0, 0.6), DVec3::new(-0.8, 0.0, 0.6)])
            .next()
            .mean(0, 0);
        let smooth = row(&[DVec3::Z, DVec3::Z]).next().mean(0, 0);
        assert_eq!(naive(rough), naive(smooth));
        assert!(smooth.length() - rough.length() > 0.39);
    }

    #[test]
    fn opposite_normals_leave_straight_up() {
        let next = row(&[DVec3::X, -DVec3::X]).next();
        assert_eq!((next.length(0, 0), naive(next.mean(0, 0))), (0.0, DVec3::Z));
    }
}
