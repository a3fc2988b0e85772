//! Whether a material's height map is used, and by which technique.
//!
//! Dropped, in this order: no map; constant heights; nothing textured to displace; pinned to `none`; out of view; a displacement
//! of less than [`LEAST_PX`] everywhere on screen. Otherwise the pinned technique, or the chosen one (see `choose.rs`), which may be
//! none at all where the error without relief is within the budget.

use bossage_shaders::Shading;

use crate::choose::{Choice, Limits, Price, RAYS, choose};
use crate::decide::{Decision, NO_ERROR, Subject, evidence};
use crate::facts::HeightFacts;
use crate::model::{HeightSource, Material, TechniquePin};
use crate::plan::{Evidence, Fact, Predicted};
use crate::predict::{Sample, Sampler};
use crate::technique::Technique;

/// A displacement that stays below this is not drawn, pixels.
pub(crate) const LEAST_PX: f64 = 1.0;

/// The outcome.
pub(crate) struct ReliefPlan {
    pub(crate) technique: Technique,
    pub(crate) decision: Decision,
    pub(crate) predicted: Predicted,
    pub(crate) choice: Option<Choice>,
    /// Whether leaving relief out moves what is seen: within a budget or a pixel, or as pinned, and not by nothing.
    pub(crate) approximates: bool,
}

/// Whether the technique of a material is chosen by its cost, and so has a share in the scene's time.
pub(crate) fn is_chosen(material: &Material) -> bool {
    let varies = |height: &HeightSource| !height.field.is_flat();
    material.technique == TechniquePin::Auto
        && material.shading == Shading::BlinnPhong
        && material.height.as_ref().is_some_and(varies)
}

/// Decides for one material. `textured`: whether there is a map left that a shifted coordinate would sample.
pub(crate) fn decide(subject: &Subject<'_>, textured: bool) -> ReliefPlan {
    let (Some(height), Some(range)) = (&subject.material.height, subject.facts.height) else {
        return without("the material has no height map", Evidence::new(), NO_ERROR);
    };
    let Displacement { px, facts } = displacement(subject, height, range);
    let (pin, shading) = (subject.material.technique, subject.material.shading);
    if pin == TechniquePin::Auto && range.is_constant() {
        return without(
            "height does not vary: the surface is the polygon",
            facts,
            NO_ERROR,
        );
    }
    if !textured && pin != TechniquePin::Displacement {
        return without("no map is left that it would displace", facts, NO_ERROR);
    }
    let mut sampler = Sampler::new(subject.material, height, &subject.views, None);
    if let Some(technique) = Technique::pinned(subject.material) {
        return pinned(technique, facts, predicted(&mut sampler, technique, subject));
    }
    let shifts_nothing = match shading {
        Shading::BlinnPhong => None,
        Shading::WrapLambert => Some("`wrap_lambert` goes with the slope techniques, and none is pinned"),
        Shading::Emboss => Some("embossing stands in for it"),
        Shading::Dot3SinglePass | Shading::Dot3TwoPass => Some("`dot3` shifts no texture"),
    };
    if let Some(reason) = shifts_nothing {
        without(reason, facts, predicted(&mut sampler, Technique::None, subject))
    } else if px == 0.0 {
        let unseen = predicted(&mut sampler, Technique::None, subject);
        without("nothing of it is in view", facts, unseen)
    } else if px < LEAST_PX {
        below_a_pixel(facts, predicted(&mut sampler, Technique::None, subject), subject)
    } else {
        chosen(&mut sampler, subject, facts)
    }
}

/// How far the relief can move a point on screen, with the numbers that say so.
struct Displacement {
    px: f64,
    facts: Evidence,
}

fn displacement(subject: &Subject<'_>, height: &HeightSource, range: HeightFacts) -> Displacement {
    let (low, high) = (height.elevation.at(range.min), height.elevation.at(range.max));
    let reach = low.abs().max(high.abs());
    let px = subject
        .views
        .iter()
        .map(|view| view.displacement_px(reach))
        .fold(0.0, f64::max);
    let tile_px = subject
        .views
        .iter()
        .filter_map(|view| view.footprint())
        .map(|seen| seen.tile_px)
        .fold(0.0, f64::max);
    let side = f64::from(height.field.width.max(height.field.height));
    let mut facts = evidence([
        ("height_range", Fact::Numbers(vec![range.min, range.max])),
        ("elevation_uv_range", Fact::Numbers(vec![low.x, high.x])),
        ("displacement_px_max", Fact::Number(px)),
    ]);
    let budget = &subject.scene.budget;
    facts.extend(budget.error_px.map(|px| ("budget_px", Fact::Number(px))));
    facts.extend(subject.time_ms.map(|ms| ("budget_ms", Fact::Number(ms))));
    if tile_px > 0.0 {
        facts.insert("texels_per_px_nearest", Fact::Number(side / tile_px));
    }
    Displacement { px, facts }
}

fn predicted(sampler: &mut Sampler<'_>, technique: Technique, subject: &Subject<'_>) -> Predicted {
    sampler.grow(RAYS);
    let mut sample = Sample::default();
    sampler.extend(technique, &mut sample, sampler.len());
    let error = sample.error();
    Predicted {
        error_texels_p99: error.map(|error| error.texels_p99),
        error_px_p99: error.map(|error| error.px_p99),
        time_ms: price(subject).time_ms(technique, sample.mean_steps()),
        ..Predicted::default()
    }
}

fn price<'a>(subject: &Subject<'a>) -> Price<'a> {
    Price {
        profile: &subject.scene.budget.profile,
        pixels: subject.views.iter().map(|view| view.area_px()).sum(),
    }
}

fn without(reason: &str, facts: Evidence, predicted: Predicted) -> ReliefPlan {
    ReliefPlan {
        technique: Technique::None,
        decision: Decision::dropped(reason, facts),
        predicted,
        choice: None,
        approximates: false,
    }
}

fn below_a_pixel(facts: Evidence, predicted: Predicted, subject: &Subject<'_>) -> ReliefPlan {
    let reason = "the displacement stays below 1 pixel everywhere on screen";
    let (error, budget) = (predicted.error_px_p99, subject.scene.budget.error_px);
    let reason = match error.zip(budget) {
        Some((error, budget)) if error > budget => {
            format!("{reason}, where relief is not worth its time; the budget is finer than that and not met")
        }
        _ => reason.to_owned(),
    };
    ReliefPlan {
        approximates: true,
        ..without(&reason, facts, predicted)
    }
}

fn pinned(technique: Technique, facts: Evidence, predicted: Predicted) -> ReliefPlan {
    let decision = match technique {
        Technique::None => Decision::dropped("pinned to none by the scene", facts),
        // The vertex stage does it all.
        Technique::Displacement => Decision::dropped("the vertices themselves are displaced", facts),
        Technique::ParallaxSlopeAo | Technique::ParallaxSlopeAoDirected | Technique::Search(_) => {
            Decision::kept("pinned by the scene", facts)
        }
    };
    ReliefPlan {
        technique,
        decision,
        predicted,
        choice: None,
        approximates: false,
    }
}

fn chosen(sampler: &mut Sampler<'_>, subject: &Subject<'_>, facts: Evidence) -> ReliefPlan {
    let limits = Limits {
        error_px: subject.scene.budget.error_px,
        time_ms: subject.time_ms,
    };
    let drawable: Vec<Technique> = Technique::ladder()
        .into_iter()
        .filter(|technique| technique.relief().is_some())
        .collect();
    let Some(choice) = choose(sampler, &drawable, limits, price(subject)) else {
        return without("it is seen from behind only", facts, Predicted::default());
    };
    let chosen = &choice.chosen;
    let reason = match (choice.meets_budget, limits.error_px, limits.time_ms) {
        (true, Some(_), _) => "the cheapest within the budget",
        (true, None, _) => "the most accurate within the time",
        (false, Some(_), Some(_)) => "none meets the budget: the most accurate within the time",
        (false, _, _) => "none meets the budget: the best",
    };
    let reason = format!("{reason}: {}", chosen.technique);
    let predicted = Predicted {
        error_texels_p99: Some(chosen.error.texels_p99),
        error_px_p99: Some(chosen.error.px_p99),
        time_ms: Some(chosen.time_ms),
        ..Predicted::default()
    };
    let decision = if chosen.how == Technique::None {
        Decision::dropped(reason, facts)
    } else {
        Decision::kept(reason, facts)
    };
    ReliefPlan {
        technique: chosen.how,
        decision,
        predicted,
        approximates: chosen.how == Technique::None,
        choice: Some(choice),
    }
}
