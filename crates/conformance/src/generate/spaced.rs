//! Evenly spaced inputs: the documented domain of each role, covered without gaps and without clusters.
//!
//! A lattice of rank one in as many dimensions as the fields have coordinates: point i has the coordinates i·g⁻ʲ mod 1, with g
//! the root above 1 of x^(d+1) = x + 1 (Roberts 2018, the sequence R_d). Any prefix is spread almost as evenly as a grid of as
//! many points, and along each coordinate alone it is. Scalars run through their range evenly, lengths through their powers of
//! two evenly, directions over the sphere by equal areas.

use bossage_shaders::{Field, Probe, Role};
use glam::{DMat3, DMat4, DQuat, DVec3};

use super::{Inputs, item};

/// Spaced items of one probe in an ordinary run.
pub const ORDINARY: usize = 2048;
/// Spaced items of one probe in a full run.
pub const FULL: usize = 65_536;

/// `count` items from item `first` on.
#[must_use]
pub fn generate(probe: &Probe, first: usize, count: usize) -> Inputs {
    let steps = lattice(probe.inputs.iter().map(coordinates).sum());
    let mut inputs = Inputs::of(probe);
    for index in first..first + count {
        let mut place = Place { index, steps: &steps };
        inputs.push(item(probe.inputs, |_, field| value(field, &mut place)));
    }
    inputs
}

/// The steps along each of `dimensions` coordinates.
fn lattice(dimensions: usize) -> Vec<f64> {
    let power = (dimensions + 1) as i32;
    // x^(d+1) − x − 1 has one root above 1; bisection to the last bit.
    let (mut low, mut high) = (1.0, 2.0);
    for _ in 0..60 {
        let middle: f64 = f64::midpoint(low, high);
        if middle.powi(power) > middle + 1.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    (1..power).map(|j| high.powi(-j)).collect()
}

/// The coordinates of one lattice point, taken one after the other.
struct Place<'a> {
    index: usize,
    steps: &'a [f64],
}

impl Place<'_> {
    /// The next coordinate, in [0, 1).
    fn next(&mut self) -> f64 {
        let (step, rest) = self.steps.split_first().unwrap_or((&0.0, &[]));
        self.steps = rest;
        (0.5 + self.index as f64 * step).fract()
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// 2 to a power between two.
    fn power(&mut self, low: f64, high: f64) -> f64 {
        self.between(low, high).exp2()
    }

    /// A whole number from `low` to `high`, both included.
    fn whole(&mut self, low: i32, high: i32) -> f64 {
        self.between(f64::from(low), f64::from(high) + 1.0).floor()
    }

    fn either(&mut self, first: f64, second: f64) -> f64 {
        if self.next() < 0.5 { first } else { second }
    }

    /// A unit vector (Archimedes: z is spaced evenly).
    fn unit(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = (std::f64::consts::TAU * self.next()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        DVec3::new(across * cos, across * sin, z)
    }

    fn rotation(&mut self) -> DMat3 {
        let axis = self.unit();
        DMat3::from_quat(DQuat::from_axis_angle(axis, std::f64::consts::TAU * self.next()))
    }
}

/// How many coordinates a field takes.
fn coordinates(field: &Field) -> usize {
    match field.role {
        Role::Unit => 2,
        Role::Vector | Role::MapNormal | Role::Tangent | Role::Position | Role::Edge => 3,
        Role::Matrix => 8,
        Role::Rigid => 6,
        _ => field.shape.floats(),
    }
}

fn value(field: &Field, place: &mut Place<'_>) -> Vec<f32> {
    let values: Vec<f64> = match field.role {
        Role::Unit => place.unit().to_array().to_vec(),
        Role::Vector => scaled(place, -126.0, 126.0),
        Role::Position | Role::Edge => scaled(place, -10.0, 10.0),
        Role::MapNormal => {
            let n = place.unit();
            (DVec3::new(n.x, n.y, n.z.abs()) * place.between(0.11, 1.5))
                .to_array()
                .to_vec()
        }
        Role::Tangent => {
            let t = place.unit();
            vec![t.x, t.y, t.z, place.either(-1.0, 1.0)]
        }
        Role::Matrix => matrix(place).to_cols_array().to_vec(),
        Role::Rigid => {
            let shift = place.unit();
            DMat4::from_mat3_translation(place.rotation(), shift * place.power(-4.0, 8.0))
                .to_cols_array()
                .to_vec()
        }
        Role::Layer => vec![
            place.between(0.0, 0.5),
            place.between(-0.5, 0.5),
            place.power(-3.0, 3.0),
        ],
        role => (0..field.shape.floats()).map(|_| scalar(role, place)).collect(),
    };
    values.into_iter().map(|x| x as f32).collect()
}

/// A vector in any direction, its length a power of two between two.
fn scaled(place: &mut Place<'_>, low: f64, high: f64) -> Vec<f64> {
    (place.unit() * place.power(low, high)).to_array().to_vec()
}

/// Two rotations round a stretch of 1/8 to 8 an axis, half of them mirrored.
fn matrix(place: &mut Place<'_>) -> DMat3 {
    let left = place.rotation();
    let stretch = DVec3::new(
        place.either(-1.0, 1.0) * place.power(-3.0, 3.0),
        place.power(-3.0, 3.0),
        place.power(-3.0, 3.0),
    );
    let (axis, angle) = (DVec3::new(0.48, 0.6, 0.64), std::f64::consts::TAU * place.next());
    left * DMat3::from_diagonal(stretch) * DMat3::from_axis_angle(axis, angle)
}

fn scalar(role: Role, place: &mut Place<'_>) -> f64 {
    match role {
        Role::Unorm | Role::Height => place.between(0.0, 1.0),
        Role::Snorm | Role::Cosine | Role::UvEdge => place.between(-1.0, 1.0),
        Role::Scale => place.between(-0.5, 0.5),
        Role::Slope => place.between(-64.0, 64.0),
        Role::Elevation => place.between(-0.1, 0.1),
        Role::Uv => place.between(-8.0, 8.0),
        Role::Colour => place.between(0.0, 4.0),
        Role::Gain => place.between(0.0, 64.0),
        Role::Exponent => place.power(-2.0, 12.0),
        Role::Weight => place.power(-3.0, 8.0),
        Role::Length => place.power(-126.0, 126.0),
        Role::Above => -place.power(-16.0, 0.0),
        Role::Sign => place.either(-1.0, 1.0),
        Role::Byte => place.whole(0, 255),
        Role::Index => place.whole(-70_000, 70_000),
        Role::Size => place.whole(1, 16_384),
        Role::Texel => place.whole(0, 16_383),
        Role::Codec => place.either(0.0, 1.0),
        Role::Face => place.whole(0, 5),
        Role::EdgeMode => place.whole(0, 2),
        Role::SnormOne => place.either(127.0, 32_767.0),
        Role::SnormCode => place.whole(-32_768, 32_767),
        Role::UnormOne => place.either(255.0, 65_535.0),
        Role::UnormCode => place.whole(0, 65_535),
        Role::Vector
        | Role::Unit
        | Role::MapNormal
        | Role::Tangent
        | Role::Matrix
        | Role::Rigid
        | Role::Position
        | Role::Edge
        | Role::Layer
        | Role::Output
        | Role::Direction => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use bossage_shaders::{PROBES, Probe, Role};

    use super::{coordinates, generate, lattice};

    #[test]
    fn the_lattice_has_its_constants() {
        // d = 1: the golden ratio; d = 2: the plastic number.
        assert!((lattice(1)[0] - 0.618_033_988_749_895).abs() < 1e-15);
        assert!((lattice(2)[0] - 0.754_877_666_246_693).abs() < 1e-15);
    }

    #[test]
    fn every_coordinate_is_covered_without_gaps() {
        let probe = Probe::find("elevation").unwrap();
        let inputs = generate(probe, 0, 1024);
        for (at, (low, high)) in [(0, (0.0, 1.0)), (1, (-0.5, 0.5))] {
            let mut values: Vec<f32> = inputs.items().map(|item| item[at]).collect();
            values.sort_by(f32::total_cmp);
            let width = (high - low) / 1024.0;
            // n random points leave a largest gap of ln(n)/n on average; spaced ones stay below that.
            let widest = 1024f32.ln() * width;
            let gaps = values.windows(2).map(|pair| pair[1] - pair[0]);
            assert!(gaps.fold(0.0, f32::max) < widest, "coordinate {at}");
            assert!(
                values[0] < low + widest && values[1023] > high - widest,
                "coordinate {at}"
            );
        }
    }

    #[test]
    fn a_long_run_goes_on_where_a_short_one_ends() {
        let probe = Probe::find("blinn_phong").unwrap();
        let all = generate(probe, 0, 32).values;
        assert_eq!(
            all,
            [generate(probe, 0, 16).values, generate(probe, 16, 16).values].concat()
        );
    }

    #[test]
    fn every_field_takes_its_coordinates_and_gives_its_floats() {
        for probe in PROBES {
            assert!(
                probe
                    .inputs
                    .iter()
                    .all(|field| coordinates(field) > 0 && field.role != Role::Output)
            );
            let inputs = generate(probe, 0, 64);
            assert_eq!(inputs.len(), 64, "{}", probe.id);
            assert!(inputs.values.iter().all(|x| x.is_finite()), "{}", probe.id);
        }
    }
}
