//! The casters' depth as the light sees it: what both kinds of shadow map draw and look up.

use super::{MethodError, PrepareContext};
use crate::frame::fullscreen::{buffer_binding, texture_binding};
use crate::frame::{Frame, MaskPass, MaskShader, SceneBuffers};
use crate::geometry::Bounds;
use crate::gpu::{Gpu, Stage, shader};
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};
use std::ops::Range;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// One view from the light. Twin of `Light` in shaders/methods/shadow_map/map.wgsl.
///
/// Both maps see places relative to `origin`, the light itself or the middle of the casters, so that the
/// last digits are those of distances in the scene wherever in the world it is. What is nearer is larger:
/// so floating-point depth is finest where it has to be, far from the light.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct LightView {
    pub view_projection: Mat4,
    pub origin: Vec4,
}

/// The constant bias: how far a surface may seem to be from where it is, for rounding alone.
///
/// With u = 2^-24, half the last bit of 1, and M the largest coordinate: the rows of the matrix by which the
/// G-buffer places a vertex, and the sums in them, are off by some 3 u (M + eye); that is the same for all
/// pixels of the triangle, whose corners may lie far outside of the picture. Depth, the ray of the pixel and
/// the way from the map's origin add a few u times distances that are at most twice as long. A dozen u
/// (M + eye) bounds all of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rounding {
    units: i32,
    largest: f64,
}

impl Rounding {
    /// By so many u, of a scene that is seen from `origin`.
    pub(super) fn new(units: i32, scene: Bounds, origin: Vec3) -> Self {
        let scene = scene.union(Bounds::of([&origin]));
        Self {
            units,
            largest: scene.low.abs().max(scene.high.abs()).max_element(),
        }
    }

    /// See [`Self`].
    pub(super) const DEFAULT_UNITS: i32 = 12;

    /// As shaders/methods/shadow_map/bias.wgsl has it.
    pub(super) fn for_shader(self) -> Vec4 {
        const HALF_LAST_BIT: f64 = f32::EPSILON as f64 / 2.0;
        let per_unit = f64::from(self.units) * HALF_LAST_BIT;
        Vec4::new(per_unit as f32, self.largest as f32, 0.0, 0.0)
    }
}

/// The texel at a place on a layer, as the lookup shaders have it: x right and y up from -1 to 1.
pub(super) fn texel_at(layer: i64, x: f64, y: f64, resolution: u32) -> [i64; 3] {
    let texel = |at: f64| {
        let last = i64::from(resolution) - 1;
        ((at * f64::from(resolution)).floor() as i64).clamp(0, last)
    };
    [layer, texel(0.5 + 0.5 * x), texel(0.5 - 0.5 * y)]
}

/// A depth texture of `layers` square layers.
pub(super) fn texture(
    gpu: &Gpu,
    resolution: u32,
    layers: u32,
) -> Result<wgpu::Texture, MethodError> {
    Ok(gpu.texture(&wgpu::TextureDescriptor {
        label: Some("a shadow map"),
        size: wgpu::Extent3d {
            width: resolution,
            height: resolution,
            depth_or_array_layers: layers,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })?)
}

/// The pipeline that draws casters into a map; bind group 0 holds a [`LightView`].
pub(super) fn pipeline(gpu: &Gpu, slope_bias: f32) -> wgpu::RenderPipeline {
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
                format: FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: wgpu::StencilState::default(),
                // Nearer is larger, so what pushes away is negative.
                bias: wgpu::DepthBiasState {
                    constant: 0,
                    slope_scale: -slope_bias,
                    clamp: 0.0,
                },
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        })
}

/// Draws `objects` into one layer.
pub(super) fn draw(
    stage: &mut Stage<'_, '_>,
    layer: &wgpu::TextureView,
    (pipeline, light): (&wgpu::RenderPipeline, &wgpu::BindGroup),
    scene: &SceneBuffers,
    objects: &[Range<u32>],
) {
    let mut pass = stage
        .encoder()
        .begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: layer,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, light, &[]);
    let draw_calls = scene.draw(&mut pass, objects);
    drop(pass);
    stage.count_draws(draw_calls);
}

/// The pass over the picture that looks the map up.
pub(super) struct Lookup(MaskPass);

impl Lookup {
    /// `shader` reads the frame's depth, the map, and a uniform `light`, and averages a square of `pcf`
    /// texels.
    pub(super) fn new(
        context: &PrepareContext<'_>,
        shader: &str,
        (map, dimension): (&wgpu::TextureView, wgpu::TextureViewDimension),
        light: &wgpu::Buffer,
        pcf: u32,
    ) -> Self {
        let PrepareContext { gpu, resources, .. } = context;
        let depth = texture_binding(wgpu::TextureSampleType::Depth);
        let map_binding = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: dimension,
            multisampled: false,
        };
        let uniform = buffer_binding(wgpu::BufferBindingType::Uniform);
        let texture = wgpu::BindingResource::TextureView;
        let inputs = [
            (depth, texture(&resources.targets.depth_only_view)),
            (map_binding, texture(map)),
            (uniform, light.as_entire_binding()),
        ];
        let lookup = MaskShader {
            module: &shader::wgsl(&gpu.device, shader),
            fragment: "lookup",
            constants: &[("pcf", f64::from(pcf))],
            inputs: &inputs,
        };
        Self(MaskPass::new(&gpu.device, resources, &lookup))
    }

    /// Records the stage `lookup`.
    pub(super) fn record(&self, frame: &mut Frame<'_>) {
        let resources = frame.resources();
        frame.stage("lookup", |stage| self.0.record(stage, resources));
    }
}
