//! A shadow map: the casters' depth seen from the light in one perspective (or, for a light at
//! infinity, parallel) view, looked up once a pixel (Williams 1978; in Milet et al. 2014 the
//! method that silhouettes are compared with in table 3).

use super::depth_map::{self, DepthMap, MapKind, MapParameters};
use super::frustum::LightFrustum;
use super::light_depth::{self, Lookup};
use super::{Limit, MethodError, MethodInfo, PrepareContext, PreparedMethod, Texels};
use crate::frame::Stage;
use crate::frame::fullscreen::bind_group;
use crate::gpu::FrameRecorder;
use crate::metrics::Label;
use glam::DVec3;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "shadow_map",
    title: "one perspective shadow map",
    source: "Williams 1978; Milet et al. 2014, table 3",
    needs: &[],
    limits: &[
        depth_map::LIMITS,
        &[Limit {
            text: "a light among the casters: what its widest frustum (150 degrees) leaves out is lit",
            with: &[],
            fails: &[
                ("light_in_mesh", 0.5),
                ("light_in_lantern", 0.6),
                ("light_near_face", 1.0),
                ("light_on_element", 1.0),
            ],
            kinds: &[Label::Uncovered],
            most_px: u64::MAX,
        }],
    ],
    tolerated_share: depth_map::TOLERATED_SHARE,
    parameters: &[
        &[
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
        ],
        depth_map::PARAMETERS,
    ],
};

/// The map, in one perspective or parallel view.
#[derive(Debug, Clone)]
pub(super) struct OneView;

/// The method with its parameters.
pub(super) type ShadowMap = DepthMap<OneView>;

impl MapKind for OneView {
    fn info() -> &'static MethodInfo {
        &INFO
    }

    const RESOLUTION: u32 = 8192;
    const CONSTANT_BIAS: i32 = 2;

    fn prepare(
        context: &PrepareContext<'_>,
        map: &MapParameters,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let scene = context.scene;
        let frustum = LightFrustum::around_casters(&scene.mesh, scene.light).ok_or_else(|| {
            MethodError::Unavailable("no caster lies before the light in any one view".to_owned())
        })?;
        Ok(Box::new(PreparedMap::new(context, map, frustum)?))
    }
}

/// The map of one scene.
struct PreparedMap {
    map: wgpu::TextureView,
    pipeline: wgpu::RenderPipeline,
    light: wgpu::BindGroup,
    lookup: Lookup,
    frustum: LightFrustum,
    parameters: MapParameters,
}

impl PreparedMap {
    fn new(
        context: &PrepareContext<'_>,
        parameters: &MapParameters,
        frustum: LightFrustum,
    ) -> Result<Self, MethodError> {
        let gpu = context.gpu;
        let matrix = bytemuck::bytes_of(&frustum.view_projection);
        let matrix = gpu.buffer("a light", matrix, wgpu::BufferUsages::UNIFORM)?;
        let map = light_depth::texture(gpu, parameters.resolution, 1)?
            .create_view(&wgpu::TextureViewDescriptor::default());
        let bias = wgpu::DepthBiasState {
            constant: parameters.constant_bias,
            slope_scale: parameters.slope_bias,
            clamp: 0.0,
        };
        let pipeline = light_depth::pipeline(gpu, wgpu::CompareFunction::Less, bias);
        let layout = pipeline.get_bind_group_layout(0);
        let dimension = wgpu::TextureViewDimension::D2;
        let shader = "methods/shadow_map/lookup.wgsl";
        Ok(Self {
            light: bind_group(&gpu.device, &layout, &[matrix.as_entire_binding()]),
            lookup: Lookup::new(context, shader, (&map, dimension), &matrix, parameters.pcf),
            map,
            pipeline,
            parameters: *parameters,
            frustum,
        })
    }
}

impl PreparedMethod for PreparedMap {
    fn record(&self, frame: &mut FrameRecorder<'_>, stage: &Stage) {
        frame.stage("map", |encoder| {
            let how = (&self.pipeline, &self.light);
            let casters = &stage.scene.casters;
            light_depth::draw(encoder, &self.map, 1.0, how, &stage.scene, casters)
        });
        self.lookup.record(frame, stage);
    }

    fn texels(&self) -> Option<Texels<'_>> {
        let view_projection = self.frustum.view_projection.as_dmat4();
        let of = move |point: DVec3| {
            let clip = view_projection * point.extend(1.0);
            let ndc = clip.truncate() / clip.w;
            let inside = clip.w > 0.0 && ndc.x.abs().max(ndc.y.abs()) < 1.0;
            inside.then(|| light_depth::texel_at(0, ndc.x, ndc.y, self.parameters.resolution))
        };
        Some(Texels {
            of: Box::new(of),
            reach: self.parameters.pcf / 2,
        })
    }

    fn warnings(&self) -> Vec<String> {
        if self.frustum.covered >= 1.0 {
            return Vec::new();
        }
        vec![format!(
            "the light is among the casters: one map covers {:.0} % of their vertices, and what it \
             leaves out is lit",
            100.0 * self.frustum.covered
        )]
    }
}
