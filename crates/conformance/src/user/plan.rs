//! What is run of a shader: its entry points, each with its inputs from their ranges.

use bossage_bounds::Error as BoundsError;
use bossage_bounds::ranges::{Declared, Inputs};
use bossage_translate::{Shader, Stage};

use super::Options;
use super::ready::Ready;
use crate::case::with_causes;
use crate::case_id::CaseId;
use crate::error::Error;

/// One entry point.
#[derive(Debug)]
pub struct Plan {
    /// The shader's name.
    pub shader: String,
    /// The entry point's name.
    pub entry: String,
    seed: u64,
    inputs: usize,
    /// Ready to run, or why it cannot be.
    pub(crate) ready: Result<Ready, String>,
}

impl Plan {
    /// The name of a case of this entry point.
    #[must_use]
    pub fn id(&self, generator: &str) -> CaseId {
        let id = CaseId::new(&self.shader, None, generator).with("entry", &self.entry);
        if generator == "corpus" {
            return id.with("n", self.replayed());
        }
        id.with("n", self.inputs).with("seed", self.seed)
    }

    /// The names of all its cases.
    #[must_use]
    pub fn ids(&self) -> Vec<CaseId> {
        let corpus = (self.replayed() > 0).then(|| self.id("corpus"));
        let others = [self.id("ranges"), self.id("agreement")];
        others.into_iter().chain(corpus).collect()
    }

    fn replayed(&self) -> usize {
        self.ready.as_ref().map_or(0, |ready| ready.replayed)
    }
}

/// The entry points that are asked for. One that cannot be run is planned with the reason, if another can be.
pub(crate) fn plans(
    shader: &Shader,
    declared: Option<&Declared>,
    options: &Options,
) -> Result<Vec<Plan>, Error> {
    let all: Vec<(String, Stage)> = shader
        .entry_points()
        .map(|(name, stage)| (name.to_owned(), stage))
        .collect();
    let asked = |(name, _): &&(String, Stage)| options.entry.as_ref().is_none_or(|wanted| wanted == name);
    let chosen: Vec<&(String, Stage)> = all.iter().filter(asked).collect();
    let none = |problem: &str| Error::NoEntryPoint {
        shader: shader.name().to_owned(),
        problem: problem.to_owned(),
        known: all
            .iter()
            .map(|(name, stage)| format!("{name} ({stage})"))
            .collect(),
    };
    if let (Some(wanted), true) = (&options.entry, chosen.is_empty()) {
        return Err(none(&format!("has no entry point `{wanted}`")));
    }
    if chosen.is_empty() {
        return Err(none("has no entry point"));
    }
    let is_overridden = declared.is_some_and(|declared| !declared.overrides().is_empty());
    let mut known = Vec::new();
    let mut plans = Vec::new();
    for (entry, stage) in &all {
        let inputs = inputs(shader, entry, declared)?;
        if let Ok(inputs) = &inputs {
            known.push(inputs.clone());
        }
        if chosen.iter().any(|(name, _)| name == entry) {
            let mut ready =
                inputs.and_then(|inputs| Ready::new(shader, entry, *stage, inputs, is_overridden, options));
            if let Ok(ready) = &mut ready {
                ready.check_size(shader.name())?;
                if let Some(corpus) = &options.corpus {
                    ready.replay(corpus.points(entry, &ready.inputs)?);
                }
            }
            plans.push(Plan {
                shader: stem(shader.name()),
                entry: entry.clone(),
                seed: options.seed,
                inputs: options.inputs,
                ready,
            });
        }
    }
    if let Some(corpus) = &options.corpus {
        let names: Vec<String> = all.iter().map(|(name, _)| name.clone()).collect();
        corpus.check(&names)?;
    }
    if let Some(declared) = declared {
        declared
            .check(&known)
            .map_err(|report| Error::Ranges(BoundsError::Ranges(report)))?;
    }
    Ok(plans)
}

/// The inputs of an entry point; ranges that do not fit are the caller's mistake, what the evaluator leaves out is a reason.
fn inputs(
    shader: &Shader,
    entry: &str,
    declared: Option<&Declared>,
) -> Result<Result<Inputs, String>, Error> {
    let Some((module, info)) = shader.module(entry) else {
        return Ok(Err(format!("`{entry}` has no module of its own")));
    };
    match Inputs::new(module, info, entry, declared) {
        Ok(inputs) => Ok(Ok(inputs)),
        Err(error @ BoundsError::Ranges(_)) => Err(Error::Ranges(error)),
        Err(error) => Ok(Err(format!(
            "inputs of `{entry}` cannot be chosen: {}",
            with_causes(&error)
        ))),
    }
}

/// The last part of a path, without its extension: what cases are called.
fn stem(name: &str) -> String {
    let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
    file.split('.').next().unwrap_or(file).to_owned()
}

#[cfg(test)]
mod tests {
    use super::stem;

    #[test]
    fn cases_are_called_after_the_file() {
        assert_eq!(stem("a/b/water.comp.glsl"), "water");
        assert_eq!(stem("water"), "water");
    }
}
