//! Renders one object, pass by pass, and gathers what each of its pixels got and should have got, at which interpolants.

use std::sync::Arc;

use bossage_runner::{Filter, is_unwritten};
use bossage_scene::Draw;
use bossage_shaders::{Alpha, FeatureSet, Stage};

use super::expected::{Expectations, Fragment, Points};
use super::interpolants::Interpolants;
use super::rig::{self, Rig};
use crate::bench::Bench;
use crate::module::Module;

/// The longer side of the rendered picture, in pixels: some thousands of pixels an object, from every angle that it has.
const LONGER_SIDE: u32 = 96;

/// One pixel of one object.
#[derive(Clone, Debug)]
pub(super) struct Pixel {
    /// x and y, and then the interpolants: what a report shows as the input.
    pub(super) place: Vec<f32>,
    /// The colour; `None` where the shader under test wrote nothing.
    pub(super) got: Option<[f32; 4]>,
    /// The depth that is kept there, where the shader writes it.
    pub(super) depth: Option<f32>,
    /// What it should be.
    pub(super) expected: Fragment,
}

/// One pass of an object as it was drawn.
pub(super) struct Drawn {
    /// The covered pixels.
    pub(super) pixels: Vec<Pixel>,
    /// Their interpolants.
    pub(super) points: Vec<Interpolants>,
}

/// Where one of a case's objects is drawn, and what is kept about it.
pub(super) struct Object<'a> {
    pub(super) bench: &'a Bench<'a>,
    /// Its place among the case's draws.
    pub(super) number: usize,
    /// The size of the scene's picture: rendered no larger than [`LONGER_SIDE`], with the same aspect.
    pub(super) size: [u32; 2],
    /// Between texels.
    pub(super) filter: Filter,
    pub(super) expectations: &'a Expectations,
}

impl Object<'_> {
    /// Renders one pass of the object with the draw's shaders, and once more with the capture variant.
    pub(super) fn render(&self, draw: &Draw, stage: Stage) -> Result<Drawn, String> {
        let size = scaled(self.size);
        let rig = Rig::new(self.bench, draw, &draw.features, &[stage])?.filtered(self.filter);
        let (picture, depth) = rig.floats_and_depth(self.bench, stage, size)?;
        let capture = Rig::new(
            self.bench,
            draw,
            &uncut(&draw.features),
            &[Stage::FragmentCapture],
        )?;
        let captured = capture.floats(self.bench, Stage::FragmentCapture, size, Interpolants::TARGETS)?;
        let covered: Vec<usize> = (0_usize..)
            .zip(captured[0].covered())
            .filter_map(|(at, covered)| covered.then_some(at))
            .collect();
        let point = |at: &usize| Interpolants::captured(&captured, *at);
        let points: Vec<Interpolants> = covered.iter().map(point).collect();
        let expected = self
            .expectations
            .of((self.number, Points::Own), &rig, stage, &points)?;
        let each = covered.into_iter().zip(&points).zip(expected.iter());
        let pixels = each
            .map(|((at, point), expected)| Pixel {
                depth: depth.as_ref().map(|depth| depth[at]),
                ..pixel(at, size[0], point, picture.pixels[at], *expected)
            })
            .collect();
        Ok(Drawn { pixels, points })
    }

    /// What a draw's shaders should make of points that another draw of the same object has captured.
    pub(super) fn expected_at(
        &self,
        draw: &Draw,
        stage: Stage,
        points: &[Interpolants],
    ) -> Result<Arc<Vec<Fragment>>, String> {
        let rig = Rig::new(self.bench, draw, &draw.features, &[stage])?.filtered(self.filter);
        self.expectations
            .of((self.number, Points::Others), &rig, stage, points)
    }
}

fn pixel(at: usize, width: u32, point: &Interpolants, got: [f32; 4], expected: Fragment) -> Pixel {
    let (x, y) = (at as u32 % width, at as u32 / width);
    Pixel {
        place: [&[x as f32, y as f32], point.numbers().as_slice()].concat(),
        got: (!got.iter().copied().all(is_unwritten)).then_some(got),
        depth: None,
        expected,
    }
}

/// The fragment stages of an object's passes.
pub(super) fn passes(draw: &Draw) -> Vec<Stage> {
    draw.passes().into_iter().map(|pass| pass.fragment).collect()
}

/// Without the alpha test, so that pixels that should be cut out are known too.
pub(super) fn uncut(features: &FeatureSet) -> FeatureSet {
    FeatureSet {
        alpha: Alpha::Opaque,
        ..*features
    }
}

/// What [`Object::render`] asks the bench for.
pub(super) fn modules(draw: &Draw) -> Vec<Module> {
    let module = |features: FeatureSet| move |stage: Stage| Module::Surface { features, stage };
    let stages = passes(draw);
    let evaluated = rig::evaluated(&draw.features, &stages);
    let captures = [Stage::Vertex, Stage::FragmentCapture].into_iter();
    let pictures = stages.into_iter().chain(evaluated).chain([Stage::Vertex]);
    pictures
        .map(module(draw.features))
        .chain(captures.map(module(uncut(&draw.features))))
        .collect()
}

/// The size with the same aspect whose longer side is at most [`LONGER_SIDE`].
fn scaled([width, height]: [u32; 2]) -> [u32; 2] {
    let longer = width.max(height).max(1);
    let most = longer.min(LONGER_SIDE);
    [width, height].map(|side| (side * most).div_ceil(longer).max(1))
}

#[cfg(test)]
mod tests {
    use super::scaled;

    #[test]
    fn scaling_keeps_the_aspect() {
        assert_eq!(scaled([800, 600]), [96, 72]);
        assert_eq!(scaled([600, 1200]), [48, 96]);
        assert_eq!(scaled([1, 10_000]), [1, 96]);
        assert_eq!(scaled([40, 30]), [40, 30]);
    }
}
