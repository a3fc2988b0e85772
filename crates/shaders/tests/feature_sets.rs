//! The algebra of feature sets: canonical forms, names, stage keys.

use std::collections::{BTreeMap, BTreeSet};

use bossage_shaders::{
    Albedo, Alpha, FeatureSet, Form, LightingSpace, Lights, NormalSource, Relief, Transform,
};

/// Every value of the type, canonical or not: 3·2·4·2·2·2·2·2·2·2 = 3072.
fn all() -> Vec<FeatureSet> {
    let mut sets = vec![FeatureSet::default()];
    let mut vary = |change: &dyn Fn(FeatureSet) -> Vec<FeatureSet>| {
        sets = sets.iter().copied().flat_map(change).collect()
    };
    vary(&|s| {
        [
            Relief::None,
            Relief::ParallaxOffset,
            Relief::ParallaxOffsetLimited,
        ]
        .map(|relief| FeatureSet { relief, ..s })
        .to_vec()
    });
    vary(&|s| {
        [NormalSource::Geometric, NormalSource::Map]
            .map(|normal| FeatureSet { normal, ..s })
            .to_vec()
    });
    vary(&|s| {
        [Lights::None, Lights::Directional, Lights::Point, Lights::Many]
            .map(|lights| FeatureSet { lights, ..s })
            .to_vec()
    });
    vary(&|s| {
        [false, true]
            .map(|specular| FeatureSet { specular, ..s })
            .to_vec()
    });
    vary(&|s| {
        [Albedo::Constant, Albedo::Map]
            .map(|albedo| FeatureSet { albedo, ..s })
            .to_vec()
    });
    vary(&|s| {
        [Alpha::Opaque, Alpha::Mask]
            .map(|alpha| FeatureSet { alpha, ..s })
            .to_vec()
    });
    vary(&|s| {
        [Transform::Rigid, Transform::General]
            .map(|transform| FeatureSet { transform, ..s })
            .to_vec()
    });
    vary(&|s| {
        [false, true]
            .map(|mirrored_uv| FeatureSet { mirrored_uv, ..s })
            .to_vec()
    });
    vary(&|s| {
        [LightingSpace::World, LightingSpace::Object]
            .map(|space| FeatureSet { space, ..s })
            .to_vec()
    });
    vary(&|s| {
        [Form::Published, Form::Hardened]
            .map(|form| FeatureSet { form, ..s })
            .to_vec()
    });
    assert_eq!(sets.len(), 3072);
    sets
}

#[test]
fn canonical_is_idempotent_and_reachable_holds_exactly_the_canonical_ones() {
    let canonical: BTreeSet<FeatureSet> = all().into_iter().map(FeatureSet::canonical).collect();
    assert!(canonical.iter().all(|set| set.canonical() == *set));
    assert_eq!(canonical.into_iter().collect::<Vec<_>>(), FeatureSet::reachable());
}

#[test]
fn equal_code_has_an_equal_key_and_different_keys_have_different_names() {
    let (mut names, mut pairs) = (BTreeMap::new(), BTreeMap::new());
    for set in FeatureSet::reachable() {
        assert_eq!(names.insert(set.name(), set), None, "{}", set.name());
        assert_eq!(
            pairs.insert((set.vertex(), set.fragment()), set),
            None,
            "{} has the modules of another",
            set.name()
        );
    }
}

#[test]
fn names_are_safe_and_not_too_long_for_a_file() {
    let longest_suffix = ".fragment.spirv.json".len();
    for set in FeatureSet::reachable() {
        for name in [set.name(), set.vertex().name(), set.fragment().name()] {
            let safe = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_' || c == '-';
            assert!(name.chars().all(safe), "{name}");
            assert!(name.len() + longest_suffix <= 255, "{name}");
        }
    }
}

#[test]
fn all_effects_keeps_what_is_pinned_and_turns_the_rest_on() {
    for set in all() {
        let every = set.all_effects();
        assert_eq!(every.canonical(), every);
        assert_eq!(every.all_effects(), every);
        assert_eq!(
            (every.form, every.normal, every.albedo, every.alpha),
            (set.form, NormalSource::Map, Albedo::Map, Alpha::Mask)
        );
        assert!(
            every.specular
                && every.mirrored_uv
                && every.relief != Relief::None
                && every.lights != Lights::None
        );
        if set.relief != Relief::None {
            assert_eq!(every.relief, set.relief);
        }
        if set.form == Form::Hardened && every.space == LightingSpace::World {
            assert_eq!(
                (every.lights, every.transform),
                (Lights::Many, Transform::General)
            );
        }
    }
}

#[test]
fn all_effects_keeps_the_lighting_space_of_the_planned_shader() {
    for set in FeatureSet::reachable().into_iter().filter(FeatureSet::has_normal) {
        assert_eq!(set.all_effects().space, set.space, "{}", set.name());
    }
}

#[test]
fn what_an_effect_needs_is_there() {
    for set in FeatureSet::reachable() {
        assert!(
            !set.has_tangent() || (set.has_normal() && set.has_uv()),
            "{}",
            set.name()
        );
        assert!(!set.has_position() || set.has_normal(), "{}", set.name());
        assert!(set.fragment().handedness == set.has_handedness());
    }
}
