//! All cases, in the order of their names.

pub mod accuracy;
pub mod bake;
pub mod cone_bake;
pub mod cube_map_bake;
pub mod defect;
mod kernel_case;
pub mod max_mip_bake;
pub mod mesh;
pub mod mikktspace;
pub mod mips_bake;
pub mod normalisation_cube_map;
pub mod probe;
pub mod relief;
pub mod scene;

use std::path::PathBuf;

use crate::case::Case;

/// What the list of cases depends on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scope {
    /// The full number of inputs instead of the ordinary one.
    pub full: bool,
    /// The seed of the random generators.
    pub seed: u64,
    /// Scene files to render.
    pub scenes: Vec<PathBuf>,
}

/// Every case, sorted by name.
#[must_use]
pub fn cases(scope: &Scope) -> Vec<Box<dyn Case>> {
    let mut cases = Vec::new();
    cases.extend(accuracy::cases(scope.full, scope.seed));
    cases.extend(probe::cases(scope.full, scope.seed));
    cases.extend(defect::cases());
    cases.extend(bake::cases());
    cases.extend(cone_bake::cases());
    cases.extend(cube_map_bake::cases());
    cases.extend(max_mip_bake::cases());
    cases.extend(mips_bake::cases());
    cases.extend(mesh::cases());
    cases.extend(mikktspace::cases());
    cases.extend(normalisation_cube_map::cases());
    cases.extend(relief::cases());
    cases.extend(scene::cases(&scope.scenes));
    cases.extend(scene::permutations::cases(scope.full));
    cases.extend(scene::vertices::cases());
    cases.extend(scene::two_pass::cases());
    cases.extend(scene::displacement::cases());
    cases.sort_by(|a, b| a.id().cmp(b.id()));
    cases
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use bossage_shaders::TECHNIQUES;

    use super::{Scope, cases};

    fn scope() -> Scope {
        Scope {
            full: false,
            seed: 1,
            scenes: Vec::new(),
        }
    }

    #[test]
    fn names_are_unique() {
        let cases = cases(&scope());
        let names: BTreeSet<String> = cases.iter().map(|case| case.id().to_string()).collect();
        assert_eq!(names.len(), cases.len());
    }

    #[test]
    fn every_technique_and_form_has_cases() {
        let cases = cases(&scope());
        for technique in TECHNIQUES {
            for form in technique.forms {
                let wanted = (technique.forms.len() > 1).then(|| form.as_str());
                let found = cases
                    .iter()
                    .any(|case| case.id().technique == technique.id && case.id().form.as_deref() == wanted);
                assert!(found, "{} {form:?}", technique.id);
            }
        }
    }
}
