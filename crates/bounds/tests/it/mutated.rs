//! Shaders of the corpus with a few tokens changed: what still parses and validates is evaluated over every domain, at random inputs and
//! at hard ones, and never panics. It may well end in an error: a budget, a size, something unsupported.

use crate::common::{FILES, source};
use bossage_bounds::ranges::{Inputs, Seed, Style};
use bossage_bounds::{Accept, Domain, Error, F32, F64, Limits, Program, Range, run_entry};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage};
use proptest::prelude::*;
use proptest::strategy::ValueTree;

/// Tokens that make trouble where another of their kind stood.
const NUMBERS: [&str; 16] = [
    "0",
    "1",
    "-1",
    "4000000000u",
    "2147483647",
    "-2147483648",
    "0u",
    "31u",
    "32u",
    "1e38",
    "-0.0",
    "1e-45",
    "0.5",
    "7",
    "3.0",
    "2u",
];
const OPERATORS: [&str; 12] = ["+", "-", "*", "/", "%", "<", ">", "&", "|", "^", "==", "!="];

/// A change of one place.
#[derive(Clone, Debug)]
enum Change {
    /// Another of its kind in its place: a hard number, an operator, a word of elsewhere.
    Replace(usize, usize),
    /// Without it.
    Drop(usize),
    /// A token of elsewhere in its place.
    Copy(usize, usize),
    /// The two exchanged.
    Swap(usize, usize),
    /// The statement up to the next semicolon once more.
    Repeat(usize),
}

fn change() -> impl Strategy<Value = Change> {
    let at = || 0..10_000usize;
    prop_oneof![
        12 => (at(), at()).prop_map(|(a, b)| Change::Replace(a, b)),
        1 => at().prop_map(Change::Drop),
        2 => (at(), at()).prop_map(|(a, b)| Change::Copy(a, b)),
        1 => (at(), at()).prop_map(|(a, b)| Change::Swap(a, b)),
        1 => at().prop_map(Change::Repeat),
    ]
}

/// Words and numbers in one piece, everything else by the character.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut in_word = false;
    for c in text.chars() {
        let word = c.is_alphanumeric() || c == '_' || c == '.';
        match tokens.last_mut() {
            Some(last) if word && in_word => last.push(c),
            _ => tokens.push(c.to_string()),
        }
        in_word = word;
    }
    tokens
}

/// A token of the same kind.
fn another(tokens: &[String], solid: &[usize], at: usize, with: usize) -> String {
    let first = |token: &str| token.chars().next().unwrap_or(' ');
    let token = &tokens[at];
    if first(token).is_numeric() {
        return NUMBERS[with % NUMBERS.len()].to_owned();
    }
    if OPERATORS.contains(&token.as_str()) {
        return OPERATORS[with % OPERATORS.len()].to_owned();
    }
    if !first(token).is_alphabetic() {
        return token.clone();
    }
    let words: Vec<&String> = solid
        .iter()
        .map(|&k| &tokens[k])
        .filter(|word| first(word).is_alphabetic())
        .collect();
    words[with % words.len()].clone()
}

fn changed(text: &str, changes: &[Change]) -> String {
    let mut tokens = tokens(text);
    // Only what means something is changed: words, numbers, operators.
    let solid: Vec<usize> = (0..tokens.len())
        .filter(|&k| !tokens[k].trim().is_empty())
        .collect();
    let place = |at: usize| solid[at % solid.len()];
    for change in changes {
        match *change {
            Change::Replace(at, with) => tokens[place(at)] = another(&tokens, &solid, place(at), with),
            Change::Drop(at) => tokens[place(at)].clear(),
            Change::Copy(at, from) => tokens[place(at)] = tokens[place(from)].clone(),
            Change::Swap(a, b) => tokens.swap(place(a), place(b)),
            Change::Repeat(at) => {
                let end = |from: usize| (from..tokens.len()).find(|&k| tokens[k] == ";");
                if let Some(start) = end(place(at))
                    && let Some(stop) = end(start + 1)
                {
                    let again = tokens[start + 1..=stop].concat();
                    tokens[stop].push_str(&again);
                }
            }
        }
    }
    tokens.concat()
}

fn valid(text: &str) -> Option<(Module, ModuleInfo)> {
    let module = naga::front::wgsl::parse_str(text).ok()?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .ok()?;
    Some((module, info))
}

pub(crate) fn run<D: Domain>(program: &Program, inputs: &Inputs, style: Style) -> Result<(), Error> {
    let mut seed = Seed::new(7);
    let point = inputs.sample(&mut seed, style);
    let quad = inputs.quad(&point, &mut seed);
    let (mut bindings, stage) = inputs.at::<D>(&quad.each_ref())?;
    let limits = Limits {
        operations: 1 << 15,
        memory: 1 << 28,
        ..Limits::default()
    };
    run_entry(program, &mut bindings, &stage, [1, 1, 1], &limits).map(drop)
}

/// Evaluates a module everywhere; whether it was valid, and whether some domain came to its end.
fn evaluate(text: &str) -> (bool, bool) {
    let Some((module, info)) = valid(text) else {
        return (false, false);
    };
    let mut ended = false;
    let stages = module.entry_points.iter().filter(|entry| {
        matches!(
            entry.stage,
            ShaderStage::Vertex | ShaderStage::Fragment | ShaderStage::Compute
        )
    });
    for entry in stages {
        let Ok(program) = Program::new(&module, &info, &entry.name) else {
            continue;
        };
        let Ok(inputs) = Inputs::new(&module, &info, &entry.name, None) else {
            continue;
        };
        for style in [Style::Random, Style::Edge, Style::Related] {
            ended |= run::<F32>(&program, &inputs, style).is_ok();
            ended |= run::<F64>(&program, &inputs, style).is_ok();
            ended |= run::<Accept>(&program, &inputs, style).is_ok();
            ended |= run::<Range>(&program, &inputs, style).is_ok();
        }
    }
    (true, ended)
}

proptest! {
    #![proptest_config(crate::common::cases(400))]

    #[test]
    fn changed_shaders_never_panic(file in 0..FILES.len(), changes in prop::collection::vec(change(), 1..3)) {
        evaluate(&changed(&source(FILES[file]), &changes));
    }
}

/// Control: enough of the changed shaders are valid, and run to their end, for the property to say something.
#[test]
fn many_changed_shaders_are_evaluated() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let strategy = (0..FILES.len(), prop::collection::vec(change(), 1..3));
    let outcomes: Vec<(bool, bool)> = (0..60)
        .map(|_| {
            let (file, changes) = strategy.new_tree(&mut runner).unwrap().current();
            evaluate(&changed(&source(FILES[file]), &changes))
        })
        .collect();
    let valid = outcomes.iter().filter(|(valid, _)| *valid).count();
    let ended = outcomes.iter().filter(|(_, ended)| *ended).count();
    assert!(
        valid >= 6 && ended >= 4,
        "{valid} of 60 are valid, {ended} ran to their end"
    );
}

#[test]
fn unchanged_text_comes_back() {
    for file in FILES {
        let text = source(file);
        assert_eq!(tokens(&text).concat(), text);
        assert!(evaluate(&text).0, "{file}");
    }
}
