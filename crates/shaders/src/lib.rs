//! The WESL shader library, and its assembly: a [`FeatureSet`] in, one plain WGSL module a stage out.
//!
//! The sources are `/shaders/**.wesl`: `lib/` (pure functions), `techniques/` (one file a technique), `entry/` (surface
//! stages and bake kernels). They are embedded in the binary ([`Library::embedded`]) and can be replaced by a folder
//! ([`Library::from_dir`]). Effects that a feature set leaves out are compiled out of the *text*: the assembled module has
//! no binding, varying, uniform member, function or instruction of them.
//!
//! Names are part of the contract: nothing is mangled, and two declarations of one name are an error. The result is not
//! validated here beyond what WESL itself checks; that is `bossage-translate`'s job.
//!
//! ```
//! use bossage_shaders::{FeatureSet, Library, Lights, Stage};
//!
//! let library = Library::embedded()?;
//! let set = FeatureSet { lights: Lights::Directional, ..FeatureSet::default() };
//! let fragment = library.assemble_surface(&set, Stage::Fragment)?;
//! assert_eq!(fragment.name, "surface_fragment-directional_light");
//! assert!(fragment.wgsl.contains("fn surface_fragment("));
//! // No specular effect was asked for, so nothing of it is in the text.
//! assert!(!fragment.wgsl.contains("specular"));
//! # Ok::<(), bossage_shaders::Error>(())
//! ```

mod assemble;
mod canonical;
mod check;
mod error;
mod feature_set;
mod features;
mod kernel;
mod library;
mod name;
mod probe;
mod probe_entry;
mod probes;
mod read;
mod relief_light;
mod relief_search;
mod source;
mod stage;
mod technique;
mod user_file;

pub use error::{Error, SourceError};
pub use feature_set::{
    Albedo, Alpha, FeatureSet, Form, LightingSpace, Lights, NormalSource, Normaliser, Relief, Shading,
    Shadow, Transform,
};
pub use kernel::Kernel;
pub use library::{AssembledShader, Library};
pub use probe::{Field, Probe, ProbeId, Role, Shape, WORKGROUP_SIZE};
pub use probes::PROBES;
pub use relief_light::{LightTechnique, ReliefLight};
pub use relief_search::{HeightRead, ReliefSearch, ReliefTechnique};
pub use stage::{FragmentKey, Pass, Stage, VertexKey};
pub use technique::{TECHNIQUES, Technique};

/// The result of everything that can fail here.
pub type Result<T> = std::result::Result<T, Error>;
