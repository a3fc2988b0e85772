//! Probes: one compute entry for each pure function of the library, so that every function can be run over arrays of
//! inputs on every route.
//!
//! A probe reads `inputs: array<f32>` (`@group(0) @binding(0)`, read only), calls one function an item, and writes
//! `outputs: array<f32>` (`@group(0) @binding(1)`); both are tightly packed with the strides of [`Probe::input_floats`] and
//! [`Probe::output_floats`]. The number of items is `arrayLength(&outputs) / output_floats`; invocations beyond it do
//! nothing. Workgroups hold [`WORKGROUP_SIZE`] items. Matrices are packed column by column; integers travel as floats that
//! hold them exactly.
//!
//! The entry's text is written from the table ([`crate::Library::assemble_probe`]), so table and shader cannot disagree
//! about a stride. The table itself is [`PROBES`](crate::PROBES), alone in its file.

use std::fmt;

use crate::feature_set::Form;

/// Items a workgroup.
pub const WORKGROUP_SIZE: u32 = 64;

/// The name of a probe, unique in [`PROBES`](crate::PROBES): the name of the function it calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ProbeId(pub(crate) &'static str);

impl ProbeId {
    /// The name as text.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        self.0
    }

    /// The row of the table. `None` only for an id of another version of the table.
    #[must_use]
    pub fn probe(self) -> Option<&'static Probe> {
        Probe::find(self.0)
    }
}

impl fmt::Display for ProbeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

/// The shader type of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// `f32`.
    F32,
    /// `u32`, carried as a float.
    U32,
    /// `i32`, carried as a float.
    I32,
    /// `bool`, carried as 0 or 1.
    Bool,
    /// `vec2f`.
    Vec2,
    /// `vec3f`.
    Vec3,
    /// `vec4f`.
    Vec4,
    /// `mat3x3f`, column by column.
    Mat3,
    /// `mat4x4f`, column by column.
    Mat4,
}

impl Shape {
    /// How many floats a value takes.
    #[must_use]
    pub const fn floats(self) -> usize {
        match self {
            Shape::F32 | Shape::U32 | Shape::I32 | Shape::Bool => 1,
            Shape::Vec2 => 2,
            Shape::Vec3 => 3,
            Shape::Vec4 => 4,
            Shape::Mat3 => 9,
            Shape::Mat4 => 16,
        }
    }
}

/// What a field means: which values a generator should try. Each function's own domain is in the doc of its `.wesl` file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// A vector of any finite length; zero, 1e-23 and 2e19 are the hard ones.
    Vector,
    /// A vector of length one, to rounding.
    Unit,
    /// A decoded normal: length roughly in [0.1, 1.5].
    MapNormal,
    /// A number in [0, 1], each component.
    Unorm,
    /// A number in [−1, 1], each component.
    Snorm,
    /// A height in [0, 1].
    Height,
    /// A height scale or bias: in texture units, or texels a byte step.
    Scale,
    /// A relief layer: scale ≥ 0 and bias in widths of the tile, and the tile's width over its height.
    Layer,
    /// A gap of a sample above the surface, in [−1, 0), rarely near 0.
    Above,
    /// A factor from height difference to slope.
    Slope,
    /// A sum of areas, not negative: at least the length of the sums beside it.
    Weight,
    /// An elevation z(h) in texture units.
    Elevation,
    /// A texture coordinate.
    Uv,
    /// A difference of texture coordinates.
    UvEdge,
    /// A difference of positions.
    Edge,
    /// A linear colour, not negative.
    Colour,
    /// A cosine; rounding may put it slightly above 1.
    Cosine,
    /// A specular exponent, above zero.
    Exponent,
    /// −1 or 1.
    Sign,
    /// A tangent: unit `xyz`, −1 or 1 in `w`.
    Tangent,
    /// An invertible linear map: columns of an object's matrix.
    Matrix,
    /// A rigid transform (rotation and translation), as a 4×4 matrix.
    Rigid,
    /// A position.
    Position,
    /// A byte, in [0, 255].
    Byte,
    /// A texel index, which may lie outside of the image.
    Index,
    /// A number of texels, at least one.
    Size,
    /// A texel's column or row, not negative.
    Texel,
    /// A face of a cube map, 0 to 5.
    Face,
    /// A factor, not negative.
    Gain,
    /// A length, above zero.
    Length,
    /// The largest code of a signed format: 127 or 32767.
    SnormOne,
    /// A whole number in [−32768, 32767]: a code of a signed format.
    SnormCode,
    /// The largest code of an unsigned format: 255 or 65535.
    UnormOne,
    /// A whole number in [0, 65535]: a code of an unsigned format.
    UnormCode,
    /// A linear code of bytes: 0 `codec_unorm`, 1 `codec_biased`.
    Codec,
    /// An edge mode: 0 wrap, 1 mirror, 2 clamp.
    EdgeMode,
    /// An output, to be compared component by component.
    Output,
    /// An output of which only the direction is promised: it is of unit length (or zero), whatever the truth's length.
    Direction,
}

/// One parameter or result of a probed function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// The parameter's name in the shader; for a structure result, the member's.
    pub name: &'static str,
    /// Its type.
    pub shape: Shape,
    /// Its meaning.
    pub role: Role,
}

/// One row of [`PROBES`](crate::PROBES).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probe {
    /// The probe's name, and the function's.
    pub id: ProbeId,
    /// The technique, or the library file's name for functions below the techniques.
    pub technique: &'static str,
    /// Which form of the formula.
    pub form: Form,
    /// The entry point.
    pub entry: &'static str,
    /// The file that holds the function, below `shaders/`.
    pub file: &'static str,
    /// Floats an item in `inputs`.
    pub input_floats: usize,
    /// Floats an item in `outputs`.
    pub output_floats: usize,
    /// The parameters, in order.
    pub inputs: &'static [Field],
    /// The result: one field, or the members of the result structure.
    pub outputs: &'static [Field],
}

impl Probe {
    /// The probe of that name.
    #[must_use]
    pub fn find(id: &str) -> Option<&'static Probe> {
        crate::PROBES.iter().find(|probe| probe.id.0 == id)
    }

    /// The probed function's name.
    #[must_use]
    pub fn function(&self) -> &'static str {
        self.id.0
    }
}

/// The floats of a list of fields.
pub(crate) const fn floats(fields: &[Field]) -> usize {
    let mut sum = 0;
    let mut index = 0;
    while index < fields.len() {
        sum += fields[index].shape.floats();
        index += 1;
    }
    sum
}
