//! What drivers and compilers are known to get wrong: each with a witness, and with the inputs at which it may show.
//!
//! A case that meets a known deviation fails as expected; what is refused at other inputs is a failure as ever. An entry whose witness
//! no longer shows is a failure too: it has to go.

use bossage_runner::{AdapterInfo, AdapterSelector};

use crate::case::Outcome;
use crate::compare::{Comparison, Expected};
use crate::route::Route;
use crate::verdict::Verdict;

/// One of them.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// The routes on which it shows. Empty: every route.
    pub routes: &'static [Route],
    /// Part of the adapter's name or driver, as on the command line. Empty: every driver.
    pub driver: &'static str,
    /// What deviates: `accuracy/FUNCTION`, or a technique with the kind of its case.
    pub subject: &'static str,
    /// An item of inputs at which it shows.
    pub witness: &'static [f32],
    /// Whether it may show at an item of inputs.
    pub extent: fn(&[f32]) -> bool,
    /// What is wrong.
    pub reason: &'static str,
}

/// All that are known.
pub const ALL: &[Deviation] = &[
    Deviation {
        routes: &[],
        driver: "SwiftShader",
        subject: "accuracy/atan2",
        witness: &[-0.0, 1.0],
        extent: |pair| pair[0].abs() < f32::MIN_POSITIVE && pair[1] > 0.0,
        reason: "atan2(-0, x) is π for x > 0",
    },
    Deviation {
        routes: &[],
        driver: "SwiftShader",
        subject: "normalisation_cube_map/lookup",
        witness: &[0.003_906_25, -0.001_091_254_5, 0.003_830_036_4, 16.0],
        extent: |item| {
            let [x, y, z, size] = [0, 1, 2, 3].map(|at| item[at].abs());
            let mut along = [x, y, z];
            along.sort_by(f32::total_cmp);
            // Beyond the middle of the outermost texel of a face.
            along[1] > along[2] * (1.0 - 1.001 / size)
        },
        reason: "filtered across the edge of a face, a cube map gives other colours than the four texels around the place",
    },
    Deviation {
        routes: &[Route::Hlsl],
        driver: "",
        subject: "accuracy/sign",
        witness: &[2.0, 0.0],
        extent: |pair| pair[0] != 0.0,
        reason: "naga writes `sign(x)` for HLSL as for WGSL, where its result is an integer: stored by `asuint`, its bits are no float's",
    },
    Deviation {
        routes: &[Route::Glsl, Route::Opengl],
        driver: "",
        subject: "accuracy/to_int",
        witness: &[3e9, 0.0],
        extent: |pair| !(-2_147_483_648.0..2_147_483_648.0).contains(&pair[0]),
        reason: "naga writes `int(x)` for GLSL, which leaves numbers beyond the integers open where WGSL takes the nearest",
    },
    Deviation {
        routes: &[Route::Glsl, Route::Opengl],
        driver: "",
        subject: "accuracy/to_uint",
        witness: &[-2.0, 0.0],
        extent: |pair| !(0.0..4_294_967_296.0).contains(&pair[0]),
        reason: "naga writes `uint(x)` for GLSL, which leaves numbers beyond the integers open where WGSL takes the nearest",
    },
    Deviation {
        routes: &[Route::Opengl],
        driver: "llvmpipe",
        subject: "accuracy/asin",
        witness: &[-0.472_800_5, 0.0],
        extent: |pair| (0.36..0.48).contains(&pair[0].abs()),
        reason: "Mesa's compiler of GLSL, which asks for no accuracy of `asin`, puts a polynomial in its place that is up to 2e-4 off: more \
                 than WGSL allows where the result is just below a half",
    },
];

/// What is known of a subject on a route and an adapter.
#[must_use]
pub fn of(subject: &str, route: Route, info: &AdapterInfo) -> Option<&'static Deviation> {
    ALL.iter().find(|known| {
        known.subject == subject
            && (known.routes.is_empty() || known.routes.contains(&route))
            && (known.driver.is_empty() || AdapterSelector::named(known.driver).matches(info))
    })
}

/// A comparison that keeps what a known deviation may refuse apart from everything else.
#[derive(Clone, Debug, Default)]
pub struct Judged {
    known: Option<&'static Deviation>,
    inside: Comparison,
    outside: Comparison,
}

impl Judged {
    /// An empty one, for what is known.
    #[must_use]
    pub fn new(known: Option<&'static Deviation>) -> Self {
        Self {
            known,
            ..Self::default()
        }
    }

    /// Compares the outputs of one item.
    pub fn item(&mut self, input: &[f32], got: &[f32], expected: &[Expected]) {
        let inside = self.known.is_some_and(|known| (known.extent)(input));
        let comparison = if inside {
            &mut self.inside
        } else {
            &mut self.outside
        };
        comparison.item(input, got, expected);
    }

    /// Adds another part of the same case.
    pub fn merge(&mut self, other: Self) {
        self.inside.merge(other.inside);
        self.outside.merge(other.outside);
    }

    /// Outputs that were refused where the deviation may show.
    #[must_use]
    pub fn deviating(&self) -> usize {
        self.inside.refused
    }

    /// The outcome: a failure where something else is refused or the known deviation does not show, an expected failure where only
    /// that is refused.
    #[must_use]
    pub fn outcome(self, inputs: usize, undecided_limit: f64) -> Outcome {
        let Some(known) = self.known else {
            return Outcome::of(inputs, self.outside, undecided_limit);
        };
        let (deviating, others_refused) = (self.inside.refused, self.outside.refused);
        let mut all = self.outside;
        all.merge(self.inside);
        let outputs = all.outputs;
        let outcome = Outcome::of(inputs, all, undecided_limit);
        if deviating == 0 {
            return Outcome {
                verdict: Verdict::Fail,
                reason: Some(format!(
                    "the known deviation does not show any more ({}): take it out of the list",
                    known.reason
                )),
                ..outcome
            };
        }
        if others_refused > 0 {
            return Outcome {
                reason: Some(format!(
                    "{others_refused} of {outputs} outputs refused besides {deviating} of a known deviation ({})",
                    known.reason
                )),
                ..outcome
            };
        }
        Outcome {
            verdict: Verdict::ExpectedFail,
            reason: Some(format!("{deviating} of {outputs} outputs: {}", known.reason)),
            ..outcome
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bound::Bound;

    static KNOWN: Deviation = Deviation {
        routes: &[Route::Spirv],
        driver: "",
        subject: "accuracy/add",
        witness: &[1.0, 2.0],
        extent: |pair| pair[0] == 1.0,
        reason: "never",
    };

    fn judged(items: &[(f32, f32)]) -> Outcome {
        let mut judged = Judged::new(Some(&KNOWN));
        let expected = [Expected {
            truth: 3.0,
            bound: Bound::between(3.0, 3.0),
        }];
        for (input, got) in items {
            judged.item(&[*input, 2.0], &[*got], &expected);
        }
        judged.outcome(items.len(), 1.0)
    }

    #[test]
    fn a_deviation_is_expected_where_it_may_show_and_nowhere_else() {
        assert_eq!(judged(&[(1.0, 4.0), (0.5, 3.0)]).verdict, Verdict::ExpectedFail);
        let elsewhere = judged(&[(1.0, 4.0), (0.5, 4.0)]);
        assert_eq!(elsewhere.verdict, Verdict::Fail);
        assert!(
            elsewhere
                .reason
                .unwrap()
                .starts_with("1 of 2 outputs refused besides 1")
        );
    }

    #[test]
    fn one_that_does_not_show_is_stale() {
        let stale = judged(&[(1.0, 3.0), (0.5, 3.0)]);
        assert_eq!(stale.verdict, Verdict::Fail);
        assert!(stale.reason.unwrap().contains("take it out of the list"));
    }

    #[test]
    fn every_witness_lies_where_its_deviation_may_show_and_not_everything_does() {
        for known in ALL {
            assert!((known.extent)(known.witness), "{}", known.subject);
            let usual = [[0.7, 0.1, 0.2, 16.0], [0.0; 4]];
            assert!(
                usual
                    .iter()
                    .any(|usual| !(known.extent)(&usual[..known.witness.len()])),
                "{}",
                known.subject
            );
        }
    }

    #[test]
    fn what_is_known_of_a_driver_is_not_held_of_another() {
        let info = bossage_embedded::info();
        assert!(of("accuracy/atan2", Route::Wgsl, &info).is_none());
        let swiftshader = AdapterInfo {
            name: "SwiftShader Device".into(),
            ..info
        };
        assert!(of("accuracy/atan2", Route::Wgsl, &swiftshader).is_some());
        assert!(of("accuracy/add", Route::Wgsl, &swiftshader).is_none());
    }

    #[test]
    fn what_is_known_of_a_route_is_not_held_of_another() {
        let info = bossage_embedded::info();
        assert!(of("accuracy/sign", Route::Hlsl, &info).is_some());
        assert!(of("accuracy/sign", Route::Glsl, &info).is_none());
    }
}
