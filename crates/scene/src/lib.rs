//! `bossage-scene`: a scene file in, what the scene calls for out.
//!
//! Three steps, each usable alone:
//!
//! 1. [`load`] reads a TOML scene (format: [`schema`]), loads every file it names and checks every value. All mistakes are
//!    reported together, each with file, line, column, caret, field and what to do.
//! 2. [`plan`](fn@plan) derives from the *content* which effects each material needs, with the reason and the number behind each
//!    decision, and groups materials of equal needs under one shader permutation.
//! 3. [`draws`] gives what to draw: mesh, feature set, uniforms by name and decoded textures, independent of any graphics API.
//!
//! Invariants: the result depends on the files alone (no clock, no random state; sampling is seeded); a dropped effect cannot
//! change a pixel by more than the bound stated in its evidence.
//!
//! Not here: assembling shaders (`bossage-shaders`), running them (`bossage-runner`), static costs (read from the manifest).
//!
//! ```
//! # fn main() -> Result<(), bossage_scene::Error> {
//! let scene = bossage_scene::load_str(
//!     "inline.toml",
//!     r#"
//!     schema = 1
//!     ambient = [1.0, 1.0, 1.0]
//!     [camera]
//!     position = [0.0, 0.0, 3.0]
//!     target = [0.0, 0.0, 0.0]
//!     fov_deg = 45.0
//!     near = 0.1
//!     far = 10.0
//!     size = [64, 64]
//!     [[materials]]
//!     name = "white"
//!     [[objects]]
//!     name = "wall"
//!     shape = "plane"
//!     material = "white"
//!     "#,
//! )?;
//! let plan = bossage_scene::plan(&scene);
//! assert!(plan.materials[0].effects.iter().all(|effect| effect.state == bossage_scene::State::Dropped));
//! assert_eq!(bossage_scene::draws(&scene, &plan).len(), 1);
//! # Ok(())
//! # }
//! ```

mod camera;
mod choose;
mod decide;
mod decide_shading;
mod draw;
mod error;
mod facts;
mod fields;
mod files;
mod load;
mod load_budget;
mod load_environment;
mod load_material;
mod load_normal;
mod load_object;
mod load_search;
mod load_shadow;
mod model;
mod percentile;
mod plan;
mod predict;
pub mod profile;
mod relief;
mod relief_map;
mod rules;
pub mod schema;
mod seen;
mod sequence;
mod settings;
mod sheet;
mod suggest;
mod table;
mod technique;
mod textures;
mod tile;
mod views;

pub use camera::Matrices;
pub use choose::{Candidate, Choice, choice_among};
pub use draw::{Draw, Pass, draws, draws_with};
pub use error::{Error, NamedFile, Origin, Problem, Report};
pub use facts::{AlbedoFacts, HeightFacts, MaterialFacts, NormalFacts};
pub use load::{load, load_str, load_with};
pub use model::{
    AlbedoSource, AlphaMode, Budget, Camera, Elevation, Environment, HeightSource, Light, LightKind,
    Material, NormalSource, Normaliser, Object, ReflectionPin, Scene, Shadow, Shape, Tangents, TechniquePin,
    Transform,
};
pub use plan::{
    Effect, EffectId, Evidence, Fact, MaterialPlan, ObjectView, Permutation, Plan, Predicted, State, plan,
};
pub use predict::{Error as PredictedError, Measured, measure};
pub use seen::{SeenRay, seen_rays};
pub use settings::Setting;
pub use technique::{Settings, Technique};
pub use textures::{Level, Texels, Texture, TextureShape};
pub use views::Footprint;
