//! Whether a material's height map is used, and by which technique.
//!
//! Dropped, in this order: no map; constant heights; nothing textured to displace; pinned to `none`; out of view; a displacement
//! that cannot reach the budget anywhere on screen. Otherwise the pinned technique, or the chosen one (see `choose.rs`).

use bossage_shaders::{Relief, Shading};

use crate::choose::{Candidate, Choice, choose};
use crate::decide::{Decision, NO_ERROR, Subject, evidence};
use crate::facts::HeightFacts;
use crate::model::{HeightSource, TechniquePin};
use crate::plan::{Evidence, Fact, Predicted};
use crate::predict::Truth;

/// Techniques of `auto`, cheapest first. The limited form is the plain one without its division.
const LADDER: [Relief; 2] = [Relief::ParallaxOffsetLimited, Relief::ParallaxOffset];

/// The outcome.
pub(crate) struct ReliefPlan {
    pub(crate) technique: Relief,
    pub(crate) decision: Decision,
    pub(crate) predicted: Predicted,
    pub(crate) choice: Option<Choice>,
}

/// The technique's id, `none` without one.
pub(crate) fn id(relief: Relief) -> &'static str {
    match relief {
        Relief::None => "none",
        Relief::ParallaxOffset => "parallax_offset",
        Relief::ParallaxOffsetLimited => "parallax_offset_limited",
        Relief::ParallaxSlopeAo => "parallax_slope_ao",
        Relief::ParallaxSlopeAoDirected => "parallax_slope_ao_directed",
        Relief::Displacement => "displacement",
    }
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
    let displaces = pin == TechniquePin::Displacement;
    if !textured && !displaces {
        return without("no map is left that it would displace", facts, NO_ERROR);
    }
    let truth = Truth::trace(subject.material, height, &subject.views);
    let predict = |technique| predicted(&truth, technique, subject);
    if let Some(technique) = pin.relief() {
        return match technique {
            Relief::None => without("pinned to none by the scene", facts, predict(Relief::None)),
            Relief::Displacement => displaced(facts, predict(technique)),
            Relief::ParallaxOffset
            | Relief::ParallaxOffsetLimited
            | Relief::ParallaxSlopeAo
            | Relief::ParallaxSlopeAoDirected => pinned(technique, facts, predict(technique)),
        };
    }
    let shifts_nothing = match shading {
        Shading::BlinnPhong => None,
        Shading::WrapLambert => Some("`wrap_lambert` goes with the slope techniques, and none is pinned"),
        Shading::Emboss => Some("embossing stands in for it"),
        Shading::Dot3SinglePass | Shading::Dot3TwoPass => Some("`dot3` shifts no texture"),
    };
    if let Some(reason) = shifts_nothing {
        without(reason, facts, predict(Relief::None))
    } else if px == 0.0 {
        without("nothing of it is in view", facts, predict(Relief::None))
    } else if px <= subject.scene.budget.error_px {
        without(
            "the displacement stays within the error budget everywhere on screen",
            facts,
            predict(Relief::None),
        )
    } else {
        chosen(&truth, subject, facts)
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
        ("budget_px", Fact::Number(subject.scene.budget.error_px)),
    ]);
    if tile_px > 0.0 {
        facts.insert("texels_per_px_nearest", Fact::Number(side / tile_px));
    }
    Displacement { px, facts }
}

fn predicted(truth: &Truth<'_>, technique: Relief, subject: &Subject<'_>) -> Predicted {
    let error = truth.error(technique, subject.material.form);
    let (error_texels_p99, error_px_p99) = (error.map(|e| e.texels_p99), error.map(|e| e.px_p99));
    Predicted {
        error_texels_p99,
        error_px_p99,
        ..Predicted::default()
    }
}

fn without(reason: &str, facts: Evidence, predicted: Predicted) -> ReliefPlan {
    ReliefPlan {
        technique: Relief::None,
        decision: Decision::dropped(reason, facts),
        predicted,
        choice: None,
    }
}

fn pinned(technique: Relief, facts: Evidence, predicted: Predicted) -> ReliefPlan {
    ReliefPlan {
        technique,
        decision: Decision::kept("pinned by the scene", facts),
        predicted,
        choice: None,
    }
}

/// The vertex stage does it all.
fn displaced(facts: Evidence, predicted: Predicted) -> ReliefPlan {
    ReliefPlan {
        technique: Relief::Displacement,
        decision: Decision::dropped("the vertices themselves are displaced", facts),
        predicted,
        choice: None,
    }
}

fn chosen(truth: &Truth<'_>, subject: &Subject<'_>, facts: Evidence) -> ReliefPlan {
    let candidate = |technique| {
        let error = truth.error(technique, subject.material.form)?;
        Some(Candidate {
            technique: id(technique),
            error,
        })
    };
    let candidates: Vec<Candidate> = LADDER.into_iter().filter_map(candidate).collect();
    let Some(choice) = choose(&candidates, subject.scene.budget.error_px) else {
        return without("it is seen from behind only", facts, Predicted::default());
    };
    let technique = LADDER
        .into_iter()
        .find(|&technique| id(technique) == choice.chosen.technique)
        .unwrap_or(Relief::None);
    let error = choice.chosen.error;
    let reason = if choice.meets_budget {
        "the cheapest technique within the budget"
    } else {
        "no technique meets the budget: the best"
    };
    let reason = format!("{reason}: {}", choice.chosen.technique);
    let predicted = Predicted {
        error_texels_p99: Some(error.texels_p99),
        error_px_p99: Some(error.px_p99),
        ..Predicted::default()
    };
    ReliefPlan {
        technique,
        decision: Decision::kept(reason, facts),
        predicted,
        choice: Some(choice),
    }
}
