//! Maxima made by compute kernels: each level's codes against their twin on the CPU and the f64 reference, code by code.
//!
//! Each level is judged by itself, from the twin's level before. All is whole numbers: what is allowed, which comes from the kernels'
//! own IR (`dispatch.rs`), is one code everywhere, so kernel and twin are equal or one of them is refused.

use std::collections::BTreeMap;

use bossage_assets::max_mip::codes::{self, MaxCodes};
use bossage_assets::{EdgeMode, HeightField};
use bossage_bounds::Scalar;
use bossage_reference::max_mip as reference;
use bossage_runner::{BufferData, Resources};
use bossage_shaders::Kernel;

use super::bake::fields;
use super::kernel_case::{KernelCase, twin_and_rules};
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::dispatch::{Accepted, Dispatch, Kept};
use crate::module::Module;
use crate::tolerance::UNDECIDED_LIMIT;

/// One field with one edge mode.
struct MaxMipBake {
    id: CaseId,
    edge: EdgeMode,
    /// What each kernel is given: the heights of texels, then the twin's levels but for the last.
    given: Vec<MaxCodes>,
    /// The twin's levels.
    levels: Vec<MaxCodes>,
    expected: Kept<Vec<Vec<Expected>>>,
}

/// Every field with every edge mode.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let edges = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];
    fields().into_iter().flat_map(move |(name, field)| {
        edges.map(|edge| Box::new(MaxMipBake::new(name, &field, edge)) as Box<dyn Case>)
    })
}

impl MaxMipBake {
    fn new(name: &str, field: &HeightField, edge: EdgeMode) -> Self {
        let heights = MaxCodes {
            width: field.width,
            height: field.height,
            codes: field.to_unorm16_up(),
        };
        let levels = codes::bake(field, edge);
        let given = std::iter::once(&heights).chain(&levels).take(levels.len());
        Self {
            id: CaseId::new("max_mip", None, "bake")
                .with("field", name)
                .with("edge", edge.name()),
            edge,
            given: given.cloned().collect(),
            levels,
            expected: Kept::default(),
        }
    }

    /// The kernel that makes a level.
    fn kernel(level: usize) -> Kernel {
        if level == 0 {
            Kernel::MaxMipTexels
        } else {
            Kernel::MaxMip
        }
    }

    fn dispatch<'a>(&self, name: &'a str, level: usize, given: &'a [u8]) -> Dispatch<'a> {
        let (from, to) = (&self.given[level], &self.levels[level]);
        let mut resources = Resources::default();
        let edge = match self.edge {
            EdgeMode::Wrap => 0.0,
            EdgeMode::Mirror => 1.0,
            EdgeMode::Clamp => 2.0,
        };
        resources.uniforms.extend([
            (
                "bake.size".to_owned(),
                vec![from.width as f32, from.height as f32],
            ),
            ("bake.edge_mode".to_owned(), vec![edge]),
        ]);
        resources.buffers.extend([
            ("codes".to_owned(), BufferData::Bytes(given)),
            ("maxima".to_owned(), BufferData::Output(4 * to.codes.len())),
        ]);
        Dispatch {
            name,
            kernel: Self::kernel(level),
            resources,
            // A row and a column too many: nothing may come of them.
            invocations: [to.width + 1, to.height + 1, 1],
        }
    }

    fn expectations(&self, bench: &Bench<'_>, given: &[Vec<u8>]) -> Result<Vec<Vec<Expected>>, String> {
        let name = self.id.to_string();
        let level = |(index, from): (usize, &MaxCodes)| {
            let dispatch = self.dispatch(&name, index, &given[index]);
            let module = bench.module(&Module::Kernel(dispatch.kernel))?;
            let mut left = dispatch.accepted(&module, &BTreeMap::new())?;
            let written = left.remove("maxima").ok_or("the kernel writes no maxima")?;
            let from = reference::Level {
                width: from.width,
                height: from.height,
                codes: from.codes.iter().map(|code| f64::from(*code)).collect(),
            };
            let truth = if index == 0 {
                from.over_texels(self.edge)
            } else {
                from.next()
            };
            Ok(pair(&truth, &written))
        };
        self.given.iter().enumerate().map(level).collect()
    }
}

/// The reference's codes, and what an implementation may write.
fn pair(truth: &reference::Level, written: &Accepted) -> Vec<Expected> {
    let bound = |scalar: &Scalar<_>| match *scalar {
        Scalar::Int(low, high) => Bound::between(low as f64, high as f64),
        _ => Bound::OPEN,
    };
    let expected = truth.codes.iter().zip(written);
    expected
        .map(|(truth, written)| Expected {
            truth: *truth,
            bound: bound(written),
        })
        .collect()
}

/// A level as the kernels read it.
fn words(level: &MaxCodes) -> Vec<u8> {
    let words = level.codes.iter().map(|code| u32::from(*code));
    words.flat_map(u32::to_le_bytes).collect()
}

impl KernelCase for MaxMipBake {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        twin_and_rules()
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![Kernel::MaxMipTexels, Kernel::MaxMip]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let (name, given) = (
            self.id.to_string(),
            self.given.iter().map(words).collect::<Vec<_>>(),
        );
        let texts = [Kernel::MaxMipTexels, Kernel::MaxMip].map(|kernel| {
            bench
                .module(&Module::Kernel(kernel))
                .map(|module| module.text().to_owned())
        });
        let [first, second] = texts;
        let expected = self.expected.for_text(&format!("{}{}", first?, second?), || {
            self.expectations(bench, &given)
        })?;
        let (mut comparison, mut nodes) = (Comparison::default(), 0);
        for (index, (twin, expected)) in self.levels.iter().zip(&*expected).enumerate() {
            let got = self
                .dispatch(&name, index, &given[index])
                .run(bench)?
                .words("maxima");
            if [got.len(), expected.len()] != [twin.codes.len(); 2] {
                return Err(format!(
                    "level {index} has {} nodes instead of {}",
                    got.len(),
                    twin.codes.len()
                ));
            }
            for (node, ((got, twin), expected)) in got.iter().zip(&twin.codes).zip(expected).enumerate() {
                let (place, expected) = ([index as f32, node as f32], std::slice::from_ref(expected));
                comparison.item(&place, &[*got as f32], expected);
                comparison.item(&place, &[f32::from(*twin)], expected);
            }
            nodes += twin.codes.len();
        }
        Ok(Outcome::of(nodes, comparison, UNDECIDED_LIMIT))
    }
}
