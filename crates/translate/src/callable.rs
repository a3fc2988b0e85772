//! An entry point as a function that another one may call.
//!
//! What a vertex stage returns goes to the rasteriser, which hides it; and what a fragment stage returns fits only some targets. To see all of
//! it, an entry point is turned into a plain function of the same text: its stage attribute and the bindings in its head become spaces, so
//! every line and column stays. Members of structs keep theirs, which means nothing there. The body is not touched.

use std::ops::Range;

use crate::diagnostic::{Code, Diagnostic};
use crate::ir;
use crate::shader::Shader;
use crate::source::Language;

/// A shader whose entry point is a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Callable {
    /// The WGSL, to which an entry point that calls the function may be added.
    pub text: String,
    function: String,
    arguments: Vec<Argument>,
    outputs: Vec<String>,
}

/// An argument of the function.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Argument {
    /// An input by itself.
    One,
    /// A struct of so many inputs.
    Struct(String, usize),
}

impl Callable {
    /// Turns an entry point of a WGSL shader into a function.
    ///
    /// # Errors
    /// For other languages and names, and where the function's head is not found in the text.
    pub fn new(shader: &Shader, entry: &str) -> Result<Self, Diagnostic> {
        let refuse = |message: String| Diagnostic::new(Code::Unsupported, message).in_file(shader.name());
        if shader.language() != Language::Wgsl {
            return Err(refuse(
                "only an entry point in WGSL becomes a function".to_owned(),
            ));
        }
        let unit = shader.units().iter().find(|unit| unit.entry().name == entry);
        let unit = unit.ok_or_else(|| refuse(format!("there is no entry point `{entry}`")))?;
        let head = head(shader.text(), entry)
            .ok_or_else(|| refuse(format!("the head of `{entry}` is not found")))?;
        let module = &unit.module;
        let argument = |argument: &naga::FunctionArgument| match &module.types[argument.ty] {
            naga::Type {
                name: Some(name),
                inner: naga::TypeInner::Struct { members, .. },
            } => Argument::Struct(name.clone(), members.len()),
            _ => Argument::One,
        };
        let is_bound = unit
            .entry()
            .function
            .result
            .as_ref()
            .is_some_and(|result| result.binding.is_some());
        let member = |(name, ..): (String, _, _)| {
            if is_bound {
                String::new()
            } else {
                format!(".{name}")
            }
        };
        Ok(Self {
            text: without_attributes(shader.text(), head),
            function: entry.to_owned(),
            arguments: unit.entry().function.arguments.iter().map(argument).collect(),
            outputs: ir::interface(unit, true).into_iter().map(member).collect(),
        })
    }

    /// A call with an expression for each input, in the order of the manifest's inputs.
    #[must_use]
    pub fn call(&self, inputs: &[String]) -> String {
        let mut rest = inputs.iter().cloned();
        let mut next = |n: usize| rest.by_ref().take(n).collect::<Vec<_>>().join(", ");
        let arguments: Vec<String> = self
            .arguments
            .iter()
            .map(|argument| match argument {
                Argument::One => next(1),
                Argument::Struct(name, members) => format!("{name}({})", next(*members)),
            })
            .collect();
        format!("{}({})", self.function, arguments.join(", "))
    }

    /// Each output of a call, in the order of the manifest's outputs; `result` names what the call returned.
    #[must_use]
    pub fn outputs(&self, result: &str) -> Vec<String> {
        self.outputs
            .iter()
            .map(|member| format!("{result}{member}"))
            .collect()
    }
}

/// From the end of the declaration before the function to its body.
fn head(text: &str, function: &str) -> Option<Range<usize>> {
    let tokens: Vec<Range<usize>> = tokens(text).collect();
    let word = |at: usize| tokens.get(at).map_or("", |range| &text[range.clone()]);
    let at =
        (0..tokens.len()).find(|&at| word(at) == "fn" && word(at + 1) == function && word(at + 2) == "(")?;
    let before = (0..at).rev().find(|&k| matches!(word(k), "}" | ";"));
    let body = (at..tokens.len()).find(|&k| word(k) == "{")?;
    Some(before.map_or(0, |k| tokens[k].end)..tokens[body].start)
}

/// The text with every attribute in that range blanked.
fn without_attributes(text: &str, head: Range<usize>) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let tokens: Vec<Range<usize>> = tokens(text).filter(|token| head.contains(&token.start)).collect();
    let word = |at: usize| tokens.get(at).map_or("", |range| &text[range.clone()]);
    let mut at = 0;
    while at < tokens.len() {
        if word(at) != "@" {
            at += 1;
            continue;
        }
        let mut last = at + 1;
        if word(last + 1) == "(" {
            let mut depth = 0;
            for k in last + 1..tokens.len() {
                depth += i32::from(word(k) == "(") - i32::from(word(k) == ")");
                last = k;
                if depth == 0 {
                    break;
                }
            }
        }
        let end = tokens.get(last).map_or(head.end, |token| token.end);
        for byte in &mut bytes[tokens[at].start..end] {
            if !byte.is_ascii_whitespace() {
                *byte = b' ';
            }
        }
        at = last + 1;
    }
    // Whole tokens were replaced by as many spaces, so what was UTF-8 still is.
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Words and single signs, without comments, which may be nested.
fn tokens(text: &str) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut at = 0;
    std::iter::from_fn(move || {
        loop {
            let rest = text.get(at..).filter(|rest| !rest.is_empty())?;
            if rest.starts_with("//") {
                at += rest.find('\n').unwrap_or(rest.len());
            } else if rest.starts_with("/*") {
                at += comment(rest);
            } else {
                let length = |of: &dyn Fn(char) -> bool| rest.find(|c| !of(c)).unwrap_or(rest.len());
                let blank = length(&char::is_whitespace);
                if blank > 0 {
                    at += blank;
                    continue;
                }
                let word = length(&|c| c.is_alphanumeric() || c == '_');
                let sign = rest.chars().next().map_or(1, char::len_utf8);
                let start = at;
                at += word.max(sign);
                return Some(start..at);
            }
        }
    })
}

/// The length of the block comment that a text begins with.
fn comment(text: &str) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        if rest.starts_with("/*") {
            depth += 1;
            at += 2;
        } else if rest.starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;

    const TEXT: &str = "
// @vertex fn main( in a comment
struct In { @location(0) place: vec3f, @builtin(vertex_index) index: u32 }
struct Out { @builtin(position) clip: vec4f, @location(0) @interpolate(flat) index: u32 }
fn other(x: f32) -> f32 { return x; }
@vertex /* nested /* comment */ é */
fn main(in: In, @location(1) /* é */ weight : f32) -> Out {
    return Out(vec4f(in.place * other(weight), 1.0), in.index);
}
@fragment fn colour(@builtin(position) at: vec4f) -> @location(0) vec4f { return at; }";

    fn parsed(text: &str) -> Shader {
        Shader::parse("a.wgsl", &Source::Wgsl(text.to_owned())).unwrap()
    }

    #[test]
    fn a_vertex_stage_is_called_by_another_one() {
        let callable = Callable::new(&parsed(TEXT), "main").unwrap();
        assert_eq!(callable.text.len(), TEXT.len());
        assert_eq!(callable.text.find("é */ weight"), TEXT.find("é */ weight"));
        let call = callable.call(&["vec3f()", "7u", "2.0"].map(str::to_owned));
        assert_eq!(call, "main(In(vec3f(), 7u), 2.0)");
        assert_eq!(callable.outputs("got"), ["got.clip", "got.index"]);
        let caller = format!(
            "{}\n@vertex fn caller() -> @builtin(position) vec4f {{ let got = {call}; return got.clip; }}",
            callable.text
        );
        let called = parsed(&caller);
        let entries: Vec<_> = called.entry_points().map(|(name, _)| name.to_owned()).collect();
        assert_eq!(entries, ["colour", "caller"]);
    }

    #[test]
    fn a_bare_result_is_the_call_itself() {
        let callable = Callable::new(&parsed(TEXT), "colour").unwrap();
        assert_eq!(callable.outputs("got"), ["got"]);
        let caller = format!(
            "{}\n@fragment fn caller() -> @location(0) vec4f {{ return {}; }}",
            callable.text,
            callable.call(&["vec4f()".to_owned()])
        );
        parsed(&caller);
        assert!(Callable::new(&parsed(TEXT), "colours").is_err());
    }
}
