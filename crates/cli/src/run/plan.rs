//! `bossage plan`: what a scene calls for, as a table or as JSON.

use std::fmt::Write;

use bossage_scene::{Candidate, Choice, Effect, Fact, MaterialPlan, Plan, Predicted, State};
use bossage_shaders::{Library, Stage};

use crate::Verdict;
use crate::args::{Global, plan};
use crate::console;
use crate::error::Result;
use crate::inputs;

pub(crate) fn run(args: &plan::Plan, global: &Global) -> Result<Verdict> {
    let (library, _) = inputs::library(global)?;
    let scene = bossage_scene::load(&args.scene)?;
    let mut plan = bossage_scene::plan(&scene);
    add_costs(&mut plan, &library)?;
    if args.json {
        console::print_json(&plan)?;
    } else {
        console::print(&table(&plan))?;
    }
    Ok(Verdict::Fine)
}

/// Fills in what each permutation's fragment stages do: operations and texture fetches a pixel, of both passes where there are
/// two.
pub(crate) fn add_costs(plan: &mut Plan, library: &Library) -> Result<()> {
    for permutation in plan.permutations.clone() {
        let fragments = permutation
            .features
            .stages()
            .iter()
            .filter(|stage| **stage != Stage::Vertex);
        let (mut ops, mut fetches) = (0, 0);
        for stage in fragments {
            let assembled = library.assemble_surface(&permutation.features, *stage)?;
            let cost = inputs::entry(&assembled)?.cost;
            ops += cost.ops;
            fetches += cost.samples + cost.texture_loads;
        }
        plan.set_cost(&permutation.name, ops, fetches);
    }
    Ok(())
}

/// The plan for people.
pub(crate) fn table(plan: &Plan) -> String {
    let mut text = format!("{}: wanted: {}\n", plan.scene.display(), plan.wanted());
    for material in &plan.materials {
        text.push_str(&of_material(material, plan));
    }
    let (count, materials) = (plan.permutations.len(), plan.materials.len());
    let _ = writeln!(text, "\n{count} permutation(s) for {materials} material(s)");
    text
}

fn of_material(material: &MaterialPlan, plan: &Plan) -> String {
    let name = console::heading(format_args!("material {}", material.name));
    let mut text = format!(
        "\n{name}: technique {} ({}), shading {} ({})\n",
        material.drawn_by(),
        material.technique_by,
        material.shading,
        material.shading_by
    );
    let _ = writeln!(text, "  permutation {}", material.permutation);
    for effect in &material.effects {
        text.push_str(&of_effect(effect));
    }
    let _ = writeln!(
        text,
        "  predicted: {}",
        predicted(&material.predicted, &plan.profile)
    );
    for line in material.choice.iter().flat_map(alternatives) {
        let _ = writeln!(text, "  {line}");
    }
    text
}

/// What else could have been had: whether the budget is met, the runner-up, and what less and more would buy.
pub(crate) fn alternatives(choice: &Choice) -> Vec<String> {
    let mut lines = Vec::new();
    if !choice.meets_budget {
        lines.push("budget not met: this is the best of all candidates that may be used".to_owned());
    }
    let mut add = |what: &str, candidate: &Option<Candidate>| {
        lines.extend(candidate.as_ref().map(|it| format!("{what}: {it}")));
    };
    add("runner-up", &choice.runner_up);
    add("less budget buys", &choice.cheaper);
    add("more budget buys", &choice.more_accurate);
    lines
}

fn of_effect(effect: &Effect) -> String {
    let state = match effect.state {
        State::Kept => console::good("kept   "),
        State::Dropped => console::faint("dropped"),
    };
    let evidence: Vec<String> = effect
        .evidence
        .iter()
        .map(|(name, value)| format!("{name} = {}", fact(value)))
        .collect();
    let mut text = format!("  {state}  {:15}  {}\n", effect.id.as_str(), effect.reason);
    if !evidence.is_empty() {
        let _ = writeln!(text, "{:28}{}", "", evidence.join(", "));
    }
    text
}

/// A fact in words; numbers with four significant digits.
pub(crate) fn fact(fact: &Fact) -> String {
    match fact {
        Fact::Count(count) => count.to_string(),
        Fact::Number(number) => short(*number),
        Fact::Numbers(numbers) if !numbers.is_empty() => {
            numbers.iter().copied().map(short).collect::<Vec<_>>().join(" ")
        }
        Fact::Names(names) if !names.is_empty() => names.join(" "),
        Fact::Numbers(_) | Fact::Names(_) => "none".to_owned(),
        Fact::Text(text) => text.clone(),
    }
}

/// Four significant digits, without trailing zeros.
pub(crate) fn short(number: f64) -> String {
    let magnitude = number.abs();
    if number == 0.0 || !number.is_finite() {
        return number.to_string();
    }
    if !(1e-3..1e6).contains(&magnitude) {
        return format!("{number:.3e}");
    }
    let decimals = (3 - magnitude.log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{number:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// The prediction in words; what is not known is left out.
pub(crate) fn predicted(predicted: &Predicted, profile: &str) -> String {
    let mut parts = Vec::new();
    parts.extend(
        predicted
            .error_px_p99
            .map(|error| format!("{} px of error", short(error))),
    );
    parts.extend(
        predicted
            .error_texels_p99
            .map(|error| format!("{} texels (99 % of pixels)", short(error))),
    );
    parts.extend(
        predicted
            .time_ms
            .map(|time| format!("{} ms of relief on {profile}", short(time))),
    );
    parts.extend(predicted.ops.map(|ops| format!("{ops} operations")));
    parts.extend(
        predicted
            .fetches
            .map(|fetches| format!("{fetches} fetches a pixel")),
    );
    if parts.is_empty() {
        "nothing of it is seen".to_owned()
    } else {
        parts.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_short_and_keep_four_digits() {
        let cases = [
            (0.0, "0"),
            (0.5, "0.5"),
            (-0.012_345, "-0.01235"),
            (123.456, "123.5"),
            (99_999.0, "99999"),
            (1e-9, "1.000e-9"),
            (2.5e7, "2.500e7"),
            (100.0, "100"),
        ];
        for (number, text) in cases {
            assert_eq!(short(number), text);
        }
    }
}
