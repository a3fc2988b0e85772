//! Hand-picked inputs with answers known from geometry or worked out on paper: a third oracle beside the two computed ones.
//!
//! One file a topic, as the truths have it. Answers are exact in f64; where a decimal is rounded, it is rounded to more digits than any tolerance sees.

mod below;
mod codecs;
mod cubes;
mod frames;
mod relief;
mod search;
mod shading;

use bossage_shaders::Probe;

use super::Inputs;

/// One input and its outputs.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    function: &'static str,
    /// The arguments.
    pub inputs: &'static [f32],
    /// The answers.
    pub outputs: &'static [f64],
}

/// The known answers of a probe.
#[must_use]
pub fn rows(probe: &Probe) -> Vec<&'static Known> {
    table().filter(|row| row.function == probe.function()).collect()
}

/// The inputs of the known answers, in the order of [`rows`].
#[must_use]
pub fn generate(probe: &Probe) -> Inputs {
    let mut inputs = Inputs::of(probe);
    for row in rows(probe) {
        inputs.push([row.inputs.to_vec()]);
    }
    inputs
}

const fn known(function: &'static str, inputs: &'static [f32], outputs: &'static [f64]) -> Known {
    Known {
        function,
        inputs,
        outputs,
    }
}

const HALF_ROOT: f64 = std::f64::consts::FRAC_1_SQRT_2;
const IDENTITY: [f32; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// All rows.
pub fn table() -> impl Iterator<Item = &'static Known> {
    [
        below::ROWS,
        codecs::ROWS,
        cubes::ROWS,
        frames::ROWS,
        relief::ROWS,
        search::ROWS,
        shading::ROWS,
    ]
    .into_iter()
    .flatten()
}

#[cfg(test)]
mod tests {
    use bossage_shaders::{PROBES, TECHNIQUES};

    use super::table;

    #[test]
    fn every_row_fits_its_probe() {
        for row in table() {
            let probe = PROBES.iter().find(|probe| probe.function() == row.function);
            let probe =
                probe.unwrap_or_else(|| panic!("known answers for `{}`, which is no probe", row.function));
            assert_eq!(
                (row.inputs.len(), row.outputs.len()),
                (probe.input_floats, probe.output_floats),
                "{}",
                probe.id
            );
        }
    }

    #[test]
    fn every_technique_has_a_known_answer() {
        for technique in TECHNIQUES {
            let has = |row: &super::Known| {
                PROBES
                    .iter()
                    .any(|probe| probe.technique == technique.id && probe.function() == row.function)
            };
            assert!(table().any(has), "{}", technique.id);
        }
    }
}
