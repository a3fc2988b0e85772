//! Modules, layouts and pipelines, each made once a device.

use bossage_translate::Stage;

use crate::cache::{Layout, ModuleKey, StageKey};
use crate::code::{Code, Shader};
use crate::device::Device;
use crate::error::Error;
use crate::render::{Cull, Depth};
use crate::target::{Blend, TargetFormat};

/// The depth buffer's format.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Everything that a render pipeline depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct RenderKey {
    pub(crate) vertex: StageKey,
    pub(crate) fragment: StageKey,
    pub(crate) layout: wgpu::PipelineLayout,
    /// (location, components) of each attribute, which has a buffer of its own.
    pub(crate) attributes: Vec<(u32, u32)>,
    /// Each target's format, and whether the fragment stage writes it.
    pub(crate) targets: Vec<(TargetFormat, bool)>,
    pub(crate) cull: Cull,
    pub(crate) blend: Blend,
    pub(crate) depth: Depth,
}

/// The module of a shader, checked that it is one.
pub(crate) fn stage(device: &Device, job: &str, shader: &Shader<'_>) -> Result<StageKey, Error> {
    let key = ModuleKey {
        route: shader.code.route(),
        code: shader.code.bytes().into(),
    };
    let module = device.caches.modules.get(key, |_| module(device, job, shader))?;
    Ok(StageKey {
        module,
        entry: shader.entry_point().to_owned(),
    })
}

fn module(device: &Device, job: &str, shader: &Shader<'_>) -> Result<wgpu::ShaderModule, Error> {
    device.scoped(job, || match shader.code {
        Code::Wgsl(text) => Ok(device.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(job),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        })),
        Code::Glsl(_) => Err(Error::invalid(
            job,
            "Vulkan takes no GLSL: have it compiled first",
        )),
        Code::Spirv(bytes) => {
            let module = crate::passthrough::read(job, bytes)?;
            let what = "the passing through of SPIR-V";
            device.require(job, wgpu::Features::PASSTHROUGH_SHADERS, what)?;
            Ok(crate::passthrough::create(&device.device, job, &module))
        }
        Code::Msl(_) => Err(Error::unsupported(job, &device.info().name, "a compiler of MSL")),
    })
}

/// The layout of these groups, an empty one of which is none, and of so many bytes of push constants.
pub(crate) fn layout(
    device: &Device,
    job: &str,
    groups: Vec<Vec<wgpu::BindGroupLayoutEntry>>,
    immediate_size: u32,
) -> Result<Layout, Error> {
    device
        .caches
        .layouts
        .get((groups, immediate_size), |(groups, _)| {
            device.scoped(job, || {
                let make = |entries: &Vec<wgpu::BindGroupLayoutEntry>| {
                    let descriptor = wgpu::BindGroupLayoutDescriptor {
                        label: Some(job),
                        entries,
                    };
                    (!entries.is_empty()).then(|| device.device.create_bind_group_layout(&descriptor))
                };
                let groups: Vec<_> = groups.iter().map(make).collect();
                let pipeline = device
                    .device
                    .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                        label: Some(job),
                        bind_group_layouts: &groups.iter().map(Option::as_ref).collect::<Vec<_>>(),
                        immediate_size,
                    });
                Ok(Layout { groups, pipeline })
            })
        })
}

/// A compute pipeline.
pub(crate) fn compute(
    device: &Device,
    job: &str,
    stage: StageKey,
    layout: &Layout,
) -> Result<wgpu::ComputePipeline, Error> {
    device
        .caches
        .compute
        .get((stage, layout.pipeline.clone()), |(stage, layout)| {
            device.scoped(job, || {
                Ok(device
                    .device
                    .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                        label: Some(job),
                        layout: Some(layout),
                        module: &stage.module,
                        entry_point: Some(&stage.entry),
                        compilation_options: wgpu::PipelineCompilationOptions::default(),
                        cache: None,
                    }))
            })
        })
}

/// A render pipeline.
pub(crate) fn render(device: &Device, job: &str, key: RenderKey) -> Result<wgpu::RenderPipeline, Error> {
    device.caches.render.get(key, |key| {
        device.scoped(job, || Ok(create_render(device, job, key)))
    })
}

fn create_render(device: &Device, job: &str, key: &RenderKey) -> wgpu::RenderPipeline {
    let attributes: Vec<_> = key
        .attributes
        .iter()
        .map(|(location, floats)| [attribute(*location, *floats)])
        .collect();
    let strides = key.attributes.iter().map(|(_, floats)| u64::from(*floats) * 4);
    let buffers: Vec<_> = strides
        .zip(&attributes)
        .map(|(stride, attributes)| buffer(stride, attributes))
        .collect();
    let targets: Vec<_> = (0..)
        .zip(&key.targets)
        .map(|(index, (format, written))| target(index, *format, *written, key.blend))
        .collect();
    device
        .device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(job),
            layout: Some(&key.layout),
            vertex: wgpu::VertexState {
                module: &key.vertex.module,
                entry_point: Some(&key.vertex.entry),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: cull_mode(key.cull),
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: Some(depth_state(key.depth)),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &key.fragment.module,
                entry_point: Some(&key.fragment.entry),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
}

fn attribute(location: u32, floats: u32) -> wgpu::VertexAttribute {
    let format = match floats {
        1 => wgpu::VertexFormat::Float32,
        2 => wgpu::VertexFormat::Float32x2,
        3 => wgpu::VertexFormat::Float32x3,
        _ => wgpu::VertexFormat::Float32x4,
    };
    wgpu::VertexAttribute {
        format,
        offset: 0,
        shader_location: location,
    }
}

fn buffer(array_stride: u64, attributes: &[wgpu::VertexAttribute]) -> Option<wgpu::VertexBufferLayout<'_>> {
    Some(wgpu::VertexBufferLayout {
        array_stride,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes,
    })
}

fn target(
    location: u32,
    format: TargetFormat,
    written: bool,
    blend: Blend,
) -> Option<wgpu::ColorTargetState> {
    let write_mask = if written {
        wgpu::ColorWrites::ALL
    } else {
        wgpu::ColorWrites::empty()
    };
    let blend = if location == 0 { blend_state(blend) } else { None };
    Some(wgpu::ColorTargetState {
        format: format.wgpu(),
        blend,
        write_mask,
    })
}

fn blend_state(blend: Blend) -> Option<wgpu::BlendState> {
    let (src_factor, dst_factor) = match blend {
        Blend::Replace => return None,
        Blend::Add => (wgpu::BlendFactor::One, wgpu::BlendFactor::One),
        Blend::Multiply => (wgpu::BlendFactor::Dst, wgpu::BlendFactor::Zero),
    };
    let component = wgpu::BlendComponent {
        src_factor,
        dst_factor,
        operation: wgpu::BlendOperation::Add,
    };
    Some(wgpu::BlendState {
        color: component,
        alpha: component,
    })
}

fn cull_mode(cull: Cull) -> Option<wgpu::Face> {
    match cull {
        Cull::None => None,
        Cull::Back => Some(wgpu::Face::Back),
        Cull::Front => Some(wgpu::Face::Front),
    }
}

fn depth_state(depth: Depth) -> wgpu::DepthStencilState {
    let (writes, compare) = match depth {
        Depth::TestAndWrite => (true, wgpu::CompareFunction::Less),
        Depth::TestOnly => (false, wgpu::CompareFunction::LessEqual),
        Depth::Equal => (false, wgpu::CompareFunction::Equal),
        Depth::Ignore => (false, wgpu::CompareFunction::Always),
    };
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(writes),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

/// The stage flag of an entry point.
pub(crate) fn visibility(stage: Stage) -> wgpu::ShaderStages {
    match stage {
        Stage::Vertex => wgpu::ShaderStages::VERTEX,
        Stage::Fragment => wgpu::ShaderStages::FRAGMENT,
        Stage::Compute => wgpu::ShaderStages::COMPUTE,
    }
}
