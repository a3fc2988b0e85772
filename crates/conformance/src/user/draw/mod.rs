//! Vertex and fragment stages, run between generated stages so that everything they get and return is known.
//!
//! One input is four invocations over the same bindings.
//!
//! - A **fragment stage** runs as it stands, on the four pixels of one quad, so that derivatives are defined. A generated vertex stage puts
//!   one triangle over them; its varyings are equal at all corners or slopes. What a rasteriser makes of them is its own affair, so
//!   generated fragment stages write what arrives to targets first, and the intervals are those at *these* inputs. Where an output fits
//!   no target (three components, a depth, a sample mask), the stage is called by a generated one that hands all of it on.
//! - A **vertex stage** runs for four vertices, each of which fills one pixel. The rasteriser hides what it returns, so it is called by a
//!   generated vertex stage whose flat outputs go to targets. Its inputs, indices included, come from the caller.
//!
//! Everything that is passed on is bits in integers. The body of the stage is the text as it was read.

mod feed;
mod port;
mod text;

use bossage_bounds::ranges::{Inputs, Point, Target};
use bossage_bounds::{BufferUse, Domain, F32, Kind, Scalar, Slot, StageOutputs, Truth, Width};
use bossage_translate::manifest::Entry;
use bossage_translate::{Callable, EmitOptions, Shader, Source, Stage, manifest};

pub(super) use feed::{lanes, vertices};
use port::{Component, Port};
use text::{Feed, TARGETS};

use super::request::{Companion, Kept, Pass, Side};

/// Invocations of one input.
pub(crate) const LANES: usize = 4;

/// Values of 32 bits that may go from one stage to the next, in vectors.
const MOST_VARYINGS: usize = 15;

/// How a stage is drawn.
#[derive(Debug)]
pub(crate) struct Draw {
    stage: Stage,
    feed: Feed,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    /// Whether outputs are kept as four words each; else as the scalars that they are.
    called: bool,
    /// Generated stages that go with it.
    companion: Companion,
}

/// The text that is run, its entry point, and how.
pub(super) struct Drawn {
    pub(super) wgsl: String,
    pub(super) entry: String,
    pub(super) draw: Draw,
}

impl Draw {
    /// Plans it for an entry point of a WGSL text.
    ///
    /// # Errors
    /// Why it cannot be drawn.
    pub(super) fn plan(wgsl: &str, entry: &str, name: &str, buffers: &[BufferUse]) -> Result<Drawn, String> {
        if let Some(written) = buffers.iter().find(|buffer| buffer.writable) {
            return Err(format!(
                "it writes the buffer `{}`, and of what is drawn only targets are read back",
                written.name
            ));
        }
        let shader = Shader::parse(name, &Source::Wgsl(wgsl.to_owned())).map_err(|d| d.to_string())?;
        let manifest = manifest(&shader, &EmitOptions::default(), &[]);
        let described = manifest
            .entry(entry)
            .ok_or_else(|| format!("the manifest lacks `{entry}`"))?;
        let ports = |list: &[_]| list.iter().map(Port::new).collect::<Result<Vec<Port>, String>>();
        let (inputs, outputs) = (ports(&described.inputs)?, ports(&described.outputs)?);
        if outputs.is_empty() {
            return Err("it returns nothing, so there is nothing to compare".to_owned());
        }
        match described.stage {
            Stage::Vertex => Self::of_vertices(&shader, described, inputs, outputs),
            Stage::Fragment => Self::of_fragments(&shader, described, inputs, outputs),
            Stage::Compute => Err("a compute shader is not drawn".to_owned()),
        }
    }

    fn of_fragments(
        shader: &Shader,
        described: &Entry,
        inputs: Vec<Port>,
        outputs: Vec<Port>,
    ) -> Result<Drawn, String> {
        let located = inputs.iter().filter(|port| port.is_located());
        if let Some(half) = located.clone().find(|port| port.component == Component::F16) {
            return Err(format!(
                "`{}` is of 16 bits, and no such values go from stage to stage here",
                half.name
            ));
        }
        let feed = feed(described, located.count(), 3);
        let called = outputs.iter().any(|port| port.target().is_none());
        let (wgsl, entry) = if called {
            let callable = Callable::new(shader, &described.name).map_err(|d| d.to_string())?;
            let call = text::call_fragment(&callable, &inputs, &outputs);
            (callable.text + &call, "bossage_call".to_owned())
        } else {
            (shader.text().to_owned(), described.name.clone())
        };
        let captures = inputs.chunks(TARGETS).enumerate().map(|(number, part)| Pass {
            vertex: Side::Generated("bossage_feed".to_owned()),
            fragment: Side::Generated(text::name("capture", number)),
            targets: vec![Kept::Unsigned; part.len()],
        });
        let mut passes: Vec<Pass> = captures.collect();
        let targets = if called {
            vec![Kept::Unsigned; outputs.len()]
        } else {
            targets(&outputs)
        };
        passes.push(Pass {
            vertex: Side::Generated("bossage_feed".to_owned()),
            fragment: Side::Own,
            targets,
        });
        let draw = Self {
            stage: Stage::Fragment,
            feed,
            companion: Companion {
                wgsl: text::around_fragments(feed, &inputs),
                passes,
                corners: 3,
            },
            inputs,
            outputs,
            called,
        };
        Ok(Drawn { wgsl, entry, draw })
    }

    fn of_vertices(
        shader: &Shader,
        described: &Entry,
        inputs: Vec<Port>,
        outputs: Vec<Port>,
    ) -> Result<Drawn, String> {
        if outputs.len() > MOST_VARYINGS {
            return Err(format!(
                "it returns {} values; {MOST_VARYINGS} can be handed on",
                outputs.len()
            ));
        }
        let corners = 3 * LANES;
        let feed = feed(described, inputs.len(), corners);
        let callable = Callable::new(shader, &described.name).map_err(|d| d.to_string())?;
        let call = text::call_vertex(feed, &callable, &inputs, &outputs);
        let entry = "bossage_call".to_owned();
        let stores = outputs.chunks(TARGETS).enumerate().map(|(number, part)| Pass {
            vertex: Side::Own,
            fragment: Side::Generated(text::name("store", number)),
            targets: vec![Kept::Unsigned; part.len()],
        });
        let draw = Self {
            stage: Stage::Vertex,
            feed,
            companion: Companion {
                wgsl: text::after_vertices(outputs.len()),
                passes: stores.collect(),
                corners: corners as u32,
            },
            inputs,
            outputs,
            called: true,
        };
        Ok(Drawn {
            wgsl: callable.text + &call,
            entry,
            draw,
        })
    }

    pub(super) fn companion(&self) -> &Companion {
        &self.companion
    }

    /// Whether a generated stage calls it, so that its text is not quite as it was.
    pub(super) fn is_called(&self) -> bool {
        self.called
    }

    pub(super) fn stage(&self) -> Stage {
        self.stage
    }

    /// Where the generated stages find the inputs.
    pub(super) fn binding(&self) -> (u32, u32) {
        self.feed.binding
    }

    /// What is bound there at an input.
    pub(super) fn fed(&self, inputs: &Inputs, lanes: &[Point]) -> Vec<u8> {
        feed::bytes(self, inputs, lanes)
    }

    /// Which inputs of the stage are the same at all fragments of a triangle.
    pub(super) fn is_sloped(&self, slot: Slot) -> bool {
        self.inputs
            .iter()
            .any(|port| port.slot == slot && port.is_located() && !port.is_flat)
    }

    /// The names of the scalars that come back, invocation by invocation; first of a fragment whether it was kept.
    pub(super) fn names(&self) -> Vec<String> {
        let lane = |lane: usize| {
            let at = match self.stage {
                Stage::Fragment => format!(" at pixel ({}, {})", lane % 2, lane / 2),
                Stage::Vertex | Stage::Compute => format!(" of vertex {lane}"),
            };
            let kept = (self.stage == Stage::Fragment).then(|| format!("kept{at}"));
            let scalars = self
                .outputs
                .iter()
                .flat_map(scalar_names)
                .map(move |name| format!("{name}{at}"));
            kept.into_iter().chain(scalars).collect::<Vec<_>>()
        };
        (0..LANES).flat_map(lane).collect()
    }

    /// Scalars that come back for one invocation.
    pub(super) fn scalars_a_lane(&self) -> usize {
        usize::from(self.stage == Stage::Fragment)
            + self.outputs.iter().map(|port| port.components).sum::<usize>()
    }

    /// The outputs of an evaluation in the same order. Of a fragment that is discarded nothing is known but that it left its targets alone.
    pub(super) fn evaluated<D: Domain>(&self, outputs: &StageOutputs<D>) -> Option<Vec<Scalar<D>>> {
        let mut all = Vec::new();
        for lane in 0..LANES {
            let discarded = outputs.discarded.get(lane).copied().unwrap_or(Truth::False);
            if self.stage == Stage::Fragment {
                all.push(Scalar::Bool(negated(discarded)));
            }
            for port in &self.outputs {
                let column = outputs.columns.get(&port.slot)?;
                let own = column.of(lane).get(..port.components)?;
                all.extend(own.iter().map(|scalar| left(*scalar, discarded)));
            }
        }
        Some(all)
    }

    /// What a machine left: the inputs that arrived, where the stage's are captured, and the outputs. `None` when sizes are wrong.
    pub(super) fn decode(
        &self,
        inputs: &Inputs,
        given: &[Point],
        pictures: &[Vec<u8>],
    ) -> Option<(Vec<Point>, Vec<Scalar<F32>>)> {
        let expected: usize = self.companion.passes.iter().map(|pass| pass.targets.len()).sum();
        let pictures: Vec<[[u32; 4]; LANES]> = pictures
            .iter()
            .map(|bytes| pixels(bytes))
            .collect::<Option<_>>()?;
        if pictures.len() != expected {
            return None;
        }
        let captured = if self.stage == Stage::Fragment {
            self.inputs.len()
        } else {
            0
        };
        let (arrived, kept) = pictures.split_at(captured);
        let mut lanes = given.to_vec();
        for (port, picture) in self.inputs.iter().zip(arrived) {
            replace(port, picture, inputs, &mut lanes);
        }
        let mut all = Vec::new();
        for lane in 0..LANES {
            let written = kept.iter().any(|picture| {
                picture[lane]
                    .iter()
                    .any(|word| *word != bossage_runner::SENTINEL_BITS)
            });
            if self.stage == Stage::Fragment {
                all.push(Scalar::Bool(Truth::from_bool(written)));
            }
            for (at, port) in self.outputs.iter().enumerate() {
                let picture = kept.get(if self.called { at } else { location(port) })?;
                let scalar = |word: &u32| match written {
                    true => port.scalar(*word),
                    false => left(port.scalar(0), Truth::True),
                };
                all.extend(picture[lane][..port.components].iter().map(scalar));
            }
        }
        Some((lanes, all))
    }
}

/// A place for the array that no binding of the stage takes.
fn feed(described: &Entry, values: usize, corners: usize) -> Feed {
    let last = described
        .bindings
        .iter()
        .map(|binding| (binding.group, binding.binding))
        .max();
    Feed {
        binding: last.map_or((0, 0), |(group, binding)| (group, binding + 1)),
        stride: values + 1,
        corners,
    }
}

/// The targets of outputs that fit them, by location; one at whose location nothing is returned is left alone.
fn targets(outputs: &[Port]) -> Vec<Kept> {
    let mut targets = Vec::new();
    for port in outputs {
        let at = location(port);
        targets.resize(targets.len().max(at + 1), Kept::Floats);
        targets[at] = match port.component {
            Component::I32 => Kept::Signed,
            Component::U32 => Kept::Unsigned,
            Component::F32 | Component::F16 | Component::Bool => Kept::Floats,
        };
    }
    targets
}

fn location(port: &Port) -> usize {
    match port.slot {
        Slot::Location(location, _) => location as usize,
        _ => 0,
    }
}

fn scalar_names(port: &Port) -> Vec<String> {
    match port.components {
        1 => vec![port.name.clone()],
        n => "xyzw"
            .chars()
            .take(n)
            .map(|letter| format!("{}.{letter}", port.name))
            .collect(),
    }
}

/// The pixels of a target as words.
fn pixels(bytes: &[u8]) -> Option<[[u32; 4]; LANES]> {
    let words: Vec<u32> = bytes
        .as_chunks::<4>()
        .0
        .iter()
        .map(|word| u32::from_le_bytes(*word))
        .collect();
    let pixels: &[[u32; 4]; LANES] = words.as_chunks::<4>().0.try_into().ok()?;
    Some(*pixels)
}

/// Puts what arrived in the place of what was given.
fn replace(port: &Port, picture: &[[u32; 4]; LANES], inputs: &Inputs, lanes: &mut [Point]) {
    for (k, scalar) in inputs.scalars.iter().enumerate() {
        let Target::Stage { slot, component } = scalar.target else {
            continue;
        };
        if slot != port.slot {
            continue;
        }
        for (point, pixel) in lanes.iter_mut().zip(picture) {
            point.values[k] = super::judge::number(&port.scalar(pixel[component]));
        }
    }
}

const fn negated(truth: Truth) -> Truth {
    match truth {
        Truth::True => Truth::False,
        Truth::False => Truth::True,
        Truth::Maybe => Truth::Maybe,
    }
}

/// What an output is where its fragment is discarded: what its target held before; open where that is not decided.
fn left<D: Domain>(scalar: Scalar<D>, discarded: Truth) -> Scalar<D> {
    const BEFORE: f64 = bossage_bounds::ranges::UNWRITTEN;
    let float = Kind::Float(Width::F32);
    match (discarded, scalar) {
        (Truth::False, _) => scalar,
        (Truth::True, Scalar::Float(_)) => Scalar::Float(D::to_float(D::float(Width::F32, BEFORE))),
        (Truth::True, Scalar::Int(..)) => Scalar::Int(BEFORE as i128, BEFORE as i128),
        (Truth::True, Scalar::Bool(_)) => Scalar::Bool(Truth::False),
        (Truth::Maybe, Scalar::Float(_)) => Scalar::Float(D::to_float(D::undecided(float))),
        (Truth::Maybe, Scalar::Int(..)) => Scalar::Int(i128::from(i32::MIN), i128::from(u32::MAX)),
        (Truth::Maybe, Scalar::Bool(_)) => Scalar::Bool(Truth::Maybe),
    }
}
