//! `height_to_normal`: the hardened bake. Central differences, true wrap, mirror or clamp, no flat border.
//!
//! Red holds the slope along u (columns), green along v (growing rows), blue the rest, alpha the height. The surface is
//! z = scale·h over a tile of 1 by 1 UV units, so dz/du = scale·(h(x+1) − h(x−1))·width/2 and the same down the rows; the
//! error falls with the square of the sampling distance.
//!
//! Operation order in f32. The compute kernel does the same operations in the same order, each rounded by itself (nothing
//! contracted into fused multiply-adds), which makes the bytes equal wherever `+ − × ÷ sqrt` are correctly rounded:
//! ```text
//! slope_u = (scale_u * f32(width)) * 0.5        slope_v = (scale_v * f32(height)) * 0.5     (on the CPU, handed to the kernel)
//! gx = (h(x+1, y) - h(x-1, y)) * slope_u        gy = (h(x, y+1) - h(x, y-1)) * slope_v
//! q  = (gx*gx + gy*gy) + 1                      r  = 1 / sqrt(q)
//! red   = trunc((-gx*r)*k + o)    green = trunc((-gy*r)*k + o)    blue = trunc(r*k + o)
//! alpha = trunc(h(x, y)*255 + 0.5)
//! (k, o) = (127.5, 128) for codec_unorm, (127, 128.5) for codec_biased: the nearest byte
//! ```
//! [`Kernel::Forward`] reads h(x, y) in the place of h(x-1, y) and h(x, y-1), and leaves out the factor 0.5.
//!
//! No clamp is needed: |n| ≤ 1 + 3·2⁻²⁴, so the sums stay in [0.49, 255.6]. Slopes beyond [`MAX_SLOPE`] are refused, so that
//! q cannot overflow.

use glam::Vec3;
use rayon::prelude::*;

use crate::truncate::to_byte_range;
use crate::{EdgeMode, Error, HeightField, NormalCodec, NormalMap};

/// Steepest factor a bake accepts: its square times two stays far below the largest f32.
pub const MAX_SLOPE: f32 = 1.0e9;

/// How the gradient is estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Kernel {
    /// (h(x+1) − h(x−1))/2: second order.
    #[default]
    Central,
    /// h(x+1) − h(x): first order. The hardened form of `height_to_normal_forward`: true neighbours, axes in order.
    Forward,
}

/// What to bake.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bake {
    /// How the gradient is estimated.
    pub kernel: Kernel,
    /// What lies beyond the border.
    pub edge: EdgeMode,
    /// How components become bytes.
    pub codec: NormalCodec,
    /// Slope along u and along v for a height difference of 1 between the two texels that are read: `scale·side/2`
    /// for [`Kernel::Central`], `scale·side` for [`Kernel::Forward`].
    pub slope: [f32; 2],
}

impl Bake {
    /// Central differences for a field whose elevation is `height_scale`·h, given in UV units along u and along v. The two
    /// are equal for square tiles; a tile of 2 m by 1 m and 0.1 m of relief has [0.05, 0.1].
    ///
    /// # Errors
    /// [`Error::Parameter`] when a scale is not finite or too steep.
    pub fn central(
        field: &HeightField,
        height_scale: [f32; 2],
        edge: EdgeMode,
        codec: NormalCodec,
    ) -> Result<Self, Error> {
        Self::differences(Kernel::Central, 0.5, field, height_scale, edge, codec)
    }

    /// Forward differences; the rest as [`Bake::central`].
    ///
    /// # Errors
    /// [`Error::Parameter`] when a scale is not finite or too steep.
    pub fn forward(
        field: &HeightField,
        height_scale: [f32; 2],
        edge: EdgeMode,
        codec: NormalCodec,
    ) -> Result<Self, Error> {
        Self::differences(Kernel::Forward, 1.0, field, height_scale, edge, codec)
    }

    fn differences(
        kernel: Kernel,
        share: f32,
        field: &HeightField,
        height_scale: [f32; 2],
        edge: EdgeMode,
        codec: NormalCodec,
    ) -> Result<Self, Error> {
        let slope = [
            (height_scale[0] * field.width as f32) * share,
            (height_scale[1] * field.height as f32) * share,
        ];
        match slope.iter().find(|s| !s.is_finite() || s.abs() > MAX_SLOPE) {
            Some(s) => Err(Error::Parameter {
                parameter: "height scale times side",
                value: s.to_string(),
                expected: "finite and at most 1e9",
            }),
            None => Ok(Bake {
                kernel,
                edge,
                codec,
                slope,
            }),
        }
    }

    /// (k, o) of the module's formula: byte = trunc(n·k + o).
    #[must_use]
    pub fn byte_scale_offset(&self) -> [f32; 2] {
        match self.codec {
            NormalCodec::Unorm => [127.5, 128.0],
            NormalCodec::Biased => [127.0, 128.5],
        }
    }
}

/// Bakes a normal map, rows in parallel. The result does not depend on the number of threads.
///
/// # Panics
/// When the field's list does not fit its sides, which its constructors rule out.
#[must_use]
pub fn bake(field: &HeightField, bake: &Bake) -> NormalMap {
    let mut texels = vec![[0; 4]; field.texels.len()];
    bake_into(field, bake, &mut texels).expect("as many texels as heights");
    NormalMap {
        width: field.width,
        height: field.height,
        codec: bake.codec,
        texels,
    }
}

/// The normals that [`bake()`] writes, before they become bytes: for encodings that are not linear. Row by row, in the order of the
/// module's operations.
#[must_use]
pub fn normals(field: &HeightField, bake: &Bake) -> Vec<Vec3> {
    let height = |x: i64, y: i64| {
        let (x, y) = (
            bake.edge.resolve(x, field.width),
            bake.edge.resolve(y, field.height),
        );
        field.texel(x, y)
    };
    let first = match bake.kernel {
        Kernel::Central => -1,
        Kernel::Forward => 0,
    };
    let normal = |index: u32| {
        let (x, y) = (i64::from(index % field.width), i64::from(index / field.width));
        let gx = (height(x + 1, y) - height(x + first, y)) * bake.slope[0];
        let gy = (height(x, y + 1) - height(x, y + first)) * bake.slope[1];
        let r = 1.0 / ((gx * gx + gy * gy) + 1.0).sqrt();
        Vec3::new(-gx * r, -gy * r, r)
    };
    (0..field.width * field.height)
        .into_par_iter()
        .map(normal)
        .collect()
}

/// As [`bake()`], into texels that are there already: a large map that is baked again and again costs no fresh memory.
///
/// # Errors
/// [`Error::TexelCount`] when `texels`, or the field's own list, does not fit the field's sides.
pub fn bake_into(field: &HeightField, bake: &Bake, texels: &mut [[u8; 4]]) -> Result<(), Error> {
    let width = field.width as usize;
    let expected = width * field.height as usize;
    for found in [field.texels.len(), texels.len()] {
        if found != expected {
            let (width, height) = (field.width, field.height);
            return Err(Error::TexelCount {
                what: "normal map",
                width,
                height,
                expected,
                found,
            });
        }
    }
    let row_at = |y: i64| &field.texels[bake.edge.resolve(y, field.height) as usize * width..][..width];
    texels
        .par_chunks_mut(width.max(1))
        .enumerate()
        .for_each(|(y, out)| {
            let y = y as i64;
            let rows = Rows {
                above: row_at(y - 1),
                mid: row_at(y),
                below: row_at(y + 1),
            };
            match bake.kernel {
                Kernel::Central => difference_row(out, &rows, bake, 0),
                Kernel::Forward => difference_row(out, &rows, bake, 1),
            }
        });
    Ok(())
}

/// The rows a 3x3 kernel sees.
struct Rows<'a> {
    above: &'a [f32],
    mid: &'a [f32],
    below: &'a [f32],
}

/// Difference kernels of two texels an axis: central ones take their first texel before, forward ones here.
fn difference_row(out: &mut [[u8; 4]], rows: &Rows<'_>, bake: &Bake, first: usize) {
    let encoder = Encoder {
        slope: bake.slope,
        byte: bake.byte_scale_offset(),
    };
    let (width, mid) = (out.len(), rows.mid);
    let before = if first == 0 { rows.above } else { mid };
    let border = |x: usize| {
        let column = |i: i64| mid[bake.edge.resolve(i, width as u32) as usize];
        let (left, right) = (column((x + first) as i64 - 1), column(x as i64 + 1));
        encoder.texel(right - left, rows.below[x] - before[x], mid[x])
    };
    out[0] = border(0);
    out[width - 1] = border(width - 1);
    if width > 2 {
        let inner = 1..width - 1;
        let across = [
            &mid[first..],
            &mid[2..],
            &before[inner.clone()],
            &rows.below[inner.clone()],
        ];
        encoder.interior(&mut out[inner.clone()], &mid[inner], across);
    }
}

#[derive(Clone, Copy)]
struct Encoder {
    slope: [f32; 2],
    byte: [f32; 2],
}

impl Encoder {
    /// The hot loop: equal-length slices, no branches, no bounds checks, so that it becomes vector code.
    fn interior(self, out: &mut [[u8; 4]], here: &[f32], [left, right, before, after]: [&[f32]; 4]) {
        let n = out.len();
        let (left, here, right) = (&left[..n], &here[..n], &right[..n]);
        let (before, after) = (&before[..n], &after[..n]);
        for x in 0..n {
            out[x] = self.texel(right[x] - left[x], after[x] - before[x], here[x]);
        }
    }

    #[inline(always)]
    fn texel(self, dx: f32, dy: f32, h: f32) -> [u8; 4] {
        let [k, o] = self.byte;
        let gx = dx * self.slope[0];
        let gy = dy * self.slope[1];
        let q = (gx * gx + gy * gy) + 1.0;
        let r = 1.0 / q.sqrt();
        let red = to_byte_range((-gx * r) * k + o);
        let green = to_byte_range((-gy * r) * k + o);
        let blue = to_byte_range(r * k + o);
        let alpha = to_byte_range(h * 255.0 + 0.5);
        (red | green << 8 | blue << 16 | alpha << 24).to_le_bytes()
    }
}
