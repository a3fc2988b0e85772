//! A part of the mutants: by name, by shard, or by lot.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::error::Error;
use crate::mutant::Mutant;

/// Which mutants are run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Part {
    /// Only those with this in their id; a whole id selects just that one.
    pub(crate) filter: Option<String>,
    /// Part i of n, from 1.
    pub(crate) shard: Option<(usize, usize)>,
    /// So many, drawn with a seed.
    pub(crate) sample: Option<(usize, u64)>,
}

impl Part {
    /// Whether this is everything.
    pub(crate) fn is_whole(&self) -> bool {
        *self == Self::default()
    }

    /// The mutants of this part, in order.
    pub(crate) fn of(&self, mutants: &[Mutant]) -> Result<Vec<Mutant>, Error> {
        let filter = self.filter.as_deref().unwrap_or_default();
        let exact = mutants.iter().any(|mutant| mutant.id == filter);
        let wanted = |mutant: &&Mutant| {
            if exact {
                mutant.id == filter
            } else {
                mutant.id.contains(filter)
            }
        };
        let mut part: Vec<Mutant> = mutants.iter().filter(wanted).cloned().collect();
        if part.is_empty() {
            return Err(Error::NoSuchMutant {
                filter: filter.to_owned(),
                known: mutants.len(),
            });
        }
        if let Some((index, count)) = self.shard {
            part = part.into_iter().skip(index - 1).step_by(count).collect();
        }
        if let Some((count, seed)) = self.sample {
            part = drawn(part, count, seed);
        }
        Ok(part)
    }
}

/// `count` of them, each equally likely, in their order (the first steps of a Fisher–Yates shuffle).
fn drawn(mut mutants: Vec<Mutant>, count: usize, seed: u64) -> Vec<Mutant> {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut order: Vec<usize> = (0..mutants.len()).collect();
    for at in 0..count.min(order.len()) {
        let other = rng.random_range(at..order.len());
        order.swap(at, other);
    }
    order.truncate(count);
    let mut index = 0;
    mutants.retain(|_| {
        index += 1;
        order.contains(&(index - 1))
    });
    mutants
}

#[cfg(test)]
mod tests {
    use super::Part;
    use crate::generate::of_file;
    use crate::mutant::Mutant;

    fn mutants() -> Vec<Mutant> {
        of_file(
            "x.wesl",
            "fn f(a: vec3f, b: vec3f) -> f32 { return a.x * b.y - a.y * b.x + a.z * b.z; }",
        )
        .unwrap()
    }

    fn ids(part: &Part) -> Vec<String> {
        part.of(&mutants())
            .unwrap()
            .into_iter()
            .map(|mutant| mutant.id)
            .collect()
    }

    #[test]
    fn a_whole_id_selects_one() {
        let all = ids(&Part::default());
        let first = Part {
            filter: Some("x.wesl:f:swap_components:1".to_owned()),
            ..Part::default()
        };
        assert_eq!(ids(&first), ["x.wesl:f:swap_components:1"]);
        let none = Part {
            filter: Some("y.wesl".to_owned()),
            ..Part::default()
        };
        assert!(none.of(&mutants()).is_err());
        assert!(all.len() > 10);
    }

    #[test]
    fn shards_are_a_partition() {
        let shard = |index| {
            ids(&Part {
                shard: Some((index, 3)),
                ..Part::default()
            })
        };
        let mut joined: Vec<String> = (1..=3).flat_map(shard).collect();
        let mut all = ids(&Part::default());
        joined.sort();
        all.sort();
        assert_eq!(joined, all);
    }

    #[test]
    fn a_sample_depends_on_its_seed_alone() {
        let sample = |seed| {
            ids(&Part {
                sample: Some((5, seed)),
                ..Part::default()
            })
        };
        assert_eq!(sample(1).len(), 5);
        assert_eq!(sample(1), sample(1));
        assert_ne!(sample(1), sample(2));
        let all = ids(&Part::default());
        let places: Vec<_> = sample(1)
            .iter()
            .map(|id| all.iter().position(|other| other == id))
            .collect();
        assert!(places.is_sorted());
        assert_eq!(
            ids(&Part {
                sample: Some((1000, 1)),
                ..Part::default()
            }),
            all
        );
    }
}
