//! A kernel's dispatch, run twice from one description: on an adapter, and over acceptance intervals.
//!
//! The intervals come from the IR of the very kernel that runs, with the buffers, textures and settings that it is given. Buffers
//! that an earlier pass wrote are passed on as intervals, so what the passes lose adds up. A kernel that reads or writes
//! outside of what it is bound to is refused: drivers hide that in different ways, and the language promises no result then.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use bossage_bounds::{Accept, BufferData as Contents, Limits, Scalar, run_compute};
use bossage_embedded::bindings;
use bossage_runner::{Code, ComputeJob, ComputeOutput, Resources, Shader, resolve};
use bossage_shaders::Kernel;

use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::with_causes;
use crate::module::Module;
use crate::route::Prepared;

/// The contents of a buffer over acceptance intervals: one for each scalar of its type, without padding.
pub(crate) type Accepted = Vec<Scalar<Accept>>;

/// Who mixes texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Filtering {
    /// A sampler of hardware, or of a driver: it has 8 bits of the weights.
    OfHardware,
    /// The evaluator: exact weights.
    Ideal,
}

/// What a kernel is dispatched with.
#[derive(Clone, Debug)]
pub(crate) struct Dispatch<'a> {
    /// The name that errors use.
    pub(crate) name: &'a str,
    /// The kernel.
    pub(crate) kernel: Kernel,
    /// What it is bound to.
    pub(crate) resources: Resources<'a>,
    /// How many invocations are needed along each axis; workgroups are rounded up.
    pub(crate) invocations: [u32; 3],
}

impl Dispatch<'_> {
    fn workgroups(&self) -> [u32; 3] {
        let size = self.kernel.workgroup_size();
        std::array::from_fn(|axis| self.invocations[axis].div_ceil(size[axis]))
    }

    /// What the adapter leaves in the buffers that the kernel may write.
    pub(crate) fn run(&self, bench: &Bench<'_>) -> Result<ComputeOutput, String> {
        let module = bench.module(&Module::Kernel(self.kernel))?;
        let job = ComputeJob {
            name: self.name,
            shader: module.shader(self.kernel.entry())?,
            resources: self.resources.clone(),
            workgroups: self.workgroups(),
        };
        job.run(bench.device).map_err(|error| with_causes(&error))
    }

    /// What an implementation may leave there, by buffer. `known` takes the place of buffers that an earlier pass wrote.
    pub(crate) fn accepted(
        &self,
        module: &Prepared,
        known: &BTreeMap<String, Accepted>,
    ) -> Result<BTreeMap<String, Accepted>, String> {
        self.accepted_by(module, known, Filtering::OfHardware)
    }

    /// The same, where it is known who filters textures.
    pub(crate) fn accepted_by(
        &self,
        module: &Prepared,
        known: &BTreeMap<String, Accepted>,
        filtering: Filtering,
    ) -> Result<BTreeMap<String, Accepted>, String> {
        let entry = self.kernel.entry();
        let program = module.program(entry)?;
        let shader = Shader {
            code: Code::Wgsl(module.text()),
            entry: module.entry(entry)?,
        };
        let resolved =
            resolve(self.name, &[&shader], &self.resources).map_err(|error| with_causes(&error))?;
        let mut bound = bindings::<Accept>(self.name, &resolved).map_err(|error| with_causes(&error))?;
        for one in &resolved {
            if let Some(contents) = known.get(&one.binding.name) {
                bound
                    .buffers
                    .insert(one.place, Contents::Scalars(contents.clone()));
            }
        }
        for sampler in bound.samplers.values_mut().flatten() {
            sampler.ideal = filtering == Filtering::Ideal;
        }
        let outcome = run_compute(&program, &mut bound, self.workgroups(), &Limits::default())
            .map_err(|error| with_causes(&error))?;
        if outcome.counters.out_of_bounds > 0 {
            return Err(format!(
                "`{entry}` reads or writes outside of what it is bound to, {} times",
                outcome.counters.out_of_bounds
            ));
        }
        let left = resolved
            .iter()
            .filter_map(|one| match bound.buffers.remove(&one.place) {
                Some(Contents::Scalars(contents)) => Some((one.binding.name.clone(), contents)),
                Some(Contents::Bytes(_)) | None => None,
            });
        Ok(left.collect())
    }
}

/// The bounds of floats; open where the buffer holds something else.
pub(crate) fn float_bounds(contents: &[Scalar<Accept>]) -> Vec<Bound> {
    let bound = |scalar: &Scalar<Accept>| scalar.float().map_or(Bound::OPEN, Bound::from);
    contents.iter().map(bound).collect()
}

/// The bounds of the bytes of a word, lowest first. Where the words between the two ends differ in a byte, the bytes below it may
/// be anything: the interval does not say which of them go together.
pub(crate) fn byte_bounds(word: &Scalar<Accept>) -> [Bound; 4] {
    parts_of_word(word, 8)
}

/// The same for the two halves of a word.
pub(crate) fn half_bounds(word: &Scalar<Accept>) -> [Bound; 2] {
    parts_of_word(word, 16)
}

fn parts_of_word<const N: usize>(word: &Scalar<Accept>, bits: u32) -> [Bound; N] {
    let Scalar::Int(low, high) = *word else {
        return [Bound::OPEN; N];
    };
    let mask = (1_i128 << bits) - 1;
    std::array::from_fn(|part| {
        let shift = bits * part as u32;
        let (from, to) = (low >> shift, high >> shift);
        if from == to {
            Bound::exactly((from & mask) as f64)
        } else if from >> bits == to >> bits {
            Bound::between((from & mask) as f64, (to & mask) as f64).forked()
        } else {
            Bound::between(0.0, mask as f64).forked()
        }
    })
}

/// Something that is made once for each text of a shader, and kept between routes and adapters that run the same.
#[derive(Debug)]
pub(crate) struct Kept<T>(Mutex<Option<(String, Arc<T>)>>);

impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self(Mutex::new(None))
    }
}

impl<T> Kept<T> {
    /// What was made for this text, or `make`'s.
    pub(crate) fn for_text(
        &self,
        text: &str,
        make: impl FnOnce() -> Result<T, String>,
    ) -> Result<Arc<T>, String> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, made)) = kept.as_ref().filter(|(of, _)| of == text) {
            return Ok(Arc::clone(made));
        }
        let made = Arc::new(make()?);
        *kept = Some((text.to_owned(), Arc::clone(&made)));
        Ok(made)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use bossage_bounds::Scalar;

    use super::{Kept, byte_bounds, half_bounds};
    use crate::bound::Bound;

    #[test]
    fn a_known_word_has_known_bytes() {
        let bytes = byte_bounds(&Scalar::Int(0x80ff_0102, 0x80ff_0102));
        assert_eq!(bytes.map(|byte| byte.low()), [2.0, 1.0, 255.0, 128.0]);
        assert!(bytes.iter().all(Bound::is_settled));
        let halves = half_bounds(&Scalar::Int(0x8000_ffff, 0x8000_ffff));
        assert_eq!(
            halves.map(|half| (half.low(), half.high())),
            [(65_535.0, 65_535.0), (32_768.0, 32_768.0)]
        );
    }

    #[test]
    fn below_a_byte_that_is_open_nothing_is_known() {
        let bytes = byte_bounds(&Scalar::Int(0x0102_03ff, 0x0102_0400));
        let ends = bytes.map(|byte| (byte.low(), byte.high(), byte.is_forked()));
        assert_eq!(
            ends,
            [
                (0.0, 255.0, true),
                (3.0, 4.0, true),
                (2.0, 2.0, false),
                (1.0, 1.0, false)
            ]
        );
        let lowest = byte_bounds(&Scalar::Int(127, 128))[0];
        assert!(lowest.contains(127.0) && lowest.contains(128.0) && !lowest.contains(126.0));
    }

    #[test]
    fn another_text_is_made_anew() {
        let (kept, made) = (Kept::default(), Cell::new(0));
        let ask = |text: &str| {
            let count = || {
                made.set(made.get() + 1);
                Ok(made.get())
            };
            *kept.for_text(text, count).unwrap()
        };
        assert_eq!([ask("a"), ask("a"), ask("b"), ask("a")], [1, 1, 2, 3]);
        assert!(kept.for_text("c", || Err("no".to_owned())).is_err());
    }
}
