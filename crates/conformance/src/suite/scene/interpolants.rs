//! What the fragment stage was given, as it wrote it out itself: the points at which surfaces are judged.

use bossage_reference::surface as reference;
use bossage_runner::{Picture, is_unwritten};
use glam::{DVec2, DVec3, DVec4};

use crate::oracle::stages::Inputs;

/// The interpolants of one fragment; zeros where the shader has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interpolants {
    pub(super) position: [f32; 3],
    pub(super) normal: [f32; 3],
    pub(super) tangent: [f32; 4],
    pub(super) uv: [f32; 2],
}

impl Interpolants {
    /// Targets that the capture variant of the fragment stage writes: the colour, and then these.
    pub(super) const TARGETS: usize = 5;

    /// The interpolants of a pixel of the capture's targets.
    pub(super) fn captured(targets: &[Picture], at: usize) -> Self {
        let read = |target: usize| targets[target].pixels[at].map(|x| if is_unwritten(x) { 0.0 } else { x });
        let three = |[x, y, z, _]: [f32; 4]| [x, y, z];
        let [u, v, ..] = read(4);
        Self {
            position: three(read(1)),
            normal: three(read(2)),
            tangent: read(3),
            uv: [u, v],
        }
    }

    /// In the order of the targets, for reports.
    pub(super) fn numbers(&self) -> Vec<f32> {
        [self.position.as_slice(), &self.normal, &self.tangent, &self.uv].concat()
    }

    /// As the reference takes them.
    pub(super) fn exact(&self) -> reference::Interpolants {
        reference::Interpolants {
            position: DVec3::from_array(self.position.map(f64::from)),
            normal: DVec3::from_array(self.normal.map(f64::from)),
            tangent: DVec4::from_array(self.tangent.map(f64::from)),
            uv: DVec2::from_array(self.uv.map(f64::from)),
        }
    }

    /// As the evaluator takes them, by the names of the stage's inputs.
    pub(super) fn inputs(points: &[Self]) -> Inputs {
        let all = || points.iter();
        Inputs::new(points.len())
            .with("position", all().map(|at| at.position))
            .with("normal", all().map(|at| at.normal))
            .with("tangent", all().map(|at| at.tangent))
            .with("uv", all().map(|at| at.uv))
    }
}
