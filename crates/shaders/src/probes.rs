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
            file: concat!($dir, "/", stringify!($technique), ".wesl"),
            input_floats: floats(fields!($($inputs)*)),
            output_floats: floats(fields!($($outputs)*)),
            inputs: fields!($($inputs)*),
            outputs: fields!($($outputs)*),
        }
    };
}

/// Every probe, sorted by file and then as the functions stand in it.
pub const PROBES: &[Probe] = &[
    // lib
    probe!(resolve_edge, "lib"/edge, Hardened, (index: I32 Index, size: U32 Size, edge_mode: U32 EdgeMode) -> (texel: U32 Output)),
    probe!(euclidean_remainder, "lib"/edge, Hardened, (index: I32 Index, n: I32 Size) -> (remainder: I32 Output)),
    probe!(bitangent, "lib"/frame, Hardened, (normal: Vec3 Vector, tangent: Vec4 Tangent) -> (bitangent: Vec3 Output)),
    probe!(tangent_from_normal, "lib"/frame, Hardened, (normal: Vec3 Unit) -> (tangent: Vec3 Output)),
    probe!(lambert, "lib"/lambert, Hardened, (normal: Vec3 Unit, light_dir: Vec3 Unit) -> (factor: F32 Output)),
    probe!(linear_part, "lib"/linear, Hardened, (affine: Mat4 Rigid) -> (linear: Mat3 Output)),
    probe!(column_scales, "lib"/linear, Hardened, (linear: Mat3 Matrix) -> (scales: Vec3 Output)),
    probe!(cofactor_direction, "lib"/linear, Hardened, (linear: Mat3 Matrix, v: Vec3 Unit) -> (direction: Vec3 Direction)),
    probe!(mirror_sign, "lib"/linear, Hardened, (linear: Mat3 Matrix) -> (sign: F32 Output)),
    probe!(largest_component, "lib"/normalise, Hardened, (v: Vec3 Vector) -> (largest: F32 Output)),
    probe!(normalise, "lib"/normalise, Hardened, (v: Vec3 Vector) -> (unit: Vec3 Direction)),
    probe!(normalise_published, "lib"/normalise, Published, (v: Vec3 Vector) -> (unit: Vec3 Direction)),
    probe!(elevation, "lib"/relief, Hardened,
        (height: F32 Height, height_scale: F32 Scale, height_bias: F32 Scale) -> (z: F32 Output)),
    // techniques
    probe!(half_vector, "techniques"/blinn_phong, Hardened,
        (light_dir: Vec3 Unit, view_dir: Vec3 Unit) -> (half_dir: Vec3 Direction)),
    probe!(half_vector_published, "techniques"/blinn_phong, Published,
        (light_dir: Vec3 Unit, view_dir: Vec3 Unit) -> (half_dir: Vec3 Direction)),
    probe!(highlight_power, "techniques"/blinn_phong, Hardened,
        (n_dot_h: F32 Cosine, shininess: F32 Exponent) -> (factor: F32 Output)),
    probe!(highlight_power_published, "techniques"/blinn_phong, Published,
        (n_dot_h: F32 Cosine, shininess: F32 Exponent) -> (factor: F32 Output)),
    probe!(blinn_phong, "techniques"/blinn_phong, Hardened,
        (normal: Vec3 Unit, light_dir: Vec3 Unit, view_dir: Vec3 Unit, diffuse: Vec3 Colour, specular: Vec3 Colour,
         shininess: F32 Exponent) -> (colour: Vec3 Output)),
    probe!(blinn_phong_published, "techniques"/blinn_phong, Published,
        (normal: Vec3 Unit, light_dir: Vec3 Unit, view_dir: Vec3 Unit, diffuse: Vec3 Colour, specular: Vec3 Colour,
         shininess: F32 Exponent) -> (colour: Vec3 Output)),
    probe!(codec_biased_encode, "techniques"/codec_biased, Hardened, (normal: Vec3 Snorm) -> (bytes: Vec3 Output)),
    probe!(codec_biased_encode_published, "techniques"/codec_biased, Published, (normal: Vec3 Snorm) -> (bytes: Vec3 Output)),
    probe!(codec_biased_decode, "techniques"/codec_biased, Hardened, (bytes: Vec3 Byte) -> (normal: Vec3 Output)),
    probe!(codec_biased_decode_published, "techniques"/codec_biased, Published, (bytes: Vec3 Byte) -> (normal: Vec3 Output)),
    probe!(codec_unorm_encode, "techniques"/codec_unorm, Hardened, (normal: Vec3 Snorm) -> (code: Vec3 Output)),
    probe!(codec_unorm_decode, "techniques"/codec_unorm, Hardened, (code: Vec3 Unorm) -> (normal: Vec3 Output)),
    probe!(codec_unorm_encode_byte, "techniques"/codec_unorm, Hardened, (normal: Vec3 Snorm) -> (bytes: Vec3 Output)),
    probe!(dot3, "techniques"/dot3, Hardened,
        (normal: Vec3 MapNormal, light: Vec3 Vector, diffuse: Vec3 Colour) -> (colour: Vec3 Output)),
    probe!(dot3_published, "techniques"/dot3, Published,
        (normal: Vec3 MapNormal, light: Vec3 Vector, diffuse: Vec3 Colour) -> (colour: Vec3 Output)),
    probe!(dot3_combiner, "techniques"/dot3, Hardened, (a: Vec3 Unorm, b: Vec3 Unorm) -> (intensity: F32 Output)),
    probe!(frame_from_uv_triangle, "techniques"/frame_from_uv, Hardened,
        (p: Vec3 Edge, q: Vec3 Edge, st1: Vec2 UvEdge, st2: Vec2 UvEdge)
        -> (normal: Vec3 Output, tangent: Vec3 Output, bitangent: Vec3 Output, weight: F32 Output)),
    probe!(frame_from_uv_triangle_published, "techniques"/frame_from_uv, Published,
        (p: Vec3 Edge, q: Vec3 Edge, st1: Vec2 UvEdge, st2: Vec2 UvEdge)
        -> (normal: Vec3 Output, tangent: Vec3 Output, bitangent: Vec3 Output, weight: F32 Output)),
    probe!(frame_from_uv_vertex, "techniques"/frame_from_uv, Hardened,
        (normal: Vec3 Unit, tangent_sum: Vec3 Vector, bitangent_sum: Vec3 Vector, weight: F32 Weight)
        -> (tangent: Vec4 Output)),
    probe!(frame_from_uv_vertex_published, "techniques"/frame_from_uv, Published,
        (normal: Vec3 Unit, tangent_sum: Vec3 Vector, bitangent_sum: Vec3 Vector) -> (tangent: Vec4 Output)),
    probe!(handedness_of, "techniques"/frame_from_uv, Hardened,
        (normal: Vec3 Unit, tangent: Vec3 Vector, bitangent_dir: Vec3 Vector) -> (sign: F32 Output)),
    probe!(length_of, "techniques"/frame_from_uv, Hardened, (v: Vec3 Vector) -> (length: F32 Output)),
    probe!(frame_mikktspace, "techniques"/frame_mikktspace, Hardened,
        (normal: Vec3 Vector, tangent: Vec4 Tangent, vector_ts: Vec3 MapNormal) -> (direction: Vec3 Output)),
    probe!(combine_frame, "techniques"/frame_mikktspace, Hardened,
        (tangent: Vec3 Vector, bitangent_dir: Vec3 Vector, normal: Vec3 Vector, vector_ts: Vec3 MapNormal)
        -> (direction: Vec3 Output)),
    probe!(height_to_normal, "techniques"/height_to_normal, Hardened,
        (left: F32 Height, right: F32 Height, before: F32 Height, after: F32 Height, slope: Vec2 Slope)
        -> (normal: Vec3 Direction)),
    probe!(height_to_normal_forward, "techniques"/height_to_normal_forward, Hardened,
        (here: F32 Height, right: F32 Height, after: F32 Height, slope: Vec2 Slope) -> (normal: Vec3 Direction)),
    probe!(height_to_normal_forward_published, "techniques"/height_to_normal_forward, Published,
        (here: F32 Byte, next_row: F32 Byte, next_column: F32 Byte, height_scale: F32 Scale) -> (normal: Vec3 Direction)),
    probe!(light_to_tangent, "techniques"/light_to_tangent, Hardened,
        (tangent: Vec3 Unit, bitangent_dir: Vec3 Unit, normal: Vec3 Unit, light: Vec3 Vector) -> (light_ts: Vec3 Output)),
    probe!(light_to_tangent_world_space, "techniques"/light_to_tangent, Hardened,
        (normal_ws: Vec3 Unit, tangent_ws: Vec4 Tangent, light_ws: Vec3 Vector) -> (light_ts: Vec3 Output)),
    probe!(light_to_tangent_object_space, "techniques"/light_to_tangent, Hardened,
        (normal_os: Vec3 Unit, tangent_os: Vec4 Tangent, position_os: Vec3 Position, light_ws: Vec3 Position,
         local_from_world: Mat4 Rigid) -> (light_ts: Vec3 Output)),
    probe!(normal_transform, "techniques"/normal_transform, Hardened,
        (linear: Mat3 Matrix, normal: Vec3 Unit) -> (normal: Vec3 Direction)),
    probe!(normal_transform_by_cofactor, "techniques"/normal_transform, Hardened,
        (cofactor: Mat3 Matrix, mirror: F32 Sign, normal: Vec3 Unit) -> (normal: Vec3 Direction)),
    probe!(normal_transform_published, "techniques"/normal_transform, Published,
        (linear: Mat3 Matrix, normal: Vec3 Unit) -> (normal: Vec3 Output)),
    probe!(tangent_transform, "techniques"/normal_transform, Hardened,
        (linear: Mat3 Matrix, tangent: Vec3 Unit) -> (tangent: Vec3 Direction)),
    probe!(tangent_transform_published, "techniques"/normal_transform, Published,
        (linear: Mat3 Matrix, tangent: Vec3 Unit) -> (tangent: Vec3 Output)),
    probe!(parallax_offset, "techniques"/parallax_offset, Hardened,
        (uv: Vec2 Uv, z: F32 Elevation, view_dir_ts: Vec3 Unit) -> (uv: Vec2 Output)),
    probe!(parallax_offset_published, "techniques"/parallax_offset, Published,
        (uv: Vec2 Uv, z: F32 Elevation, view_dir_ts: Vec3 Unit) -> (uv: Vec2 Output)),
    probe!(parallax_offset_limited, "techniques"/parallax_offset_limited, Hardened,
        (uv: Vec2 Uv, z: F32 Elevation, view_dir_ts: Vec3 Unit) -> (uv: Vec2 Output)),
];
