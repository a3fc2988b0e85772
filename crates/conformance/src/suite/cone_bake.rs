//! Cones made by compute kernels: held to what makes a cone map right, and so is their twin on the CPU.
//!
//! Kernel and twin search in different orders and each lets go a 16th, so their ratios are not equal bit by bit. What is allowed is
//! derived instead, texel by texel, in f64 (`reference::cone_map`):
//! - not wider than the widest cone over any place of the four cells that read the texel, of the surface sampled there;
//! - not narrower than 16/17 of what the boxes of cells allow, less 2⁻¹⁸ for the roundings of f32.

use std::sync::OnceLock;

use bossage_assets::{EdgeMode, HeightField, cone_map, relaxed_cone_map};
use bossage_reference::cone_map as reference;
use bossage_runner::Resources;
use bossage_shaders::Kernel;
use glam::DVec2;
use rand::RngExt;

use super::kernel_case::{KernelCase, TWIN};
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::cone_passes;
use crate::dispatch::Dispatch;
use crate::generate::random::stream;
use crate::oracle;
use crate::tolerance::UNDECIDED_LIMIT;

const KERNELS: [Kernel; 4] = [
    Kernel::ConesCells,
    Kernel::ConesAbove,
    Kernel::ConesSearch,
    Kernel::ConesRatios,
];

/// One field with one edge mode.
struct ConeBake {
    id: CaseId,
    relaxed: bool,
    field: HeightField,
    edge: EdgeMode,
    expected: OnceLock<Vec<Expected>>,
}

/// The fields by name: small, since the truth looks from every place at every other; sides odd and even, and of one texel.
fn fields() -> [(&'static str, HeightField); 7] {
    let mut rng = stream("cones", 1);
    let mut noise = |width: u32, height: u32| {
        let texels: Vec<f32> = (0..width * height)
            .map(|_| rng.random_range(0..=255u32) as f32 / 255.0)
            .collect();
        HeightField::from_fn(width, height, |x, y| texels[(y * width + x) as usize])
    };
    let waves = |x: u32, y: u32| 0.5 + 0.3 * (0.5 * x as f32).sin() + 0.15 * (0.9 * y as f32).cos();
    [
        ("one", HeightField::from_fn(1, 1, |_, _| 0.625)),
        ("column", noise(1, 7)),
        ("row", noise(6, 1)),
        ("noise", noise(13, 8)),
        ("waves", HeightField::from_fn(12, 10, waves)),
        (
            "spike",
            HeightField::from_fn(16, 9, |x, y| if (x, y) == (11, 4) { 1.0 } else { 0.25 }),
        ),
        (
            "block",
            HeightField::from_fn(14, 11, |x, y| {
                if (3..9).contains(&x) && y > 5 {
                    0.875
                } else {
                    0.125
                }
            }),
        ),
    ]
}

/// Both kinds of cones over every field with every edge mode.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let edges = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];
    fields().into_iter().flat_map(move |(name, field)| {
        edges.into_iter().flat_map(move |edge| {
            let field = field.clone();
            [("cone_map", false), ("relaxed_cone_map", true)].map(move |(technique, relaxed)| {
                let id = CaseId::new(technique, None, "bake")
                    .with("field", name)
                    .with("edge", edge.name());
                Box::new(ConeBake {
                    id,
                    relaxed,
                    field: field.clone(),
                    edge,
                    expected: OnceLock::new(),
                }) as Box<dyn Case>
            })
        })
    })
}

impl ConeBake {
    /// What each texel's ratio may be.
    fn expectations(&self) -> Vec<Expected> {
        let (field, edge) = (&self.field, self.edge);
        let (w, h) = (i64::from(field.width), i64::from(field.height));
        let longer = w.max(h) as f64;
        // A falling place is never on a crest itself, so its samples lie inside cells.
        let samples = reference::surroundings(field, edge, 3, if self.relaxed { 1.0 / 6.0 } else { 0.0 });
        let steepest = |at: DVec2| {
            let from = reference::place(field, edge, at);
            if self.relaxed {
                reference::steepest_falling(from, &samples)
            } else {
                reference::steepest(from, &samples)
            }
        };
        // Half a texel apart, on the tile and a texel before it: the cells that read its first texels.
        let columns = 2 * w + 2;
        let halves = (-2..2 * h).flat_map(|y| (-2..2 * w).map(move |x| DVec2::new(x as f64, y as f64) / 2.0));
        let steep: Vec<f64> = halves.map(steepest).collect();
        let boxes = reference::boxes(field, edge);
        let texels = (0..h).flat_map(|y| (0..w).map(move |x| (x, y)));
        let texel = |(x, y): (i64, i64)| {
            let near = (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| (2 * x + dx, 2 * y + dy)));
            let inside = near.filter(|(i, j)| *i < 2 * w && *j < 2 * h);
            let most = inside
                .map(|(i, j)| steep[((j + 2) * columns + i + 2) as usize])
                .fold(1.0 / longer, f64::max);
            let cells = [(x, y), (x - 1, y), (x, y - 1), (x - 1, y - 1)];
            let most_by_boxes = cells
                .map(|(i, j)| boxes[(self.cell(j, h) * w + self.cell(i, w)) as usize])
                .into_iter()
                .fold(1.0 / longer, f64::max);
            let widest = 1.0 / (longer * most);
            let least = 16.0 / 17.0 / (longer * most_by_boxes) * (1.0 - 1.0 / f64::from(1 << 18));
            Expected {
                truth: widest,
                bound: Bound::between(least, widest),
            }
        };
        texels.map(texel).collect()
    }

    /// The cell on the tile that stands for one: the one before the first lies across the seam, or is the border going on.
    fn cell(&self, place: i64, side: i64) -> i64 {
        match self.edge {
            EdgeMode::Wrap => place.rem_euclid(side),
            EdgeMode::Mirror | EdgeMode::Clamp => place.max(0),
        }
    }

    fn baked(&self, bench: &Bench<'_>) -> Result<Vec<f32>, String> {
        let name = self.id.to_string();
        cone_passes::ratios(&self.field, self.edge, self.relaxed, |pass| {
            let mut resources = Resources::default();
            resources.uniforms.extend(pass.uniforms);
            let buffers = pass.buffers.into_iter();
            resources
                .buffers
                .extend(buffers.map(|(name, data)| (name.to_owned(), data)));
            Dispatch {
                name: &name,
                kernel: pass.kernel,
                resources,
                // A row and a column too many: nothing may come of them.
                invocations: [pass.invocations[0] + 1, pass.invocations[1] + 1, 1],
            }
            .run(bench)
        })
    }
}

impl KernelCase for ConeBake {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn kernels(&self) -> Vec<Kernel> {
        KERNELS.to_vec()
    }

    fn basis(&self) -> Vec<&'static str> {
        vec![TWIN, oracle::BASIS[0]]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let kernel = self.baked(bench)?;
        let twin = if self.relaxed {
            relaxed_cone_map::bake(&self.field, self.edge)
        } else {
            cone_map::bake(&self.field, self.edge)
        };
        let expected = self.expected.get_or_init(|| self.expectations());
        if let Some(texel) = expected.iter().position(|expected| !expected.bound.is_decided()) {
            return Err(format!(
                "texel {texel}: a place is steeper than the boxes of cells allow"
            ));
        }
        if kernel.len() != expected.len() {
            return Err(format!(
                "the kernel wrote {} texels of {}",
                kernel.len(),
                expected.len()
            ));
        }
        let mut comparison = Comparison::default();
        let mut apart = 1.0_f32;
        for (index, ((got, twin), expected)) in kernel.iter().zip(&twin.ratios).zip(expected).enumerate() {
            let place = [index as u32 % self.field.width, index as u32 / self.field.width].map(|i| i as f32);
            let expected = std::slice::from_ref(expected);
            comparison.item(&place, &[*got], expected);
            comparison.item(&place, &[*twin], expected);
            apart = apart.max(got / twin).max(twin / got);
        }
        let outcome = Outcome::of(kernel.len(), comparison, UNDECIDED_LIMIT);
        let note =
            format!("kernel and twin are apart by a factor of {apart:.4} at most, each within its bound");
        let reason = outcome.reason.clone().or((apart > 1.0).then_some(note));
        Ok(Outcome { reason, ..outcome })
    }
}
