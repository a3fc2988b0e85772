//! What is run of one entry point: its code, its inputs from their ranges, and what it binds at each.

use bossage_bounds::ranges::{Declared, Inputs, Point, Seed, Style, TextureInput, UNWRITTEN, scalar_names};
use bossage_bounds::{
    Bindings, BufferUse, Dimension, Error as BoundsError, F32, Limits, Program, Scalar, TexelFormat,
};
use bossage_runner::slot;
use bossage_translate::manifest::Kind;
use bossage_translate::{Contents, EmitOptions, Language, Shader, Stage, Target, emit, manifest};

use super::Options;
use super::request::{Buffer, Job, Request, Texels};
use crate::case::with_causes;
use crate::case_id::CaseId;
use crate::compare::NamedInput;
use crate::error::Error;
use crate::route::Route;

/// The most invocations of a dispatch.
const MAX_INVOCATIONS: u64 = 1 << 20;

/// One entry point.
#[derive(Debug)]
pub struct Plan {
    /// The shader's name.
    pub shader: String,
    /// The entry point's name.
    pub entry: String,
    seed: u64,
    inputs: usize,
    /// Ready to run, or why it cannot be.
    pub(crate) ready: Result<Ready, String>,
}

/// An entry point that can be run.
#[derive(Debug)]
pub(crate) struct Ready {
    /// Its own IR, as it was read.
    pub(crate) program: Program,
    pub(crate) inputs: Inputs,
    pub(crate) points: Vec<Point>,
    pub(crate) workgroups: [u32; 3],
    pub(crate) limits: Limits,
    /// Writable buffers, with the names of their scalars.
    pub(crate) outputs: Vec<(BufferUse, Vec<String>)>,
    wgsl: String,
    /// The entry point's name in `wgsl`.
    entry: String,
}

impl Plan {
    /// The name of a case of this entry point.
    #[must_use]
    pub fn id(&self, generator: &str) -> CaseId {
        CaseId::new(&self.shader, None, generator)
            .with("entry", &self.entry)
            .with("n", self.inputs)
            .with("seed", self.seed)
    }
}

/// The entry points that are asked for. One that cannot be run is planned with the reason, if another can be.
pub(crate) fn plans(
    shader: &Shader,
    declared: Option<&Declared>,
    options: &Options,
) -> Result<Vec<Plan>, Error> {
    let all: Vec<(String, Stage)> = shader
        .entry_points()
        .map(|(name, stage)| (name.to_owned(), stage))
        .collect();
    let asked = |(name, _): &&(String, Stage)| options.entry.as_ref().is_none_or(|wanted| wanted == name);
    let chosen: Vec<&(String, Stage)> = all.iter().filter(asked).collect();
    let none = |problem: &str| Error::NoEntryPoint {
        shader: shader.name().to_owned(),
        problem: problem.to_owned(),
        known: all
            .iter()
            .map(|(name, stage)| format!("{name} ({stage})"))
            .collect(),
    };
    if let (Some(wanted), true) = (&options.entry, chosen.is_empty()) {
        return Err(none(&format!("has no entry point `{wanted}`")));
    }
    if !chosen.iter().any(|(_, stage)| *stage == Stage::Compute) {
        return Err(none(
            "has no entry point that can be run: only compute shaders are",
        ));
    }
    let mut known = Vec::new();
    let mut plans = Vec::new();
    for (entry, stage) in &all {
        let inputs = inputs(shader, entry, declared)?;
        if let Ok(inputs) = &inputs {
            known.push(inputs.clone());
        }
        if chosen.iter().any(|(name, _)| name == entry) {
            let ready = inputs.and_then(|inputs| Ready::new(shader, entry, *stage, inputs, options));
            if let Ok(ready) = &ready {
                ready.check_size(shader.name())?;
            }
            plans.push(Plan {
                shader: stem(shader.name()),
                entry: entry.clone(),
                seed: options.seed,
                inputs: options.inputs,
                ready,
            });
        }
    }
    if let Some(declared) = declared {
        declared
            .check(&known)
            .map_err(|report| Error::Ranges(BoundsError::Ranges(report)))?;
    }
    Ok(plans)
}

/// The inputs of an entry point; ranges that do not fit are the caller's mistake, what the evaluator leaves out is a reason.
fn inputs(
    shader: &Shader,
    entry: &str,
    declared: Option<&Declared>,
) -> Result<Result<Inputs, String>, Error> {
    let Some((module, info)) = shader.module(entry) else {
        return Ok(Err(format!("`{entry}` has no module of its own")));
    };
    match Inputs::new(module, info, entry, declared) {
        Ok(inputs) => Ok(Ok(inputs)),
        Err(error @ BoundsError::Ranges(_)) => Err(Error::Ranges(error)),
        Err(error) => Ok(Err(format!(
            "inputs of `{entry}` cannot be chosen: {}",
            with_causes(&error)
        ))),
    }
}

/// The last part of a path, without its extension: what cases are called.
fn stem(name: &str) -> String {
    let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
    file.split('.').next().unwrap_or(file).to_owned()
}

impl Ready {
    fn new(
        shader: &Shader,
        entry: &str,
        stage: Stage,
        inputs: Inputs,
        options: &Options,
    ) -> Result<Self, String> {
        if stage != Stage::Compute {
            return Err(format!("it is a {stage} shader; only compute shaders are run"));
        }
        bindable(shader, entry, &inputs)?;
        let (module, info) = shader
            .module(entry)
            .ok_or_else(|| format!("no entry point `{entry}`"))?;
        let program = Program::new(module, info, entry).map_err(|error| {
            format!(
                "no interval can be derived for `{entry}`: {}",
                with_causes(&error)
            )
        })?;
        let mut seed = Seed::new(options.seed);
        // Half of the inputs at the edges of their ranges, half of them anywhere.
        let style = |k: usize| {
            if k.is_multiple_of(2) {
                Style::Edge
            } else {
                Style::Random
            }
        };
        let points: Vec<Point> = (0..options.inputs)
            .map(|k| inputs.sample(&mut seed, style(k)))
            .collect();
        let (wgsl, entry) = code(shader, entry)?;
        let elements = inputs.longest_array();
        let written = program.buffers().into_iter().filter(|buffer| buffer.writable);
        let outputs = written.map(|buffer| {
            let names = scalar_names(module, buffer.binding, inputs.elements(buffer.binding))
                .map_err(|error| with_causes(&error))?;
            Ok((buffer, names))
        });
        let outputs: Vec<_> = outputs.collect::<Result<_, String>>()?;
        if outputs.is_empty() {
            return Err("it writes no buffer, so there is nothing to compare".to_owned());
        }
        let declared = inputs.workgroups;
        let derived = || derived(declared, elements, program.workgroup_size());
        Ok(Self {
            workgroups: options.workgroups.unwrap_or_else(derived),
            limits: Limits {
                operations: options.operations,
                ..Limits::default()
            },
            program,
            points,
            outputs,
            inputs,
            wgsl,
            entry,
        })
    }

    /// Every invocation is evaluated several times over, for every input.
    fn check_size(&self, shader: &str) -> Result<(), Error> {
        let product = |list: [u32; 3]| list.iter().map(|n| u64::from(*n)).product::<u64>();
        let invocations = product(self.workgroups) * product(self.program.workgroup_size());
        if invocations <= MAX_INVOCATIONS {
            return Ok(());
        }
        Err(Error::TooManyInvocations {
            shader: shader.to_owned(),
            workgroups: self.workgroups,
            invocations,
            limit: MAX_INVOCATIONS,
        })
    }

    /// Everything that a route needs.
    pub(super) fn request(&self, name: &str, route: Route, adapter: &str) -> Request {
        Request {
            route: route.name().to_owned(),
            adapter: adapter.to_owned(),
            name: name.to_owned(),
            wgsl: self.wgsl.clone(),
            entry: self.entry.clone(),
            jobs: self.points.iter().filter_map(|point| self.job(point)).collect(),
        }
    }

    /// What is bound at a point.
    fn job(&self, point: &Point) -> Option<Job> {
        let (bindings, _) = self.inputs.at::<F32>(&[point]).ok()?;
        let buffer = |buffer: BufferUse| {
            let (group, binding) = buffer.binding;
            Some(Buffer {
                binding: buffer.binding,
                bytes: bytes(&bindings, &self.program, group, binding)?,
                written: buffer.writable,
            })
        };
        let textures = self.inputs.textures.iter().zip(&point.texels);
        Some(Job {
            buffers: self
                .program
                .buffers()
                .into_iter()
                .map(buffer)
                .collect::<Option<_>>()?,
            textures: textures
                .map(|(texture, texels)| texels_of(texture, texels))
                .collect(),
            samplers: self.inputs.samplers.iter().map(|s| s.binding).collect(),
            workgroups: self.workgroups,
        })
    }

    /// The outputs of a job as scalars, buffer by buffer; `None` when they are not of the buffers' sizes.
    pub(super) fn decode(&self, buffers: &[Vec<u8>]) -> Option<Vec<Scalar<F32>>> {
        let mut all = Vec::new();
        if buffers.len() != self.outputs.len() {
            return None;
        }
        for ((buffer, names), bytes) in self.outputs.iter().zip(buffers) {
            let scalars = self.program.scalars_of::<F32>(buffer.binding, bytes)?;
            if scalars.len() != names.len() {
                return None;
            }
            all.extend(scalars);
        }
        Some(all)
    }

    /// The name of an output.
    pub(crate) fn name(&self, output: usize) -> String {
        let mut at = output;
        for (buffer, names) in &self.outputs {
            if let Some(name) = names.get(at) {
                return if buffer.name.is_empty() {
                    format!("{}{name}", slot(buffer.binding.0, buffer.binding.1))
                } else {
                    name.clone()
                };
            }
            at -= names.len();
        }
        format!("output {output}")
    }

    /// Whether an output's buffer holds [`UNWRITTEN`] before the shader runs.
    pub(super) fn starts_unwritten(&self, output: usize) -> bool {
        let mut at = output;
        for (buffer, names) in &self.outputs {
            if at < names.len() {
                return !self.inputs.is_read(buffer.binding);
            }
            at -= names.len();
        }
        false
    }

    /// The inputs of a point by name; those with the index of the output's name first.
    pub(crate) fn named_inputs(&self, point: &Point, output: &str) -> Vec<NamedInput> {
        let index = output
            .find('[')
            .and_then(|at| Some(&output[at..=at + output[at..].find(']')?]));
        let mut groups: Vec<_> = self.inputs.groups.iter().collect();
        groups.sort_by_key(|group| index.is_some_and(|index| !group.name.contains(index)));
        groups
            .into_iter()
            .map(|group| NamedInput {
                name: group.name.clone(),
                values: point.values[group.scalars.clone()].to_vec(),
            })
            .collect()
    }

    /// The value that [`UNWRITTEN`] has in an output.
    pub(super) fn is_unwritten(got: &Scalar<F32>) -> bool {
        match got {
            Scalar::Float(x) => *x == UNWRITTEN,
            Scalar::Int(lo, hi) => lo == hi && *lo == UNWRITTEN as i128,
            Scalar::Bool(_) => false,
        }
    }
}

fn bytes(bindings: &Bindings<F32>, program: &Program, group: u32, binding: u32) -> Option<Vec<u8>> {
    let mut bytes = bindings.to_bytes(program, group, binding)?;
    // The size of a uniform buffer is a multiple of the alignment of its type, which is 16 at most; more than that does no harm.
    bytes.resize(bytes.len().max(4), 0);
    Some(bytes)
}

fn texels_of(texture: &TextureInput, texels: &[f64]) -> Texels {
    Texels {
        binding: texture.binding,
        size: [texture.size[0], texture.size[1]],
        cube: texture.dimension == Dimension::Cube,
        bytes: texels.iter().flat_map(|x| (*x as f32).to_le_bytes()).collect(),
    }
}

/// Enough workgroups along x for one invocation an element, unless the sidecar says how many.
fn derived(declared: [u32; 3], elements: u32, size: [u32; 3]) -> [u32; 3] {
    if declared != [1; 3] {
        return declared;
    }
    [elements.div_ceil(size[0].max(1)).max(1), 1, 1]
}

/// The code that every route starts from: the text itself, or, of other languages, the WGSL that we emit for it.
fn code(shader: &Shader, entry: &str) -> Result<(String, String), String> {
    if shader.language() == Language::Wgsl {
        return Ok((shader.text().to_owned(), entry.to_owned()));
    }
    let emitted = emit(shader, Target::Wgsl, &EmitOptions::default()).map_err(|d| d.to_string())?;
    let file = emitted
        .file(entry)
        .ok_or_else(|| format!("no WGSL was emitted for `{entry}`"))?;
    match &file.contents {
        Contents::Text(text) => Ok((text.clone(), file.entry_point.clone())),
        Contents::Binary(_) => Err("the emitted WGSL is no text".to_owned()),
    }
}

/// Whether everything that the entry point uses can be bound by a job.
fn bindable(shader: &Shader, entry: &str, inputs: &Inputs) -> Result<(), String> {
    let manifest = manifest(shader, &EmitOptions::default(), &[]);
    let described = manifest
        .entry(entry)
        .ok_or_else(|| format!("the manifest lacks `{entry}`"))?;
    if described.immediates.is_some() {
        return Err("push constants are not bound here".to_owned());
    }
    for binding in &described.bindings {
        let refused = |what: &str| Err(format!("`{}` is {what}, which is not bound here", binding.name));
        if binding.count.is_some() {
            return refused("a binding array");
        }
        match binding.kind {
            Kind::UniformBuffer
            | Kind::ReadOnlyStorageBuffer
            | Kind::StorageBuffer
            | Kind::Texture
            | Kind::Sampler => {}
            Kind::DepthTexture => return refused("a depth texture"),
            Kind::StorageTexture => return refused("a storage texture"),
            Kind::ComparisonSampler => return refused("a comparison sampler"),
        }
    }
    let plain = |texture: &&TextureInput| {
        let layers = if texture.dimension == Dimension::Cube {
            6
        } else {
            1
        };
        matches!(texture.dimension, Dimension::D2 | Dimension::Cube)
            && texture.layers == layers
            && texture.samples == 1
            && texture.format == TexelFormat::Rgba32Float
    };
    match inputs.textures.iter().find(|texture| !plain(texture)) {
        None => Ok(()),
        Some(other) => Err(format!(
            "`{}` is no plain 2D or cube texture of floats, and others are not bound here",
            other.name
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::{derived, stem};

    #[test]
    fn workgroups_cover_the_longest_array() {
        assert_eq!(derived([1; 3], 16, [64, 1, 1]), [1, 1, 1]);
        assert_eq!(derived([1; 3], 65, [64, 1, 1]), [2, 1, 1]);
        assert_eq!(derived([1; 3], 0, [8, 8, 1]), [1, 1, 1]);
        assert_eq!(derived([3, 2, 1], 65, [64, 1, 1]), [3, 2, 1]);
    }

    #[test]
    fn cases_are_called_after_the_file() {
        assert_eq!(stem("a/b/water.comp.glsl"), "water");
        assert_eq!(stem("water"), "water");
    }
}
