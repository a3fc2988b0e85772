//! What is run, as a message: code, what it binds and how often, for one route on one adapter. And what comes back.
//!
//! A message holds everything, so that the process that runs it reads no file and depends on nothing that may change meanwhile. Lines of
//! JSON in both directions; bytes are base64.

use std::collections::BTreeMap;
use std::io::{BufRead, Write};

use bossage_bounds::IMMEDIATE;
use bossage_runner::{
    AdapterSelector, BufferData, ComputeJob, Machine, PUSH_CONSTANTS, Resources, SamplerSettings,
    TexelFormat, TextureData, TextureDimension, slot,
};
use bossage_shaders::AssembledShader;
use serde::{Deserialize, Serialize};

use super::{Execution, Stop, picture};
use crate::case::with_causes;
use crate::error::Error;
use crate::machines;
use crate::route::{Prepared, Route};

/// Bytes of address space that a process which runs a user's shader may take: a driver that compiles with LLVM needs two or three.
const MEMORY_LIMIT: u64 = 16 << 30;

/// Runs of one entry point by one route on one adapter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// The route's name.
    pub route: String,
    /// The adapter's name.
    pub adapter: String,
    /// What messages call the shader.
    pub name: String,
    /// The code that every route starts from.
    pub wgsl: String,
    /// The entry point's name in it.
    pub entry: String,
    /// A file to run instead, as it is.
    #[serde(default)]
    pub original: Option<Original>,
    /// Of a stage that is drawn: what is generated around it.
    #[serde(default)]
    pub companion: Option<Companion>,
    /// What to run, one after the other.
    pub jobs: Vec<Job>,
}

/// A file of SPIR-V.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Original {
    /// Its bytes.
    #[serde(with = "text")]
    pub bytes: Vec<u8>,
    /// The entry point's name in it.
    pub entry: String,
}

/// Generated stages, and the passes that draw with them and with the shader's own. Each pass draws the same triangles to 2 × 2 pixels.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Companion {
    /// The generated code.
    pub wgsl: String,
    /// What is drawn, one after the other.
    pub passes: Vec<Pass>,
    /// Corners of triangles. A vertex gets its number as a float at location 0.
    pub corners: u32,
}

/// A pair of stages, and what the fragment stage's locations are kept in.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pass {
    /// The vertex stage.
    pub vertex: Side,
    /// The fragment stage.
    pub fragment: Side,
    /// By location. All are read back, four words a pixel.
    pub targets: Vec<Kept>,
}

/// An entry point, and whose it is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The one that is asked for.
    Own,
    /// In the companion's.
    Generated(String),
}

/// What a target keeps, four a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kept {
    /// Floats.
    Floats,
    /// Unsigned integers.
    Unsigned,
    /// Signed integers.
    Signed,
}

/// One dispatch, or what is bound for all passes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// All buffers.
    pub buffers: Vec<Buffer>,
    /// All textures.
    pub textures: Vec<Texels>,
    /// Places of samplers, which all repeat and filter linearly.
    pub samplers: Vec<(u32, u32)>,
    /// How many workgroups.
    pub workgroups: [u32; 3],
}

/// A buffer before the shader runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Buffer {
    /// Bind group and binding number.
    pub binding: (u32, u32),
    /// Its bytes.
    #[serde(with = "text")]
    pub bytes: Vec<u8>,
    /// Whether it is read back.
    pub written: bool,
}

/// A texture of one level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Texels {
    /// Bind group and binding number.
    pub binding: (u32, u32),
    /// Its shape.
    pub shape: Shape,
    /// Width and height.
    pub size: [u32; 2],
    /// The format, as WebGPU calls it but in capitals: `Rgba32Float`.
    pub format: String,
    /// The texels, row by row, layer by layer.
    #[serde(with = "text")]
    pub bytes: Vec<u8>,
    /// Whether it is read back.
    pub written: bool,
}

/// How a texture's texels are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// One row.
    Line,
    /// One layer.
    Plane,
    /// So many layers.
    Array(u32),
    /// Six faces.
    Cube,
    /// So many cubes.
    CubeArray(u32),
    /// So many slices.
    Volume(u32),
}

/// What the process says, a line each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Said {
    /// The code is prepared, the adapter open.
    Ready,
    /// A job is done: its written buffers and then its written textures in the order of the job, or the targets of all passes.
    Done(Vec<Bytes>),
    /// Nothing more comes.
    Stopped(Stop),
}

/// Bytes in a message.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Bytes(#[serde(with = "text")] pub(super) Vec<u8>);

/// Bytes as text.
mod text {
    use base64::Engine;
    use base64::prelude::BASE64_STANDARD;
    use serde::{Deserialize, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(bytes: &[u8], serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&BASE64_STANDARD.encode(bytes))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<u8>, D::Error> {
        let text = String::deserialize(deserializer)?;
        BASE64_STANDARD.decode(text).map_err(serde::de::Error::custom)
    }
}

/// Runs one request from `input`, in this process and within a limit of memory, and answers on `output`.
///
/// # Errors
/// When `input` is no request, or `output` is closed.
pub fn serve(input: &mut dyn BufRead, output: &mut dyn Write) -> std::io::Result<()> {
    limit_memory();
    let request: Request = serde_json::from_reader(input)?;
    let mut closed = Ok(());
    let mut say = |said: Said| {
        if closed.is_ok() {
            closed = line(output, &said);
        }
    };
    if let Err(stop) = run(&request, &mut say) {
        say(Said::Stopped(stop));
    }
    closed
}

fn line(output: &mut dyn Write, said: &Said) -> std::io::Result<()> {
    serde_json::to_writer(&mut *output, said)?;
    output.write_all(b"\n")?;
    output.flush()
}

/// Where it cannot be limited the machine's memory is the limit.
fn limit_memory() {
    #[cfg(unix)]
    {
        let _ = rlimit::Resource::AS.set(MEMORY_LIMIT, MEMORY_LIMIT);
    }
}

/// The same in this process, without limits.
#[must_use]
pub fn execute(request: &Request) -> Execution {
    let mut execution = Execution::default();
    let mut hear = |said: Said| match said {
        Said::Ready | Said::Stopped(_) => {}
        Said::Done(buffers) => execution
            .done
            .push(buffers.into_iter().map(|bytes| bytes.0).collect()),
    };
    let stopped = run(request, &mut hear).err();
    Execution { stopped, ..execution }
}

fn run(request: &Request, say: &mut dyn FnMut(Said)) -> Result<(), Stop> {
    let route: Route = request
        .route
        .parse()
        .map_err(|error| Stop::Failed(format!("{error}")))?;
    let prepare = |name: String, wgsl: &str| {
        let assembled = AssembledShader {
            name,
            wgsl: wgsl.to_owned(),
            features: Vec::new(),
            modules: Vec::new(),
        };
        route.prepare(&assembled).map_err(unprepared)
    };
    let (prepared, entry) = match &request.original {
        Some(original) => {
            let read = Prepared::of_spirv(&request.name, &original.bytes).map_err(unprepared)?;
            (read, original.entry.as_str())
        }
        None => (
            prepare(request.name.clone(), &request.wgsl)?,
            request.entry.as_str(),
        ),
    };
    let companion = request.companion.as_ref();
    let generated = companion
        .map(|companion| prepare(format!("{} (generated)", request.name), &companion.wgsl))
        .transpose()?;
    let machine = open(request, route)?;
    say(Said::Ready);
    for job in &request.jobs {
        let left = match (companion, &generated) {
            (Some(companion), Some(generated)) => {
                picture::run(job, companion, (&prepared, entry), generated, machine.as_ref())?
            }
            _ => job.run(entry, &prepared, machine.as_ref())?,
        };
        say(Said::Done(left));
    }
    Ok(())
}

/// What runs a route on the adapter of that name.
fn open(request: &Request, route: Route) -> Result<Box<dyn Machine>, Stop> {
    let all = machines::adapters();
    let selector = AdapterSelector::named(&request.adapter);
    let info = all.iter().find(|info| selector.matches(info)).ok_or_else(|| {
        stop(&bossage_runner::Error::NoSuchAdapter {
            wanted: request.adapter.clone(),
            found: all.iter().map(|info| info.name.clone()).collect(),
        })
    })?;
    machines::open(info, route).map_err(|error| match error {
        Error::Adapter(error) => stop(&error),
        other => Stop::Failed(other.to_string()),
    })
}

impl Job {
    /// The textures as a machine takes them.
    pub(super) fn textures(&self) -> Result<Vec<TextureData>, Stop> {
        self.textures.iter().map(Texels::data).collect()
    }

    fn run(&self, entry: &str, prepared: &Prepared, machine: &dyn Machine) -> Result<Vec<Bytes>, Stop> {
        let shader = prepared.shader(entry).map_err(Stop::Failed)?;
        let textures = self.textures()?;
        let job = ComputeJob {
            name: entry,
            shader,
            resources: self.resources(&textures),
            workgroups: self.workgroups,
        };
        let output = job.run(machine).map_err(|e| stop(&e))?;
        let named = |binding: (u32, u32)| {
            let described = shader
                .entry
                .bindings
                .iter()
                .find(|b| (b.group, b.binding) == binding);
            let all = |name: &str| output.buffers.get(name).or_else(|| output.textures.get(name));
            let bytes = described.and_then(|b| all(&b.name));
            bytes
                .cloned()
                .map(Bytes)
                .ok_or_else(|| Stop::Failed(format!("{} was not read back", slot(binding.0, binding.1))))
        };
        let buffers = self.buffers.iter().filter(|buffer| buffer.written);
        let textures = self.textures.iter().filter(|texels| texels.written);
        let places = buffers
            .map(|buffer| buffer.binding)
            .chain(textures.map(|texels| texels.binding));
        places.map(named).collect()
    }

    pub(super) fn resources<'a>(&'a self, textures: &'a [TextureData]) -> Resources<'a> {
        let key = |place: (u32, u32)| match place {
            IMMEDIATE => PUSH_CONSTANTS.to_owned(),
            (group, binding) => slot(group, binding),
        };
        let samplers = self.samplers.iter();
        Resources {
            uniforms: BTreeMap::new(),
            buffers: self
                .buffers
                .iter()
                .map(|buffer| (key(buffer.binding), BufferData::Bytes(&buffer.bytes)))
                .collect(),
            textures: self
                .textures
                .iter()
                .map(|texels| key(texels.binding))
                .zip(textures)
                .collect(),
            samplers: samplers
                .map(|&at| (key(at), SamplerSettings::default()))
                .collect(),
        }
    }
}

impl Texels {
    fn data(&self) -> Result<TextureData, Stop> {
        let format = format_named(&self.format)
            .ok_or_else(|| Stop::Failed(format!("textures of {} are not bound here", self.format)))?;
        let [width, height] = self.size;
        Ok(TextureData {
            width,
            height,
            format,
            dimension: match self.shape {
                Shape::Line => TextureDimension::Line,
                Shape::Plane => TextureDimension::Plane,
                Shape::Array(layers) => TextureDimension::Array(layers),
                Shape::Cube => TextureDimension::Cube,
                Shape::CubeArray(cubes) => TextureDimension::CubeArray(cubes),
                Shape::Volume(slices) => TextureDimension::Volume(slices),
            },
            levels: vec![self.bytes.clone()],
        })
    }
}

/// The format of that name, of those that a machine binds.
pub(super) fn format_named(name: &str) -> Option<TexelFormat> {
    use TexelFormat as T;
    let all = [
        T::Rgba8Unorm,
        T::Rgba8Snorm,
        T::Rgba8Uint,
        T::Rgba8Sint,
        T::Rgba16Unorm,
        T::Rgba16Float,
        T::Rgba16Uint,
        T::Rgba16Sint,
        T::R32Float,
        T::R32Uint,
        T::R32Sint,
        T::Rg32Float,
        T::Rg32Uint,
        T::Rg32Sint,
        T::Rgba32Float,
        T::Rgba32Uint,
        T::Rgba32Sint,
        T::Depth16Unorm,
    ];
    all.into_iter().find(|format| format!("{format:?}") == name)
}

/// What a language or its writer cannot express is a lack of the route.
fn unprepared(text: String) -> Stop {
    if text.starts_with("error[unsupported]") {
        Stop::Lacks(text)
    } else {
        Stop::Failed(text)
    }
}

/// What the machine lacks is a skip; everything else is a failure of the shader, the route or the driver.
pub(super) fn stop(error: &bossage_runner::Error) -> Stop {
    use bossage_runner::Error;
    let text = with_causes(error);
    match error {
        Error::Unsupported { .. }
        | Error::Interface { .. }
        | Error::GaveUp { .. }
        | Error::TooLarge { .. } => Stop::Lacks(text),
        // wgpu has no kind of error of its own for what the device cannot do.
        Error::Validation { message, .. } if message.contains("requires capability") => Stop::Lacks(text),
        Error::NoAdapter
        | Error::NoSuchAdapter { .. }
        | Error::Open { .. }
        | Error::Validation { .. }
        | Error::OutOfMemory { .. }
        | Error::Internal { .. }
        | Error::Lost { .. }
        | Error::StagesDisagree { .. }
        | Error::MixedRoutes { .. }
        | Error::MissingResource { .. }
        | Error::WrongResource { .. }
        | Error::UnknownResource { .. }
        | Error::MissingUniform { .. }
        | Error::BadUniform { .. }
        | Error::Mesh { .. }
        | Error::Texture { .. }
        | Error::Target { .. }
        | Error::NotSpirv { .. }
        | Error::Length { .. } => Stop::Failed(text),
    }
}
