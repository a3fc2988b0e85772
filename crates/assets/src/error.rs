//! What can go wrong between a file and an asset, each variant naming the file, texel, vertex or line at fault.
//!
//! Display texts are written for the person whose file it is: what is wrong, where, and what to do. A variant with a
//! `source` does not repeat it; print the chain.

use std::path::PathBuf;

use crate::{Channel, CubeFace, MAX_DECODED_BYTES, MAX_SIDE};

/// Every failure of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file cannot be opened or read.
    #[error("{}: cannot be read; check the path and the permissions", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file holds no bytes.
    #[error("{}: the file is empty (0 bytes)", path.display())]
    EmptyFile {
        /// The file.
        path: PathBuf,
    },
    /// Neither the first bytes nor the extension name a format that is read here.
    #[error("{}: not an image format that is read here; use PNG, JPEG, TGA, BMP, TIFF, OpenEXR or Radiance HDR", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The decoder refused the file: truncated, damaged, or of a kind it does not support.
    #[error("{}: the {format} data is truncated, damaged or of an unsupported kind", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// The format as which it was read.
        format: String,
        /// What the decoder said.
        source: ::image::ImageError,
    },
    /// An image without texels.
    #[error("{}: the image is {width}x{height}: it has no texels", path.display())]
    ZeroSized {
        /// The file.
        path: PathBuf,
        /// Columns in the header.
        width: u32,
        /// Rows in the header.
        height: u32,
    },
    /// An image beyond [`MAX_SIDE`] or [`MAX_DECODED_BYTES`], found in the header before anything is decoded.
    #[error(
        "{}: the image is {width}x{height} ({bytes} bytes decoded); the limit is {MAX_SIDE} texels a side and {MAX_DECODED_BYTES} bytes decoded",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Columns in the header.
        width: u32,
        /// Rows in the header.
        height: u32,
        /// Bytes the decoded image would take.
        bytes: u64,
    },
    /// A float image holds NaN or an infinity.
    #[error("{}: texel ({x}, {y}) channel {channel} is {value}; only finite numbers are allowed", path.display())]
    NonFinite {
        /// The file.
        path: PathBuf,
        /// Column.
        x: u32,
        /// Row.
        y: u32,
        /// Channel, from 0.
        channel: u8,
        /// The value found.
        value: f32,
    },
    /// A float image holds a value that the use at hand has no place for.
    #[error("{}: texel ({x}, {y}) channel {channel} is {value}; a {usage} needs values from 0 to 1 (rescale the image)", path.display())]
    OutOfRange {
        /// The file.
        path: PathBuf,
        /// Column.
        x: u32,
        /// Row.
        y: u32,
        /// Channel, from 0.
        channel: u8,
        /// The value found.
        value: f32,
        /// What it was to become.
        usage: &'static str,
    },
    /// The image lacks the channel asked for.
    #[error("{}: the image has no {channel} channel (it has {channels}); choose another channel", path.display())]
    MissingChannel {
        /// The file.
        path: PathBuf,
        /// The channel asked for.
        channel: Channel,
        /// How many channels there are.
        channels: u8,
    },
    /// An image with fewer than three channels given as a normal map.
    #[error("{}: a normal map needs red, green and blue; this image has {channels} channel(s)", path.display())]
    NotANormalMap {
        /// The file.
        path: PathBuf,
        /// How many channels there are.
        channels: u8,
    },
    /// An image with too few channels for the code its normals are said to be written in.
    #[error("{}: the normal codec `{codec}` needs {needed} colour channels; this image has {channels} channel(s)", path.display())]
    CodecChannels {
        /// The file.
        path: PathBuf,
        /// The codec's name.
        codec: &'static str,
        /// How many colour channels it needs.
        needed: u8,
        /// How many channels there are.
        channels: u8,
    },
    /// Float samples for a code of integers.
    #[error("{}: the normal codec `{codec}` needs integer samples of 8 or 16 bits; this image holds floats", path.display())]
    CodecSamples {
        /// The file.
        path: PathBuf,
        /// The codec's name.
        codec: &'static str,
    },
    /// A cube map of other than six images.
    #[error("a cube map has six faces, in the order +X, −X, +Y, −Y, +Z, −Z; {found} given")]
    CubeFaceCount {
        /// How many were given.
        found: usize,
    },
    /// A cube map's face that is no square.
    #[error("{}: the {face} face of the cube map is {width}x{height}; faces must be square", path.display())]
    CubeFaceNotSquare {
        /// The file.
        path: PathBuf,
        /// Which face.
        face: CubeFace,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A cube map's face of another size than the first.
    #[error(
        "{}: the {face} face of the cube map is {side}x{side}, but {} is {expected}x{expected}; all six must be of one size",
        path.display(), first.display()
    )]
    CubeFaceSize {
        /// The file.
        path: PathBuf,
        /// Which face.
        face: CubeFace,
        /// Its side.
        side: u32,
        /// The file of the first face.
        first: PathBuf,
        /// The first face's side.
        expected: u32,
    },
    /// Sizes that do not fit together, in values built by code.
    #[error("{what}: {width}x{height} needs {expected} texels, {found} were given")]
    TexelCount {
        /// What was being built.
        what: &'static str,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// `width * height`.
        expected: usize,
        /// Length of the list.
        found: usize,
    },
    /// An OBJ file that cannot be parsed.
    #[error("{}:{line}: {what}", path.display())]
    ObjSyntax {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is wrong, and what is expected there.
        what: String,
        /// What the parser said.
        source: tobj::LoadError,
    },
    /// An OBJ file whose contents make no usable mesh.
    #[error("{}{}: not a usable mesh", path.display(), line.map(|n| format!(":{n}")).unwrap_or_default())]
    ObjMesh {
        /// The file.
        path: PathBuf,
        /// Line, from 1, where one line is to blame.
        line: Option<usize>,
        /// What is wrong with it.
        source: MeshDefect,
    },
    /// A mesh built by code that is not usable.
    #[error("the mesh is not usable")]
    Mesh(#[from] MeshDefect),
    /// A number handed in by code or by a scene that makes no sense there.
    #[error("{parameter} is {value}; it must be {expected}")]
    Parameter {
        /// The parameter.
        parameter: &'static str,
        /// Its value as text.
        value: String,
        /// What is allowed.
        expected: &'static str,
    },
    /// A picture could not be encoded.
    #[error("cannot encode the {width}x{height} PNG")]
    Encode {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// What the encoder said.
        source: ::image::ImageError,
    },
}

/// What makes a mesh unusable. See [`crate::Mesh::validate`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshDefect {
    /// There is nothing to draw.
    #[error("it has no faces")]
    NoFaces,
    /// The index count is not a multiple of three.
    #[error("{count} indices do not make whole triangles")]
    PartialTriangle {
        /// How many indices there are.
        count: usize,
    },
    /// There are no texture coordinates at all.
    #[error("it has no texture coordinates (UVs); unwrap the model and export it with `vt` lines")]
    NoUvs,
    /// Some corners have texture coordinates, others do not.
    #[error("some faces have texture coordinates (UVs) and some have none; unwrap the whole model")]
    PartialUvs,
    /// Some corners have normals, others do not.
    #[error("some faces have normals and some have none; export all of them or none")]
    PartialNormals,
    /// An attribute list of another length than the positions.
    #[error("{count} {attribute} for {vertices} vertices")]
    AttributeCount {
        /// Which list.
        attribute: &'static str,
        /// Its length.
        count: usize,
        /// The number of positions.
        vertices: usize,
    },
    /// An index that points past the vertices.
    #[error("triangle {triangle} uses vertex {index}, but there are {vertices} vertices")]
    IndexOutOfRange {
        /// Triangle, from 0.
        triangle: usize,
        /// The index.
        index: u32,
        /// The number of positions.
        vertices: usize,
    },
    /// A face of an OBJ file that points past its `v`, `vt` or `vn` lines.
    #[error("a face uses {attribute} {index}, but the file has {count} by then")]
    FaceOutOfRange {
        /// `v`, `vt` or `vn`.
        attribute: &'static str,
        /// The index as written (from 1, or negative).
        index: i64,
        /// How many there are.
        count: usize,
    },
    /// NaN or an infinity in an attribute.
    #[error("{attribute} of vertex {vertex} is not finite: {value}")]
    NonFinite {
        /// Which list.
        attribute: &'static str,
        /// Vertex, from 0.
        vertex: usize,
        /// The value as text.
        value: String,
    },
}
