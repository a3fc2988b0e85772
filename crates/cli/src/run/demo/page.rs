//! The demo's page: one file, no script, no font, no picture from elsewhere.
//!
//! Everything works by keyboard (links, `details`, and code blocks that take the focus to be scrolled). Colours follow the
//! reader's light or dark setting and never carry meaning alone.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use bossage_conformance::report::page::Page;
use bossage_scene::{Effect, MaterialPlan, State};
use bossage_translate::external::{CheckState, State as ToolState};
use bossage_translate::{Contents, EmittedFile, Target};
use maud::{Markup, PreEscaped, html};

use super::{Shot, Story};
use crate::error::Result;
use crate::machine;
use crate::run::{emit, plan};
use crate::translation::Translation;

const STYLE: &str = include_str!("style.css");

/// The whole page.
pub(super) fn write(story: &Story) -> Result<String> {
    let main = html! {
        (summary(story))
        (pictures(story))
        (plans(story))
        (code(story)?)
        (checks(story))
        (conformance(story))
    };
    let page = Page {
        title: "Bossage: a scene, end to end",
        style: STYLE,
        parts: &PARTS,
        main,
        script: "",
    };
    Ok(page.write())
}

const PARTS: [(&str, &str); 5] = [
    ("picture", "Picture"),
    ("plan", "Plan"),
    ("code", "Code"),
    ("checks", "Checks"),
    ("conformance", "Conformance"),
];

fn summary(story: &Story) -> Markup {
    let verdict = if story.is_fine() {
        "Nothing failed."
    } else {
        "Something failed: see below."
    };
    html! {
        p.verdict.(if story.is_fine() { "pass" } else { "fail" }) { (verdict) }
        @for one in &story.executed.conformance.environment.not_run {
            p.verdict.skip { "Route " code { (one.route) } @if let Some(adapter) = &one.adapter { " on " (adapter) } " is left out: " (one.reason) "." }
        }
        @if machine::is_embedded(&story.executed.machine) {
            p.verdict.skip { "There is no driver: the times below are those of our own evaluator, and say nothing about a GPU." }
        }
        dl.totals {
            div { dt { "permutations" } dd { (story.inputs.scenes.iter().map(|s| s.plan.permutations.len()).sum::<usize>()) } }
            div { dt { "shaders" } dd { (story.inputs.modules.len()) } }
            div { dt { "languages" } dd { (Target::ALL.len()) } }
            @for (name, time) in &story.times { div { dt { (name) } dd { (format!("{:.2} s", time.as_secs_f64())) } } }
        }
        p { "Tool: bossage " (env!("CARGO_PKG_VERSION")) ". The files named here lie beside this page." }
    }
}

fn pictures(story: &Story) -> Markup {
    html! {
        section #picture aria-labelledby="picture-heading" {
            h2 #picture-heading { "Picture" }
            p { "Drawn on " (story.executed.machine) "." }
            @for shot in &story.executed.pictures { (picture(shot)) }
        }
    }
}

fn picture(shot: &Shot) -> Markup {
    let data = format!("data:image/png;base64,{}", BASE64.encode(&shot.png));
    html! {
        figure {
            img src=(data) alt=(shot.caption);
            figcaption { strong { (shot.title) } " " (shot.caption) " File: " a href=(shot.file) { (shot.file) } }
        }
    }
}

fn plans(story: &Story) -> Markup {
    html! {
        section #plan aria-labelledby="plan-heading" {
            h2 #plan-heading { "Plan" }
            p { "Effects are derived from what the scene holds. A dropped effect leaves nothing in any shader." }
            @for planned in &story.inputs.scenes {
                p { "Scene: " code { (planned.scene.path.display()) } ". Wanted: " (planned.plan.wanted()) "." }
                @for material in &planned.plan.materials { (material_plan(material, &planned.plan.profile)) }
            }
        }
    }
}

fn material_plan(material: &MaterialPlan, profile: &str) -> Markup {
    html! {
        h3 { "Material " code { (material.name) } }
        p {
            "Technique " code { (material.drawn_by()) } " (" (material.technique_by) "), permutation "
            code { (material.permutation) } ". Predicted: " (plan::predicted(&material.predicted, profile)) "."
        }
        div.scroll tabindex="0" role="region" aria-label={ "Effects of " (material.name) } {
            table {
                thead { tr { th scope="col" { "effect" } th scope="col" { "state" } th scope="col" { "why" } th scope="col" { "evidence" } } }
                tbody { @for effect in &material.effects { (effect_row(effect)) } }
            }
        }
        @if let Some(choice) = &material.choice {
            ul { @for line in plan::alternatives(choice) { li { (line) } } }
        }
    }
}

fn effect_row(effect: &Effect) -> Markup {
    let (class, state) = match effect.state {
        State::Kept => ("pass", "kept"),
        State::Dropped => ("skip", "dropped"),
    };
    let evidence: Vec<String> = effect
        .evidence
        .iter()
        .map(|(name, fact)| format!("{name} = {}", plan::fact(fact)))
        .collect();
    html! {
        tr {
            th scope="row" { code { (effect.id.as_str()) } }
            td.(class) { (state) }
            td { (effect.reason) }
            td { (evidence.join(", ")) }
        }
    }
}

fn code(story: &Story) -> Result<Markup> {
    let mut modules = Vec::new();
    for (module, translation) in story.inputs.modules.iter().zip(&story.done.translations) {
        modules.push((module.name.as_str(), listings(translation)?));
    }
    Ok(html! {
        section #code aria-labelledby="code-heading" {
            h2 #code-heading { "Code" }
            p { "Everything that was emitted, each language in its own block; " a href={ "shaders/" (emit::MANIFEST) } { "manifest.json" } " says how to bind it." }
            @for (name, listings) in &modules {
                h3 { code { (name) } }
                @for listing in listings { (listing) }
            }
        }
    })
}

/// One block a file; the first is open.
fn listings(translation: &Translation) -> Result<Vec<Markup>> {
    let mut blocks = Vec::new();
    for emitted in &translation.emitted {
        for file in &emitted.files {
            blocks.push(listing(emitted.target, file, emitted.target == Target::Wgsl)?);
        }
    }
    for (target, diagnostic) in &translation.failures {
        blocks
            .push(html! { div.fail { p { (target) " cannot express this shader:" } pre { (diagnostic) } } });
    }
    Ok(blocks)
}

fn listing(target: Target, file: &EmittedFile, open: bool) -> Result<Markup> {
    let (name, text) = match &file.contents {
        Contents::Text(text) => (file.file_name.clone(), text.clone()),
        Contents::Binary(bytes) => (
            format!("{}asm", file.file_name),
            emit::listing(&file.file_name, bytes)?,
        ),
    };
    let lines = text.lines().count();
    Ok(html! {
        details open[open] {
            summary { (title(target)) span.note { (lines) " lines, " (file.contents.bytes().len()) " bytes" } }
            p { a href={ "shaders/" (name) } { (name) } ", entry point " code { (file.entry_point) } }
            pre.code tabindex="0" aria-label={ (title(target)) " of " (file.entry) } { code { (PreEscaped(numbered(&text))) } }
        }
    })
}

const fn title(target: Target) -> &'static str {
    match target {
        Target::Spirv => "SPIR-V",
        Target::Hlsl => "HLSL",
        Target::Msl => "MSL",
        Target::Glsl => "GLSL",
        Target::Wgsl => "WGSL",
    }
}

/// Each line in an element of its own, which the style sheet numbers: numbers are not selected with the text.
fn numbered(text: &str) -> String {
    let mut out = String::new();
    for line in text.lines() {
        let _ = writeln!(
            out,
            "<span class=\"line\">{}</span>",
            html! { (line) }.into_string()
        );
    }
    out
}

fn checks(story: &Story) -> Markup {
    html! {
        section #checks aria-labelledby="checks-heading" {
            h2 #checks-heading { "Checks" }
            ul {
                @for validator in &story.validators {
                    li {
                        code { (validator.tool) } " "
                        @match validator.state {
                            ToolState::Enabled => { strong { "ENABLED" } " " (validator.version.as_deref().unwrap_or_default()) }
                            ToolState::Disabled => { strong { "DISABLED" } ": " (validator.reason.as_deref().unwrap_or_default()) }
                        }
                    }
                }
            }
            div.scroll tabindex="0" role="region" aria-label="Checks by language" { (check_table(story)) }
            @if story.check.lints.is_empty() { p { "Lints: none." } } @else {
                h3 { "Lints" }
                ul { @for lint in &story.check.lints { li { code { (lint.lint.rule) } " " (lint.lint.message) } } }
            }
        }
    }
}

fn check_table(story: &Story) -> Markup {
    html! {
        table {
            thead { tr { th scope="col" { "language" } th scope="col" { "file" } th scope="col" { "tool" } th scope="col" { "verdict" } th scope="col" { "message" } } }
            tbody {
                @for (target, report) in &story.check.targets {
                    @if report.checks.is_empty() {
                        tr { th scope="row" { (target) } td { "all" } td { "none" } td.skip { "not checked" } td { "no external tool for this language" } }
                    }
                    @for check in &report.checks {
                        tr {
                            th scope="row" { (target) }
                            td { code { (check.file) } }
                            td { (check.tool) }
                            td.(class(check.state)) { (class(check.state)) }
                            td { (check.message.lines().next().unwrap_or_default()) }
                        }
                    }
                }
            }
        }
    }
}

const fn class(state: CheckState) -> &'static str {
    match state {
        CheckState::Pass => "pass",
        CheckState::Fail => "fail",
        CheckState::Skip => "skip",
    }
}

fn conformance(story: &Story) -> Markup {
    html! {
        section #conformance aria-labelledby="conformance-heading" {
            h2 #conformance-heading { "Conformance" }
            p { "The scene and every technique in its shaders, executed and compared with float64 truth." }
            (PreEscaped(bossage_conformance::report::html::fragment(&story.executed.conformance)))
        }
    }
}
