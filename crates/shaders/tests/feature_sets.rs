//! The algebra of feature sets: canonical forms, names, stage keys.

use std::collections::{BTreeMap, BTreeSet};

use bossage_shaders::{
    Albedo, Alpha, FeatureSet, Form, LightingSpace, Lights, NormalSource, Normaliser, Pass, Relief, Shading,
    Shadow, Stage, Transform,
};

/// Every value of the type without shadows and depth, canonical or not: 13·5·2·2·2·4·2⁸.
fn all() -> Vec<FeatureSet> {
    let mut sets = vec![FeatureSet::default()];
    let mut vary = |change: &dyn Fn(FeatureSet) -> Vec<FeatureSet>| {
        sets = sets.iter().copied().flat_map(change).collect()
    };
    vary(&|s| Relief::ALL.map(|relief| FeatureSet { relief, ..s }).to_vec());
    vary(&|s| Shading::ALL.map(|shading| FeatureSet { shading, ..s }).to_vec());
    vary(&|s| {
        [Normaliser::Arithmetic, Normaliser::Cube]
            .map(|normaliser| FeatureSet { normaliser, ..s })
            .to_vec()
    });
    vary(&|s| {
        [false, true]
            .map(|environment| FeatureSet { environment, ..s })
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
    assert_eq!(sets.len(), 266_240);
    sets
}

#[test]
fn canonical_is_idempotent_and_reachable_holds_exactly_the_canonical_ones() {
    let with = |set: FeatureSet| {
        Shadow::ALL.into_iter().flat_map(move |shadow| {
            [false, true].map(|pixel_depth| FeatureSet {
                shadow,
                pixel_depth,
                ..set
            })
        })
    };
    let canonical: BTreeSet<FeatureSet> = all()
        .into_iter()
        .flat_map(with)
        .map(FeatureSet::canonical)
        .collect();
    assert!(canonical.iter().all(|set| set.canonical() == *set));
    assert_eq!(canonical.into_iter().collect::<Vec<_>>(), FeatureSet::reachable());
}

#[test]
fn equal_code_has_an_equal_key_and_different_keys_have_different_names() {
    let (mut names, mut modules) = (BTreeMap::new(), BTreeMap::new());
    for set in FeatureSet::reachable() {
        assert_eq!(names.insert(set.name(), set), None, "{}", set.name());
        assert_eq!(
            modules.insert((set.vertex(), set.fragment(), set.second_pass()), set),
            None,
            "{} has the modules of another",
            set.name()
        );
    }
}

/// A search has one shader for each kind of shadow, for depth and for both, with and without a mask and a reflection, whatever else is asked for.
#[test]
fn shadows_and_depth_add_twenty_fragment_shaders_a_search() {
    let placed = |set: &FeatureSet| set.shadow != Shadow::None || set.pixel_depth;
    let reachable = FeatureSet::reachable();
    let fragments: BTreeSet<_> = reachable
        .iter()
        .filter(|set| placed(set))
        .map(FeatureSet::fragment)
        .collect();
    let searches = Relief::ALL
        .into_iter()
        .filter(|relief| relief.is_search())
        .count();
    assert_eq!(fragments.len(), 20 * searches);
    for set in all() {
        let asked = |shadow, pixel_depth| FeatureSet {
            shadow,
            pixel_depth,
            ..set
        };
        let [hard, deep] = [asked(Shadow::Hard, false), asked(Shadow::None, true)].map(FeatureSet::canonical);
        let searched = set.canonical().relief.is_search();
        assert!(!searched || deep.pixel_depth, "{}", deep.name());
        let lit = set.lights != Lights::None;
        assert!(
            !searched || (hard.shadow == Shadow::Hard) == lit,
            "{}",
            hard.name()
        );
        // Without one there is nothing that the same set without has not.
        for canonical in [hard, deep] {
            assert_eq!(canonical.canonical(), canonical);
            assert!(
                placed(&canonical) || canonical == set.canonical(),
                "{}",
                canonical.name()
            );
        }
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
fn all_effects_keeps_what_is_pinned_and_turns_on_all_that_goes_with_it() {
    for set in all() {
        let (planned, every) = (set.canonical(), set.all_effects());
        assert_eq!(every.canonical(), every);
        assert_eq!(every.all_effects(), every);
        assert_eq!(
            (every.shading, every.normaliser, every.albedo),
            (planned.shading, planned.normaliser, Albedo::Map)
        );
        if planned.relief != Relief::None {
            assert_eq!(every.relief, planned.relief);
        }
        let one_form = every.normaliser == Normaliser::Cube
            || every.relief == Relief::ParallaxSlopeAoDirected
            || every.relief.is_search();
        assert_eq!(every.form, if one_form { Form::Hardened } else { set.form });
        let two_pass = every.shading == Shading::Dot3TwoPass;
        assert_eq!(every.alpha == Alpha::Mask, !two_pass, "{}", every.name());
        // These have normals of their own.
        let own_normals = every.relief == Relief::Displacement || every.shading == Shading::Emboss;
        assert_eq!(every.normal == NormalSource::Map, !own_normals);
        assert!(every.has_tangent() == every.mirrored_uv && every.lights != Lights::None);
        let plain = every.shading == Shading::BlinnPhong;
        assert_eq!(every.specular, plain);
        let world = every.space == LightingSpace::World;
        assert_eq!(every.environment, plain && world && !every.relief.is_slope());
        assert_eq!(
            every.relief == Relief::None,
            every.shading == Shading::Emboss || every.shading.is_dot3()
        );
        if every.form == Form::Hardened && world && set.form == Form::Hardened {
            assert_eq!(every.transform, Transform::General);
            assert_eq!(every.lights == Lights::Many, plain);
        }
    }
}

/// A dropped effect is on in the shader that proves it: nothing of the planned shader is missing there.
#[test]
fn all_effects_has_all_that_was_planned() {
    for planned in FeatureSet::reachable() {
        let every = planned.all_effects();
        let name = planned.name();
        assert_eq!(
            (every.shadow, every.pixel_depth),
            (planned.shadow, planned.pixel_depth),
            "{name}"
        );
        assert!(every.specular || !planned.specular, "{name}");
        assert!(every.environment || !planned.environment, "{name}");
        assert!(every.has_normal() || !planned.has_normal(), "{name}");
        assert!(every.has_tangent() || !planned.has_tangent(), "{name}");
        assert!(every.has_uv() || !planned.has_uv(), "{name}");
        assert!(
            every.alpha == Alpha::Mask || planned.alpha == Alpha::Opaque,
            "{name}"
        );
        assert!(
            every.normal == NormalSource::Map || planned.normal == NormalSource::Geometric,
            "{name}"
        );
        assert_eq!(
            every.second_pass().is_some(),
            planned.second_pass().is_some(),
            "{name}"
        );
    }
}

#[test]
fn all_effects_keeps_the_lighting_space_of_the_planned_shader() {
    for set in FeatureSet::reachable().into_iter().filter(FeatureSet::has_normal) {
        assert_eq!(set.all_effects().space, set.space, "{}", set.name());
    }
}

/// The rules of the articles, by counting what exists.
#[test]
fn each_technique_goes_with_what_its_article_has() {
    for set in FeatureSet::reachable() {
        let name = set.name();
        let one_light = matches!(set.lights, Lights::Directional | Lights::Point);
        if set.shading != Shading::BlinnPhong {
            assert!(
                one_light && !set.specular && !set.environment && !set.relief.is_offset(),
                "{name}"
            );
        }
        if set.shading.is_dot3() {
            assert!(
                set.normal == NormalSource::Map && set.relief == Relief::None,
                "{name}"
            );
        }
        if set.shading == Shading::Emboss {
            assert!(
                set.normal == NormalSource::Geometric && set.relief == Relief::None,
                "{name}"
            );
        }
        if set.relief.is_slope() {
            assert!(set.normal == NormalSource::Map && !set.environment, "{name}");
        }
        if set.shadow != Shadow::None || set.pixel_depth {
            assert!(set.relief.is_search() && set.lights == Lights::Many, "{name}");
        }
        if set.relief == Relief::Displacement {
            assert!(set.normal == NormalSource::Geometric, "{name}");
        }
        if set.relief.is_search() {
            assert!(set.mirrored_uv && set.fragment().handedness, "{name}");
        }
        if set.environment {
            assert!(
                set.specular == (set.lights != Lights::None) && set.space == LightingSpace::World,
                "{name}"
            );
        }
    }
}

#[test]
fn two_passes_share_a_vertex_module_and_part_their_work() {
    let mut seen = 0;
    for set in FeatureSet::reachable() {
        let two = set.shading == Shading::Dot3TwoPass;
        assert_eq!(set.stages().contains(&Stage::SecondPass), two);
        let Some(second) = set.second_pass() else {
            assert_eq!(set.fragment().pass, Pass::Only);
            continue;
        };
        let first = set.fragment();
        assert_eq!((first.pass, second.pass), (Pass::First, Pass::Second));
        // Colour is the second's, everything else the first's.
        assert_eq!((first.albedo, second.albedo), (Albedo::Constant, set.albedo));
        assert_eq!(
            (second.lights, second.normal),
            (Lights::None, NormalSource::Geometric)
        );
        // What the second reads, the shared vertex module gives.
        assert!(set.vertex().uv);
        assert_ne!(
            set.module_name(Stage::Fragment),
            set.module_name(Stage::SecondPass)
        );
        seen += 1;
    }
    assert!(seen > 0);
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
