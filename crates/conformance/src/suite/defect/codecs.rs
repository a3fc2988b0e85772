//! Defects of the codecs of normals.

use super::property::{ensure, finite};
use super::{Defect, Evidence};

pub(super) const ROWS: &[Defect] = &[
    Defect {
        name: "byte_zero",
        published: "codec_biased_decode_published",
        hardened: Some("codec_biased_decode"),
        witness: &[0.0, 128.0, 255.0],
        cured_witness: None,
        property: |out| ensure(out[0] >= -1.0, || format!("byte 0 decodes to {}", out[0])),
        evidence: Evidence::Output,
        about: "byte 0 decodes to −1.0079",
        cure: "byte 0 counts as −1",
    },
    Defect {
        name: "truncation",
        published: "codec_biased_encode_published",
        hardened: Some("codec_biased_encode"),
        witness: &[0.9 / 127.0, 0.0, 1.0],
        cured_witness: None,
        property: |out| {
            ensure((out[0] - 128.9).abs() <= 0.5, || {
                format!("128.9 is encoded as {}", out[0])
            })
        },
        evidence: Evidence::Output,
        about: "truncation errs by up to a whole step instead of half of one",
        cure: "rounds to the nearest byte",
    },
    Defect {
        name: "code_mixed",
        published: "codec_unorm_decode",
        hardened: Some("codec_biased_decode"),
        witness: &[1.0 / 255.0, 128.0 / 255.0, 1.0],
        cured_witness: Some(&[1.0, 128.0, 255.0]),
        property: |out| {
            ensure(out[0] == -1.0 && out[1] == 0.0, || {
                format!(
                    "bytes 1 and 128, written for −1 and 0, are read as {} and {}",
                    out[0], out[1]
                )
            })
        },
        evidence: Evidence::Output,
        about: "a map written by codec_biased and read by codec_unorm, as the article does: −1 and 0 come back as −0.992 and 0.0039",
        cure: "one code for both ways: 1 is −1, 128 is 0",
    },
    Defect {
        name: "no_zero",
        published: "codec_unorm_decode",
        hardened: None,
        witness: &[128.0 / 255.0, 127.0 / 255.0, 1.0],
        cured_witness: None,
        property: |out| {
            ensure(out[0] == 0.0 || out[1] == 0.0, || {
                format!("bytes 128 and 127 decode to {} and {}", out[0], out[1])
            })
        },
        evidence: Evidence::Output,
        about: "no byte stands for 0: a flat map tilts by 0.318°",
        cure: "none in this code: codec_biased and codec_snorm hold 0",
    },
    Defect {
        name: "outside_the_circle",
        published: "codec_two_channel_decode_published",
        hardened: Some("codec_two_channel_decode"),
        witness: &[0.8, 0.8],
        cured_witness: None,
        property: finite,
        evidence: Evidence::Output,
        about: "x² + y² > 1 has no z: the root of a negative number",
        cure: "nothing left for z: z = 0",
    },
    Defect {
        name: "sign_of_zero",
        published: "codec_octahedral_encode_published",
        hardened: Some("codec_octahedral_encode"),
        witness: &[0.0, 0.0, -1.0],
        cured_witness: None,
        property: |out| {
            ensure(out.iter().all(|c| c.abs() == 1.0), || {
                format!("−z is encoded as {out:?}: +z")
            })
        },
        evidence: Evidence::Output,
        about: "sign(0) is 0: −z is folded onto the point of +z",
        cure: "the sign of zero is +1: (1, 1)",
    },
    Defect {
        name: "meridian",
        published: "codec_octahedral_encode_published",
        hardened: Some("codec_octahedral_encode"),
        witness: &[0.0, 0.6, -0.8],
        cured_witness: None,
        property: |out| {
            ensure(out[0].abs() > 0.5, || {
                format!("(0, 0.6, −0.8) is encoded as {out:?}, which is y")
            })
        },
        evidence: Evidence::Output,
        about: "sign(0) is 0: directions of the lower half with x = 0 collapse onto an axis",
        cure: "the sign of zero is +1",
    },
    Defect {
        name: "no_direction",
        published: "codec_octahedral_encode_published",
        hardened: Some("codec_octahedral_encode"),
        witness: &[0.0, 0.0, 0.0],
        cured_witness: None,
        property: finite,
        evidence: Evidence::Output,
        about: "the zero vector is divided by the sum of its components",
        cure: "(0, 0), which is +z",
    },
];
