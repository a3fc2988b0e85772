//! The domain of a field, by its role: what brings any numbers into it. The same domains as those from which `random` draws.
//!
//! Roles whose values depend on each other in ways that a number of their own cannot keep (maps and transforms) are not mended: they are
//! drawn, and taken over whole.

use bossage_shaders::{Field, Role};

/// Whether single numbers of the field may change.
pub(super) fn is_free(field: &Field) -> bool {
    !matches!(field.role, Role::Matrix | Role::Rigid)
}

/// Brings the values of a field into its domain.
pub(super) fn mend(field: &Field, values: &mut [f64]) {
    let each = |values: &mut [f64], lo: f64, hi: f64| {
        for x in values {
            *x = single(if x.is_nan() { lo } else { x.clamp(lo, hi) });
        }
    };
    let whole = |values: &mut [f64], lo: f64, hi: f64| {
        for x in values {
            *x = if x.is_nan() { lo } else { x.round().clamp(lo, hi) };
        }
    };
    let one_of = |values: &mut [f64], low: f64, high: f64| {
        for x in values {
            *x = if *x < f64::midpoint(low, high) { low } else { high };
        }
    };
    let most = 120_f64.exp2();
    match field.role {
        Role::Vector => each(values, -most, most),
        Role::Unit => unit(values),
        Role::MapNormal => map_normal(values),
        Role::Tangent => {
            if let [direction @ .., sign] = values {
                unit(direction);
                *sign = if *sign < 0.0 { -1.0 } else { 1.0 };
            }
        }
        Role::Unorm | Role::Height => each(values, 0.0, 1.0),
        Role::Snorm | Role::Cosine | Role::UvEdge => each(values, -1.0, 1.0),
        Role::Scale => each(values, -0.5, 0.5),
        Role::Slope => each(values, -64.0, 64.0),
        Role::Weight => each(values, 0.125, 256.0),
        Role::Elevation => each(values, -0.1, 0.1),
        Role::Uv => each(values, -8.0, 8.0),
        Role::Edge => each(values, -1024.0, 1024.0),
        Role::Position => each(values, -256.0, 256.0),
        Role::Colour => each(values, 0.0, 4.0),
        Role::Exponent => each(values, 0.25, 4096.0),
        Role::Gain => each(values, 0.0, 64.0),
        Role::Length => each(values, 1.0 / 256.0, 256.0),
        Role::Layer => {
            if let [scale, bias, v_factor] = values {
                each(std::slice::from_mut(scale), 0.0, 0.5);
                each(std::slice::from_mut(bias), -0.5, 0.5);
                each(std::slice::from_mut(v_factor), 0.125, 8.0);
            }
        }
        Role::Above => each(values, -1.0, -1.0 / 65_536.0),
        Role::Sign => one_of(values, -1.0, 1.0),
        Role::SnormOne => one_of(values, 127.0, 32_767.0),
        Role::UnormOne => one_of(values, 255.0, 65_535.0),
        Role::Codec => one_of(values, 0.0, 1.0),
        Role::Byte => whole(values, 0.0, 255.0),
        Role::Index => whole(values, -70_000.0, 70_000.0),
        Role::Size => whole(values, 1.0, 16_384.0),
        Role::Texel => whole(values, 0.0, 16_383.0),
        Role::Face => whole(values, 0.0, 5.0),
        Role::EdgeMode => whole(values, 0.0, 2.0),
        Role::SnormCode => whole(values, -32_768.0, 32_767.0),
        Role::UnormCode => whole(values, 0.0, 65_535.0),
        Role::Matrix | Role::Rigid | Role::Output | Role::Direction => {}
    }
}

fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

/// Length one to rounding; what is so already stays as it is, bit for bit.
fn unit(values: &mut [f64]) {
    let squared: f64 = values.iter().map(|x| x * x).sum();
    if (squared - 1.0).abs() < 1e-6 {
        return;
    }
    let length = squared.sqrt();
    if length > 0.0 && length.is_finite() {
        values.iter_mut().for_each(|x| *x = single(*x / length));
    } else if let [first, rest @ ..] = values {
        *first = 1.0;
        rest.fill(0.0);
    }
}

/// Upward, of a length that real maps hold.
fn map_normal(values: &mut [f64]) {
    if let Some(z) = values.last_mut() {
        *z = z.abs();
    }
    let length = values.iter().map(|x| x * x).sum::<f64>().sqrt();
    let wanted = length.clamp(0.11, 1.5);
    if length > 0.0 && length.is_finite() {
        if wanted != length {
            values.iter_mut().for_each(|x| *x = single(*x * wanted / length));
        }
    } else if let [rest @ .., z] = values {
        rest.fill(0.0);
        *z = 1.0;
    }
}

#[cfg(test)]
mod tests {
    use bossage_shaders::PROBES;

    use super::{is_free, mend};
    use crate::generate::random;

    /// What `random` draws is in the domain already.
    #[test]
    fn domains_are_those_of_the_generator() {
        for probe in PROBES {
            for item in random::generate(probe, 50, 0, 1).items() {
                let mut at = 0;
                for field in probe.inputs {
                    let n = field.shape.floats();
                    let values: Vec<f64> = item[at..at + n].iter().map(|x| f64::from(*x)).collect();
                    let mut mended = values.clone();
                    mend(field, &mut mended);
                    assert!(
                        !is_free(field)
                            || values
                                .iter()
                                .zip(&mended)
                                .all(|(a, b)| (a - b).abs() <= 1e-6 * a.abs()),
                        "{} of {}: {values:?} became {mended:?}",
                        field.name,
                        probe.id
                    );
                    at += n;
                }
            }
        }
    }

    #[test]
    fn anything_is_brought_in() {
        for probe in PROBES {
            for field in probe.inputs.iter().filter(|field| is_free(field)) {
                for wild in [f64::NAN, 1e300, -1e300, 0.0, -0.4] {
                    let mut once = vec![wild; field.shape.floats()];
                    mend(field, &mut once);
                    assert!(once.iter().all(|x| x.is_finite()), "{}: {once:?}", field.name);
                }
            }
        }
    }
}
