//! The casters' depth as the light sees it: what both kinds of shadow map share.

use super::parameters::{Parameters, in_range};
use super::{
    BiasSearch, MethodError, MethodInfo, Parameter, PrepareContext, PreparedMethod, ShadowMethod,
};
use crate::frame::fullscreen::{
    self, FullscreenDesc, bind_group, bind_group_layout, texture_binding,
};
use crate::frame::targets::MASK_FORMAT;
use crate::frame::{SceneBuffers, Stage};
use crate::gpu::{FrameRecorder, Gpu, shader};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// See [`super::MethodInfo::parameters`]; each kind of map has its own resolution and constant bias.
pub(super) const PARAMETERS: &[Parameter] = &[
    (
        "slope_bias",
        "2.0",
        "depth bias in texels times the slope of the surface, at least 0; search: in a run, the smallest \
         without acne",
    ),
    (
        "pcf",
        "1",
        "side of the square of texels whose answers are averaged: 1, 3, 5, ... 15",
    ),
];

/// Largest square of percentage-closer filtering.
const MOST_PCF: u32 = 15;

/// The bias by the slope of a surface, in texels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum SlopeBias {
    /// So much.
    Fixed(f64),
    /// The smallest without acne, which somebody has to find first.
    Search,
}

/// The word for [`SlopeBias::Search`].
const SEARCH: &str = "search";

impl Serialize for SlopeBias {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Fixed(texels) => serializer.serialize_f64(*texels),
            Self::Search => serializer.serialize_str(SEARCH),
        }
    }
}

impl<'de> Deserialize<'de> for SlopeBias {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl de::Visitor<'_> for Visitor {
            type Value = SlopeBias;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a number of texels or \"{SEARCH}\"")
            }

            fn visit_f64<E: de::Error>(self, texels: f64) -> Result<SlopeBias, E> {
                Ok(SlopeBias::Fixed(texels))
            }

            fn visit_i64<E: de::Error>(self, texels: i64) -> Result<SlopeBias, E> {
                Ok(SlopeBias::Fixed(texels as f64))
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<SlopeBias, E> {
                match word {
                    SEARCH => Ok(SlopeBias::Search),
                    _ => Err(E::invalid_value(de::Unexpected::Str(word), &self)),
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

/// A kind of shadow map.
pub(super) trait MapKind: Clone + 'static {
    /// The method that draws it.
    fn info() -> &'static MethodInfo;
    /// Side of the map unless told otherwise.
    const RESOLUTION: u32;
    /// Constant bias unless told otherwise.
    const CONSTANT_BIAS: i32;
    /// Makes it ready for a scene.
    fn prepare(
        context: &PrepareContext<'_>,
        map: &MapParameters,
    ) -> Result<Box<dyn PreparedMethod>, MethodError>;
}

/// What a map is made with.
#[derive(Debug, Clone, Copy)]
pub(super) struct MapParameters {
    /// Side in texels.
    pub resolution: u32,
    /// Bias in units of the last bit.
    pub constant_bias: i32,
    /// Bias in texels, by the slope.
    pub slope_bias: f32,
    /// Side of the square that is averaged.
    pub pcf: u32,
}

/// A method that looks a map up; the two differ in the map, nothing else.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(default, bound = "")]
pub(super) struct DepthMap<K: MapKind> {
    resolution: u32,
    constant_bias: i32,
    slope_bias: SlopeBias,
    pcf: u32,
    #[serde(skip)]
    kind: PhantomData<K>,
}

impl<K: MapKind> Default for DepthMap<K> {
    fn default() -> Self {
        Self {
            resolution: K::RESOLUTION,
            constant_bias: K::CONSTANT_BIAS,
            slope_bias: SlopeBias::Fixed(2.0),
            pcf: 1,
            kind: PhantomData,
        }
    }
}

impl<K: MapKind> Parameters for DepthMap<K> {
    fn validate(&self) -> Result<(), String> {
        in_range("resolution", self.resolution, 1..=1 << 16)?;
        in_range("constant_bias", self.constant_bias, 0..=i32::MAX)?;
        if let SlopeBias::Fixed(texels) = self.slope_bias {
            in_range("slope_bias", texels, 0.0..=1e6)?;
        }
        in_range("pcf", self.pcf, 1..=MOST_PCF)?;
        if self.pcf.is_multiple_of(2) {
            return Err(format!("`pcf` is {}; it must be odd", self.pcf));
        }
        Ok(())
    }
}

impl<K: MapKind> ShadowMethod for DepthMap<K> {
    fn info(&self) -> &'static MethodInfo {
        K::info()
    }

    fn variant(&self) -> String {
        self.difference()
    }

    fn bias_search(&self) -> Option<BiasSearch<'_>> {
        (self.slope_bias == SlopeBias::Search).then(|| BiasSearch {
            resolution: self.resolution,
            with_bias: Box::new(|texels| {
                Box::new(Self {
                    slope_bias: SlopeBias::Fixed(texels),
                    ..self.clone()
                })
            }),
        })
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let SlopeBias::Fixed(slope_bias) = self.slope_bias else {
            let reason =
                "slope_bias=search is for runs, which find the bias first: give a number here";
            return Err(MethodError::Parameter(reason.to_owned()));
        };
        let map = MapParameters {
            resolution: self.resolution,
            constant_bias: self.constant_bias,
            slope_bias: slope_bias as f32,
            pcf: self.pcf,
        };
        K::prepare(context, &map)
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
    let largest = gpu.max_texture_px();
    if resolution > largest {
        return Err(MethodError::Parameter(format!(
            "a map of {resolution} × {resolution} texels is larger than this device allows \
             ({largest} × {largest})"
        )));
    }
    Ok(gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("shadow map"),
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
    }))
}

/// The pipeline that draws casters into a map; bind group 0 holds the light's matrix.
pub(super) fn pipeline(
    gpu: &Gpu,
    nearer: wgpu::CompareFunction,
    bias: wgpu::DepthBiasState,
) -> wgpu::RenderPipeline {
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
                depth_compare: Some(nearer),
                stencil: wgpu::StencilState::default(),
                bias,
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        })
}

/// Draws `objects` into one layer, over depth `far`; gives the number of draw calls.
pub(super) fn draw(
    encoder: &mut wgpu::CommandEncoder,
    layer: &wgpu::TextureView,
    far: f32,
    (pipeline, light): (&wgpu::RenderPipeline, &wgpu::BindGroup),
    scene: &SceneBuffers,
    objects: &[Range<u32>],
) -> u32 {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("shadow map"),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: layer,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(far),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, light, &[]);
    scene.draw(&mut pass, objects)
}

/// Keeps the larger of what is there and what is drawn.
const MAX_BLEND: wgpu::BlendState = {
    let component = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Max,
    };
    wgpu::BlendState {
        color: component,
        alpha: component,
    }
};

/// The pass over the picture that looks the map up.
pub(super) struct Lookup {
    pipeline: wgpu::RenderPipeline,
    inputs: wgpu::BindGroup,
}

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
        let PrepareContext { gpu, stage, .. } = context;
        let device = &gpu.device;
        let depth = texture_binding(wgpu::TextureSampleType::Depth);
        let map_binding = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: dimension,
            multisampled: false,
        };
        let uniform = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let input_layout = bind_group_layout(device, "lookup", &[depth, map_binding, uniform]);
        let resources = [
            wgpu::BindingResource::TextureView(&stage.targets.depth_only_view),
            wgpu::BindingResource::TextureView(map),
            light.as_entire_binding(),
        ];
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("lookup"),
            bind_group_layouts: &[Some(&stage.uniform.layout), Some(&input_layout)],
            ..Default::default()
        });
        let module = shader::wgsl(device, shader);
        Self {
            pipeline: fullscreen::pipeline(
                device,
                &FullscreenDesc {
                    constants: &[("pcf", f64::from(pcf))],
                    // What is dark already stays so.
                    blend: Some(MAX_BLEND),
                    ..FullscreenDesc::new(&module, "lookup", &layout, MASK_FORMAT)
                },
            ),
            inputs: bind_group(device, &input_layout, &resources),
        }
    }

    /// Records the stage `lookup`.
    pub(super) fn record(&self, frame: &mut FrameRecorder<'_>, stage: &Stage) {
        frame.stage("lookup", |encoder| {
            let mask = &stage.targets.mask_view;
            let load = wgpu::LoadOp::Load;
            let mut pass = fullscreen::pass(encoder, "shadow map lookup", mask, load, None);
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &stage.uniform.bind_group, &[]);
            pass.set_bind_group(1, &self.inputs, &[]);
            pass.draw(0..3, 0..1);
            1
        });
    }
}
