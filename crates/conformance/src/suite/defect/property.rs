//! What should hold of an output where a defect breaks it.

/// `Ok` where it holds.
pub(super) fn ensure(holds: bool, otherwise: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(otherwise()) }
}

pub(super) fn finite(out: &[f32]) -> Result<(), String> {
    ensure(out.iter().all(|x| x.is_finite()), || format!("{out:?}"))
}

/// Light is not negative.
pub(super) fn not_negative(out: &[f32]) -> Result<(), String> {
    ensure(out.iter().all(|x| *x >= 0.0), || format!("{out:?}"))
}

/// A part of the light: neither less than none nor more than all.
pub(super) fn a_share(out: &[f32]) -> Result<(), String> {
    ensure(out.iter().all(|x| (0.0..=1.0).contains(x)), || {
        format!("a share of {out:?}")
    })
}

/// Level ground stays where it is.
pub(super) fn level(out: &[f32]) -> Result<(), String> {
    ensure(out.iter().all(|x| x.abs() < 1e-6), || {
        format!("level ground is shifted by {out:?}")
    })
}

/// A shift of at most one tile from the middle of the texture.
pub(super) fn within_a_tile(out: &[f32]) -> Result<(), String> {
    ensure(out.iter().all(|x| (x - 0.5).abs() <= 1.0), || {
        format!("uv {out:?}")
    })
}

/// Unit length to a part in 10⁵: f32 rounding leaves below 1e-6, the defects are off by 1 or NaN.
pub(super) fn unit(out: &[f32]) -> Result<(), String> {
    let length = out.iter().map(|x| x * x).sum::<f32>().sqrt();
    ensure((length - 1.0).abs() < 1e-5, || format!("length {length}"))
}

/// Tangent and bitangent unit, at right angles to each other and to the normal, to a part in 10⁵: f32 rounding leaves below
/// 1e-6, the defects are off by a tenth or more.
pub(super) fn orthonormal(normal: [f32; 3], out: &[f32]) -> Result<(), String> {
    let vector = |at: usize| [out[at], out[at + 1], out[at + 2]].map(f64::from);
    let (n, t, b) = (normal.map(f64::from), vector(0), vector(3));
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let errors = [
        dot(t, t).sqrt() - 1.0,
        dot(b, b).sqrt() - 1.0,
        dot(t, b),
        dot(n, t),
        dot(n, b),
    ];
    let sound = errors.iter().all(|error| error.abs() < 1e-5);
    ensure(sound, || {
        format!("|T| − 1, |B| − 1, T·B, N·T and N·B are {errors:.3?}")
    })
}
