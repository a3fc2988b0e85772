//! The fragment stage over quads: inputs interpolated at each pixel's centre, helper invocations included.

use bossage_bounds::{F32, Scalar, Slot, StageInputs, StageOutputs, Truth};
use bossage_runner::{Draw, Error};
use bossage_translate::manifest::{Kind, Varying};
use rayon::prelude::*;

use crate::select::NAME;
use crate::stages::Stages;
use crate::triangle::{Triangle, Weights};
use crate::vertex::{Values, Vertices};

/// Four pixels of one triangle: (0,0), (1,0), (0,1), (1,1) from the upper left one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quad {
    /// The upper left pixel; both coordinates are even.
    pub(crate) at: [u32; 2],
    /// Bit x + 2·y of each pixel that is to be drawn; the others are helpers.
    pub(crate) mask: u8,
    /// Which of the draw's triangles.
    pub(crate) triangle: u32,
}

impl Quad {
    /// The pixel of a lane.
    pub(crate) fn pixel(&self, lane: u32) -> [u32; 2] {
        [self.at[0] + lane % 2, self.at[1] + lane / 2]
    }

    /// The lanes that are to be drawn.
    pub(crate) fn lanes(self) -> impl Iterator<Item = u32> {
        (0..4).filter(move |lane| self.mask & (1 << lane) != 0)
    }
}

/// How a value of the corners becomes one of a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Interpolation {
    Perspective,
    Linear,
    Flat,
}

/// An input of the fragment stage.
enum Input<'a> {
    Location {
        location: u32,
        interpolation: Interpolation,
        values: &'a Values,
    },
    Position,
    FrontFacing,
    PrimitiveIndex,
}

/// The fragment stage of a draw, ready to run.
pub(crate) struct Shading<'a> {
    pub(crate) size: [u32; 2],
    pub(crate) triangles: &'a [Triangle],
    inputs: Vec<Input<'a>>,
}

impl<'a> Shading<'a> {
    /// Checks that the vertex stage gives what the fragment stage takes.
    pub(crate) fn new(
        job: &str,
        draw: &Draw<'_>,
        size: [u32; 2],
        triangles: &'a [Triangle],
        vertices: &'a Vertices,
    ) -> Result<Self, Error> {
        let entry = draw.fragment.entry;
        if let Some(buffer) = entry.bindings.iter().find(|b| b.kind == Kind::StorageBuffer) {
            let what = format!("storage buffers that a fragment stage writes (`{}`)", buffer.name);
            return Err(Error::unsupported(job, NAME, what));
        }
        let mut inputs = Vec::new();
        for varying in &entry.inputs {
            inputs.extend(input(job, draw, vertices, varying)?);
        }
        Ok(Self {
            size,
            triangles,
            inputs,
        })
    }

    /// The weights at the centre of a quad's pixel.
    pub(crate) fn weights(&self, quad: &Quad, lane: u32) -> Weights {
        let [x, y] = quad.pixel(lane).map(|pixel| f64::from(pixel) + 0.5);
        let [width, height] = self.size.map(f64::from);
        let point = [2.0 * x / width - 1.0, 1.0 - 2.0 * y / height];
        self.triangles[quad.triangle as usize].weights(point)
    }

    /// Runs the fragment stage over quads.
    pub(crate) fn run(&self, stages: &mut dyn Stages, quads: &[Quad]) -> Result<Shaded, Error> {
        let weights: Vec<Weights> = (0..4 * quads.len())
            .into_par_iter()
            .map(|at| self.weights(&quads[at / 4], (at % 4) as u32))
            .collect();
        let mut inputs = StageInputs::new(weights.len());
        for input in &self.inputs {
            let (slot, components) = input.slot();
            let column = (0..weights.len())
                .into_par_iter()
                .flat_map_iter(|at| {
                    let quad = &quads[at / 4];
                    let triangle = &self.triangles[quad.triangle as usize];
                    let pixel = quad.pixel((at % 4) as u32);
                    (0..components).map(move |k| (triangle, pixel, at, k))
                })
                .map(|(triangle, pixel, at, k)| input.value(triangle, pixel, &weights[at], k))
                .collect();
            inputs = inputs.set(slot, components, column);
        }
        Ok(Shaded(stages.fragments(&inputs)?))
    }
}

/// What a varying of the fragment stage is made of; `None` for what the evaluator fills in by itself.
fn input<'a>(
    job: &str,
    draw: &Draw<'_>,
    vertices: &'a Vertices,
    varying: &Varying,
) -> Result<Option<Input<'a>>, Error> {
    let Some(location) = varying.location else {
        return Ok(match varying.builtin.as_deref() {
            Some("position") => Some(Input::Position),
            Some("front_facing") => Some(Input::FrontFacing),
            Some("primitive_index") => Some(Input::PrimitiveIndex),
            Some(_) | None => None,
        });
    };
    let (vertex, fragment) = (draw.vertex.entry, draw.fragment.entry);
    let wrong = |problem: String| Err(Error::misfit(fragment, &varying.name, problem));
    let given = vertex
        .outputs
        .iter()
        .find(|output| output.location == Some(location));
    let (Some(given), Some(values)) = (given, vertices.location(location)) else {
        return wrong(format!("the vertex stage has no output at @location({location})"));
    };
    if given.ty != varying.ty {
        return wrong(format!(
            "it is {}, but the vertex stage returns {}",
            varying.ty, given.ty
        ));
    }
    let is_float = varying.ty.contains('f');
    let interpolation = match varying.interpolation.as_deref() {
        Some("flat") => Interpolation::Flat,
        Some("linear") => Interpolation::Linear,
        Some("perspective") | None if is_float => Interpolation::Perspective,
        None => Interpolation::Flat,
        Some(other) => {
            return Err(Error::unsupported(
                job,
                NAME,
                format!("the interpolation `{other}`"),
            ));
        }
    };
    Ok(Some(Input::Location {
        location,
        interpolation,
        values,
    }))
}

impl Input<'_> {
    fn slot(&self) -> (Slot, usize) {
        match self {
            Self::Location { location, values, .. } => (Slot::Location(*location, 0), values.components()),
            Self::Position => (Slot::Position, 4),
            Self::FrontFacing => (Slot::FrontFacing, 1),
            Self::PrimitiveIndex => (Slot::PrimitiveIndex, 1),
        }
    }

    /// One scalar of one fragment.
    fn value(
        &self,
        triangle: &Triangle,
        pixel: [u32; 2],
        weights: &Weights,
        component: usize,
    ) -> Scalar<F32> {
        match self {
            Self::Location {
                interpolation,
                values,
                ..
            } => {
                let corner = |corner: u32| values.at(corner as usize, component);
                let mixed = |weights: [f64; 3]| {
                    let floats = triangle.corners.map(|c| corner(c).float().unwrap_or(f64::NAN));
                    Scalar::Float(Weights::mix(weights, floats))
                };
                match interpolation {
                    Interpolation::Perspective => mixed(weights.perspective),
                    Interpolation::Linear => mixed(weights.linear),
                    Interpolation::Flat => corner(triangle.corners[0]),
                }
            }
            Self::Position => Scalar::Float(match component {
                0 | 1 => f64::from(pixel[component]) + 0.5,
                2 => f64::from(weights.depth()),
                _ => f64::from(weights.inverse_w as f32),
            }),
            Self::FrontFacing => Scalar::Bool(Truth::from_bool(triangle.is_front)),
            Self::PrimitiveIndex => {
                let number = i128::from(triangle.number);
                Scalar::Int(number, number)
            }
        }
    }
}

/// What fragments became.
pub(crate) struct Shaded(StageOutputs<F32>);

impl Shaded {
    /// Whether a fragment is drawn: not discarded, and its sample is in the mask that the shader returns.
    pub(crate) fn is_kept(&self, fragment: usize) -> bool {
        let masked = self.0.columns.get(&Slot::SampleMask).is_some_and(|column| {
            let mask = column.of(fragment).first().and_then(Scalar::int);
            mask.is_some_and(|mask| mask & 1 == 0)
        });
        !masked && self.0.discarded[fragment] == Truth::False
    }

    /// The depth that the shader returns, where it does.
    pub(crate) fn depth(&self, fragment: usize) -> Option<f32> {
        let column = self.0.columns.get(&Slot::FragDepth)?;
        let depth = column.of(fragment).first()?.float()?;
        Some(depth.clamp(0.0, 1.0) as f32)
    }

    /// The colour, or the integers, at a location.
    pub(crate) fn colour(&self, location: u32, fragment: usize) -> Option<[Scalar<F32>; 4]> {
        let column = self.0.columns.get(&Slot::Location(location, 0))?;
        column.of(fragment).first_chunk::<4>().copied()
    }
}
