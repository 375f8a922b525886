//! Graphics pipelines with native stages.

use super::bindings::Bindings;
use super::counting::{self, Raster};
use super::target::Target;
use super::{NativeError, raw_device, wait_idle};
use crate::gpu::DepthDirection;
use crate::gpu::shader::{GlslStage, Spirv};
use ash::vk;
use wgpu::hal::api::Vulkan;

/// What a draw's vertices are put together to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PrimitiveTopology {
    /// One primitive a vertex.
    Points,
    /// Three vertices a primitive.
    Triangles,
    /// Four vertices a primitive.
    LinesWithAdjacency,
    /// Six vertices a primitive.
    TrianglesWithAdjacency,
    /// Tessellation patches of so many control points.
    Patches(u32),
    /// There are no vertices: task or mesh shaders make the primitives.
    Meshes,
}

/// Where a pipeline's vertices come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VertexInput {
    /// Nowhere: a vertex is its number, and shaders fetch what they need.
    Numbers,
    /// Positions, three floats each and so many bytes apart, at location 0.
    Positions {
        /// Bytes from one position to the next.
        stride: u32,
    },
}

/// A graphics pipeline.
pub struct PipelineDesc<'a> {
    /// In pipeline order.
    pub stages: &'a [Spirv],
    /// Where vertices come from.
    pub input: VertexInput,
    /// How vertices form primitives.
    pub topology: PrimitiveTopology,
    /// What becomes of the primitives.
    pub raster: Raster,
    /// How far primitives are pushed away from the eye before the depth test: by the change of their
    /// depth over so many pixels.
    pub push_back_px: f32,
}

/// A native graphics pipeline.
pub struct Pipeline {
    pub(super) handle: vk::Pipeline,
    /// Calls of the extension, where the pipeline has mesh shaders.
    pub(super) meshes: Option<ash::ext::mesh_shader::Device>,
    raw: ash::Device,
    device: wgpu::Device,
}

impl Pipeline {
    /// Builds the pipeline for passes over `target` with `bindings`.
    ///
    /// # Errors
    /// When the driver refuses the pipeline.
    pub fn new(
        device: &wgpu::Device,
        target: &Target,
        bindings: &Bindings,
        desc: &PipelineDesc<'_>,
    ) -> Result<Self, NativeError> {
        let raw = raw_device(device)?;
        let meshes = desc.topology == PrimitiveTopology::Meshes;
        let meshes = meshes.then(|| mesh_calls(device)).transpose()?;
        let mut modules = Vec::with_capacity(desc.stages.len());
        for stage in desc.stages {
            let info = vk::ShaderModuleCreateInfo::default().code(&stage.words);
            // SAFETY: the words are valid SPIR-V, straight from the compiler.
            modules.push((stage.stage, unsafe {
                raw.create_shader_module(&info, None)
            }?));
        }
        let handle = create(&raw, target, bindings, desc, &modules);
        for (_, module) in modules {
            // SAFETY: a pipeline keeps what it needs of its modules, so they may go now.
            unsafe { raw.destroy_shader_module(module, None) };
        }
        Ok(Self {
            handle: handle?,
            meshes,
            raw,
            device: device.clone(),
        })
    }
}

fn mesh_calls(device: &wgpu::Device) -> Result<ash::ext::mesh_shader::Device, NativeError> {
    // SAFETY: the handle is only borrowed, to ask for the addresses of functions.
    let hal = unsafe { device.as_hal::<Vulkan>() }.ok_or(NativeError::NotVulkan)?;
    let instance = hal.shared_instance().raw_instance();
    Ok(ash::ext::mesh_shader::Device::new(
        instance,
        hal.raw_device(),
    ))
}

fn create(
    raw: &ash::Device,
    target: &Target,
    bindings: &Bindings,
    desc: &PipelineDesc<'_>,
    modules: &[(GlslStage, vk::ShaderModule)],
) -> Result<vk::Pipeline, vk::Result> {
    let stages: Vec<_> = modules.iter().map(stage_info).collect();
    let (buffers, attributes) = vertex_buffers(desc.input);
    let vertex_input = vk::PipelineVertexInputStateCreateInfo::default()
        .vertex_binding_descriptions(&buffers)
        .vertex_attribute_descriptions(&attributes);
    let (topology, control_points) = topology(desc.topology);
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(topology);
    let tessellation = vk::PipelineTessellationStateCreateInfo::default()
        .patch_control_points(control_points.unwrap_or_default());
    let vk::Extent2D { width, height } = target.extent;
    // The negative height turns y up in clip space, as in wgpu's own passes.
    let viewports = [vk::Viewport {
        x: 0.0,
        y: height as f32,
        width: width as f32,
        height: -(height as f32),
        min_depth: 0.0,
        max_depth: 1.0,
    }];
    let scissors = [vk::Rect2D {
        offset: vk::Offset2D::default(),
        extent: target.extent,
    }];
    let viewport = vk::PipelineViewportStateCreateInfo::default()
        .viewports(&viewports)
        .scissors(&scissors);
    let rasterization = rasterization(desc, target.direction);
    let depth_stencil = counting::tests(desc.raster, target.direction, &target.counts);
    let multisample = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(vk::SampleCountFlags::TYPE_1);
    let added = target.counts.texture().map(|_| counting::addition());
    let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(added.as_slice());
    let mut info = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&vertex_input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&rasterization)
        .multisample_state(&multisample)
        .depth_stencil_state(&depth_stencil)
        .color_blend_state(&blend)
        .layout(bindings.layout)
        .render_pass(target.render_pass);
    if control_points.is_some() {
        info = info.tessellation_state(&tessellation);
    }
    // SAFETY: everything that `info` points to lives until after the call.
    unsafe { raw.create_graphics_pipelines(vk::PipelineCache::null(), &[info], None) }
        .map(|pipelines| pipelines[0])
        .map_err(|(_, error)| error)
}

/// How vertices form primitives, and the control points of a patch.
///
/// Mesh shaders say for themselves how; the device does not look at what is given here.
fn topology(topology: PrimitiveTopology) -> (vk::PrimitiveTopology, Option<u32>) {
    match topology {
        PrimitiveTopology::Points => (vk::PrimitiveTopology::POINT_LIST, None),
        PrimitiveTopology::Triangles | PrimitiveTopology::Meshes => {
            (vk::PrimitiveTopology::TRIANGLE_LIST, None)
        }
        PrimitiveTopology::LinesWithAdjacency => {
            (vk::PrimitiveTopology::LINE_LIST_WITH_ADJACENCY, None)
        }
        PrimitiveTopology::TrianglesWithAdjacency => {
            (vk::PrimitiveTopology::TRIANGLE_LIST_WITH_ADJACENCY, None)
        }
        PrimitiveTopology::Patches(points) => (vk::PrimitiveTopology::PATCH_LIST, Some(points)),
    }
}

fn rasterization(
    desc: &PipelineDesc<'_>,
    direction: DepthDirection,
) -> vk::PipelineRasterizationStateCreateInfo<'static> {
    // No depth clamp: what lies before the near plane never fails a depth test, so clipping it
    // changes no count, and it keeps the depth of the clipped faces precise (a face that reaches
    // almost to the eye would have depths of thousands, and lose its far end to rounding).
    vk::PipelineRasterizationStateCreateInfo::default()
        .rasterizer_discard_enable(desc.raster == Raster::Discard)
        .polygon_mode(vk::PolygonMode::FILL)
        .cull_mode(vk::CullModeFlags::NONE)
        .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
        .depth_bias_enable(desc.push_back_px != 0.0)
        .depth_bias_slope_factor(match direction {
            DepthDirection::Reversed => -desc.push_back_px,
            DepthDirection::Standard => desc.push_back_px,
        })
        .line_width(1.0)
}

fn vertex_buffers(
    input: VertexInput,
) -> (
    Vec<vk::VertexInputBindingDescription>,
    Vec<vk::VertexInputAttributeDescription>,
) {
    match input {
        VertexInput::Numbers => (Vec::new(), Vec::new()),
        VertexInput::Positions { stride } => (
            vec![
                vk::VertexInputBindingDescription::default()
                    .stride(stride)
                    .input_rate(vk::VertexInputRate::VERTEX),
            ],
            vec![
                vk::VertexInputAttributeDescription::default().format(vk::Format::R32G32B32_SFLOAT),
            ],
        ),
    }
}

fn stage_info(
    (stage, module): &(GlslStage, vk::ShaderModule),
) -> vk::PipelineShaderStageCreateInfo<'static> {
    vk::PipelineShaderStageCreateInfo::default()
        .stage(stage_flag(*stage))
        .module(*module)
        .name(c"main")
}

fn stage_flag(stage: GlslStage) -> vk::ShaderStageFlags {
    match stage {
        GlslStage::Vertex => vk::ShaderStageFlags::VERTEX,
        GlslStage::TessellationControl => vk::ShaderStageFlags::TESSELLATION_CONTROL,
        GlslStage::TessellationEvaluation => vk::ShaderStageFlags::TESSELLATION_EVALUATION,
        GlslStage::Geometry => vk::ShaderStageFlags::GEOMETRY,
        GlslStage::Fragment => vk::ShaderStageFlags::FRAGMENT,
        GlslStage::Task => vk::ShaderStageFlags::TASK_EXT,
        GlslStage::Mesh => vk::ShaderStageFlags::MESH_EXT,
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        wait_idle(&self.device);
        // SAFETY: nothing that was submitted still runs, and the handle is ours alone.
        unsafe { self.raw.destroy_pipeline(self.handle, None) };
    }
}
