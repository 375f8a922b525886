//! Passes that run one fragment a pixel, and the bindings that they read.

/// A layout of consecutive bindings, visible to `stages`.
pub fn bind_group_layout(
    device: &wgpu::Device,
    label: &str,
    stages: wgpu::ShaderStages,
    types: &[wgpu::BindingType],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(types)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: stages,
            ty: *ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// Resources at consecutive bindings.
pub fn bind_group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry {
            binding,
            resource: resource.clone(),
        })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}

/// The binding type of a 2D texture that is read texel by texel.
pub const fn texture_binding(sample_type: wgpu::TextureSampleType) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}

/// The binding type of a whole buffer.
pub const fn buffer_binding(ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

/// A pipeline that covers the picture.
pub struct FullscreenDesc<'a> {
    /// Includes shared/fullscreen.wgsl.
    pub module: &'a wgpu::ShaderModule,
    /// Name of the fragment shader.
    pub fragment: &'a str,
    /// What it reads.
    pub layout: &'a wgpu::PipelineLayout,
    /// What it writes beside depth.
    pub formats: Vec<wgpu::TextureFormat>,
    /// Values of the module's `override`s.
    pub constants: &'a [(&'a str, f64)],
    /// How what it writes is put together with what is there.
    pub blend: Option<wgpu::BlendState>,
    /// Tests that decide which pixels get there.
    pub depth_stencil: Option<wgpu::DepthStencilState>,
}

impl<'a> FullscreenDesc<'a> {
    /// One that overwrites every pixel.
    pub fn new(
        module: &'a wgpu::ShaderModule,
        fragment: &'a str,
        layout: &'a wgpu::PipelineLayout,
        format: wgpu::TextureFormat,
    ) -> Self {
        Self {
            module,
            fragment,
            layout,
            formats: vec![format],
            constants: &[],
            blend: None,
            depth_stencil: None,
        }
    }
}

/// Builds the pipeline: `fullscreen` of shared/fullscreen.wgsl, then the fragment shader.
pub fn pipeline(device: &wgpu::Device, desc: &FullscreenDesc<'_>) -> wgpu::RenderPipeline {
    let target = |&format: &wgpu::TextureFormat| {
        Some(wgpu::ColorTargetState {
            blend: desc.blend,
            ..format.into()
        })
    };
    let targets: Vec<_> = desc.formats.iter().map(target).collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(desc.fragment),
        layout: Some(desc.layout),
        vertex: wgpu::VertexState {
            module: desc.module,
            entry_point: Some("fullscreen"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: desc.depth_stencil.clone(),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: desc.module,
            entry_point: Some(desc.fragment),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: desc.constants,
                ..Default::default()
            },
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A pass that draws into `view`, over what is there or (`LoadOp::Clear`) from a plain colour.
pub fn pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    view: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
    depth_stencil: Option<&wgpu::TextureView>,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load,
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: depth_stencil.map(|view| {
            wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: None,
                stencil_ops: None,
            }
        }),
        ..Default::default()
    })
}
