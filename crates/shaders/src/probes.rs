//! The table of probes. One row a pure function of `shaders/lib` and `shaders/techniques`; a test holds it complete.

use crate::feature_set::Form::{Hardened, Published};
use crate::probe::{Field, Probe, ProbeId, Role, Shape, floats};

macro_rules! fields {
    ($($name:ident: $shape:ident $role:ident),* $(,)?) => {
        &[$(Field { name: stringify!($name), shape: Shape::$shape, role: Role::$role }),*]
    };
}

macro_rules! probe {
    ($function:ident, $dir:literal / $technique:ident, $form:ident, ($($inputs:tt)*) -> ($($outputs:tt)*)) => {
        Probe {
            id: ProbeId(stringify!($function)),
            technique: stringify!($technique),
            form: $form,
            entry: concat!("probe_", stringify!($function)),
            module: concat!($dir, "/", stringify!($technique)),
            input_floats: floats(fields!($($inputs)*)),
            output_floats: floats(fields!($($outputs)*)),
            inputs: fields!($($inputs)*),
            outputs: fields!($($outputs)*),
        }
    };
}

/// Every probe, sorted by file and then as the functions stand in it.
pub const PROBES: &[Probe] = &[
    // ------------------------------------------------------------------------------------------------------------- lib
    probe!(resolve_edge, "lib"/edge, Hardened, (index: I32 Index, size: U32 Size, edge_mode: U32 EdgeMode) -> (index: U32 Output)),
    probe!(bitangent, "lib"/frame, Hardened, (normal: Vec3 Unit, tangent: Vec4 Tangent) -> (bitangent: Vec3 Output)),
    probe!(cofactor_matrix, "lib"/linear, Hardened, (linear: Mat3 Matrix) -> (cofactor: Mat3 Output)),
    probe!(normalise, "lib"/normalise, Hardened, (v: Vec3 Vector) -> (unit: Vec3 Output)),
    probe!(normalise_published, "lib"/normalise, Published, (v: Vec3 Vector) -> (unit: Vec3 Output)),
    probe!(pack_rgba8, "lib"/pack, Hardened, (bytes: Vec4u Byte) -> (word: U32 Output)),
    probe!(elevation, "lib"/relief, Hardened, (height: F32 Height, height_scale: F32 Scale, height_bias: F32 Scale) -> (z: F32 Output)),
    // ------------------------------------------------------------------------------------------------------ techniques
    probe!(blinn_phong, "techniques"/blinn_phong, Hardened,
        (normal: Vec3 Unit, light_dir: Vec3 Unit, view_dir: Vec3 Unit, diffuse: Vec3 Colour, specular: Vec3 Colour, shininess: F32 Exponent)
        -> (colour: Vec3 Output)),
    probe!(blinn_phong_published, "techniques"/blinn_phong, Published,
        (normal: Vec3 Unit, light_dir: Vec3 Unit, view_dir: Vec3 Unit, diffuse: Vec3 Colour, specular: Vec3 Colour, shininess: F32 Exponent)
        -> (colour: Vec3 Output)),
    probe!(lambert, "techniques"/blinn_phong, Hardened, (normal: Vec3 Unit, light_dir: Vec3 Unit) -> (factor: F32 Output)),
    probe!(half_vector, "techniques"/blinn_phong, Hardened, (light_dir: Vec3 Unit, view_dir: Vec3 Unit) -> (half_dir: Vec3 Output)),
    probe!(half_vector_published, "techniques"/blinn_phong, Published, (light_dir: Vec3 Unit, view_dir: Vec3 Unit) -> (half_dir: Vec3 Output)),
    probe!(specular_lobe, "techniques"/blinn_phong, Hardened, (n_dot_h: F32 Cosine, shininess: F32 Exponent) -> (factor: F32 Output)),
    probe!(specular_lobe_published, "techniques"/blinn_phong, Published, (n_dot_h: F32 Cosine, shininess: F32 Exponent) -> (factor: F32 Output)),
    probe!(codec_biased_encode, "techniques"/codec_biased, Hardened, (normal: Vec3 Snorm) -> (bytes: Vec3 Output)),
    probe!(codec_biased_encode_published, "techniques"/codec_biased, Published, (normal: Vec3 Snorm) -> (bytes: Vec3 Output)),
    probe!(codec_biased_decode, "techniques"/codec_biased, Hardened, (bytes: Vec3 Byte) -> (normal: Vec3 Output)),
    probe!(codec_biased_decode_published, "techniques"/codec_biased, Published, (bytes: Vec3 Byte) -> (normal: Vec3 Output)),
    probe!(codec_unorm_encode, "techniques"/codec_unorm, Hardened, (normal: Vec3 Snorm) -> (code: Vec3 Output)),
    probe!(codec_unorm_encode_published, "techniques"/codec_unorm, Published, (normal: Vec3 Snorm) -> (code: Vec3 Output)),
    probe!(codec_unorm_decode, "techniques"/codec_unorm, Hardened, (code: Vec3 Unorm) -> (normal: Vec3 Output)),
    probe!(codec_unorm_decode_published, "techniques"/codec_unorm, Published, (code: Vec3 Unorm) -> (normal: Vec3 Output)),
    probe!(unorm_byte, "techniques"/codec_unorm, Hardened, (code: Vec3 Unorm) -> (bytes: Vec3 Output)),
    probe!(dot3, "techniques"/dot3, Hardened, (normal: Vec3 MapNormal, light: Vec3 Vector, diffuse: Vec3 Colour) -> (colour: Vec3 Output)),
    probe!(dot3_published, "techniques"/dot3, Published, (normal: Vec3 MapNormal, light: Vec3 Vector, diffuse: Vec3 Colour) -> (colour: Vec3 Output)),
    probe!(dot3_combiner, "techniques"/dot3, Published, (a: Vec3 Unorm, b: Vec3 Unorm) -> (intensity: F32 Output)),
    probe!(frame_mikktspace, "techniques"/frame_mikktspace, Hardened, (normal_ts: Vec3 MapNormal, normal: Vec3 Vector, tangent: Vec4 Tangent) -> (normal: Vec3 Output)),
    probe!(frame_from_uv_triangle, "techniques"/frame_from_uv, Hardened, (p: Vec3 Edge, q: Vec3 Edge, st1: Vec2 UvEdge, st2: Vec2 UvEdge) -> (tangent: Vec3 Output, bitangent: Vec3 Output)),
    probe!(frame_from_uv_triangle_published, "techniques"/frame_from_uv, Published, (p: Vec3 Edge, q: Vec3 Edge, st1: Vec2 UvEdge, st2: Vec2 UvEdge) -> (tangent: Vec3 Output, bitangent: Vec3 Output)),
    probe!(frame_from_uv_vertex, "techniques"/frame_from_uv, Hardened, (normal: Vec3 Unit, tangent_sum: Vec3 Vector, bitangent_sum: Vec3 Vector) -> (tangent: Vec4 Output)),
    probe!(frame_from_uv_vertex_published, "techniques"/frame_from_uv, Published, (normal: Vec3 Unit, tangent_sum: Vec3 Vector, bitangent_sum: Vec3 Vector) -> (tangent: Vec4 Output)),
    probe!(height_to_normal, "techniques"/height_to_normal, Hardened, (left: F32 Height, right: F32 Height, before: F32 Height, after: F32 Height, slope_scale: Vec2 Scale) -> (normal: Vec3 Output)),
    probe!(height_to_normal_forward, "techniques"/height_to_normal_forward, Hardened, (here: F32 Height, right: F32 Height, after: F32 Height, slope_scale: Vec2 Scale) -> (normal: Vec3 Output)),
    probe!(height_to_normal_forward_published, "techniques"/height_to_normal_forward, Published, (here: F32 Height, next_row: F32 Height, next_column: F32 Height, slope_scale: F32 Scale) -> (normal: Vec3 Output)),
    probe!(light_to_tangent, "techniques"/light_to_tangent, Hardened, (tangent: Vec3 Unit, bitangent: Vec3 Unit, normal: Vec3 Unit, light: Vec3 Vector) -> (light_ts: Vec3 Output)),
    probe!(light_to_tangent_object_space, "techniques"/light_to_tangent, Hardened, (object_from_world: Mat3 Rotation, tangent: Vec3 Unit, bitangent: Vec3 Unit, normal: Vec3 Unit, light: Vec3 Vector) -> (light_ts: Vec3 Output)),
    probe!(normal_transform, "techniques"/normal_transform, Hardened, (linear: Mat3 Matrix, normal: Vec3 Unit) -> (normal: Vec3 Output)),
    probe!(normal_transform_published, "techniques"/normal_transform, Published, (linear: Mat3 Matrix, normal: Vec3 Unit) -> (normal: Vec3 Output)),
    probe!(tangent_transform, "techniques"/normal_transform, Hardened, (linear: Mat3 Matrix, tangent: Vec4 Tangent) -> (tangent: Vec4 Output)),
    probe!(parallax_offset, "techniques"/parallax_offset, Hardened, (uv: Vec2 Uv, z: F32 Elevation, view_dir_ts: Vec3 Unit) -> (uv: Vec2 Output)),
    probe!(parallax_offset_published, "techniques"/parallax_offset, Published, (uv: Vec2 Uv, z: F32 Elevation, view_dir_ts: Vec3 Unit) -> (uv: Vec2 Output)),
    probe!(parallax_offset_limited, "techniques"/parallax_offset_limited, Hardened, (uv: Vec2 Uv, z: F32 Elevation, view_dir_ts: Vec3 Unit) -> (uv: Vec2 Output)),
];
