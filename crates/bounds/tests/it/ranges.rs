//! Sidecars of input ranges: what they say, what is inferred, and how mistakes are shown.

use crate::common::module as module_of;
use bossage_bounds::ranges::{Declared, Group, Inputs, Seed, Style, Values};

const SHADER: &str = "
    struct Light { vector: vec4f, radiance: vec4f }
    struct Material { shininess: f32, base_color: vec4f, lights: array<Light, 3> }
    @group(0) @binding(0) var<uniform> material: Material;
    @group(0) @binding(1) var<storage, read> heights: array<f32>;
    @group(0) @binding(2) var normal_map: texture_2d<f32>;
    @group(0) @binding(3) var linear_sampler: sampler;
    @fragment fn main(@location(0) normal: vec3f, @location(1) tangent: vec4f, @location(2) uv: vec2f) -> @location(0) vec4f {
        let texel = textureSample(normal_map, linear_sampler, uv);
        return texel * heights[0] + material.lights[1].vector + material.base_color * material.shininess
            + vec4f(normal, 1.0) + tangent;
    }";

fn inputs(sidecar: Option<&str>) -> Inputs {
    let (module, info) = module_of(SHADER);
    let declared =
        sidecar.map(|text| Declared::parse("a.ranges.toml", text).unwrap_or_else(|e| panic!("{e}")));
    let inputs = Inputs::new(&module, &info, "main", declared.as_ref()).unwrap_or_else(|e| panic!("{e}"));
    if let Some(declared) = declared {
        declared
            .check(std::slice::from_ref(&inputs))
            .unwrap_or_else(|e| panic!("{e}"));
    }
    inputs
}

fn group<'a>(inputs: &'a Inputs, name: &str) -> &'a Group {
    let names: Vec<&str> = inputs.groups.iter().map(|g| g.name.as_str()).collect();
    inputs
        .groups
        .iter()
        .find(|g| g.name == name)
        .unwrap_or_else(|| panic!("no {name} among {names:?}"))
}

/// What is wrong with a sidecar: by itself, or for the shader above.
fn problem(text: &str) -> String {
    let (module, info) = module_of(SHADER);
    match Declared::parse("a.ranges.toml", text) {
        Err(report) => report.to_string(),
        Ok(declared) => match Inputs::new(&module, &info, "main", Some(&declared)) {
            Err(error) => error.to_string(),
            Ok(inputs) => declared
                .check(&[inputs])
                .expect_err("this sidecar is wrong")
                .to_string(),
        },
    }
}

#[test]
fn undeclared_inputs_are_inferred() {
    let inputs = inputs(None);
    assert_eq!(group(&inputs, "normal").values, Values::Unit);
    assert_eq!(group(&inputs, "tangent.xyz").values, Values::Unit);
    assert_eq!(group(&inputs, "tangent.w").values, Values::OneOf(vec![-1.0, 1.0]));
    assert_eq!(group(&inputs, "uv").values, Values::Between(vec![(0.0, 1.0); 2]));
    assert_eq!(
        group(&inputs, "material.shininess").values,
        Values::Between(vec![(0.0, 4096.0)])
    );
    assert_eq!(inputs.textures[0].channels, [(0.0, 1.0); 4]);
    assert!(inputs.groups.iter().all(|g| !g.declared));
}

#[test]
fn the_specific_declaration_wins() {
    let inputs = inputs(Some(
        "schema = 1\n[ranges]\n\"material.lights[1].vector\" = { lo = 5, hi = 6 }\n\
         \"material.lights[].vector.xyz\" = { unit = true }\n\"material.lights\" = { lo = -1, hi = [2] }\n\
         heights = { size = 7, lo = -0.5, hi = 0.5 }\n\"heights[2..5]\" = { unit = true }\n\
         normal_map = { size = [8, 2], lo = 0.25, hi = 0.75 }\nnormal = { one_of = [0, 1] }",
    ));
    let declared = |name: &str| group(&inputs, name).values.clone();
    assert_eq!(declared("material.lights[0].vector.xyz"), Values::Unit);
    assert_eq!(
        declared("material.lights[0].vector.w"),
        Values::Between(vec![(-1.0, 2.0)])
    );
    assert_eq!(
        declared("material.lights[1].radiance"),
        Values::Between(vec![(-1.0, 2.0); 4])
    );
    assert_eq!(declared("heights[2]..heights[4]"), Values::Unit);
    assert_eq!(declared("heights[6]"), Values::Between(vec![(-0.5, 0.5)]));
    assert_eq!(declared("normal"), Values::OneOf(vec![0.0, 1.0]));
    assert!(
        inputs.groups.iter().all(|g| g.name != "heights[7]"),
        "seven elements"
    );
    assert_eq!(
        (inputs.textures[0].size, inputs.textures[0].channels[0]),
        ([8, 2, 1], (0.25, 0.75))
    );
    // Longer keys are more specific: the exact index does not beat the component of every element.
    assert_eq!(declared("material.lights[1].vector.xyz"), Values::Unit);
    assert_eq!(
        declared("material.lights[1].vector.w"),
        Values::Between(vec![(5.0, 6.0)])
    );
}

#[test]
fn samples_lie_in_the_ranges_and_repeat_with_the_seed() {
    let inputs = inputs(Some(
        "schema = 1\n[ranges]\n\"material.base_color\" = { lo = [0, 0.5, -3, 1e-40], hi = [0, 0.75, -2, 1e30] }",
    ));
    for style in [Style::Edge, Style::Random, Style::Related] {
        let (mut a, mut b) = (Seed::new(9), Seed::new(9));
        for _ in 0..2000 {
            let point = inputs.sample(&mut a, style);
            assert!(inputs.admits(&point), "{point:?}");
            assert_eq!(point, inputs.sample(&mut b, style));
        }
    }
}

#[test]
fn a_point_outside_is_seen() {
    let inputs = inputs(None);
    let mut point = inputs.sample(&mut Seed::new(1), Style::Random);
    point.values[group(&inputs, "uv").scalars.start] = 1.5;
    assert!(!inputs.admits(&point), "negative control");
}

#[test]
fn mistakes_have_their_place_and_a_way_out() {
    let with = |line: &str| problem(&format!("schema = 1\n[ranges]\n{line}\n"));
    for (line, message, place) in [
        ("normal = { lo = 2, hi = 1 }", "lo = 2 is above hi = 1", "3:17"),
        (
            "normal = { lo = nan, hi = 1 }",
            "NaN is not the end of a range",
            "3:17",
        ),
        (
            "normal = { lo = 0, hi = inf }",
            "beyond the numbers of f32",
            "3:25",
        ),
        ("normal = { lo = 0, high = 1 }", "unknown key `high`", "3:20"),
        ("normals = { unit = true }", "did you mean `normal`?", "3:1"),
        (
            "material.shinines = { lo = 0, hi = 1 }",
            "a key with a dot needs quotes",
            "3:10",
        ),
        (
            "\"material.shinines\" = { lo = 0, hi = 1 }",
            "did you mean `material.shininess`?",
            "3:1",
        ),
        (
            "\"material.lights[7].vector\" = { unit = true }",
            "no input `material.lights[7].vector`",
            "3:1",
        ),
        (
            "normal = { lo = [0, 0], hi = 1 }",
            "2 bounds, and normal has 3 scalars",
            "3:10",
        ),
        (
            "\"uv.x\" = { unit = true }",
            "a unit vector is more than one scalar",
            "3:10",
        ),
        (
            "normal = { unit = true, lo = 0, hi = 1 }",
            "more than one kind of range",
            "3:10",
        ),
        ("normal = { lo = 0 }", "a range has both ends", "3:17"),
        ("heights = { size = 0 }", "this is not a size", "3:20"),
        ("normal_map = { size = 4 }", "`normal_map` has 2 size(s)", "3:23"),
        ("normal_map = { unit = true }", "texels of `normal_map`", "3:14"),
        ("\"uv[\" = { lo = 0, hi = 1 }", "`[` is no index", "3:1"),
        ("uv = { one_of = [] }", "a choice of nothing", "3:17"),
        ("uv = { lo = \"0\", hi = 1 }", "this is not a number", "3:13"),
        ("uv = 3", "the range of `uv` is a table", "3:6"),
    ] {
        let shown = with(line);
        assert!(shown.contains(message), "{line}: {shown}");
        assert!(
            shown.contains(&format!("a.ranges.toml:{place}")),
            "{line}: {shown}"
        );
        assert!(shown.contains('^'), "{line}: {shown}");
    }
}

#[test]
fn the_file_itself_may_be_wrong() {
    for (text, message) in [
        ("", "`schema` is missing"),
        ("schema = 2", "not a schema that is known here"),
        ("schema = 1\nrange = 3", "did you mean `ranges`?"),
        ("schema = 1\nworkgroups = [1, 0, 1]", "not a number of workgroups"),
        ("schema = 1\nranges = 4", "`ranges` is a table"),
        ("schema = ", "not TOML"),
    ] {
        let shown = problem(text);
        assert!(shown.contains(message), "{text}: {shown}");
    }
}

const ARRAYS: &str = "
    @group(0) @binding(0) var<storage, read> source: array<f32>;
    @group(0) @binding(1) var<storage, read_write> result: array<vec3f>;
    @compute @workgroup_size(1) fn main() { result[0] = vec3f(source[0]); }";

fn arrays(sidecar: &str) -> Result<Inputs, String> {
    let (module, info) = module_of(ARRAYS);
    let declared = Declared::parse("a.ranges.toml", sidecar).map_err(|e| e.to_string())?;
    let inputs = Inputs::new(&module, &info, "main", Some(&declared)).map_err(|e| e.to_string())?;
    let known = [inputs];
    declared.check(&known).map_err(|e| e.to_string())?;
    let [inputs] = known;
    Ok(inputs)
}

#[test]
fn arrays_that_are_only_written_have_a_size() {
    let sizes = |sidecar: &str| {
        let inputs = arrays(sidecar).unwrap();
        [inputs.elements((0, 0)), inputs.elements((0, 1))]
    };
    assert_eq!(sizes("schema = 1"), [16, 16]);
    assert_eq!(
        sizes("schema = 1\n[ranges]\nsource = { size = 9 }\n"),
        [9, 9],
        "as long as what is declared"
    );
    let both = "schema = 1\n[ranges]\nsource = { size = 9 }\nresult = { size = 4 }\n";
    assert_eq!(sizes(both), [9, 4]);
    let inputs = arrays(both).unwrap();
    assert!(inputs.is_read((0, 0)) && !inputs.is_read((0, 1)));
    assert_eq!(inputs.longest_array(), 9);
    let told = arrays("schema = 1\n[ranges]\nresult = { size = 4, lo = 0, hi = 1 }\n").unwrap_err();
    assert!(
        told.contains("a.ranges.toml:3:") && told.contains("only written"),
        "{told}"
    );
}

#[test]
fn scalars_of_buffers_have_names_and_bytes() {
    use bossage_bounds::ranges::{UNWRITTEN, scalar_names};
    use bossage_bounds::{F32, Program};
    let (module, info) = module_of(ARRAYS);
    let names = scalar_names(&module, (0, 1), 2).unwrap();
    assert_eq!(
        names[..4],
        ["result[0].x", "result[0].y", "result[0].z", "result[1].x"]
    );
    let program = Program::new(&module, &info, "main").unwrap();
    let inputs = arrays("schema = 1\n[ranges]\nsource = { size = 2 }\n").unwrap();
    let point = inputs.sample(&mut Seed::new(1), Style::Random);
    let (bindings, _) = inputs.at::<F32>(&[&point]).unwrap();
    // Two elements of sixteen bytes each, though the last one's padding holds nothing.
    let bytes = bindings.to_bytes(&program, 0, 1).unwrap();
    assert_eq!(bytes.len(), 32);
    let scalars = program.scalars_of::<F32>((0, 1), &bytes).unwrap();
    assert_eq!(scalars.len(), 6);
    assert!(scalars.iter().all(|scalar| scalar.float() == Some(UNWRITTEN)));
    assert_eq!(program.scalars_of::<F32>((0, 1), &bytes[..16]).unwrap().len(), 3);
    assert_eq!(program.scalars_of::<F32>((0, 7), &bytes), None);
}
