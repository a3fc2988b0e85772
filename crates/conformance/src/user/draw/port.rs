//! What goes into or out of a stage, and how it is written as four words of 32 bits.

use bossage_bounds::{Scalar, Slot};
use bossage_translate::manifest::Varying;

/// What one component is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Component {
    F32,
    F16,
    I32,
    U32,
    Bool,
}

/// An input or output of a stage: a scalar or a vector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Port {
    /// As reports call it.
    pub(crate) name: String,
    pub(crate) slot: Slot,
    pub(crate) component: Component,
    pub(crate) components: usize,
    /// The type in WGSL's words.
    ty: String,
    /// Its attributes in WGSL.
    attributes: String,
    /// Whether it has the value of one vertex everywhere.
    pub(crate) is_flat: bool,
}

impl Port {
    /// What the manifest says of a value.
    ///
    /// # Errors
    /// When it is of a kind that is not passed on here.
    pub(super) fn new(varying: &Varying) -> Result<Self, String> {
        let (component, components) = shape(&varying.ty).ok_or_else(|| {
            format!(
                "{} is of type {}, which is not passed on here",
                said(varying),
                varying.ty
            )
        })?;
        let slot = slot(varying).ok_or_else(|| format!("{} is not passed on here", said(varying)))?;
        let interpolation = varying.interpolation.as_deref();
        let attributes = match (varying.location, varying.builtin.as_deref()) {
            (Some(location), _) => {
                let parts: Vec<&str> = [interpolation, varying.sampling.as_deref()]
                    .into_iter()
                    .flatten()
                    .collect();
                match parts.is_empty() {
                    true => format!("@location({location})"),
                    false => format!("@location({location}) @interpolate({})", parts.join(", ")),
                }
            }
            (None, Some(builtin)) => format!("@builtin({builtin})"),
            (None, None) => String::new(),
        };
        Ok(Self {
            name: said(varying),
            slot,
            component,
            components,
            ty: varying.ty.clone(),
            attributes,
            is_flat: varying.location.is_none()
                || interpolation == Some("flat")
                || component != Component::F32,
        })
    }

    /// Whether it has a location.
    pub(super) fn is_located(&self) -> bool {
        matches!(self.slot, Slot::Location(..))
    }

    /// A declaration with its attributes.
    pub(super) fn declared(&self, name: &str) -> String {
        format!("{} {name}: {}", self.attributes, self.ty)
    }

    /// Whether a target keeps it as it is, and of which scalars.
    pub(super) fn target(&self) -> Option<Component> {
        let whole = self.components == 4 && matches!(self.slot, Slot::Location(_, 0));
        let kept = matches!(self.component, Component::F32 | Component::I32 | Component::U32);
        (whole && kept).then_some(self.component)
    }

    /// WGSL: the value in four words.
    pub(super) fn unpacked(&self, words: &str) -> String {
        let part = &words_of(self.components);
        let bits = format!("{words}.{part}");
        let as_type = |scalar: &str| match self.components {
            1 => format!("bitcast<{scalar}>({bits})"),
            n => format!("bitcast<vec{n}<{scalar}>>({bits})"),
        };
        match self.component {
            Component::F32 => as_type("f32"),
            Component::I32 => as_type("i32"),
            Component::U32 => bits,
            Component::F16 => format!("{}({})", self.ty, as_type("f32")),
            Component::Bool => format!("{bits} != {}", self.zero()),
        }
    }

    fn zero(&self) -> String {
        match self.components {
            1 => "0u".to_owned(),
            n => format!("vec{n}<u32>()"),
        }
    }

    /// WGSL: a value as four words.
    pub(super) fn packed(&self, value: &str) -> String {
        let of = |scalar: &str| match self.components {
            1 => scalar.to_owned(),
            n => format!("vec{n}<{scalar}>"),
        };
        let bits = match self.component {
            Component::U32 => value.to_owned(),
            Component::F32 | Component::I32 => format!("bitcast<{}>({value})", of("u32")),
            Component::F16 => format!("bitcast<{}>({}({value}))", of("u32"), of("f32")),
            Component::Bool => format!("{}({value})", of("u32")),
        };
        let padding = ", 0u".repeat(4 - self.components);
        format!("vec4<u32>({bits}{padding})")
    }

    /// A number as the word that [`Port::unpacked`] reads.
    pub(super) fn word(&self, x: f64) -> u32 {
        match self.component {
            Component::F32 | Component::F16 => (x as f32).to_bits(),
            Component::I32 => x as i32 as u32,
            Component::U32 => x as u32,
            Component::Bool => u32::from(x >= 0.5),
        }
    }

    /// A word that came back, as a scalar of a machine.
    pub(super) fn scalar(&self, word: u32) -> Scalar<bossage_bounds::F32> {
        let int = |n: i128| Scalar::Int(n, n);
        match self.component {
            Component::F32 | Component::F16 => Scalar::Float(f64::from(f32::from_bits(word))),
            Component::I32 => int(i128::from(word as i32)),
            Component::U32 => int(i128::from(word)),
            Component::Bool => Scalar::Bool(bossage_bounds::Truth::from_bool(word != 0)),
        }
    }
}

fn words_of(components: usize) -> &'static str {
    ["x", "xy", "xyz", "xyzw"][components.clamp(1, 4) - 1]
}

/// A type of 16 or 32 bits a component.
fn shape(ty: &str) -> Option<(Component, usize)> {
    let (components, scalar) = match ty.strip_prefix("vec") {
        None => (1, ty),
        Some(rest) => {
            let (n, scalar) = rest.split_at_checked(1)?;
            (n.parse().ok()?, scalar.trim_matches(['<', '>']))
        }
    };
    let component = match scalar {
        "f32" | "f" => Component::F32,
        "f16" | "h" => Component::F16,
        "i32" | "i" => Component::I32,
        "u32" | "u" => Component::U32,
        "bool" => Component::Bool,
        _ => return None,
    };
    (1..=4).contains(&components).then_some((component, components))
}

fn slot(varying: &Varying) -> Option<Slot> {
    if let Some(location) = varying.location {
        return Some(Slot::Location(location, varying.blend_src.unwrap_or(0)));
    }
    // "position, invariant" is a position.
    let builtin = varying.builtin.as_deref()?;
    Some(match builtin.split(',').next().unwrap_or(builtin) {
        "position" => Slot::Position,
        "vertex_index" => Slot::VertexIndex,
        "instance_index" => Slot::InstanceIndex,
        "front_facing" => Slot::FrontFacing,
        "sample_index" => Slot::SampleIndex,
        "sample_mask" => Slot::SampleMask,
        "frag_depth" => Slot::FragDepth,
        "point_size" => Slot::PointSize,
        _ => return None,
    })
}

/// How a report calls a value: by its name, else by its place.
fn said(varying: &Varying) -> String {
    match (&varying.name, varying.location, &varying.builtin) {
        (name, ..) if !name.is_empty() => name.clone(),
        (_, Some(location), _) => format!("location({location})"),
        (_, None, Some(builtin)) => builtin.clone(),
        (_, None, None) => "result".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_read_in_both_spellings() {
        assert_eq!(shape("f32"), Some((Component::F32, 1)));
        assert_eq!(shape("vec3<f16>"), Some((Component::F16, 3)));
        assert_eq!(shape("vec2u"), Some((Component::U32, 2)));
        assert_eq!(shape("vec4<bool>"), Some((Component::Bool, 4)));
        for other in ["f64", "mat2x2<f32>", "array<f32, 2>", "vec5f", "vec", ""] {
            assert_eq!(shape(other), None, "{other}");
        }
    }
}
