//! The library's f32 functions in another arithmetic: the same text with other types.

use std::fmt;

use bossage_shaders::AssembledShader;

/// A floating-point format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Real {
    F16,
    F32,
    F64,
}

impl Real {
    pub(super) const ALL: [Self; 3] = [Self::F16, Self::F32, Self::F64];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::F16 => "f16",
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }

    pub(super) const fn bytes(self) -> usize {
        match self {
            Self::F16 => 2,
            Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The smallest normal number, which guards compare with.
    const fn smallest_normal(self) -> &'static str {
        match self {
            Self::F16 => "6.103515625e-5",
            Self::F32 => F32_SMALLEST_NORMAL,
            Self::F64 => "2.2250738585072014e-308",
        }
    }

    const fn enable(self) -> &'static str {
        match self {
            Self::F16 => "enable f16;\n",
            Self::F32 | Self::F64 => "",
        }
    }
}

impl fmt::Display for Real {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// As `lib/normalise.wesl` writes it.
const F32_SMALLEST_NORMAL: &str = "1.17549435e-38";

/// The module with every f32 taken for a `real`, and `harness` behind it, in which `real` is that name. `None` where the text does not
/// have the guard whose constant is to be changed.
pub(super) fn retyped(assembled: &AssembledShader, harness: &str, real: Real) -> Option<AssembledShader> {
    let functions = &assembled.wgsl;
    if !functions.contains(F32_SMALLEST_NORMAL) {
        return None;
    }
    let functions = words(functions, |word| match word {
        "f32" => Some(real.name().to_owned()),
        "vec2f" | "vec3f" | "vec4f" => Some(format!("{}<{real}>", &word[..4])),
        _ => None,
    });
    let functions = functions.replace(F32_SMALLEST_NORMAL, real.smallest_normal());
    let harness = words(harness, |word| (word == "real").then(|| real.name().to_owned()));
    Some(AssembledShader {
        name: format!("{}_{real}", assembled.name),
        wgsl: format!("{}{functions}\n{harness}", real.enable()),
        ..assembled.clone()
    })
}

/// The text with some of its words replaced.
fn words(text: &str, replace: impl Fn(&str) -> Option<String>) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(is_of_a_word) {
        let (before, from) = rest.split_at(start);
        let end = from.find(|c| !is_of_a_word(c)).unwrap_or(from.len());
        let (word, after) = from.split_at(end);
        out.push_str(before);
        out.push_str(replace(word).as_deref().unwrap_or(word));
        rest = after;
    }
    out.push_str(rest);
    out
}

fn is_of_a_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_words_are_replaced_and_no_parts() {
        let text = words("f32 xf32 f32_ vec3f(f32(1)) f32", |word| {
            (word == "f32").then(|| "f16".to_owned())
        });
        assert_eq!(text, "f16 xf32 f32_ vec3f(f16(1)) f16");
    }

    #[test]
    fn types_and_the_guard_change_together() {
        let assembled = AssembledShader {
            name: "half".to_owned(),
            wgsl:
                "const SMALLEST_NORMAL: f32 = 1.17549435e-38;\nfn half(v: vec3f) -> f32 { return 0.5 * v.x; }"
                    .to_owned(),
            features: Vec::new(),
            modules: Vec::new(),
        };
        let double = retyped(&assembled, "var<private> a: real;", Real::F64).unwrap();
        assert_eq!(double.name, "half_f64");
        assert_eq!(
            double.wgsl,
            "const SMALLEST_NORMAL: f64 = 2.2250738585072014e-308;\nfn half(v: vec3<f64>) -> f64 { return 0.5 * v.x; }\n\
             var<private> a: f64;"
        );
        let without = AssembledShader {
            wgsl: "fn half(x: f32) -> f32 { return 0.5 * x; }".to_owned(),
            ..assembled
        };
        assert_eq!(retyped(&without, "", Real::F64), None);
    }
}
