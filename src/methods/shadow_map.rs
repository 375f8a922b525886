//! A shadow map: the casters' depth seen from the light in one perspective (or, for a light at
//! infinity, parallel) view, looked up once a pixel (Williams 1978; in Milet et al. 2014 the
//! method that silhouettes are compared with in table 3).

use super::frustum::LightFrustum;
use super::parameters::{Parameters, in_range};
use super::{MethodError, MethodInfo, PrepareContext, PreparedMethod, ShadowMethod};
use crate::frame::fullscreen::{self, bind_group, bind_group_layout, texture_binding};
use crate::frame::targets::MASK_FORMAT;
use crate::frame::{SceneBuffers, Stage};
use crate::gpu::{FrameRecorder, Gpu, shader};
use serde::{Deserialize, Serialize};
use wgpu::util::DeviceExt;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "shadow_map",
    title: "one perspective shadow map, nearest texel",
    source: "Williams 1978; Milet et al. 2014, table 3",
    needs: &[],
    limits: &[
        "edges are as coarse as the map's texels; acne and detached shadows trade off by bias",
        "a light among the casters: what its widest frustum (150 degrees) leaves out is lit",
    ],
    parameters: &[
        (
            "resolution",
            "8192",
            "side of the square map in texels, up to the device's limit",
        ),
        (
            "constant_bias",
            "2",
            "depth bias in units of the depth buffer's last bit, at least 0",
        ),
        (
            "slope_bias",
            "2.0",
            "depth bias in texels times the slope of the surface, at least 0",
        ),
    ],
};

/// The method's parameters.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ShadowMap {
    resolution: u32,
    constant_bias: i32,
    slope_bias: f32,
}

impl Default for ShadowMap {
    fn default() -> Self {
        Self {
            resolution: 8192,
            constant_bias: 2,
            slope_bias: 2.0,
        }
    }
}

impl Parameters for ShadowMap {
    fn validate(&self) -> Result<(), String> {
        in_range("resolution", self.resolution, 1..=1 << 16)?;
        in_range("constant_bias", self.constant_bias, 0..=i32::MAX)?;
        in_range("slope_bias", self.slope_bias, 0.0..=1e6)
    }
}

impl ShadowMethod for ShadowMap {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn variant(&self) -> String {
        self.difference()
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let largest = context.gpu.max_texture_px();
        if self.resolution > largest {
            return Err(MethodError::Parameter(format!(
                "a map of {0} × {0} texels is larger than this device allows ({largest} × {largest})",
                self.resolution
            )));
        }
        let scene = context.scene;
        let frustum = LightFrustum::around_casters(&scene.mesh, scene.light).ok_or_else(|| {
            MethodError::Unavailable("no caster lies before the light in any one view".to_owned())
        })?;
        Ok(Box::new(PreparedMap::new(context, self, &frustum)))
    }
}

/// The map of one scene.
struct PreparedMap {
    map_view: wgpu::TextureView,
    map_pipeline: wgpu::RenderPipeline,
    map_bindings: wgpu::BindGroup,
    lookup_pipeline: wgpu::RenderPipeline,
    inputs: wgpu::BindGroup,
    covered: f64,
}

const MAP_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

impl PreparedMap {
    fn new(context: &PrepareContext<'_>, parameters: &ShadowMap, frustum: &LightFrustum) -> Self {
        let PrepareContext { gpu, stage, .. } = context;
        let device = &gpu.device;
        let light = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("light"),
            contents: bytemuck::bytes_of(&frustum.view_projection),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let side = parameters.resolution;
        let map = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d {
                width: side,
                height: side,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: MAP_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let map_view = map.create_view(&wgpu::TextureViewDescriptor::default());

        let uniform = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let map_pipeline = map_pipeline(gpu, parameters);
        let map_layout = map_pipeline.get_bind_group_layout(0);
        let map_bindings = bind_group(device, &map_layout, &[light.as_entire_binding()]);

        let inputs_layout = bind_group_layout(
            device,
            "shadow map inputs",
            &[
                texture_binding(wgpu::TextureSampleType::Depth),
                texture_binding(wgpu::TextureSampleType::Depth),
                uniform,
            ],
        );
        let inputs = bind_group(
            device,
            &inputs_layout,
            &[
                wgpu::BindingResource::TextureView(&stage.targets.depth_only_view),
                wgpu::BindingResource::TextureView(&map_view),
                light.as_entire_binding(),
            ],
        );
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow map lookup"),
            bind_group_layouts: &[Some(&stage.uniform.layout), Some(&inputs_layout)],
            ..Default::default()
        });
        let module = shader::wgsl(device, "methods/shadow_map/lookup.wgsl");
        let lookup_pipeline =
            fullscreen::pipeline(device, &module, "lookup", &layout, MASK_FORMAT, None);
        Self {
            map_view,
            map_pipeline,
            map_bindings,
            lookup_pipeline,
            inputs,
            covered: frustum.covered,
        }
    }
}

fn map_pipeline(gpu: &Gpu, parameters: &ShadowMap) -> wgpu::RenderPipeline {
    let module = shader::wgsl(&gpu.device, "methods/shadow_map/map.wgsl");
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("shadow map"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(SceneBuffers::vertex_layout())],
            },
            // Both sides cast: meshes may be open.
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: MAP_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState {
                    constant: parameters.constant_bias,
                    slope_scale: parameters.slope_bias,
                    clamp: 0.0,
                },
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        })
}

impl PreparedMethod for PreparedMap {
    fn record(&self, frame: &mut FrameRecorder<'_>, stage: &Stage) {
        frame.stage("map", |encoder| {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("shadow map"),
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &self.map_view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            pass.set_pipeline(&self.map_pipeline);
            pass.set_bind_group(0, &self.map_bindings, &[]);
            stage.scene.draw(&mut pass, &stage.scene.casters)
        });
        frame.stage("lookup", |encoder| {
            let mask = &stage.targets.mask_view;
            let mut pass =
                fullscreen::pass(encoder, "shadow map lookup", mask, wgpu::LoadOp::Load, None);
            pass.set_pipeline(&self.lookup_pipeline);
            pass.set_bind_group(0, &stage.uniform.bind_group, &[]);
            pass.set_bind_group(1, &self.inputs, &[]);
            pass.draw(0..3, 0..1);
            1
        });
    }

    fn warnings(&self) -> Vec<String> {
        if self.covered >= 1.0 {
            return Vec::new();
        }
        vec![format!(
            "the light is among the casters: one map covers {:.0} % of their vertices, and what it \
             leaves out is lit",
            100.0 * self.covered
        )]
    }
}
