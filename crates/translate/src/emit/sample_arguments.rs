//! Arguments of texture samples that naga 30.0.1 writes for two dimensions, whatever the texture has.
//!
//! - MSL: explicit gradients are always `metal::gradient2d(x, y)`. A cube wants `gradientcube`, a volume `gradient3d`.
//! - HLSL: an offset is always put into `int2(…)`. A volume wants `int3(…)`, a row `int(…)`.
//!
//! Every compiler of those languages refuses such a text. Here the word is set right by the type with which the texture is declared
//! in the text. A texture whose declaration is not found is an error, and nothing is emitted.
//!
//! naga gives each sample a statement of its own, so that a call never stands in another's arguments.

use std::collections::BTreeMap;

use naga::{Expression, ImageDimension, TypeInner};

use crate::ir;
use crate::shader::Unit;

/// What one language has wrong.
pub(super) struct Idiom {
    /// How the types of textures begin.
    types: &'static [&'static str],
    /// How the name of a sampling method begins, with its point.
    method: &'static str,
    /// How the argument begins, up to its bracket.
    wrong: &'static str,
    /// What stands there for a texture of this type, where it is another.
    right: fn(&str) -> Option<&'static str>,
}

/// Gradients in MSL.
pub(super) const MSL_GRADIENTS: Idiom = Idiom {
    types: &["metal::texture", "metal::depth"],
    method: ".sample",
    wrong: "metal::gradient2d",
    right: |ty| {
        let (_, dimensions) = ty.split_at_checked("metal::depth".len())?;
        if dimensions.contains("cube") {
            Some("metal::gradientcube")
        } else {
            dimensions.contains("3d").then_some("metal::gradient3d")
        }
    },
};

/// Offsets in HLSL.
pub(super) const HLSL_OFFSETS: Idiom = Idiom {
    types: &["Texture"],
    method: ".Sample",
    wrong: "int2",
    right: |ty| match ty {
        "Texture3D" => Some("int3"),
        "Texture1D" | "Texture1DArray" => Some("int"),
        _ => None,
    },
};

/// Whether a unit samples a texture that has not two dimensions, in such a way.
pub(super) fn occurs(unit: &Unit, wanted: impl Fn(&Expression) -> bool) -> bool {
    ir::functions(unit).any(|(function, info)| {
        function.expressions.iter().any(|(_, expression)| {
            let Expression::ImageSample { image, .. } = *expression else {
                return false;
            };
            let ty = info[image].ty.inner_with(&unit.module.types);
            wanted(expression)
                && !matches!(
                    ty,
                    TypeInner::Image {
                        dim: ImageDimension::D2,
                        ..
                    }
                )
        })
    })
}

impl Idiom {
    /// The text with the right words.
    pub(super) fn apply(&self, text: &str) -> Result<String, String> {
        let mut types: BTreeMap<&str, &str> = BTreeMap::new();
        let mut out = String::with_capacity(text.len());
        let mut copied = 0;
        for (at, _) in text.match_indices(['<', '(']) {
            if text[at..].starts_with('<') {
                types.extend(self.declaration(text, at));
            } else if let Some((receiver, wrong)) = self.call(text, at) {
                let ty = types.get(receiver).copied();
                let ty = ty.ok_or_else(|| format!("`{receiver}` is sampled before it is declared"))?;
                out.push_str(&text[copied..wrong]);
                out.push_str((self.right)(ty).unwrap_or(self.wrong));
                copied = wrong + self.wrong.len();
            }
        }
        out.push_str(&text[copied..]);
        Ok(out)
    }

    /// Name and type of the texture in whose type this bracket opens.
    fn declaration<'t>(&self, text: &'t str, bracket: usize) -> Option<(&'t str, &'t str)> {
        let before = &text[..bracket];
        let ty = &before[before.trim_end_matches(is_path).len()..];
        if !self.types.iter().any(|known| ty.starts_with(known)) {
            return None;
        }
        let rest = &text[closing(text, bracket)? + 1..];
        // An array of textures is a pointer to a wrapper of them in MSL.
        let rest = rest.trim_start_matches(['>', '*', ' ']);
        let name = &rest[..rest.len() - rest.trim_start_matches(is_word).len()];
        (!name.is_empty()).then_some((name, ty))
    }

    /// Where the call that opens with this bracket has the argument, and the texture that it samples.
    fn call<'t>(&self, text: &'t str, bracket: usize) -> Option<(&'t str, usize)> {
        let before = &text[..bracket];
        let method = before.trim_end_matches(is_word).len().checked_sub(1)?;
        if !text[method..].starts_with(self.method) {
            return None;
        }
        let found = arguments(text, bracket)?
            .into_iter()
            .map(|at| text.len() - text[at..].trim_start().len())
            .find(|&at| opens_with(&text[at..], self.wrong))?;
        Some((receiver(&text[..method]), found))
    }
}

/// Whether a text is such a word and then a bracket.
fn opens_with(text: &str, word: &str) -> bool {
    text.strip_prefix(word).is_some_and(|rest| rest.starts_with('('))
}

const fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_' || !c.is_ascii()
}

const fn is_path(c: char) -> bool {
    is_word(c) || c == ':'
}

/// The bracket that closes this one.
fn closing(text: &str, opening: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, c) in text[opening..].char_indices() {
        match c {
            '(' | '[' | '<' => depth += 1,
            ')' | ']' | '>' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(opening + at);
        }
    }
    None
}

/// Where each argument of a call begins. `<` and `>` compare there.
fn arguments(text: &str, opening: usize) -> Option<Vec<usize>> {
    let mut starts = vec![opening + 1];
    let mut depth = 0_usize;
    for (at, c) in text[opening..].char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' if depth == 1 => starts.push(opening + at + 1),
            _ => {}
        }
        if depth == 0 {
            return Some(starts);
        }
    }
    None
}

/// The variable at the end of a text, of which an element or a member may be taken.
fn receiver(text: &str) -> &str {
    let mut depth = 0_usize;
    let mut start = text.len();
    for (at, c) in text.char_indices().rev() {
        match c {
            ']' => depth += 1,
            '[' if depth > 0 => depth -= 1,
            '.' => {}
            c if is_word(c) || depth > 0 => {}
            _ => break,
        }
        start = at;
    }
    let whole = &text[start..];
    &whole[..whole.find(['.', '[']).unwrap_or(whole.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    const MSL: &str = "\
metal::float4 look(metal::texturecube<float, metal::access::sample> t, metal::sampler s) {
    metal::float4 _e5 = t.sample(s, d_1, metal::gradient2d(d_1.yzx, (a < b) ? d : e));
fragment f(metal::texture2d<float, metal::access::sample> plain [[texture(0)]]
, constant NagaArgumentBufferWrapper<metal::texture3d<float, metal::access::sample>>* fogs [[buffer(0)]]
, metal::texturecube_array<float, metal::access::sample> skies [[texture(2)]]
) {
    metal::float4 _e6 = plain.sample(s, d.xy, metal::gradient2d(x, y), metal::int2(1, 0));
    metal::float4 _e7 = fogs[a[1] + 1].inner.sample(s, d, metal::gradient2d(x, y));
    metal::float4 _e8 = skies.sample(s, d, 1, metal::gradient2d(f(x, y), y)) + _e7;
";

    #[test]
    fn gradients_are_those_of_the_texture() {
        let text = MSL_GRADIENTS.apply(MSL).unwrap();
        for right in [
            "t.sample(s, d_1, metal::gradientcube(d_1.yzx, (a < b) ? d : e))",
            "plain.sample(s, d.xy, metal::gradient2d(x, y), metal::int2(1, 0))",
            "fogs[a[1] + 1].inner.sample(s, d, metal::gradient3d(x, y))",
            "skies.sample(s, d, 1, metal::gradientcube(f(x, y), y)) + _e7",
        ] {
            assert!(text.contains(right), "{right}\n{text}");
        }
        assert_eq!(text.lines().count(), MSL.lines().count());
    }

    const HLSL: &str = "\
Texture3D<float4> fog : register(t0);
Texture2DArray<float4> layers : register(t1);
float4 look(Texture1D<float4> row, SamplerState s) {
    float4 _e5 = row.Sample(s, u, int2(int(1)));
    float4 _e6 = fog.SampleLevel(s, float3(int2(uv), 1.0), 0.0, int2(OFFSET));
    float4 _e7 = layers.SampleGrad(s, float3(uv, 1), x, y, int2(int2(int(1), int(0))));
    int2 place = int2(uv);
";

    #[test]
    fn offsets_are_those_of_the_texture() {
        let text = HLSL_OFFSETS.apply(HLSL).unwrap();
        for right in [
            "row.Sample(s, u, int(int(1)))",
            "fog.SampleLevel(s, float3(int2(uv), 1.0), 0.0, int3(OFFSET))",
            "layers.SampleGrad(s, float3(uv, 1), x, y, int2(int2(int(1), int(0))))",
            "int2 place = int2(uv);",
        ] {
            assert!(text.contains(right), "{right}\n{text}");
        }
    }

    #[test]
    fn a_texture_that_nothing_declares_is_an_error() {
        let unknown = MSL.replace("texturecube<", "picture<");
        let said = MSL_GRADIENTS.apply(&unknown).unwrap_err();
        assert_eq!(said, "`t` is sampled before it is declared");
        let without = unknown.replace("metal::gradient2d(d_1", "metal::level(d_1");
        assert!(MSL_GRADIENTS.apply(&without).is_ok());
    }
}
