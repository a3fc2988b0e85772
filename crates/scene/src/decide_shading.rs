//! Effects of shading: shadow, highlight, reflection, embossing, the normalisation cube map, occlusion, displacement, the second pass.
//!
//! A pinned technique is kept as long as what it reads says anything; where the content makes it exactly nothing it is dropped like
//! any other effect.

use bossage_assets::Texels;
use bossage_shaders::{Relief, Shading};

use crate::decide::{Decision, Subject, evidence};
use crate::model::{Normaliser, ReflectionPin, Shadow, TechniquePin};
use crate::plan::{EffectId, Evidence, Fact};
use crate::technique::Technique;
use crate::tile::Tile;

/// What a shader with shadows or depth has beside them, whatever the material calls for.
const BESIDE_PLACES: [EffectId; 6] = [
    EffectId::Lighting,
    EffectId::LightVector,
    EffectId::LightLoop,
    EffectId::Specular,
    EffectId::NormalMap,
    EffectId::AlbedoMap,
];

/// An effect's decision where the shader has shadows or depth: kept, although it changes nothing.
pub(crate) fn beside_places(id: EffectId, decision: Decision) -> Decision {
    if decision.kept || !BESIDE_PLACES.contains(&id) {
        return decision;
    }
    let reason = format!(
        "every shader with shadows or depth of the relief has it; it changes nothing here: {}",
        decision.reason
    );
    Decision::kept(reason, decision.evidence)
}

impl Subject<'_> {
    /// `technique`: what the relief is drawn by.
    pub(crate) fn shadow(&self, lit: bool, technique: Technique) -> Decision {
        let shadow = self.material.shadow;
        if shadow == Shadow::None {
            return Decision::dropped("the scene asks for none", Evidence::new());
        }
        let mut facts = evidence([("light_samples", Fact::Count(u64::from(shadow.samples())))]);
        if let Shadow::Soft { half_width, .. } = shadow {
            facts.insert("light_half_width", Fact::Number(half_width));
        }
        let searches = technique.relief().is_some_and(Relief::is_search);
        if !lit {
            Decision::dropped("there is no light to cast one", facts)
        } else if technique == Technique::None {
            Decision::dropped("no relief is drawn that could cast one", facts)
        } else if !searches {
            let reason = format!("`{}` finds no place for one to fall on", technique.id());
            Decision::dropped(reason, facts)
        } else {
            // A light below the polygon lights nothing with shadows, and without them slopes that face it: dropping would show.
            Decision::kept("asked for by the scene", facts)
        }
    }

    /// `technique`: what the relief is drawn by.
    pub(crate) fn pixel_depth(&self, technique: Technique) -> Decision {
        if !self.material.pixel_depth {
            Decision::dropped("the scene asks for the polygon's", Evidence::new())
        } else if technique == Technique::None {
            Decision::dropped(
                "no relief is drawn that could be deeper than its polygon",
                Evidence::new(),
            )
        } else if !technique.relief().is_some_and(Relief::is_search) {
            let reason = format!("`{}` finds no place whose depth it would be", technique.id());
            Decision::dropped(reason, Evidence::new())
        } else {
            Decision::kept("asked for by the scene", Evidence::new())
        }
    }

    pub(crate) fn specular(&self, lit: bool) -> Decision {
        let (specular, shading) = (self.material.specular, self.material.shading);
        let facts = evidence([("specular", Fact::Numbers(specular.to_array().to_vec()))]);
        if specular.as_vec3() == glam::Vec3::ZERO {
            Decision::dropped("specular is 0: no half vector", facts)
        } else if !lit {
            Decision::dropped("nothing to reflect: there is no light", facts)
        } else if shading != Shading::BlinnPhong {
            Decision::dropped(format!("`{}` has no highlight", shading.as_str()), facts)
        } else {
            Decision::kept("specular is not 0", facts)
        }
    }

    pub(crate) fn environment(&self) -> Decision {
        let material = self.material;
        let Some(environment) = &self.scene.environment else {
            return Decision::dropped("the scene has none", Evidence::new());
        };
        let facts = evidence([
            ("specular", Fact::Numbers(material.specular.to_array().to_vec())),
            ("face_texels", Fact::Count(u64::from(environment.map.size))),
            ("black", Fact::Text(environment.is_black().to_string())),
        ]);
        if material.reflection == ReflectionPin::None {
            Decision::dropped("pinned to none by the scene", facts)
        } else if material.specular.as_vec3() == glam::Vec3::ZERO {
            Decision::dropped("specular is 0: nothing is mirrored", facts)
        } else if environment.is_black() {
            Decision::dropped("every texel of it is black", facts)
        } else if material.shading != Shading::BlinnPhong {
            Decision::dropped(format!("`{}` mirrors nothing", material.shading.as_str()), facts)
        } else if material.technique.relief().is_some_and(Relief::is_slope) {
            Decision::dropped(
                format!("`{}` goes without a reflection", material.technique.as_str()),
                facts,
            )
        } else if material.reflection == ReflectionPin::EnvironmentBump {
            Decision::kept("pinned by the scene", facts)
        } else {
            Decision::kept("there is an environment, and specular is not 0", facts)
        }
    }

    pub(crate) fn emboss(&self) -> Decision {
        let (Shading::Emboss, Some(height), Some(range)) =
            (self.material.shading, &self.material.height, self.facts.height)
        else {
            return Decision::dropped("shading is another", Evidence::new());
        };
        let facts = evidence([
            ("height_range", Fact::Numbers(vec![range.min, range.max])),
            ("step_texels", Fact::Number(self.material.emboss_texels)),
            (
                "map_texels",
                Fact::Numbers(vec![
                    f64::from(height.field.width),
                    f64::from(height.field.height),
                ]),
            ),
        ]);
        if range.is_constant() {
            Decision::dropped("height does not vary: the difference is 0 everywhere", facts)
        } else {
            Decision::kept("pinned by the scene", facts)
        }
    }

    pub(crate) fn normalisation_cube(&self) -> Decision {
        match &self.material.normaliser {
            Normaliser::Arithmetic if self.material.shading.is_dot3() => {
                Decision::dropped("the normaliser is arithmetic", Evidence::new())
            }
            Normaliser::Arithmetic => Decision::dropped("only `dot3` has a normaliser", Evidence::new()),
            Normaliser::Cube(map) => {
                let bits = match &map.faces[0] {
                    Texels::Unorm8(_) => 8,
                    Texels::Unorm16(_) => 16,
                    Texels::Float32(_) => 32,
                };
                let facts = evidence([
                    ("face_texels", Fact::Count(u64::from(map.size))),
                    ("bits", Fact::Count(bits)),
                ]);
                Decision::kept("pinned by the scene", facts)
            }
        }
    }

    pub(crate) fn ambient_occlusion(&self) -> Decision {
        let ambient = self.scene.ambient;
        let facts = evidence([
            ("occlusion", Fact::Number(self.material.occlusion)),
            ("ambient", Fact::Numbers(ambient.to_array().to_vec())),
        ]);
        match self.material.technique.relief() {
            Some(relief) if relief.is_slope() => {
                Decision::kept("the pinned technique occludes ambient light by the slope", facts)
            }
            Some(_) | None => Decision::dropped("no slope technique is pinned", Evidence::new()),
        }
    }

    pub(crate) fn displacement(&self) -> Decision {
        if self.material.technique != TechniquePin::Displacement {
            return Decision::dropped("only where it is pinned: it needs a fine mesh", Evidence::new());
        }
        let tiles = self.objects.iter().filter_map(|object| Tile::of(&object.mesh));
        let stretch = tiles.map(|tile| tile.stretch).fold(1.0, f64::max);
        let vertices = self
            .objects
            .iter()
            .map(|object| object.mesh.positions.len())
            .max();
        let facts = evidence([
            ("vertices_most", Fact::Count(vertices.unwrap_or(0) as u64)),
            ("tile_stretch", Fact::Number(stretch)),
        ]);
        Decision::kept("pinned by the scene", facts)
    }

    pub(crate) fn second_pass(&self) -> Decision {
        if self.material.shading == Shading::Dot3TwoPass {
            Decision::kept(
                "pinned by the scene: the colour is multiplied in by blending",
                Evidence::new(),
            )
        } else {
            Decision::dropped("one pass does it", Evidence::new())
        }
    }
}
