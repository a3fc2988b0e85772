//! `frame_from_normal`: a tangent and a bitangent from the normal alone.
//!
//! Source: the first article, *Parallax Bump Mapping*: A = (n.y, −n.z, n.x), T = N × A, B = T × N. Hardened: Duff et al.,
//! *Building an Orthonormal Basis, Revisited*, JCGT 6(1), 2017, with the sign of zero taken as +1.
//!
//! Space: any; N is a unit vector and the results are in its space. Domain: unit vectors.
//!
//! Known faults of the published form:
//! - the article says that A never has the direction of N. A = c·N asks for n.y = c·n.x, −n.z = c·n.y, n.x = c·n.z, so
//!   c³ = −1: for N ∝ (−1, 1, 1) (and its opposite) A = −N and T = B = 0, which cannot be normalised;
//! - around that axis T is a difference of nearly equal products: in f32 its direction is rounding noise;
//! - |T| = |sin ∠(N, A)|: T and B are not unit vectors for nearly all N, and the article does not normalise them;
//! - B = T × N makes (N × T)·B = −|T|²: by the article's own rule, w = −1, where its texture-aligned frames have w = +1.
//!
//! [`hughes_moller`] and [`frisvad`] are here for comparison only.

use glam::DVec3;

use crate::frame_from_uv::Tangents;
use crate::vector::{normalize, sign_not_zero};

/// As published, lengths and all: T = N × A and B = T × N.
#[must_use]
pub fn published(n: DVec3) -> Tangents {
    let a = DVec3::new(n.y, -n.z, n.x);
    let tangent = n.cross(a);
    Tangents {
        tangent,
        bitangent: tangent.cross(n),
    }
}

/// As published, then both normalised as a shader has to: NaN on the axis (−1, 1, 1).
#[must_use]
pub fn published_unit(n: DVec3) -> Tangents {
    let Tangents { tangent, bitangent } = published(n);
    Tangents {
        tangent: normalize(tangent),
        bitangent: normalize(bitangent),
    }
}

/// Hardened: unit, orthogonal and right-handed (B = N × T, w = +1) for every unit vector.
#[must_use]
pub fn hardened(n: DVec3) -> Tangents {
    let s = sign_not_zero(n.z);
    // s + n.z is at least 1 in magnitude: nothing cancels.
    let rotation = 1.0 / (s + n.z);
    let shear = -n.x * n.y * rotation;
    Tangents {
        tangent: DVec3::new(1.0 - s * n.x * n.x * rotation, s * shear, -s * n.x),
        bitangent: DVec3::new(shear, s - n.y * n.y * rotation, -n.y),
    }
}

/// For comparison: Hughes and Möller, *Building an Orthonormal Basis from a Unit Vector*, 1999. Safe, but it branches,
/// takes a root, and turns by a quarter where |n.x| = |n.z|.
#[must_use]
pub fn hughes_moller(n: DVec3) -> Tangents {
    let across = if n.x.abs() > n.z.abs() {
        DVec3::new(-n.y, n.x, 0.0)
    } else {
        DVec3::new(0.0, -n.z, n.y)
    };
    let bitangent = normalize(across);
    Tangents {
        tangent: bitangent.cross(n),
        bitangent,
    }
}

/// Frisvad's threshold: below it the formula gives way to a constant frame.
pub const FRISVAD_THRESHOLD: f64 = -0.999_999_9;

/// For comparison: Frisvad, *Building an Orthonormal Basis from a 3D Unit Vector Without Normalization*, 2012. Near −z its
/// 1/(1 + n.z) magnifies rounding; below the threshold the constant frame is only as orthogonal as n is near −z.
#[must_use]
pub fn frisvad(n: DVec3) -> Tangents {
    if n.z < FRISVAD_THRESHOLD {
        return Tangents {
            tangent: DVec3::NEG_Y,
            bitangent: DVec3::NEG_X,
        };
    }
    let a = 1.0 / (1.0 + n.z);
    let b = -n.x * n.y * a;
    Tangents {
        tangent: DVec3::new(1.0 - n.x * n.x * a, b, -n.x),
        bitangent: DVec3::new(b, 1.0 - n.y * n.y * a, -n.y),
    }
}

/// How far (T, B, N) is from an orthonormal frame: the largest of | |T|−1 |, | |B|−1 |, |T·B|, |N·T|, |N·B|. NaN for a frame
/// that holds NaN.
#[must_use]
pub fn orthonormality_error(n: DVec3, frame: Tangents) -> f64 {
    let Tangents {
        tangent: t,
        bitangent: b,
    } = frame;
    let errors = [t.length() - 1.0, b.length() - 1.0, t.dot(b), n.dot(t), n.dot(b)];
    if errors.iter().any(|e| e.is_nan()) {
        return f64::NAN;
    }
    errors.iter().fold(0.0, |worst, e| e.abs().max(worst))
}

#[cfg(test)]
mod tests;
