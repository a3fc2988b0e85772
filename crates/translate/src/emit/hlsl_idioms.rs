//! Rewrites the idioms of naga's HLSL that only wgpu's Direct3D 12 back end can bind.
//!
//! **Sampler heap.** naga declares two heaps of 2048 samplers and, for each group, a buffer of indices into them:
//!
//! ```hlsl
//! SamplerState nagaSamplerHeap[2048]: register(s0, space0);
//! SamplerComparisonState nagaComparisonSamplerHeap[2048]: register(s0, space1);
//! StructuredBuffer<uint> nagaGroup0SamplerIndexArray : register(t0, space255);
//! static const SamplerState linear_sampler = nagaSamplerHeap[nagaGroup0SamplerIndexArray[1]];
//! ```
//!
//! which becomes `SamplerState linear_sampler : register(s1);`. These four line shapes are all that naga 30.0.1 writes for
//! samplers outside binding arrays (which are refused beforehand). Each is matched in full; if one does not match, or any
//! trace of a heap or an index buffer is left, that is an error and nothing is emitted.
//!
//! **`ConstantBuffer<T>`** is not in shader model 5.0; `ConstantBuffer<T> name: register(b0);` becomes
//! `cbuffer name_block : register(b0) { T name; }`.
//!
//! Only lines that may be of an idiom are looked at; the rest is copied as it is, so time and memory are linear in the text.

use std::collections::BTreeMap;

use super::hlsl_registers::Register;

const HEAP: &str = "nagaSamplerHeap";
const COMPARISON_HEAP: &str = "nagaComparisonSamplerHeap";

/// What to rewrite, and to what.
pub(super) struct Rewrite<'a> {
    /// The register of the sampler with this group and this index in the group's index buffer.
    pub(super) samplers: &'a BTreeMap<(u32, u32), Register>,
    /// The register space that naga was told to put the index buffers in; the register is the group.
    pub(super) index_buffer_space: u8,
    /// Whether `ConstantBuffer<T>` must go.
    pub(super) plain_constant_buffers: bool,
}

impl Rewrite<'_> {
    /// The text with plain samplers.
    pub(super) fn apply(&self, text: &str) -> Result<String, String> {
        let mut out = String::with_capacity(text.len());
        let mut index_buffers: BTreeMap<&str, u32> = BTreeMap::new();
        let mut declared = 0;
        let mut rest = text;
        while let Some((before, line, after)) = self.next_line(rest) {
            out.push_str(before);
            rest = after;
            if is_heap(line) {
                continue;
            }
            if let Some((name, group)) = self.index_buffer(line) {
                index_buffers.insert(name, group);
            } else if let Some(sampler) = Sampler::read(line) {
                let register = self.register(&sampler, &index_buffers)?;
                out.push_str(&format!(
                    "{} {} : register({register});\n",
                    sampler.ty, sampler.name
                ));
                declared += 1;
            } else if let Some(plain) = self.constant_buffer(line, text) {
                out.push_str(&plain);
            } else {
                check_traces(line, &index_buffers)?;
                out.push_str(line);
                out.push('\n');
            }
        }
        out.push_str(rest);
        if declared == self.samplers.len() {
            Ok(out)
        } else {
            Err(format!(
                "{declared} of {} samplers were declared",
                self.samplers.len()
            ))
        }
    }

    /// The next line that may have to be rewritten, without its end, and what stands before and after it. Every line of
    /// every idiom has `naga` in it, but for constant buffers.
    fn next_line<'t>(&self, text: &'t str) -> Option<(&'t str, &'t str, &'t str)> {
        let naga = text.find("naga");
        let constants = if self.plain_constant_buffers {
            text.find("ConstantBuffer<")
        } else {
            None
        };
        let at = match (naga, constants) {
            (Some(a), Some(b)) => a.min(b),
            (one, other) => one.or(other)?,
        };
        let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
        let end = text[at..].find('\n').map_or(text.len(), |newline| at + newline);
        let after = text.get(end + 1..).unwrap_or_default();
        Some((&text[..start], &text[start..end], after))
    }

    /// `StructuredBuffer<uint> NAME : register(tGROUP, spaceN);`
    fn index_buffer<'t>(&self, line: &'t str) -> Option<(&'t str, u32)> {
        let rest = line.strip_prefix("StructuredBuffer<uint> ")?;
        let (name, rest) = rest.split_once(" : register(t")?;
        let group = rest.strip_suffix(&format!(", space{});", self.index_buffer_space))?;
        Some((name, group.parse().ok()?))
    }

    fn register(
        &self,
        sampler: &Sampler<'_>,
        index_buffers: &BTreeMap<&str, u32>,
    ) -> Result<Register, String> {
        let group = index_buffers
            .get(sampler.index_buffer)
            .ok_or_else(|| format!("`{}` is read before it is declared", sampler.index_buffer))?;
        self.samplers
            .get(&(*group, sampler.index))
            .copied()
            .ok_or_else(|| format!("sampler `{}` has no register", sampler.name))
    }

    /// `ConstantBuffer<T> NAME: register(R);`
    fn constant_buffer(&self, line: &str, text: &str) -> Option<String> {
        if !self.plain_constant_buffers {
            return None;
        }
        let rest = line.strip_prefix("ConstantBuffer<")?;
        let (ty, rest) = rest.split_once("> ")?;
        let (name, rest) = rest.split_once(": register(")?;
        let register = rest.strip_suffix(");")?;
        let mut block = format!("{name}_block");
        while text.contains(&block) {
            block.push('_');
        }
        Some(format!(
            "cbuffer {block} : register({register}) {{ {ty} {name}; }}\n"
        ))
    }
}

/// Either line that declares a heap.
fn is_heap(line: &str) -> bool {
    let rest = line
        .strip_prefix("SamplerState nagaSamplerHeap[2048]: register(s")
        .or_else(|| line.strip_prefix("SamplerComparisonState nagaComparisonSamplerHeap[2048]: register(s"));
    rest.is_some_and(|rest| rest.ends_with(");"))
}

/// `static const TYPE NAME = HEAP[INDEX_BUFFER[INDEX]];`
struct Sampler<'t> {
    ty: &'t str,
    name: &'t str,
    index_buffer: &'t str,
    index: u32,
}

impl<'t> Sampler<'t> {
    fn read(line: &'t str) -> Option<Self> {
        let rest = line.strip_prefix("static const ")?;
        let (ty, rest) = rest.split_once(' ')?;
        let heap = match ty {
            "SamplerState" => HEAP,
            "SamplerComparisonState" => COMPARISON_HEAP,
            _ => return None,
        };
        let (name, rest) = rest.split_once(" = ")?;
        let rest = rest.strip_prefix(heap)?.strip_prefix('[')?;
        let (index_buffer, rest) = rest.split_once('[')?;
        let index = rest.strip_suffix("]];")?.parse().ok()?;
        Some(Self {
            ty,
            name,
            index_buffer,
            index,
        })
    }
}

/// No heap and no index buffer may be named in a line that stays.
fn check_traces(line: &str, index_buffers: &BTreeMap<&str, u32>) -> Result<(), String> {
    let trace = identifiers(line)
        .find(|word| *word == HEAP || *word == COMPARISON_HEAP || index_buffers.contains_key(word));
    match trace {
        None => Ok(()),
        Some(word) => Err(format!("`{word}` is used in an unknown way: {}", line.trim())),
    }
}

fn identifiers(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAGA: &str = "\
SamplerState nagaSamplerHeap[2048]: register(s0, space0);
SamplerComparisonState nagaComparisonSamplerHeap[2048]: register(s0, space1);
StructuredBuffer<uint> nagaGroup0SamplerIndexArray : register(t0, space255);
static const SamplerState linear_sampler = nagaSamplerHeap[nagaGroup0SamplerIndexArray[1]];
Texture2D<float4> color : register(t2);
StructuredBuffer<uint> nagaGroup3SamplerIndexArray : register(t3, space255);
static const SamplerComparisonState shadow = nagaComparisonSamplerHeap[nagaGroup3SamplerIndexArray[7]];
float4 f() { return color.Sample(linear_sampler, 0.0); }
";

    fn registers() -> BTreeMap<(u32, u32), Register> {
        let register = |number, space| Register {
            class: 's',
            number,
            space,
        };
        BTreeMap::from([((0, 1), register(1, 0)), ((3, 7), register(7, 3))])
    }

    fn rewrite(text: &str, plain_constant_buffers: bool) -> Result<String, String> {
        let samplers = registers();
        let rewrite = Rewrite {
            samplers: &samplers,
            index_buffer_space: 255,
            plain_constant_buffers,
        };
        rewrite.apply(text)
    }

    #[test]
    fn samplers_become_plain() {
        let expected = "\
SamplerState linear_sampler : register(s1);
Texture2D<float4> color : register(t2);
SamplerComparisonState shadow : register(s7, space3);
float4 f() { return color.Sample(linear_sampler, 0.0); }
";
        assert_eq!(rewrite(NAGA, false).unwrap(), expected);
    }

    #[test]
    fn a_use_of_the_heap_that_is_not_the_idiom_is_an_error() {
        let text = format!("{NAGA}float4 g() {{ return x.Sample(nagaSamplerHeap[2], 0.0); }}\n");
        let error = rewrite(&text, false).unwrap_err();
        assert!(
            error.contains("`nagaSamplerHeap` is used in an unknown way"),
            "{error}"
        );
    }

    #[test]
    fn a_use_of_an_index_buffer_that_is_not_the_idiom_is_an_error() {
        let text = format!("{NAGA}uint g() {{ return nagaGroup3SamplerIndexArray[0]; }}\n");
        assert!(
            rewrite(&text, false)
                .unwrap_err()
                .contains("nagaGroup3SamplerIndexArray")
        );
    }

    #[test]
    fn a_declaration_of_another_shape_is_an_error() {
        for (from, to) in [
            ("[2048]: register(s0, space0)", "[4096]: register(s0, space0)"),
            ("static const SamplerState linear", "const SamplerState linear"),
            ("IndexArray[1]]", "IndexArray[1 + 0]]"),
            ("(t0, space255)", "(t0, space254)"),
        ] {
            assert!(NAGA.contains(from));
            let changed = NAGA.replace(from, to);
            assert!(rewrite(&changed, false).is_err(), "{from} -> {to}");
        }
    }

    #[test]
    fn a_sampler_that_naga_did_not_declare_is_an_error() {
        let without = NAGA.replace(
            "static const SamplerState linear_sampler = nagaSamplerHeap[nagaGroup0SamplerIndexArray[1]];\n",
            "",
        );
        assert_eq!(
            rewrite(&without, false).unwrap_err(),
            "1 of 2 samplers were declared"
        );
    }

    #[test]
    fn names_that_only_look_alike_stay() {
        let text = format!("{NAGA}static uint nagaSamplerHeap_1 = 0u;\n");
        assert!(rewrite(&text, false).unwrap().contains("nagaSamplerHeap_1"));
    }

    #[test]
    fn constant_buffers_become_plain_where_asked() {
        let text = format!("{NAGA}ConstantBuffer<Push> push: register(b3);\n");
        assert!(
            rewrite(&text, true)
                .unwrap()
                .ends_with("cbuffer push_block : register(b3) { Push push; }\n")
        );
        assert!(
            rewrite(&text, false)
                .unwrap()
                .ends_with("ConstantBuffer<Push> push: register(b3);\n")
        );
    }
}
