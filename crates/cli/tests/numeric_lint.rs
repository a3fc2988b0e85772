//! `bossage check` and numbers: findings with place, caret and witness; sidecars of input ranges, right and wrong.

mod tool;

use std::fs;
use std::path::PathBuf;

use tempfile::TempDir;
use tool::{bossage, text};

const SHADER: &str = "\
@group(0) @binding(0) var<uniform> light: vec3f;
fn toward(v: vec3f) -> vec3f {
    return normalize(v);
}
@fragment fn main(@location(0) position: vec3f) -> @location(0) vec4f {
    return vec4f(toward(light - position), 1.0);
}
";

struct Folder(TempDir);

impl Folder {
    fn new(sidecar: Option<&str>) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        fs::write(folder.path("a.wgsl"), SHADER).unwrap();
        if let Some(sidecar) = sidecar {
            fs::write(
                folder.path("a.ranges.toml"),
                format!("schema = 1\n[ranges]\n{sidecar}\n"),
            )
            .unwrap();
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn lints(&self, more: &[&str]) -> Vec<serde_json::Value> {
        let (shader, cache) = (self.path("a.wgsl"), self.path("cache"));
        let mut arguments = vec!["check", text(&shader), "--json", "--cache", text(&cache)];
        arguments.extend(more);
        let report: serde_json::Value = serde_json::from_str(&bossage(&arguments).exits(0).stdout).unwrap();
        report["inputs"][0]["lints"].as_array().unwrap().clone()
    }
}

#[test]
fn a_finding_has_its_place_and_a_witness_that_does_it() {
    let folder = Folder::new(None);
    let lints = folder.lints(&[]);
    let found = lints
        .iter()
        .find(|l| l["rule"] == "normalise_zero")
        .expect("light may be where the surface is");
    assert_eq!(
        (found["line"].as_u64(), found["column"].as_u64()),
        (Some(3), Some(12))
    );
    assert_eq!(found["severity"], "warning");
    assert!(
        found["message"].as_str().unwrap().contains("in `toward`"),
        "{found}"
    );
    assert!(found["file"].as_str().unwrap().ends_with("a.wgsl"));
    let inputs = &found["witness"]["inputs"];
    let vector = |name: &str| -> Vec<f32> {
        let list = inputs[name].as_array().unwrap_or_else(|| panic!("{inputs}"));
        list.iter().map(|x| x.as_f64().unwrap() as f32).collect()
    };
    let (light, position) = (vector("light"), vector("position"));
    let squared: f32 = light.iter().zip(&position).map(|(l, p)| (l - p) * (l - p)).sum();
    assert_eq!(squared, 0.0, "the witness does it");
}

#[test]
fn the_text_shows_line_and_caret() {
    let folder = Folder::new(None);
    let (shader, cache) = (folder.path("a.wgsl"), folder.path("cache"));
    let run = bossage(&["check", text(&shader), "--cache", text(&cache)]).exits(0);
    for word in [
        "a.wgsl:3:12",
        "return normalize(v);",
        "^^^^^^^^^",
        "[normalise_zero]",
        "witness: position = ",
    ] {
        assert!(run.stdout.contains(word), "{word:?} is not in:\n{}", run.stdout);
    }
}

#[test]
fn a_sidecar_that_keeps_the_light_away_leaves_nothing_to_find() {
    let apart = "light = { lo = 5, hi = 9 }\nposition = { lo = -1, hi = 1 }";
    assert!(Folder::new(Some(apart)).lints(&[]).is_empty());
    let near = "light = { lo = 0, hi = 9 }\nposition = { lo = -1, hi = 1 }";
    assert!(!Folder::new(Some(near)).lints(&[]).is_empty(), "negative control");
}

#[test]
fn a_sidecar_may_be_named_and_the_lint_left_out() {
    let folder = Folder::new(None);
    let other = folder.path("other.toml");
    fs::write(
        &other,
        "schema = 1\n[ranges]\nlight = { lo = 5, hi = 9 }\nposition = { lo = -1, hi = 1 }\n",
    )
    .unwrap();
    assert!(folder.lints(&["--ranges", text(&other)]).is_empty());
    assert!(folder.lints(&["--lint-time", "0"]).is_empty());
}

#[test]
fn a_wrong_sidecar_is_shown_with_file_line_and_caret() {
    for (sidecar, message) in [
        ("ligth = { lo = 0, hi = 1 }", "did you mean `light`?"),
        ("light = { lo = 2, hi = 1 }", "lo = 2 is above hi = 1"),
        ("light = { lo = nan, hi = 1 }", "NaN is not the end of a range"),
        ("light = { lo = 0, hi = 1, step = 2 }", "unknown key `step`"),
    ] {
        let folder = Folder::new(Some(sidecar));
        let (shader, cache) = (folder.path("a.wgsl"), folder.path("cache"));
        bossage(&["check", text(&shader), "--json", "--cache", text(&cache)])
            .exits(2)
            .says(&[message, "a.ranges.toml:3:", "^"]);
    }
}

#[test]
fn wrong_calls_say_what_to_write() {
    let folder = Folder::new(None);
    let shader = folder.path("a.wgsl");
    bossage(&["check", text(&shader), "--lint-time", "soon"])
        .exits(2)
        .says(&["seconds from 0 to 86400"]);
    bossage(&["check", text(&shader), "--ranges", "/nonexistent.toml", "--json"])
        .exits(2)
        .says(&["/nonexistent.toml"]);
}
