//! Every mistake comes back as an error that names it, and the device goes on working.

use bossage_runner::{
    AdapterSelector, BufferData, Code, ComputeJob, Device, Error, Resources, Shader, TextureData, run_probe,
};

use crate::support::{Compiled, compile, device};

const TINT: &str = "
struct Tint { colour: vec4f, gain: f32 }
@group(0) @binding(0) var<uniform> tint: Tint;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var<storage, read_write> outputs: array<f32>;
@compute @workgroup_size(1) fn tinted() {
    outputs[0] = tint.colour.r * tint.gain * textureLoad(picture, vec2u(0, 0), 0).r;
}";

struct Fixture {
    compiled: Compiled,
    picture: TextureData,
}

impl Fixture {
    fn new() -> Self {
        Self {
            compiled: compile(TINT),
            picture: TextureData::r32f(1, 1, &[3.0]),
        }
    }

    /// A job that works, changed by `spoil`.
    fn run(&self, device: &Device, spoil: impl Fn(&mut ComputeJob<'_>)) -> Result<f32, Error> {
        let mut resources = Resources::default();
        resources
            .uniforms
            .insert("tint.colour".into(), vec![5.0, 0.0, 0.0, 1.0]);
        resources.uniforms.insert("tint.gain".into(), vec![2.0]);
        resources.textures.insert("picture".into(), &self.picture);
        resources.buffers.insert("outputs".into(), BufferData::Output(4));
        let shader = self.compiled.wgsl("tinted");
        let mut job = ComputeJob {
            name: "tint",
            shader,
            resources,
            workgroups: [1, 1, 1],
        };
        spoil(&mut job);
        job.run(device).map(|output| output.floats("outputs")[0])
    }
}

#[test]
fn the_unspoilt_job_works() {
    let Some(device) = device("the_unspoilt_job_works") else {
        return;
    };
    assert_eq!(Fixture::new().run(device, |_| {}).unwrap(), 30.0);
}

#[test]
fn a_missing_uniform_is_named_with_its_type() {
    let Some(device) = device("a_missing_uniform_is_named_with_its_type") else {
        return;
    };
    let error = Fixture::new()
        .run(device, |job| drop(job.resources.uniforms.remove("tint.gain")))
        .unwrap_err();
    assert!(
        matches!(&error, Error::MissingUniform { member, .. } if member == "tint.gain"),
        "{error}"
    );
    assert!(error.to_string().contains("f32"), "{error}");
}

#[test]
fn a_uniform_of_the_wrong_length_is_refused() {
    let Some(device) = device("a_uniform_of_the_wrong_length_is_refused") else {
        return;
    };
    let spoil =
        |job: &mut ComputeJob<'_>| drop(job.resources.uniforms.insert("tint.colour".into(), vec![1.0; 3]));
    let error = Fixture::new().run(device, spoil).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`tint`: uniform `tint.colour`: 3 numbers are given, it has 4"
    );
}

#[test]
fn a_missing_texture_is_named_with_its_place() {
    let Some(device) = device("a_missing_texture_is_named_with_its_place") else {
        return;
    };
    let error = Fixture::new()
        .run(device, |job| job.resources.textures.clear())
        .unwrap_err();
    let Error::MissingResource {
        name,
        group: 0,
        binding: 1,
        ..
    } = &error
    else {
        panic!("{error}")
    };
    assert_eq!(name, "picture");
}

#[test]
fn a_cube_for_a_plane_is_refused() {
    let Some(device) = device("a_cube_for_a_plane_is_refused") else {
        return;
    };
    let mut fixture = Fixture::new();
    fixture.picture.dimension = bossage_runner::TextureDimension::Cube;
    fixture.picture.levels = vec![vec![0; 24]];
    assert!(matches!(
        fixture.run(device, |_| {}),
        Err(Error::WrongResource { .. })
    ));
}

#[test]
fn a_level_of_the_wrong_length_is_named() {
    let Some(device) = device("a_level_of_the_wrong_length_is_named") else {
        return;
    };
    let mut fixture = Fixture::new();
    fixture.picture.levels = vec![vec![0; 3]];
    let error = fixture.run(device, |_| {}).unwrap_err();
    assert_eq!(
        error.to_string(),
        "texture `picture`: level 0 has 3 bytes instead of 4"
    );
}

#[test]
fn an_unknown_buffer_is_a_mistake() {
    let Some(device) = device("an_unknown_buffer_is_a_mistake") else {
        return;
    };
    let spoil = |job: &mut ComputeJob<'_>| {
        let misspelt = ("ouputs".to_owned(), BufferData::Output(4));
        job.resources.buffers.extend([misspelt]);
    };
    let error = Fixture::new().run(device, spoil).unwrap_err();
    assert!(
        matches!(&error, Error::UnknownResource { name, .. } if name == "ouputs"),
        "{error}"
    );
}

#[test]
fn too_many_workgroups_are_refused_with_the_limit() {
    let Some(device) = device("too_many_workgroups_are_refused_with_the_limit") else {
        return;
    };
    let limit = device.limits().max_compute_workgroups_per_dimension;
    let error = Fixture::new()
        .run(device, |job| job.workgroups[1] = limit + 1)
        .unwrap_err();
    assert!(
        matches!(error, Error::TooLarge { limit: most, .. } if most == u64::from(limit)),
        "{error}"
    );
}

#[test]
fn a_shader_that_does_not_compile_is_an_error_and_the_device_lives_on() {
    let Some(device) = device("a_shader_that_does_not_compile_is_an_error_and_the_device_lives_on") else {
        return;
    };
    let fixture = Fixture::new();
    let broken = TINT.replace("tint.colour.r", "tint.colour");
    let error = fixture
        .run(device, |job| job.shader.code = Code::Wgsl(broken.clone().leak()))
        .unwrap_err();
    assert!(matches!(error, Error::Validation { .. }), "{error}");
    assert_eq!(fixture.run(device, |_| {}).unwrap(), 30.0);
}

#[test]
fn a_manifest_of_another_shader_is_an_error_not_a_panic() {
    let Some(device) = device("a_manifest_of_another_shader_is_an_error_not_a_panic") else {
        return;
    };
    let other = compile(
        "@group(0) @binding(5) var<storage, read_write> outputs: array<f32>;
         @compute @workgroup_size(1) fn tinted() { outputs[0] = 1.0; }",
    );
    let fixture = Fixture::new();
    let shader = Shader {
        code: other.wgsl("tinted").code,
        entry: fixture.compiled.wgsl("tinted").entry,
    };
    let mut resources = Resources::default();
    resources.uniforms.insert("tint".into(), vec![1.0; 5]);
    resources.textures.insert("picture".into(), &fixture.picture);
    resources.buffers.insert("outputs".into(), BufferData::Output(4));
    let error = ComputeJob {
        name: "mixed",
        shader,
        resources,
        workgroups: [1; 3],
    }
    .run(device)
    .unwrap_err();
    assert!(matches!(error, Error::Validation { .. }), "{error}");
}

#[test]
fn inputs_that_are_no_whole_items_are_refused() {
    let Some(device) = device("inputs_that_are_no_whole_items_are_refused") else {
        return;
    };
    let shader = compile(TINT);
    let shader = shader.wgsl("tinted");
    let error = run_probe(device, shader.code, shader.entry, &[1.0; 7], 1, 3).unwrap_err();
    assert!(
        matches!(
            error,
            Error::Length {
                given: 7,
                expected: 6,
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn bytes_that_are_no_spirv_never_reach_the_driver() {
    let Some(device) = device("bytes_that_are_no_spirv_never_reach_the_driver") else {
        return;
    };
    let error = Fixture::new()
        .run(device, |job| {
            job.shader.code = Code::Spirv(b"not SPIR-V at all...")
        })
        .unwrap_err();
    assert!(matches!(error, Error::NotSpirv { .. }), "{error}");
}

#[test]
fn an_entry_point_that_is_not_in_the_module_is_an_error() {
    let Some(device) = device("an_entry_point_that_is_not_in_the_module_is_an_error") else {
        return;
    };
    let other = compile(&TINT.replace("fn tinted", "fn another"));
    let fixture = Fixture::new();
    let code = other.spirv("another").code;
    let shader = Shader {
        code,
        entry: fixture.compiled.spirv("tinted").entry,
    };
    let mut resources = Resources::default();
    resources.uniforms.insert("tint".into(), vec![1.0; 5]);
    resources.textures.insert("picture".into(), &fixture.picture);
    resources.buffers.insert("outputs".into(), BufferData::Output(4));
    let error = ComputeJob {
        name: "absent",
        shader,
        resources,
        workgroups: [1; 3],
    }
    .run(device)
    .unwrap_err();
    assert!(matches!(error, Error::Validation { .. }), "{error}");
}

#[test]
fn an_adapter_that_is_not_there_is_named_beside_those_that_are() {
    let Some(device) = device("an_adapter_that_is_not_there_is_named_beside_those_that_are") else {
        return;
    };
    let error = Device::open(&AdapterSelector::named("Voodoo Graphics")).unwrap_err();
    assert!(error.is_missing_environment());
    let text = error.to_string();
    assert!(
        text.contains("Voodoo Graphics") && text.contains(&device.info().name),
        "{text}"
    );
}

#[test]
fn adapters_are_listed_in_the_same_order_every_time() {
    let Some(device) = device("adapters_are_listed_in_the_same_order_every_time") else {
        return;
    };
    let first = bossage_runner::adapters();
    assert_eq!(first, bossage_runner::adapters());
    assert!(first.contains(device.info()));
}
