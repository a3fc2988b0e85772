//! Does the planner choose well? Over random scenes, what it chose is measured on independent rays, and so is all that is cheaper.
//!
//! Wanted: the chosen technique meets the budget in at least 98 % of the scenes, and no cheaper candidate does as well in at least 90 %.
//! The scenes are always the same; an ordinary run takes the first of them, `BOSSAGE_PLANNER_SCENES=200` as many as one likes.

use bossage_scene::{Candidate, Choice, Scene, Technique, choice_among, measure};
use rayon::prelude::*;

use crate::random_scene;

/// Scenes of an ordinary run.
const SCENES: u64 = 60;
/// Independent rays by which a technique is measured; a first look takes a sixteenth of them.
const RAYS: u32 = 1 << 15;
/// Seed of those rays: none of the planner's.
const SEED: u64 = 0x5eed;

fn scenes() -> u64 {
    let given = std::env::var("BOSSAGE_PLANNER_SCENES");
    given.map_or(SCENES, |count| count.parse().expect("a number of scenes"))
}

/// A random scene and the choice among techniques with all settings.
fn chosen(seed: u64, techniques: &[Technique]) -> (Scene, Choice) {
    let scene = random_scene::scene(seed);
    let choice = choice_among(&scene, 0, techniques).expect("the scene shows its material");
    (scene, choice)
}

/// The ladder without its last rung, which alone is right for every budget where its price is low.
fn inexact() -> Vec<Technique> {
    let mut techniques = Technique::ladder();
    techniques.retain(|technique| technique.id() != "exact");
    techniques
}

/// Whether a technique's measured error meets the scene's budget.
fn meets(scene: &Scene, technique: Technique) -> bool {
    let most = scene.budget.error_px.expect("random scenes have an error");
    let look = measure(scene, 0, technique, RAYS / 16, SEED).expect("it is seen");
    if look.error_px_p99_between[0] > most {
        return false;
    }
    measure(scene, 0, technique, RAYS, SEED)
        .expect("it is seen")
        .error
        .px_p99
        <= most
}

/// How a pick turned out: whether it meets the budget, and whether nothing cheaper does.
fn judged(scene: &Scene, choice: &Choice, pick: &Candidate) -> (bool, bool) {
    let all = choice.others.iter().chain([&choice.chosen]);
    let mut cheaper = all.filter(|it| it.time_ms < pick.time_ms);
    (meets(scene, pick.how), !cheaper.any(|it| meets(scene, it.how)))
}

fn share(of: usize, all: usize) -> f64 {
    of as f64 / all as f64
}

#[test]
#[expect(
    clippy::print_stderr,
    reason = "the shares are figures to watch, with --nocapture"
)]
fn what_is_chosen_meets_the_budget_and_nothing_cheaper_does() {
    let seeds: Vec<u64> = (0..scenes()).collect();
    let outcomes: Vec<(String, (bool, bool))> = seeds
        .par_iter()
        .map(|&seed| {
            let (scene, choice) = chosen(seed, &Technique::ladder());
            let told = format!("{seed}: {} for {:?} px", choice.chosen, scene.budget.error_px);
            (told, judged(&scene, &choice, &choice.chosen))
        })
        .collect();
    let met = outcomes.iter().filter(|(_, (meets, _))| *meets).count();
    let cheapest = outcomes.iter().filter(|(_, (_, cheapest))| *cheapest).count();
    let told = |bad: &dyn Fn(&(bool, bool)) -> bool| -> Vec<&String> {
        outcomes
            .iter()
            .filter(|(_, it)| bad(it))
            .map(|(told, _)| told)
            .collect()
    };
    let all = outcomes.len();
    let exact = outcomes
        .iter()
        .filter(|(told, _)| told.contains(": exact"))
        .count();
    eprintln!("{met} of {all} meet the budget, in {cheapest} nothing cheaper does; `exact` in {exact}");
    assert!(share(met, all) >= 0.98, "not met: {:#?}", told(&|it| !it.0));
    assert!(
        share(cheapest, all) >= 0.9,
        "cheaper ones: {:#?}",
        told(&|it| !it.1)
    );
}

#[test]
fn the_random_scenes_ask_for_more_than_one_technique() {
    let seeds: Vec<u64> = (0..SCENES).collect();
    let mut names: Vec<&str> = seeds
        .par_iter()
        .map(|&seed| chosen(seed, &inexact()).1.chosen.how.id())
        .collect();
    names.sort_unstable();
    let most = names.chunk_by(|a, b| a == b).map(<[&str]>::len).max();
    assert!(share(most.unwrap_or(0), names.len()) <= 0.6, "{names:?}");
}

#[test]
fn planners_that_choose_worse_are_seen() {
    let seeds: Vec<u64> = (0..24).collect();
    let outcomes: Vec<(bool, Option<bool>)> = seeds
        .par_iter()
        .map(|&seed| {
            let (scene, choice) = chosen(seed, &Technique::ladder());
            // One that takes the second cheapest of those that fit: something cheaper does as well.
            let second = choice
                .runner_up
                .as_ref()
                .filter(|it| it.time_ms > choice.chosen.time_ms);
            let second = second.map(|pick| judged(&scene, &choice, pick).1);
            // One that looks at cost alone: it is off.
            let all = choice.others.iter().chain([&choice.chosen]);
            let cheapest = all
                .min_by(|a, b| a.time_ms.total_cmp(&b.time_ms))
                .expect("there is a candidate");
            (meets(&scene, cheapest.how), second)
        })
        .collect();
    let (met, all) = (outcomes.iter().filter(|it| it.0).count(), outcomes.len());
    assert!(share(met, all) < 0.98, "{met} of {all}");
    let second: Vec<bool> = outcomes.iter().filter_map(|it| it.1).collect();
    let cheapest = second.iter().filter(|cheapest| **cheapest).count();
    assert!(
        second.len() > 12 && share(cheapest, second.len()) < 0.9,
        "{cheapest} of {second:?}"
    );
}
