use glam::DVec3;

use super::{Depth, Map};
use crate::cube::Seams;
use crate::sphere::angle_deg;

#[test]
fn print_errors() {
    for depth in [Depth::Eight, Depth::Sixteen, Depth::Exact] {
        for size in [16, 32, 64, 128, 256] {
            for seams in [Seams::Face, Seams::Seamless] {
                let e = Map { seams, ..Map::new(size, depth) }.errors(200_000);
                eprintln!("{depth:?} {size} {seams:?} {e:?}");
            }
        }
    }
    let _ = angle_deg(DVec3::X, DVec3::Y);
}
