//! Defects of tangent frames and of the vectors they are made of.

use super::property::{ensure, finite, orthonormal, unit};
use super::{Defect, Evidence};

pub(super) const ROWS: &[Defect] = &[
    Defect {
        name: "axis_parallel",
        published: "frame_from_normal_unit_published",
        hardened: Some("frame_from_normal"),
        witness: &[-0.577_350_26, 0.577_350_26, 0.577_350_26],
        cured_witness: None,
        property: |out| orthonormal([-0.577_350_26, 0.577_350_26, 0.577_350_26], out),
        evidence: Evidence::Output,
        about: "for N along (−1, 1, 1) the helper axis A is −N: no tangent is left",
        cure: "an orthonormal frame, without a helper axis",
    },
    Defect {
        name: "axis_near",
        published: "frame_from_normal_unit_published",
        hardened: Some("frame_from_normal"),
        witness: &[-0.577_350_3, 0.577_350_26, 0.577_350_3],
        cured_witness: None,
        property: |out| orthonormal([-0.577_350_3, 0.577_350_26, 0.577_350_3], out),
        evidence: Evidence::Output,
        about: "next to (−1, 1, 1) the tangent is a difference of equal products: the frame is skewed by a tenth",
        cure: "an orthonormal frame",
    },
    Defect {
        name: "axes_not_unit",
        published: "frame_from_normal_published",
        hardened: Some("frame_from_normal"),
        witness: &[0.6, 0.0, 0.8],
        cured_witness: None,
        property: |out| orthonormal([0.6, 0.0, 0.8], out),
        evidence: Evidence::Output,
        about: "T = N × A is as long as the sine of the angle between them",
        cure: "unit axes",
    },
    Defect {
        name: "left_handed",
        published: "frame_from_normal_published",
        hardened: Some("frame_from_normal"),
        witness: &[0.0, 0.0, 1.0],
        cured_witness: None,
        property: |out| {
            ensure(out[4] > 0.0, || {
                format!("N = z, T = x, and B = {:?}, not N × T = y", &out[3..])
            })
        },
        evidence: Evidence::Output,
        about: "B = T × N is the mirror image of B = cross(N, T)",
        cure: "B = N × T",
    },
    Defect {
        name: "frisvad_near_minus_z",
        published: "frame_frisvad_published",
        hardened: Some("frame_from_normal"),
        witness: &[3.832_516e-4, 3.886_863e-4, -0.999_999_9],
        cured_witness: None,
        property: |out| orthonormal([3.832_516e-4, 3.886_863e-4, -0.999_999_9], out),
        evidence: Evidence::Output,
        about: "1/(1 + n.z) magnifies the rounding of n.z near −z: the frame is off by more than a half",
        cure: "an orthonormal frame: |side + n.z| ≥ 1",
    },
    Defect {
        name: "no_texture_area",
        published: "frame_from_uv_triangle_published",
        hardened: Some("frame_from_uv_triangle"),
        witness: &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0],
        cured_witness: None,
        property: finite,
        evidence: Evidence::Output,
        about: "a triangle without texture area divides by zero",
        cure: "the triangle has no share",
    },
    Defect {
        name: "no_area",
        published: "frame_from_uv_triangle_published",
        hardened: Some("frame_from_uv_triangle"),
        witness: &[1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0],
        cured_witness: None,
        property: finite,
        evidence: Evidence::Output,
        about: "a triangle without area has no normal: 0/0 in the sum of its vertices",
        cure: "no share; the summed normal is N × twice the area",
    },
    Defect {
        name: "quantised_texture",
        published: "frame_from_uv_triangle_published",
        hardened: Some("frame_from_uv_triangle"),
        witness: &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.1, 0.7, 0.3, 2.1],
        cured_witness: None,
        property: |out| {
            ensure(out[3..9].iter().all(|x| x.abs() < 1e3), || {
                format!("tangents {:?} of a triangle of edge 1", &out[3..9])
            })
        },
        evidence: Evidence::Output,
        about: "texture edges that are parallel but for their rounding: an area of −1.1e-8 makes tangents of 10⁷",
        cure: "an area within rounding of 0 has no share",
    },
    Defect {
        name: "tangent_along_normal",
        published: "frame_from_uv_vertex_published",
        hardened: Some("frame_from_uv_vertex"),
        witness: &[0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 1.0, 0.0],
        cured_witness: Some(&[0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 1.0, 0.0, 3.0]),
        property: |out| unit(&out[..3]),
        evidence: Evidence::Output,
        about: "T parallel to N leaves no tangent",
        cure: "a tangent from the normal",
    },
    Defect {
        name: "tangent_not_unit",
        published: "frame_from_uv_vertex_published",
        hardened: Some("frame_from_uv_vertex"),
        witness: &[0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        cured_witness: Some(&[0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0, 3.0]),
        property: |out| unit(&out[..3]),
        evidence: Evidence::Output,
        about: "T' = T − (N·T) N is not a unit vector",
        cure: "a unit tangent",
    },
    Defect {
        name: "mirrored_neighbours",
        published: "frame_from_uv_vertex_published",
        hardened: Some("frame_from_uv_vertex"),
        witness: &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0],
        cured_witness: Some(&[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 2.0]),
        property: |out| unit(&out[..3]),
        evidence: Evidence::Output,
        about: "where mirrored halves meet in a vertex their tangents cancel",
        cure: "a tangent from the normal",
    },
    Defect {
        name: "non_uniform_scale",
        published: "normal_transform_published",
        hardened: Some("normal_transform"),
        // Stretched by 4 along x, the surface through (1, 0, −1)/√2 and y leans: its image holds (4, 0, −1).
        witness: &[4.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.8, 0.0, 0.6],
        cured_witness: None,
        property: |out| {
            let across = out[0] * (4.0 * 0.6) + out[2] * -0.8;
            let length = out.iter().map(|x| x * x).sum::<f32>().sqrt();
            ensure((across / length).abs() < 1e-5, || {
                format!("the normal {out:?} leans {across} out of the surface")
            })
        },
        evidence: Evidence::Output,
        about: "under non-uniform scale the normal is no longer perpendicular to the surface",
        cure: "the cofactor matrix keeps it at right angles",
    },
    Defect {
        name: "normal_not_unit",
        published: "normal_transform_published",
        hardened: Some("normal_transform"),
        witness: &[2.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0],
        cured_witness: None,
        property: unit,
        evidence: Evidence::Output,
        about: "a scaled object has scaled normals: they light with their length",
        cure: "a unit normal",
    },
    Defect {
        name: "mirrored_object",
        published: "bitangent_transform_published",
        hardened: Some("bitangent_transform"),
        witness: &[
            -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0,
        ],
        cured_witness: None,
        property: |out| {
            ensure(out[1] > 0.0, || {
                format!("mirrored along x, the bitangent y becomes {out:?}")
            })
        },
        evidence: Evidence::Output,
        about: "under a mirroring transform B = cross(N, T)·w points the wrong way",
        cure: "w times the sign of the determinant",
    },
    Defect {
        name: "tiny_light",
        published: "normalise_published",
        hardened: Some("normalise"),
        witness: &[0.0, 0.0, 1e-23],
        cured_witness: None,
        property: unit,
        evidence: Evidence::Output,
        about: "the square of 1e-23 is zero in f32: the direction is lost",
        cure: "scaled before it is squared",
    },
    Defect {
        name: "huge_light",
        published: "normalise_published",
        hardened: Some("normalise"),
        witness: &[0.0, 0.0, 2e19],
        cured_witness: None,
        property: unit,
        evidence: Evidence::Output,
        about: "the square of 2e19 overflows: the direction is lost",
        cure: "scaled before it is squared",
    },
];
