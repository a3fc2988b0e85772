//! What a budget buys: errors, times, both; and what is wrong with a cost profile.

use bossage_scene::{Choice, EffectId, Origin, Plan, State, plan};

use crate::fixture::{CAMERA, Folder, SUN, one_plane, only};

const HEIGHT: &str = "normal = { map = \"n.png\", codec = \"unorm\" }\nheight = { map = \"h.png\", scale = 0.1, bias = -0.05 }";

/// Figures with round numbers: the plain offset costs twice the limited one.
const PROFILE: &str = "schema = 1
name = \"round\"
adapter = \"none\"
driver = \"none\"
[technique.parallax_offset_limited]
ray_ns = 10
step_ns = 0
[technique.parallax_offset]
ray_ns = 20
step_ns = 0
";

fn folder(profile: &str) -> Folder {
    let folder = Folder::new();
    folder.normal("n.png", |x, y| [100 + 5 * x as u8, 100 + 5 * y as u8, 240]);
    folder.height("h.png", |x, y| {
        0.5 + 0.4 * (x as f32 * 0.785).sin() * (y as f32 * 0.785).cos()
    });
    folder.write("round.toml", profile.as_bytes());
    folder
}

fn text(budget: &str) -> String {
    let camera = format!("{CAMERA}[budget]\nprofile = \"round.toml\"\n{budget}\n");
    one_plane(SUN, HEIGHT, "").replace(CAMERA, &camera)
}

fn planned(budget: &str) -> Plan {
    plan(&folder(PROFILE).scene(&text(budget)))
}

fn choice(plan: &Plan) -> &Choice {
    only(plan).choice.as_ref().expect("the technique is auto")
}

#[test]
fn the_cheapest_within_the_error_is_chosen_and_the_best_where_none_is() {
    let tight = planned("error_px = 1e-6");
    let best = choice(&tight);
    assert!(!best.meets_budget);
    assert!(
        only(&tight)
            .effect(EffectId::Relief)
            .reason
            .contains("none meets the budget: the best")
    );
    let least = best.others.iter().map(|other| other.error.px_p99);
    assert!(least.fold(f64::INFINITY, f64::min) >= best.chosen.error.px_p99);
    // A bound that the limited form just keeps is not kept by no relief at all, which would cost nothing.
    let limited = |plan: &Plan| {
        let all = choice(plan);
        let mut found = all.others.iter().chain([&all.chosen]);
        found
            .find(|it| it.technique == "parallax_offset_limited")
            .cloned()
            .unwrap()
    };
    let bound = limited(&tight).error_px_p99_at_most.unwrap();
    let loose = planned(&format!("error_px = {bound}"));
    assert!(choice(&loose).meets_budget);
    assert_eq!(choice(&loose).chosen.technique, "parallax_offset_limited");
    assert_eq!(choice(&loose).cheaper.as_ref().unwrap().technique, "none");
    // With so much to spend nothing is needed, and the relief is dropped.
    let any = planned("error_px = 1e3");
    assert_eq!(choice(&any).chosen.technique, "none");
    assert_eq!(only(&any).effect(EffectId::Relief).state, State::Dropped);
    assert_eq!(only(&any).predicted.time_ms, Some(0.0));
}

#[test]
fn the_most_accurate_within_the_time_is_chosen() {
    let free = planned("error_px = 1e-6");
    let area = only(&free).objects[0].footprint.unwrap().area_px;
    let time_ms = |technique: &str| {
        let all = choice(&free);
        let mut found = all.others.iter().chain([&all.chosen]);
        found.find(|it| it.technique == technique).unwrap().time_ms
    };
    // Pixels times nanoseconds.
    for (technique, ns) in [
        ("parallax_offset_limited", 10.0),
        ("parallax_offset", 20.0),
        ("none", 0.0),
    ] {
        assert!(
            (time_ms(technique) - area * ns * 1e-6).abs() <= 1e-12 * area,
            "{technique}"
        );
    }
    let within = |ms: f64| {
        let plan = planned(&format!("time_ms = {ms}"));
        assert!(choice(&plan).meets_budget);
        assert!(
            plan.wanted().contains("ms of relief a frame on round"),
            "{}",
            plan.wanted()
        );
        choice(&plan).chosen.clone()
    };
    assert_eq!(within(area * 9e-6).technique, "none");
    let middle = within(area * 19e-6);
    assert!(middle.time_ms <= area * 19e-6 && middle.technique != "parallax_offset");
    let dear = within(area * 21e-6);
    assert!(dear.error.px_p99 <= middle.error.px_p99);
    let both = planned(&format!("error_px = 1e-6\ntime_ms = {}", area * 19e-6));
    assert!(!choice(&both).meets_budget && choice(&both).chosen.time_ms <= area * 19e-6);
}

#[test]
fn time_is_shared_by_pixels_among_the_materials_that_have_a_choice() {
    let second = "[[materials]]\nname = \"second\"\nheight = { map = \"h.png\", scale = 0.1, bias = -0.05 }\n\
                  albedo = { map = \"c.png\" }\ntechnique = \"TECHNIQUE\"\n\
                  [[objects]]\nname = \"p\"\nshape = \"plane\"\nmaterial = \"second\"\nsize = [1.0, 1.0]\n";
    let folder = folder(PROFILE);
    folder.color("c.png", |x, y| [x as u8 * 20, y as u8 * 20, 0, 255]);
    let shares = |technique: &str| {
        let two = text("time_ms = 1.0") + &second.replace("TECHNIQUE", technique);
        let plan = plan(&folder.scene(&two));
        let share = |index: usize| {
            let material = &plan.materials[index];
            let evidence = &material.effect(EffectId::Relief).evidence;
            let area = material.objects[0].footprint.unwrap().area_px;
            (
                evidence
                    .get("budget_ms")
                    .map(|fact| format!("{fact}").parse::<f64>().unwrap()),
                area,
            )
        };
        (share(0), share(1))
    };
    let ((first, area), (second_share, other)) = shares("auto");
    // Facts are printed with four digits.
    let expected = area / (area + other);
    assert!((first.unwrap() - expected).abs() < 1e-3 * expected);
    assert!((second_share.unwrap() - (1.0 - expected)).abs() < 1e-3);
    assert_eq!(shares("none").0.0, Some(1.0));
}

#[test]
fn a_technique_without_figures_is_no_candidate() {
    let only_limited = PROFILE.split("[technique.parallax_offset]").next().unwrap();
    let plan = plan(&folder(only_limited).scene(&text("error_px = 1e-6")));
    let all = choice(&plan);
    let names: Vec<&str> = all
        .others
        .iter()
        .chain([&all.chosen])
        .map(|it| it.technique)
        .collect();
    assert!(
        names.contains(&"parallax_offset_limited") && !names.contains(&"parallax_offset"),
        "{names:?}"
    );
}

#[test]
fn what_is_wrong_with_a_profile_is_shown_in_the_profile() {
    let broken = PROFILE
        .replace("ray_ns = 20", "ray_ns = -20")
        .replace("schema = 1", "schema = 3");
    let error = folder(&broken).load(&text("error_px = 0.0")).unwrap_err();
    let problems = error.problems();
    assert_eq!(problems.len(), 3, "{error}");
    assert_eq!(problems[0].field, "budget.error_px");
    assert_eq!((problems[1].field.as_str(), problems[1].line), ("schema", 1));
    assert_eq!(
        (problems[2].field.as_str(), problems[2].line),
        ("technique.parallax_offset.ray_ns", 9)
    );
    assert!(matches!(&problems[2].origin, Origin::Named(file) if file.path.ends_with("round.toml")));
    let shown = error.to_string();
    assert!(
        shown.contains("round.toml:9:10") && shown.contains("ray_ns = -20"),
        "{shown}"
    );
}
