//! A correct scene, and each mistake that can be made by one replacement in it.

/// A correct scene; each case breaks it by one replacement.
pub(super) const GOOD: &str = r#"schema = 1
ambient = [0.1, 0.1, 0.1]

[camera]
position = [0.0, 0.0, 3.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_deg = 45.0
near = 0.1
far = 10.0
size = [64, 48]

[budget]
error_px = 1.0

[[lights]]
name = "sun"
kind = "directional"
direction = [0.0, 0.0, -1.0]
color = [1.0, 1.0, 1.0]
intensity = 1.0

[[materials]]
name = "bricks"
albedo = { color = [1.0, 1.0, 1.0], map = "color.png" }
normal = { map = "normal.png", codec = "unorm" }
height = { map = "height.png", scale = 0.04, bias = -0.02 }
specular = [0.2, 0.2, 0.2]
shininess = 32.0
alpha = { mode = "mask", cutoff = 0.5 }
address = "wrap"
technique = "auto"

[[objects]]
name = "wall"
shape = "plane"
size = [2.0, 2.0]
material = "bricks"
scale = [1.0, 1.0, 1.0]
"#;

pub(super) struct Case {
    /// What is replaced in the good scene.
    pub(super) from: &'static str,
    /// By what.
    pub(super) to: &'static str,
    /// Text at which the caret must begin; its first occurrence in the broken scene.
    pub(super) at: &'static str,
    pub(super) field: &'static str,
    pub(super) says: &'static str,
    pub(super) helps: &'static str,
}

const fn case(
    from: &'static str,
    to: &'static str,
    at: &'static str,
    field: &'static str,
    says: &'static str,
    helps: &'static str,
) -> Case {
    Case {
        from,
        to,
        at,
        field,
        says,
        helps,
    }
}

pub(super) const CASES: &[Case] = &[
    // Keys.
    case(
        "ambient",
        "ambinet",
        "ambinet",
        "ambinet",
        "unknown key",
        "did you mean `ambient`?",
    ),
    case(
        "shininess =",
        "roughness =",
        "roughness",
        "materials[0].roughness",
        "unknown key `roughness`",
        "keys of `materials[0]`",
    ),
    case(
        "fov_deg = 45.0\n",
        "",
        "[camera]",
        "camera.fov_deg",
        "`fov_deg` is missing",
        "add `fov_deg`",
    ),
    case(
        "schema = 1\n",
        "",
        "ambient",
        "schema",
        "`schema` is missing",
        "add `schema = 1`",
    ),
    case(
        "schema = 1",
        "schema = 2",
        "2\n",
        "schema",
        "schema 2 is not known",
        "reads schema 1",
    ),
    // Types.
    case(
        "fov_deg = 45.0",
        "fov_deg = \"wide\"",
        "\"wide\"",
        "camera.fov_deg",
        "expected a number, found a string",
        "write a number",
    ),
    case(
        "[64, 48]",
        "[64.5, 48]",
        "64.5",
        "camera.size[0]",
        "expected a whole number, found a float",
        "whole number",
    ),
    case(
        "[0.0, 0.0, 3.0]",
        "[0.0, 0.0]",
        "[0.0, 0.0]\n",
        "camera.position",
        "expected 3 numbers, found 2",
        "array of 3 numbers",
    ),
    case(
        "material = \"bricks\"",
        "material = 0",
        "0\nscale",
        "objects[0].material",
        "expected a string, found an integer",
        "string",
    ),
    // Numbers.
    case(
        "fov_deg = 45.0",
        "fov_deg = 180.0",
        "180.0",
        "camera.fov_deg",
        "180 is out of range",
        "in (0, 180) degrees",
    ),
    case(
        "fov_deg = 45.0",
        "fov_deg = nan",
        "nan",
        "camera.fov_deg",
        "NaN",
        "in (0, 180)",
    ),
    case(
        "far = 10.0",
        "far = inf",
        "inf",
        "camera.far",
        "infinity",
        "greater than 0",
    ),
    case(
        "far = 10.0",
        "far = 1e300",
        "1e300",
        "camera.far",
        "too large for a 32-bit float",
        "greater than 0",
    ),
    case(
        "near = 0.1",
        "near = 10.0",
        "10.0\nfar",
        "camera.near",
        "near (10) is not less than far (10)",
        "make `near` smaller",
    ),
    case(
        "near = 0.1",
        "near = -0.1",
        "-0.1",
        "camera.near",
        "-0.1 is out of range",
        "greater than 0",
    ),
    case(
        "[64, 48]",
        "[64, 0]",
        "0]\n\n[budget",
        "camera.size[1]",
        "0 is out of range",
        "from 1 to 16384",
    ),
    case(
        "[64, 48]",
        "[64, 20000]",
        "20000",
        "camera.size[1]",
        "20000 is out of range",
        "from 1 to 16384",
    ),
    case(
        "up = [0.0, 1.0, 0.0]",
        "up = [0.0, 0.0, 2.0]",
        "[0.0, 0.0, 2.0]",
        "camera.up",
        "parallel to the viewing",
        "choose an `up`",
    ),
    case(
        "position = [0.0, 0.0, 3.0]",
        "position = [0.0, 0.0, 0.0]",
        "[0.0, 0.0, 0.0]\nup",
        "camera.target",
        "own position",
        "move `target`",
    ),
    case(
        "error_px = 1.0",
        "error_px = -1.0",
        "-1.0\n\n[[lights",
        "budget.error_px",
        "-1 is out of range",
        "greater than 0",
    ),
    case(
        "error_px = 1.0",
        "error_px = nan",
        "nan\n\n[[lights",
        "budget.error_px",
        "NaN is not a usable number",
        "greater than 0",
    ),
    case(
        "error_px = 1.0",
        "time_ms = -0.5\nprofile = \"lavapipe\"",
        "-0.5\nprofile",
        "budget.time_ms",
        "-0.5 is out of range",
        "greater than 0",
    ),
    case(
        "error_px = 1.0",
        "time_ms = nan\nprofile = \"lavapipe\"",
        "nan\nprofile",
        "budget.time_ms",
        "NaN is not a usable number",
        "greater than 0",
    ),
    case(
        "error_px = 1.0",
        "time_ms = 0.5",
        "[budget]",
        "budget.profile",
        "`profile` is missing",
        "on which machine",
    ),
    case(
        "error_px = 1.0",
        "profile = \"lavapip\"",
        "\"lavapip\"",
        "budget.profile",
        "there is no cost profile `lavapip`",
        "did you mean `lavapipe`?",
    ),
    case(
        "error_px = 1.0",
        "profile = \"none.toml\"",
        "\"none.toml\"",
        "budget.profile",
        "cannot read the cost profile",
        "start at the scene's folder",
    ),
    case(
        "color = [1.0, 1.0, 1.0]\nint",
        "color = [1.0, -2.0, 1.0]\nint",
        "-2.0",
        "lights[0].color[1]",
        "-2 is out of range",
        "0 or greater",
    ),
    case(
        "[0.0, 0.0, -1.0]",
        "[0.0, 0.0, 0.0]",
        "[0.0, 0.0, 0.0]\ncolor",
        "lights[0].direction",
        "length 0",
        "the way the light travels",
    ),
    case(
        "scale = 0.04",
        "scale = 0.0",
        "0.0, bias",
        "materials[0].height.scale",
        "0 is out of range",
        "greater than 0",
    ),
    case(
        "shininess = 32.0",
        "shininess = 1e6",
        "1e6",
        "materials[0].shininess",
        "1000000 is out of range",
        "at most 65536",
    ),
    case(
        "cutoff = 0.5",
        "cutoff = 1.5",
        "1.5",
        "materials[0].alpha.cutoff",
        "1.5 is out of range",
        "in (0, 1]",
    ),
    case(
        "scale = [1.0, 1.0, 1.0]",
        "scale = [1.0, 0.0, 1.0]",
        "0.0, 1.0]\n",
        "objects[0].scale[1]",
        "0 is out of range",
        "not 0",
    ),
    // Words.
    case(
        "\"directional\"",
        "\"directonal\"",
        "\"directonal\"",
        "lights[0].kind",
        "`directonal` is not known",
        "did you mean `directional`?",
    ),
    case(
        "\"auto\"",
        "\"paralax_offset\"",
        "\"paralax",
        "materials[0].technique",
        "not known",
        "did you mean `parallax_offset`?",
    ),
    case(
        "codec = \"unorm\"",
        "codec = \"snrm\"",
        "\"snrm\"",
        "materials[0].normal.codec",
        "not known",
        "did you mean `snorm`?",
    ),
    case(
        ", codec = \"unorm\"",
        "",
        "{ map = \"normal",
        "materials[0].normal.codec",
        "`codec` is missing",
        "as the map is written",
    ),
    case(
        "\"wrap\"",
        "\"repeat\"",
        "\"repeat\"",
        "materials[0].address",
        "not known",
        "`wrap`, `mirror`, `clamp`",
    ),
    case(
        "\"plane\"",
        "\"plan\"",
        "\"plan\"",
        "objects[0].shape",
        "not known",
        "did you mean `plane`?",
    ),
    case(
        "material = \"bricks\"",
        "material = \"brick\"",
        "\"brick\"",
        "objects[0].material",
        "no material `brick`",
        "did you mean `bricks`?",
    ),
    case(
        "name = \"wall\"",
        "name = \" \"",
        "\" \"",
        "objects[0].name",
        "empty",
        "not blank",
    ),
    // Keys that do not go together.
    case(
        "size = [2.0, 2.0]",
        "radius = 2.0",
        "2.0\nmaterial",
        "objects[0].radius",
        "a plane has no `radius`",
        "a plane has `size`",
    ),
    case(
        "intensity = 1.0",
        "position = [0.0, 0.0, 0.0]",
        "[0.0, 0.0, 0.0]\n\n",
        "lights[0].position",
        "has no position",
        "`kind = \"point\"`",
    ),
    case(
        ", bias = -0.02",
        ", depth = 0.1",
        "0.04",
        "materials[0].height.scale",
        "does not go with world",
        "give either",
    ),
    case(
        ", bias = -0.02",
        "",
        "{ map = \"height",
        "materials[0].height.bias",
        "`bias` is missing",
        "`-scale`",
    ),
    case(
        "\"mask\"",
        "\"opaque\"",
        "0.5 }",
        "materials[0].alpha.cutoff",
        "an opaque material has no cutoff",
        "set mode to `mask`",
    ),
    case(
        "{ map = \"normal.png\"",
        "{ map = \"normal.png\", bake = \"central\"",
        "\"normal.png\", b",
        "materials[0].normal.map",
        "does not go with `bake`",
        "give a `map`",
    ),
    // Files.
    case(
        "color.png",
        "colour.png",
        "\"colour.png\"",
        "materials[0].albedo.map",
        "cannot be read",
        "paths start at the scene's folder",
    ),
    case(
        "color.png",
        "empty.png",
        "\"empty.png\"",
        "materials[0].albedo.map",
        "empty",
        "images:",
    ),
    case(
        "color.png",
        "cut.png",
        "\"cut.png\"",
        "materials[0].albedo.map",
        "truncated",
        "images:",
    ),
    case(
        "color.png",
        "scene.toml",
        "\"scene.toml\"",
        "materials[0].albedo.map",
        "not an image",
        "images:",
    ),
    case(
        "normal.png",
        "height.png",
        "\"height.png\", codec",
        "materials[0].normal.map",
        "needs 3 colour channels",
        "channels of its codec",
    ),
    case(
        "height.png\"",
        "height.png\", channel = \"alpha\"",
        "\"height.png\", ch",
        "materials[0].height.map",
        "no alpha channel",
        "heights",
    ),
];
