//! Height fields: their normals, their levels, and relief.

use bossage_reference::{
    codec_biased, codec_unorm, displacement, height_to_normal, height_to_normal_forward,
    height_to_normal_fourth_order, normal_mips, parallax_offset, parallax_offset_limited, parallax_slope_ao,
    parallax_slope_ao_directed,
};
use displacement::Tile;
use glam::DVec2;

use super::below::length_of;
use super::{Rows, out2, out3, v2, v3};

pub(super) const ROWS: Rows = &[
    ("height_to_normal", |a| {
        out3(height_to_normal::normal(
            a.scalar(),
            a.scalar(),
            a.scalar(),
            a.scalar(),
            v2(a),
        ))
    }),
    ("height_to_normal_forward", |a| {
        out3(height_to_normal_forward::normal_hardened(
            a.scalar(),
            a.scalar(),
            a.scalar(),
            v2(a),
        ))
    }),
    ("height_to_normal_forward_published", |a| {
        out3(height_to_normal_forward::normal_published(
            a.scalar(),
            a.scalar(),
            a.scalar(),
            a.scalar(),
        ))
    }),
    ("height_to_normal_fourth_order", |a| {
        out3(height_to_normal_fourth_order::normal(a.array(), a.array(), v2(a)))
    }),
    ("parallax_offset", |a| {
        let (uv, z) = (v2(a), a.scalar());
        out2(parallax_offset::hardened(uv, v3(a), z, 1.0, 0.0))
    }),
    ("parallax_offset_published", |a| {
        let (uv, z) = (v2(a), a.scalar());
        out2(parallax_offset::published(uv, v3(a), z, 1.0, 0.0))
    }),
    ("parallax_offset_limited", |a| {
        let (uv, z) = (v2(a), a.scalar());
        out2(parallax_offset_limited::offset(uv, v3(a), z, 1.0, 0.0))
    }),
    ("parallax_slope_ao_delta", |a| {
        let (n, up, view) = (v3(a), v3(a), v3(a));
        let [height, scale] = a.array();
        vec![parallax_slope_ao::delta_hardened(n, up, view, height, scale)]
    }),
    ("parallax_slope_ao_delta_published", |a| {
        let (n, up, view) = (v3(a), v3(a), v3(a));
        let [height, scale] = a.array();
        vec![parallax_slope_ao::delta_published(n, up, view, height, scale)]
    }),
    ("slope_occlusion", |a| {
        vec![parallax_slope_ao::occlusion(a.scalar(), a.scalar())]
    }),
    ("slope_occlusion_published", |a| {
        vec![parallax_slope_ao::published(DVec2::ZERO, a.scalar(), a.scalar()).ambient_occlusion]
    }),
    ("parallax_slope_ao", |a| {
        out2(parallax_slope_ao::hardened(v2(a), a.scalar(), 0.0).uv)
    }),
    ("parallax_slope_ao_directed", |a| {
        out2(parallax_slope_ao_directed::shift(v2(a), v3(a), a.scalar(), 0.0).uv)
    }),
    ("displacement", |a| {
        let (position, normal) = (v3(a), v3(a));
        let [height, scale, bias, unit] = a.array();
        out3(displacement::position(
            position, normal, height, scale, bias, unit,
        ))
    }),
    ("displacement_slope", |a| {
        let heights = a.array();
        out2(displacement::slope(heights, v2(a)))
    }),
    ("displacement_normal", |a| {
        let tile = Tile {
            normal: v3(a),
            along_u: v3(a),
            along_v: v3(a),
        };
        out3(displacement::normal(&tile, v2(a)))
    }),
    ("mip_shares", |a| {
        let (index, from) = (a.scalar() as u32, a.scalar() as u32);
        normal_mips::shares(index, from).to_vec()
    }),
    ("normal_mips", |a| out3(normal_mips::naive(v3(a)))),
    ("normal_mips_published", |a| out3(v3(a))),
    ("normal_mips_bytes", |a| {
        let normal = normal_mips::naive(v3(a));
        let encode = [codec_unorm::encode_byte, codec_biased::encode_hardened][a.scalar() as usize];
        normal.to_array().map(|n| f64::from(encode(n))).to_vec()
    }),
    ("normal_mips_decode", |a| {
        let (bytes, codec) = (v3(a), a.scalar());
        let decode = |byte| match codec as u32 {
            0 => codec_unorm::decode_byte(byte as u8),
            _ => codec_biased::decode_hardened(byte),
        };
        bytes.to_array().map(decode).to_vec()
    }),
    ("normal_mips_length", |a| vec![length_of(v3(a))]),
];
