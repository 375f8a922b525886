//! A shadow map: the casters' depth seen from the light in one perspective (or, for a light at
//! infinity, parallel) view, looked up once a pixel (Williams 1978; in Milet et al. 2014 the
//! method that silhouettes are compared with in table 3).

use super::depth_map::{self, DepthMap, MapKind, MapParameters};
use super::frustum::LightFrustum;
use super::light_depth::{self, LightView, Lookup, Rounding};
use super::{Bound, Limit, MethodError, MethodInfo, PrepareContext, PreparedMethod, Texels};
use crate::frame::FrameResources;
use crate::frame::fullscreen::bind_group;
use crate::gpu::FrameRecorder;
use crate::metrics::Label;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec4};

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
            fails: &[],
            kinds: &[Label::Uncovered],
            at_most: Bound::All,
        }],
    ],
    tolerated_share: depth_map::TOLERATED_SHARE,
    parameters: &[
        &[(
            "resolution",
            "8192",
            "side of the square map in texels, up to the device's limit",
        )],
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

    fn prepare(
        context: &PrepareContext<'_>,
        map: &MapParameters,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let scene = context.scene;
        let frustum = LightFrustum::around_casters(&scene.mesh, scene.flight.at(0.0).light.place)
            .ok_or_else(|| {
            MethodError::Unavailable("no caster lies before the light in any one view".to_owned())
        })?;
        Ok(Box::new(PreparedMap::new(context, map, frustum)?))
    }
}

/// Twin of `Light` in shaders/methods/shadow_map/lookup.wgsl; begins like the one in map.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct LookupLight {
    view: LightView,
    step: Vec4,
    rounding: Vec4,
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
        let scene = context.stage.extents.scene;
        let rounding = Rounding::new(parameters.constant_bias, scene, frustum.origin);
        let light = LookupLight {
            view: LightView {
                view_projection: frustum.view_projection,
                origin: frustum.origin.extend(1.0),
            },
            step: frustum.step,
            rounding: rounding.for_shader(),
        };
        let light = bytemuck::bytes_of(&light);
        let light = gpu.buffer("a light", light, wgpu::BufferUsages::UNIFORM)?;
        let map = light_depth::texture(gpu, parameters.resolution, 1)?
            .create_view(&wgpu::TextureViewDescriptor::default());
        let pipeline = light_depth::pipeline(gpu, parameters.slope_bias);
        let layout = pipeline.get_bind_group_layout(0);
        let dimension = wgpu::TextureViewDimension::D2;
        let shader = "methods/shadow_map/lookup.wgsl";
        Ok(Self {
            light: bind_group(&gpu.device, &layout, &[light.as_entire_binding()]),
            lookup: Lookup::new(context, shader, (&map, dimension), &light, parameters.pcf),
            map,
            pipeline,
            parameters: *parameters,
            frustum,
        })
    }
}

impl PreparedMethod for PreparedMap {
    fn record(&self, frame: &mut FrameRecorder<'_>, stage: &FrameResources) {
        frame.stage("map", |encoder| {
            let how = (&self.pipeline, &self.light);
            let casters = &stage.scene.casters;
            light_depth::draw(encoder, &self.map, how, &stage.scene, casters)
        });
        self.lookup.record(frame, stage);
    }

    fn texels(&self) -> Option<Texels<'_>> {
        let view_projection = self.frustum.view_projection.as_dmat4();
        let origin = self.frustum.origin.as_dvec3();
        let of = move |point: DVec3| {
            let clip = view_projection * (point - origin).extend(1.0);
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
