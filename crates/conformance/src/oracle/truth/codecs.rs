//! The codecs of normals.

use bossage_reference::{codec_biased, codec_octahedral, codec_snorm, codec_two_channel, codec_unorm};
use codec_snorm::Bits;

use super::{Rows, each3, out2, out3, v2, v3};

pub(super) const ROWS: Rows = &[
    ("codec_biased_encode", |a| {
        each3(a, |n| f64::from(codec_biased::encode_hardened(n)))
    }),
    ("codec_biased_encode_published", |a| {
        each3(a, |n| f64::from(codec_biased::encode_published(n)))
    }),
    ("codec_biased_decode", |a| each3(a, codec_biased::decode_hardened)),
    ("codec_biased_decode_published", |a| {
        each3(a, codec_biased::decode_published)
    }),
    ("codec_unorm_encode", |a| each3(a, codec_unorm::encode)),
    ("codec_unorm_decode", |a| each3(a, codec_unorm::decode)),
    ("codec_unorm_encode_byte", |a| {
        each3(a, |n| f64::from(codec_unorm::encode_byte(n)))
    }),
    ("codec_octahedral_encode", |a| {
        out2(codec_octahedral::encode_hardened(v3(a)))
    }),
    ("codec_octahedral_encode_published", |a| {
        out2(codec_octahedral::encode_published(v3(a)))
    }),
    ("codec_octahedral_decode", |a| {
        out3(codec_octahedral::decode(v2(a)))
    }),
    ("octahedral_fold", |a| out2(codec_octahedral::fold(v2(a)))),
    ("codec_snorm_encode", |a| {
        let (n, bits) = (v3(a), bits(a.scalar()));
        n.to_array()
            .map(|c| f64::from(codec_snorm::encode(c, bits)))
            .to_vec()
    }),
    ("codec_snorm_decode", |a| {
        let (code, bits) = (v3(a), bits(a.scalar()));
        code.to_array()
            .map(|c| codec_snorm::decode(c as i32, bits))
            .to_vec()
    }),
    ("codec_two_channel_encode", |a| {
        out2(codec_two_channel::encode(v3(a)))
    }),
    ("codec_two_channel_decode", |a| {
        out3(codec_two_channel::decode_hardened(v2(a)))
    }),
    ("codec_two_channel_decode_published", |a| {
        out3(codec_two_channel::decode_published(v2(a)))
    }),
];

fn bits(one: f64) -> Bits {
    if one == Bits::Eight.one() {
        Bits::Eight
    } else {
        Bits::Sixteen
    }
}
