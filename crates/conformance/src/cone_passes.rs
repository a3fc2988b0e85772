//! The passes of the kernels that bake cones (`shaders/entry/cone_map.wesl`): cells, a pyramid over them level by level, the search, the
//! ratios. Whoever calls says how a pass is run; what passes hand on is kept here.

use bossage_assets::{EdgeMode, HeightField};
use bossage_runner::{BufferData, ComputeOutput};
use bossage_shaders::Kernel;

/// One pass.
#[derive(Clone, Debug)]
pub struct Pass<'a> {
    /// The kernel.
    pub kernel: Kernel,
    /// Its uniforms by name.
    pub uniforms: Vec<(String, Vec<f32>)>,
    /// What it reads and writes.
    pub buffers: Vec<(&'static str, BufferData<'a>)>,
    /// How many invocations are needed along each axis.
    pub invocations: [u32; 3],
}

/// What is baked.
struct Bake<'a> {
    field: &'a HeightField,
    edge: EdgeMode,
    relaxed: bool,
}

/// The ratios of a field's cones, as the kernels bake them: free ones, or `relaxed`.
///
/// # Errors
/// Those of `run`.
pub fn ratios<E>(
    field: &HeightField,
    edge: EdgeMode,
    relaxed: bool,
    mut run: impl FnMut(Pass<'_>) -> Result<ComputeOutput, E>,
) -> Result<Vec<f32>, E> {
    let bake = Bake { field, edge, relaxed };
    let heights: Vec<u8> = field.texels.iter().flat_map(|h| h.to_le_bytes()).collect();
    let given = ("heights", BufferData::Bytes(&heights));
    let (slopes, peaks) = bake.pyramid(given, &mut run)?;
    let count = field.texels.len();
    let buffers = vec![
        given,
        ("slopes", BufferData::Bytes(&slopes)),
        ("peaks", BufferData::Bytes(&peaks)),
        ("steepest", BufferData::Output(4 * count)),
    ];
    let mut found = run(bake.pass(Kernel::ConesSearch, 0, buffers))?.buffers;
    let steepest = found.remove("steepest").unwrap_or_default();
    let buffers = vec![
        ("steepest", BufferData::Bytes(&steepest)),
        ("ratios", BufferData::Output(4 * count)),
    ];
    Ok(run(bake.pass(Kernel::ConesRatios, 0, buffers))?.floats("ratios"))
}

impl Bake<'_> {
    /// Slopes and peaks of all levels, one behind the other.
    fn pyramid<E>(
        &self,
        given: (&'static str, BufferData<'_>),
        run: &mut impl FnMut(Pass<'_>) -> Result<ComputeOutput, E>,
    ) -> Result<(Vec<u8>, Vec<u8>), E> {
        let mut last = run(self.pass(Kernel::ConesCells, 0, self.with_level(vec![given], 0)))?.buffers;
        let (mut slopes, mut peaks) = (Vec::new(), Vec::new());
        for level in 1.. {
            let below_slopes = last.remove("level_slopes").unwrap_or_default();
            let below_peaks = last.remove("level_peaks").unwrap_or_default();
            slopes.extend_from_slice(&below_slopes);
            peaks.extend_from_slice(&below_peaks);
            if self.level_size(level - 1) == [1, 1] {
                break;
            }
            let below = vec![
                given,
                ("slopes", BufferData::Bytes(&below_slopes)),
                ("peaks", BufferData::Bytes(&below_peaks)),
            ];
            let buffers = self.with_level(below, level);
            last = run(self.pass(Kernel::ConesAbove, level, buffers))?.buffers;
        }
        Ok((slopes, peaks))
    }

    /// The buffers, and those that a level is written to.
    fn with_level<'b>(
        &self,
        mut buffers: Vec<(&'static str, BufferData<'b>)>,
        level: u32,
    ) -> Vec<(&'static str, BufferData<'b>)> {
        let [width, height] = self.level_size(level);
        let nodes = (width * height) as usize;
        buffers.push(("level_slopes", BufferData::Output(16 * nodes)));
        buffers.push(("level_peaks", BufferData::Output(8 * nodes)));
        buffers
    }

    fn pass<'b>(&self, kernel: Kernel, level: u32, buffers: Vec<(&'static str, BufferData<'b>)>) -> Pass<'b> {
        let [width, height] = self.level_size(level);
        Pass {
            kernel,
            uniforms: self.uniforms(level),
            buffers,
            invocations: [width, height, 1],
        }
    }

    /// Columns and rows of a level.
    fn level_size(&self, level: u32) -> [u32; 2] {
        [self.field.width, self.field.height].map(|side| side.div_ceil(1 << level))
    }

    fn uniforms(&self, level: u32) -> Vec<(String, Vec<f32>)> {
        let edge = match self.edge {
            EdgeMode::Wrap => 0.0,
            EdgeMode::Mirror => 1.0,
            EdgeMode::Clamp => 2.0,
        };
        let size = vec![self.field.width as f32, self.field.height as f32];
        vec![
            ("bake.size".to_owned(), size),
            ("bake.edge_mode".to_owned(), vec![edge]),
            ("bake.rule".to_owned(), vec![f32::from(u8::from(self.relaxed))]),
            ("bake.level".to_owned(), vec![level as f32]),
        ]
    }
}
