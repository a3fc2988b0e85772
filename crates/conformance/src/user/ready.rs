//! An entry point that can be run: its code, its inputs and what it binds at each, and what comes back.

use bossage_bounds::ranges::{Inputs, Point, Seed, Style, UNWRITTEN, scalar_names};
use bossage_bounds::{
    Bindings, BufferData, BufferUse, Domain, Error as BoundsError, F32, Limits, Program, Scalar, TexelFormat,
    run_compute, run_entry,
};
use bossage_runner::slot;
use bossage_translate::{Contents, EmitOptions, Language, Shader, Stage, Target, emit};

use super::draw::{self, Draw};
use super::request::{Buffer, Job, Original, Request};
use super::texels;
use super::{Options, bindable::bindable};
use crate::case::with_causes;
use crate::compare::NamedInput;
use crate::error::Error;
use crate::route::Route;

/// The most invocations of a dispatch.
const MAX_INVOCATIONS: u64 = 1 << 20;

/// An entry point that can be run.
#[derive(Debug)]
pub(crate) struct Ready {
    /// Its own IR, as it was read.
    pub(crate) program: Program,
    pub(crate) inputs: Inputs,
    /// For each input the invocations that differ: one of a compute shader, four of another stage, over the bindings of the first.
    pub(crate) points: Vec<Vec<Point>>,
    /// How many of them, the last, come from a corpus.
    pub(crate) replayed: usize,
    pub(crate) limits: Limits,
    form: Form,
    names: Vec<String>,
    wgsl: String,
    /// The entry point's name in `wgsl`.
    entry: String,
    /// The file that the route `spirv` runs, where that was one: its bytes, and the entry point's name in it.
    original: Option<Original>,
}

/// How it is run.
#[derive(Debug)]
enum Form {
    /// As a dispatch that leaves its results in buffers.
    Dispatch {
        workgroups: [u32; 3],
        written: Vec<Written>,
    },
    /// As a picture.
    Draw(Draw),
}

/// Something that is read back, and how many scalars that is.
#[derive(Debug)]
struct Written {
    what: What,
    scalars: usize,
}

/// A buffer, or a texture, by its binding.
#[derive(Clone, Copy, Debug)]
enum What {
    Buffer((u32, u32)),
    Texture((u32, u32), TexelFormat),
}

/// What a machine made of one input.
#[derive(Clone, Debug)]
pub(crate) struct Ran {
    /// The inputs as they arrived.
    pub(crate) points: Vec<Point>,
    /// The outputs.
    pub(crate) got: Vec<Scalar<F32>>,
}

impl Ready {
    pub(super) fn new(
        shader: &Shader,
        entry: &str,
        stage: Stage,
        mut inputs: Inputs,
        is_overridden: bool,
        options: &Options,
    ) -> Result<Self, String> {
        let stored = bindable(shader, entry, &mut inputs)?;
        let (module, info) = shader
            .module(entry)
            .ok_or_else(|| format!("no entry point `{entry}`"))?;
        let program = Program::new(module, info, entry).map_err(|error| {
            format!(
                "no interval can be derived for `{entry}`: {}",
                with_causes(&error)
            )
        })?;
        let (wgsl, own) = code(shader, entry, is_overridden)?;
        let (wgsl, own, form, names) = match stage {
            Stage::Compute => {
                let scalars = |buffer: &BufferUse| {
                    scalar_names(module, buffer.binding, inputs.elements(buffer.binding))
                        .map_err(|error| with_causes(&error))
                };
                let (form, names) = Form::dispatch(&program, &inputs, &stored, options, &scalars)?;
                (wgsl, own, form, names)
            }
            Stage::Vertex | Stage::Fragment => {
                let drawn = Draw::plan(&wgsl, &own, shader.name(), &program.buffers())?;
                let names = drawn.draw.names();
                (drawn.wgsl, drawn.entry, Form::Draw(drawn.draw), names)
            }
        };
        let is_as_read = match &form {
            Form::Dispatch { .. } => true,
            Form::Draw(draw) => !draw.is_called(),
        };
        let bytes = options.original.as_ref().filter(|_| is_as_read && !is_overridden);
        let original = bytes.map(|bytes| Original {
            bytes: bytes.clone(),
            entry: entry.to_owned(),
        });
        let mut seed = Seed::new(options.seed);
        Ok(Self {
            original,
            points: (0..options.inputs)
                .map(|number| form.choose(&inputs, &mut seed, number))
                .collect(),
            limits: Limits {
                operations: options.operations,
                ..Limits::default()
            },
            replayed: 0,
            program,
            form,
            names,
            inputs,
            wgsl,
            entry: own,
        })
    }

    /// Every invocation is evaluated several times over, for every input.
    pub(super) fn check_size(&self, shader: &str) -> Result<(), Error> {
        let Form::Dispatch { workgroups, .. } = self.form else {
            return Ok(());
        };
        let product = |list: [u32; 3]| list.iter().map(|n| u64::from(*n)).product::<u64>();
        let invocations = product(workgroups) * product(self.program.workgroup_size());
        if invocations <= MAX_INVOCATIONS {
            return Ok(());
        }
        Err(Error::TooManyInvocations {
            shader: shader.to_owned(),
            workgroups,
            invocations,
            limit: MAX_INVOCATIONS,
        })
    }

    /// Adds inputs of a corpus.
    pub(super) fn replay(&mut self, points: Vec<Point>) {
        self.replayed += points.len();
        let alike: Vec<Vec<Point>> = points.iter().map(|point| self.alike(point)).collect();
        self.points.extend(alike);
    }

    /// How many inputs were chosen from their ranges.
    pub(super) fn chosen(&self) -> usize {
        self.points.len() - self.replayed
    }

    /// The invocations of an input that all get the same.
    pub(crate) fn alike(&self, point: &Point) -> Vec<Point> {
        match self.form {
            Form::Dispatch { .. } => vec![point.clone()],
            Form::Draw(_) => vec![point.clone(); draw::LANES],
        }
    }

    /// Everything that a route needs.
    pub(super) fn request(&self, name: &str, route: Route, adapter: &str) -> Request {
        Request {
            route: route.name().to_owned(),
            adapter: adapter.to_owned(),
            name: name.to_owned(),
            wgsl: self.wgsl.clone(),
            entry: self.entry.clone(),
            original: self.original.clone().filter(|_| route == Route::Spirv),
            companion: match &self.form {
                Form::Dispatch { .. } => None,
                Form::Draw(draw) => Some(draw.companion().clone()),
            },
            jobs: self.points.iter().filter_map(|points| self.job(points)).collect(),
        }
    }

    /// What is bound at an input.
    fn job(&self, points: &[Point]) -> Option<Job> {
        let (bindings, _) = self.inputs.at::<F32>(&[points.first()?]).ok()?;
        let buffer = |buffer: BufferUse| {
            let (group, binding) = buffer.binding;
            Some(Buffer {
                binding: buffer.binding,
                bytes: bytes(&bindings, &self.program, group, binding)?,
                written: buffer.writable,
            })
        };
        let mut buffers: Vec<Buffer> = self
            .program
            .buffers()
            .into_iter()
            .map(buffer)
            .collect::<Option<_>>()?;
        let workgroups = match &self.form {
            Form::Dispatch { workgroups, .. } => *workgroups,
            Form::Draw(draw) => {
                buffers.push(Buffer {
                    binding: draw.binding(),
                    bytes: draw.fed(&self.inputs, points),
                    written: false,
                });
                [1; 3]
            }
        };
        let textures = self.inputs.textures.iter().zip(&points[0].texels);
        Some(Job {
            buffers,
            textures: textures
                .map(|(texture, texels)| texels::bound(texture, texels, self.is_stored(texture.binding)))
                .collect(),
            samplers: self.inputs.samplers.iter().map(|s| s.binding).collect(),
            workgroups,
        })
    }

    /// Whether a texture is read back.
    fn is_stored(&self, place: (u32, u32)) -> bool {
        match &self.form {
            Form::Draw(_) => false,
            Form::Dispatch { written, .. } => written
                .iter()
                .any(|written| matches!(written.what, What::Texture(binding, _) if binding == place)),
        }
    }

    /// What an input's job left; `None` when it is not of the right sizes.
    pub(super) fn decode(&self, at: usize, left: &[Vec<u8>]) -> Option<Ran> {
        let points = self.points.get(at)?;
        match &self.form {
            Form::Draw(draw) => {
                let (points, got) = draw.decode(&self.inputs, points, left)?;
                Some(Ran { points, got })
            }
            Form::Dispatch { written, .. } => {
                let mut got = Vec::new();
                if left.len() != written.len() {
                    return None;
                }
                for (written, bytes) in written.iter().zip(left) {
                    let scalars = match written.what {
                        What::Buffer(binding) => self.program.scalars_of::<F32>(binding, bytes)?,
                        What::Texture(_, format) => texels::held(format, format.scalars(bytes)),
                    };
                    if scalars.len() != written.scalars {
                        return None;
                    }
                    got.extend(scalars);
                }
                Some(Ran {
                    points: points.clone(),
                    got,
                })
            }
        }
    }

    /// The outputs over a domain.
    pub(crate) fn evaluate<D: Domain>(
        &self,
        points: &[Point],
        limits: &Limits,
    ) -> Result<Vec<Scalar<D>>, BoundsError> {
        let points: Vec<&Point> = points.iter().collect();
        let (mut bindings, inputs) = self.inputs.at::<D>(&points)?;
        match &self.form {
            Form::Dispatch { workgroups, written } => {
                run_compute(&self.program, &mut bindings, *workgroups, limits)?;
                let left = |written: &Written| match written.what {
                    What::Buffer(binding) => match bindings.buffers.get(&binding) {
                        Some(BufferData::Scalars(scalars)) => scalars.clone(),
                        // A run leaves every writable buffer as scalars.
                        Some(BufferData::Bytes(_)) | None => Vec::new(),
                    },
                    What::Texture(binding, format) => {
                        let scalars = bindings.written_textures.get(&binding).cloned();
                        texels::held(format, scalars.unwrap_or_default())
                    }
                };
                Ok(written.iter().flat_map(left).collect())
            }
            Form::Draw(draw) => {
                let (outputs, _) = run_entry(&self.program, &mut bindings, &inputs, [1; 3], limits)?;
                // A stage that is drawn has outputs, all of them in the order of its interface.
                Ok(outputs
                    .and_then(|outputs| draw.evaluated(&outputs))
                    .unwrap_or_default())
            }
        }
    }

    /// The name of an output.
    pub(crate) fn name(&self, output: usize) -> String {
        self.names
            .get(output)
            .cloned()
            .unwrap_or_else(|| format!("output {output}"))
    }

    /// Whether an output holds [`UNWRITTEN`] before the shader runs.
    pub(super) fn starts_unwritten(&self, output: usize) -> bool {
        let Form::Dispatch { written, .. } = &self.form else {
            return true;
        };
        let mut at = output;
        for written in written {
            if at < written.scalars {
                return match written.what {
                    What::Buffer(binding) => !self.inputs.is_read(binding),
                    What::Texture(..) => false,
                };
            }
            at -= written.scalars;
        }
        false
    }

    /// The invocation that an output is of.
    pub(crate) fn lane(&self, output: usize) -> usize {
        match &self.form {
            Form::Dispatch { .. } => 0,
            Form::Draw(draw) => (output / draw.scalars_a_lane()).min(draw::LANES - 1),
        }
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

impl Form {
    /// A dispatch, with the names of the scalars that it writes.
    fn dispatch(
        program: &Program,
        inputs: &Inputs,
        stored: &[(u32, u32)],
        options: &Options,
        scalars: &dyn Fn(&BufferUse) -> Result<Vec<String>, String>,
    ) -> Result<(Self, Vec<String>), String> {
        let (mut written, mut names) = (Vec::new(), Vec::new());
        for buffer in program.buffers().into_iter().filter(|buffer| buffer.writable) {
            let own = scalars(&buffer)?;
            written.push(Written {
                what: What::Buffer(buffer.binding),
                scalars: own.len(),
            });
            let place = match buffer.name.is_empty() {
                true => slot(buffer.binding.0, buffer.binding.1),
                false => String::new(),
            };
            names.extend(own.into_iter().map(|name| format!("{place}{name}")));
        }
        for texture in inputs
            .textures
            .iter()
            .filter(|texture| stored.contains(&texture.binding))
        {
            let own = texels::names(texture);
            written.push(Written {
                what: What::Texture(texture.binding, texture.format),
                scalars: own.len(),
            });
            names.extend(own);
        }
        if written.is_empty() {
            return Err("it writes no buffer and no texture, so there is nothing to compare".to_owned());
        }
        let derived = || {
            derived(
                inputs.workgroups,
                inputs.longest_array(),
                program.workgroup_size(),
            )
        };
        let workgroups = options.workgroups.unwrap_or_else(derived);
        Ok((Self::Dispatch { workgroups, written }, names))
    }

    /// Half of the inputs at the edges of their ranges, half of them anywhere.
    fn choose(&self, inputs: &Inputs, seed: &mut Seed, number: usize) -> Vec<Point> {
        let style = if number.is_multiple_of(2) {
            Style::Edge
        } else {
            Style::Random
        };
        match self {
            Self::Dispatch { .. } => vec![inputs.sample(seed, style)],
            Self::Draw(draw) if draw.stage() == Stage::Vertex => draw::vertices(inputs, seed, style),
            Self::Draw(draw) => draw::lanes(draw, inputs, seed, number),
        }
    }
}

fn bytes(bindings: &Bindings<F32>, program: &Program, group: u32, binding: u32) -> Option<Vec<u8>> {
    let mut bytes = bindings.to_bytes(program, group, binding)?;
    // The size of a uniform buffer is a multiple of the alignment of its type, which is 16 at most; more than that does no harm.
    bytes.resize(bytes.len().max(4), 0);
    Some(bytes)
}

/// Enough workgroups along x for one invocation an element, unless the sidecar says how many.
fn derived(declared: [u32; 3], elements: u32, size: [u32; 3]) -> [u32; 3] {
    if declared != [1; 3] {
        return declared;
    }
    [elements.div_ceil(size[0].max(1)).max(1), 1, 1]
}

/// The code that every route starts from: the text itself, or, of other languages and with values for overrides, the WGSL that we emit
/// for it.
fn code(shader: &Shader, entry: &str, is_overridden: bool) -> Result<(String, String), String> {
    if shader.language() == Language::Wgsl && !is_overridden {
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

#[cfg(test)]
mod tests {
    use super::derived;

    #[test]
    fn workgroups_cover_the_longest_array() {
        assert_eq!(derived([1; 3], 16, [64, 1, 1]), [1, 1, 1]);
        assert_eq!(derived([1; 3], 65, [64, 1, 1]), [2, 1, 1]);
        assert_eq!(derived([1; 3], 0, [8, 8, 1]), [1, 1, 1]);
        assert_eq!(derived([3, 2, 1], 65, [64, 1, 1]), [3, 2, 1]);
    }
}
