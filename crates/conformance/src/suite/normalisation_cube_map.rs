//! Normalisation cube maps on the adapter: what directions become, component by component and as angles, by size, depth and
//! filter.
//!
//! Two filters. `face` filters four texels of one face in the shader, clamped at its border, as the third article's hardware
//! did: the figures that are known for 8 bits are its. `sampler` is the adapter's own linear filter, which goes on across the
//! edges of faces; there the clamp of half a texel is gone, and with it the larger part of the largest error.
//!
//! Directions are spread evenly over the cube's faces, of lengths 2⁻¹⁰ to 2¹⁰. Every component must lie in the acceptance interval of
//! the kernel's own IR, in which the sampler's liberties are, and so must the reference's; the angle errors must be those of the f64 filter within
//! `ANGLE_SHARE`, for `face` at 8 bits those that are stated too.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use bossage_assets::Texels as Stored;
use bossage_assets::normalisation_cube_map::{Depth, NormalisationCubeMap};
use bossage_reference::cube::{Seams, sample};
use bossage_reference::normalisation_cube_map::{Depth as TruthDepth, Map, faces_evenly};
use bossage_reference::sphere::angle_deg;
use bossage_runner::{AddressMode, BufferData, Filter, Resources, SamplerSettings, TexelFormat, TextureData};
use bossage_shaders::Kernel;
use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::kernel_case::KernelCase;
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::Expected;
use crate::deviation::{self, Judged};
use crate::dispatch::{Dispatch, Kept, float_bounds};
use crate::module::Module;
use crate::route::Prepared;
use crate::tolerance::UNDECIDED_LIMIT;
use crate::verdict::Verdict;

/// Directions a face where figures are stated. The largest angle found grows with their number: with this one it is what it was
/// when it was stated.
const STATED_DIRECTIONS: u32 = 20_000;
/// Directions a face otherwise: both filters are asked with the same ones.
const DIRECTIONS: u32 = 4_000;

/// The share by which an angle error may differ from what it should be.
const ANGLE_SHARE: f64 = 0.1;

/// Angle errors at 8 bits, filtered within faces: texels a side, root mean square and largest, in degrees.
const STATED_DEG: [(u32, f64, f64); 4] = [
    (16, 0.39, 2.09),
    (32, 0.18, 1.10),
    (64, 0.131, 0.72),
    (256, 0.129, 0.37),
];

/// What the kernels write.
const COLOURS: &str = "colours";

/// What known deviations of the adapter's own filter are listed under.
const SUBJECT: &str = "normalisation_cube_map/lookup";

/// One map with one filter.
struct CubeCase {
    id: CaseId,
    size: u32,
    depth: Depth,
    kernel: Kernel,
    directions: OnceLock<Vec<[f32; 4]>>,
    expected: Kept<Vec<[Expected; 4]>>,
}

/// Every stated size, at 8 and 16 bits, with both filters.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let kernels = [
        Kernel::NormalisationCubeMapLookup,
        Kernel::NormalisationCubeMapLookupInFace,
    ];
    let depths = [Depth::Eight, Depth::Sixteen];
    let all = STATED_DEG
        .into_iter()
        .flat_map(move |(size, ..)| depths.map(|depth| (size, depth)))
        .flat_map(move |(size, depth)| kernels.map(|kernel| (size, depth, kernel)));
    all.map(|(size, depth, kernel)| Box::new(CubeCase::new(size, depth, kernel)) as Box<dyn Case>)
}

/// Angle errors, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Angles {
    rms: f64,
    max: f64,
}

impl Angles {
    fn of(errors: &[f64]) -> Self {
        let squares: f64 = errors.iter().map(|error| error * error).sum();
        Self {
            rms: (squares / errors.len().max(1) as f64).sqrt(),
            max: errors.iter().copied().fold(0.0, f64::max),
        }
    }

    /// Whether both figures are these within [`ANGLE_SHARE`].
    fn are(self, rms: f64, max: f64) -> bool {
        let near = |found: f64, wanted: f64| (found - wanted).abs() <= ANGLE_SHARE * wanted;
        near(self.rms, rms) && near(self.max, max)
    }
}

impl CubeCase {
    fn new(size: u32, depth: Depth, kernel: Kernel) -> Self {
        let filter = match kernel {
            Kernel::NormalisationCubeMapLookup => "sampler",
            _ => "face",
        };
        let id = CaseId::new("normalisation_cube_map", None, "lookup")
            .with("bits", bits(depth))
            .with("filter", filter)
            .with("size", format!("{size:03}"));
        Self {
            id,
            size,
            depth,
            kernel,
            directions: OnceLock::new(),
            expected: Kept::default(),
        }
    }

    /// The root mean square and the largest error that are stated for this case.
    fn stated(&self) -> Option<(f64, f64)> {
        let of_size = STATED_DEG.into_iter().find(|(size, ..)| *size == self.size);
        let (_, rms, max) = of_size.filter(|_| self.is_in_face() && self.depth == Depth::Eight)?;
        Some((rms, max))
    }

    fn is_in_face(&self) -> bool {
        self.kernel == Kernel::NormalisationCubeMapLookupInFace
    }

    fn map(&self) -> Map {
        Map {
            size: self.size,
            depth: match self.depth {
                Depth::Eight => TruthDepth::Eight,
                Depth::Sixteen => TruthDepth::Sixteen,
            },
            seams: if self.is_in_face() {
                Seams::Face
            } else {
                Seams::Seamless
            },
        }
    }

    /// The directions, as floats: truth is taken of these. Lengths are powers of two, so they turn nothing.
    fn directions(&self) -> &[[f32; 4]] {
        self.directions.get_or_init(|| {
            let of = |(index, direction): (usize, DVec3)| {
                let length = 2f64.powi(index as i32 % 21 - 10);
                (length * direction).extend(0.0).as_vec4().to_array()
            };
            let count = self.stated().map_or(DIRECTIONS, |_| STATED_DIRECTIONS);
            faces_evenly(count).enumerate().map(of).collect()
        })
    }

    /// A direction and the size, as the report and known deviations have them.
    fn item(&self, direction: &[f32; 4]) -> [f32; 4] {
        let [x, y, z, _] = *direction;
        [x, y, z, self.size as f32]
    }

    fn texture(&self) -> Result<TextureData, String> {
        let map =
            NormalisationCubeMap::generate(self.size, self.depth).map_err(|error| with_causes(&error))?;
        let faces = map.faces.each_ref().map(|face| match face {
            Stored::Unorm8(codes) => bytemuck::cast_slice::<_, u8>(codes),
            Stored::Unorm16(codes) => bytemuck::cast_slice(codes),
            Stored::Float32(values) => bytemuck::cast_slice(values),
        });
        let format = match self.depth {
            Depth::Eight => TexelFormat::Rgba8Unorm,
            Depth::Sixteen => TexelFormat::Rgba16Unorm,
        };
        TextureData::cube("normalisation_map", self.size, format, &faces).map_err(|error| with_causes(&error))
    }

    /// What is dispatched, with that map.
    fn dispatch<'a>(&'a self, name: &'a str, texture: &'a TextureData) -> Dispatch<'a> {
        let directions = self.directions();
        let filter = if self.is_in_face() {
            Filter::Nearest
        } else {
            Filter::Linear
        };
        let sampler = SamplerSettings {
            address: AddressMode::Clamp,
            filter,
            mip_filter: Filter::Nearest,
            anisotropy: 1,
        };
        let mut resources = Resources::default();
        resources.textures.insert("normalisation_map".to_owned(), texture);
        resources.samplers.insert("surface_sampler".to_owned(), sampler);
        let inputs = BufferData::Bytes(bytemuck::cast_slice(directions));
        resources.buffers.insert("directions".to_owned(), inputs);
        let outputs = BufferData::Output(16 * directions.len());
        resources.buffers.insert(COLOURS.to_owned(), outputs);
        Dispatch {
            name,
            kernel: self.kernel,
            resources,
            // One more than there are directions: nothing may come of it.
            invocations: [directions.len() as u32 + 1, 1, 1],
        }
    }

    /// Both oracles of each direction: the reference's filter, and the interval of the kernel's own IR.
    fn expected(&self, module: &Prepared, dispatch: &Dispatch<'_>) -> Result<Vec<[Expected; 4]>, String> {
        let mut accepted = dispatch.accepted(module, &BTreeMap::new())?;
        let colours = accepted.remove(COLOURS).ok_or("the kernel leaves no colours")?;
        let bounds = float_bounds(&colours);
        let texels = Texels::new(self.map());
        let of = |(direction, bounds): (&[f32; 4], &[Bound; 4])| {
            let truth = texels.sample(vector(direction)).to_array();
            std::array::from_fn(|channel| Expected {
                truth: truth[channel],
                bound: bounds[channel],
            })
        };
        let each = self.directions().par_iter().zip(bounds.as_chunks::<4>().0);
        Ok(each.map(of).collect())
    }

    /// Adds what the angle errors are to the report, and fails where they are not what they should be.
    fn with_angles(&self, outcome: Outcome, got: Angles, truth: Angles) -> Outcome {
        let said = |angles: Angles| format!("rms {:.4}°, largest {:.3}°", angles.rms, angles.max);
        let mut note = format!("angle errors: {}; the f64 filter has {}", said(got), said(truth));
        let mut fails = !got.are(truth.rms, truth.max);
        if let Some((rms, max)) = self.stated() {
            note = format!("{note}; stated: rms {rms}°, largest {max}°");
            fails |= !got.are(rms, max);
        } else if !self.is_in_face() {
            note =
                format!("{note}; less than within a face, since a sampler goes on across the edges of faces");
        }
        if outcome.verdict != Verdict::Pass {
            return outcome;
        }
        Outcome {
            verdict: if fails { Verdict::Fail } else { Verdict::Pass },
            reason: Some(note),
            ..outcome
        }
    }
}

fn bits(depth: Depth) -> &'static str {
    match depth {
        Depth::Eight => "08",
        Depth::Sixteen => "16",
    }
}

fn vector(v: &[f32; 4]) -> DVec3 {
    DVec4::from_array(v.map(f64::from)).truncate()
}

/// The reference's texels, computed once.
struct Texels {
    map: Map,
    colours: Vec<DVec4>,
}

impl Texels {
    fn new(map: Map) -> Self {
        let side = map.size;
        let of = |at: u32| {
            let (face, rest) = (at / (side * side), at % (side * side));
            map.texel(face as usize, rest % side, rest / side).extend(1.0)
        };
        let colours = (0..6 * side * side).into_par_iter().map(of).collect();
        Self { map, colours }
    }

    fn texel(&self, face: usize, x: u32, y: u32) -> DVec4 {
        self.colours[(face as u32 * self.map.size * self.map.size + y * self.map.size + x) as usize]
    }

    fn sample(&self, direction: DVec3) -> DVec4 {
        sample(direction, self.map.size, self.map.seams, |face, x, y| {
            self.texel(face, x, y)
        })
    }
}

impl KernelCase for CubeCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec![
            "reference f64",
            "accuracy rules over the shader's IR",
            "stated angle errors",
        ]
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![self.kernel]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let (name, texture) = (self.id.to_string(), self.texture()?);
        let dispatch = self.dispatch(&name, &texture);
        let colours = dispatch.run(bench)?.floats(COLOURS);
        let module = bench.module(&Module::Kernel(self.kernel))?;
        let expected = self
            .expected
            .for_text(module.text(), || self.expected(&module, &dispatch))?;
        let directions = self.directions();
        let found = colours.as_chunks::<4>().0;
        if found.len() != directions.len() {
            return Err(format!("{} colours of {}", found.len(), directions.len()));
        }
        let known = deviation::of(SUBJECT, bench.route, bench.device.info()).filter(|_| !self.is_in_face());
        let mut judged = Judged::new(known);
        for ((direction, got), expected) in directions.iter().zip(found).zip(expected.iter()) {
            judged.item(&self.item(direction), got, expected);
        }
        let errors = |colour: &dyn Fn(usize) -> DVec3| -> Angles {
            let of = |at: usize| angle_deg(2.0 * colour(at) - 1.0, vector(&directions[at]));
            Angles::of(&(0..directions.len()).map(of).collect::<Vec<_>>())
        };
        let got = errors(&|at| vector(&found[at]));
        let truth = errors(&|at| DVec3::from_array([0, 1, 2].map(|channel| expected[at][channel].truth)));
        let outcome = judged.outcome(directions.len(), UNDECIDED_LIMIT);
        Ok(self.with_angles(outcome, got, truth))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_witness_of_a_known_deviation_is_among_the_directions() {
        for known in deviation::ALL.iter().filter(|known| known.subject == SUBJECT) {
            let case = CubeCase::new(16, Depth::Eight, Kernel::NormalisationCubeMapLookup);
            let mut items = case.directions().iter().map(|direction| case.item(direction));
            assert!(
                items.any(|item| item[..] == *known.witness),
                "{:?}",
                known.witness
            );
        }
    }

    #[test]
    fn figures_off_by_more_than_a_tenth_are_not_the_same() {
        let angles = Angles::of(&[3.0, 4.0, 0.0, 0.0]);
        assert_eq!(angles, Angles { rms: 2.5, max: 4.0 });
        assert!(angles.are(2.6, 3.8) && !angles.are(2.2, 4.0) && !angles.are(2.5, 4.5));
    }
}
