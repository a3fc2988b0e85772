//! The codecs of normals.

use super::{HALF_ROOT, Known, known};

pub(super) const ROWS: &[Known] = &[
    known("codec_biased_encode", &[-1.0, 0.0, 1.0], &[1.0, 128.0, 255.0]),
    // 0.7/127 lies nearer to 129 than to 128; truncation falls to 128.
    known(
        "codec_biased_encode",
        &[0.005_511_811, -0.005_511_811, 0.5],
        &[129.0, 127.0, 192.0],
    ),
    // Components outside of [-1, 1] are clamped, in the published form as bytes.
    known("codec_biased_encode", &[-1.5, 1.5, 1.0], &[1.0, 255.0, 255.0]),
    known(
        "codec_biased_encode_published",
        &[-1.5, 1.5, 1.0],
        &[0.0, 255.0, 255.0],
    ),
    known(
        "codec_biased_encode_published",
        &[-1.0, 0.0, 1.0],
        &[1.0, 128.0, 255.0],
    ),
    known(
        "codec_biased_encode_published",
        &[0.005_511_811, -0.005_511_811, 0.5],
        &[128.0, 127.0, 191.0],
    ),
    known("codec_biased_decode", &[0.0, 128.0, 255.0], &[-1.0, 0.0, 1.0]),
    known(
        "codec_biased_decode_published",
        &[0.0, 128.0, 255.0],
        &[-128.0 / 127.0, 0.0, 1.0],
    ),
    known("codec_octahedral_encode", &[0.0, 0.0, 5.0], &[0.0, 0.0]),
    known("codec_octahedral_encode", &[0.0, -1e-30, 0.0], &[0.0, -1.0]),
    known("codec_octahedral_encode", &[0.0, 0.0, -1.0], &[1.0, 1.0]),
    known("codec_octahedral_encode", &[0.0, 0.0, 0.0], &[0.0, 0.0]),
    // (1, 2, −1)/4 lies in the lower half: folded over the edge to (1 − 1/2, 1 − 1/4).
    known("codec_octahedral_encode", &[1.0, 2.0, -1.0], &[0.5, 0.75]),
    known(
        "codec_octahedral_encode_published",
        &[1.0, 2.0, -1.0],
        &[0.5, 0.75],
    ),
    known("codec_octahedral_decode", &[0.0, 0.0], &[0.0, 0.0, 1.0]),
    known("codec_octahedral_decode", &[-1.0, 1.0], &[0.0, 0.0, -1.0]),
    known(
        "codec_octahedral_decode",
        &[0.5, 0.5],
        &[HALF_ROOT, HALF_ROOT, 0.0],
    ),
    known("octahedral_fold", &[0.25, -0.5], &[0.5, -0.75]),
    known(
        "codec_snorm_encode",
        &[-1.0, 0.0, 1.0, 127.0],
        &[-127.0, 0.0, 127.0],
    ),
    known(
        "codec_snorm_encode",
        &[-1.5, 1.5, 1.25, 127.0],
        &[-127.0, 127.0, 127.0],
    ),
    // Ties go away from zero: 16383.5 and −16383.5.
    known(
        "codec_snorm_encode",
        &[0.5, -0.5, 0.25, 32_767.0],
        &[16_384.0, -16_384.0, 8192.0],
    ),
    known(
        "codec_snorm_decode",
        &[-128.0, 0.0, 127.0, 127.0],
        &[-1.0, 0.0, 1.0],
    ),
    known(
        "codec_snorm_decode",
        &[-32_768.0, -32_767.0, 32_767.0, 32_767.0],
        &[-1.0, -1.0, 1.0],
    ),
    known(
        "codec_two_channel_encode",
        &[0.6, 0.0, 0.8],
        &[0.600_000_023_841_857_9, 0.0],
    ),
    known("codec_two_channel_decode", &[0.0, 0.0], &[0.0, 0.0, 1.0]),
    // Nothing left for z, and less than nothing.
    known("codec_two_channel_decode", &[1.0, 0.0], &[1.0, 0.0, 0.0]),
    known("codec_two_channel_decode", &[0.75, -1.0], &[0.75, -1.0, 0.0]),
    // 3-4-5 along both axes; an x of 0 needs no more than y.
    known(
        "codec_two_channel_decode_published",
        &[0.0, 0.0],
        &[0.0, 0.0, 1.0],
    ),
    known(
        "codec_two_channel_decode_published",
        &[0.6, 0.0],
        &[0.600_000_023_841_857_9, 0.0, 0.799_999_982_118_606_6],
    ),
    known(
        "codec_two_channel_decode_published",
        &[0.25, 0.5],
        &[0.25, 0.5, 0.829_156_197_588_85],
    ),
    known("codec_unorm_encode", &[-1.0, 0.0, 1.0], &[0.0, 0.5, 1.0]),
    known("codec_unorm_decode", &[0.0, 0.5, 1.0], &[-1.0, 0.0, 1.0]),
    known("codec_unorm_encode_byte", &[-1.0, 0.0, 1.0], &[0.0, 128.0, 255.0]),
    known("codec_unorm_encode_byte", &[-1.5, 1.5, 1.0], &[0.0, 255.0, 255.0]),
];
