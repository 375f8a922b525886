//! A shadow map: the casters' depth seen from the light in one perspective (or, for a light at
//! infinity, parallel) view, looked up once a pixel (Williams 1978; in Milet et al. 2014 the
//! method that silhouettes are compared with in table 3).

use super::depth_map::{self, DepthMap, MapKind, MapParameters};
use super::frustum::{CasterVertices, LightFrustum};
use super::light_depth::{self, LightView, Lookup, Rounding};
use super::{Bound, Limit, MethodError, MethodInfo, PrepareContext};
use crate::frame::fullscreen::bind_group;
use crate::frame::{Frame, PreparedMethod, Texels};
use crate::geometry::Bounds;
use crate::metrics::Label;
use anyhow::Context;
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
            text: "a light among the casters: whatever lies outside its widest frustum (150 degrees) is lit",
            with: &[],
            unless: &[],
            fails: &[],
            kinds: &[Label::Uncovered],
            at_most: Bound::All,
        }],
    ],
    clashes: &[],
    tolerated_share: depth_map::TOLERATED_SHARE,
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
    const RESOLUTION_WORDS: &'static str =
        "side of the square map in texels, up to the device's limit";

    fn prepare(
        context: &PrepareContext<'_>,
        map: &MapParameters,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let casters = CasterVertices::of(&context.scene.mesh);
        let light = context.scene.flight.at(0.0).light.place;
        let frustum = LightFrustum::around(&casters, light)
            .ok_or_else(|| MethodError::Unavailable(NOTHING_BEFORE_THE_LIGHT.to_owned()))?;
        let fit = Fit { light, frustum };
        Ok(Box::new(PreparedMap::new(context, map, casters, fit)?))
    }
}

const NOTHING_BEFORE_THE_LIGHT: &str = "no caster lies before the light in any one view";

/// The frustum of a light.
struct Fit {
    light: Vec4,
    frustum: LightFrustum,
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
    light_buffer: wgpu::Buffer,
    lookup: Lookup,
    casters: CasterVertices,
    fit: Fit,
    parameters: MapParameters,
}

impl PreparedMap {
    fn new(
        context: &PrepareContext<'_>,
        parameters: &MapParameters,
        casters: CasterVertices,
        fit: Fit,
    ) -> Result<Self, MethodError> {
        let gpu = context.gpu;
        let light = LookupLight::new(&fit.frustum, parameters, context.resources.extents.scene);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let light = gpu.buffer("a light", bytemuck::bytes_of(&light), usage)?;
        let map = light_depth::texture(gpu, parameters.resolution, 1)?
            .create_view(&wgpu::TextureViewDescriptor::default());
        let pipeline = light_depth::pipeline(gpu, parameters.slope_bias);
        let layout = pipeline.get_bind_group_layout(0);
        let dimension = wgpu::TextureViewDimension::D2;
        let shader = "methods/shadow_map/lookup.wgsl";
        Ok(Self {
            light: bind_group(&gpu.device, &layout, &[light.as_entire_binding()]),
            lookup: Lookup::new(context, shader, (&map, dimension), &light, parameters.pcf),
            light_buffer: light,
            map,
            pipeline,
            parameters: *parameters,
            casters,
            fit,
        })
    }
}

impl LookupLight {
    fn new(frustum: &LightFrustum, parameters: &MapParameters, scene: Bounds) -> Self {
        let rounding = Rounding::new(parameters.constant_bias, scene, frustum.origin);
        Self {
            view: LightView {
                view_projection: frustum.view_projection,
                origin: frustum.origin.extend(1.0),
            },
            step: frustum.step,
            rounding: rounding.for_shader(),
        }
    }
}

impl PreparedMap {
    /// Fits the frustum to a light that has moved.
    fn follow(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let light = frame.view().light.place;
        if self.fit.light == light {
            return Ok(());
        }
        let scene = frame.resources().extents.scene;
        frame.stage("fit", |stage| {
            let frustum = stage.on_processor(|| LightFrustum::around(&self.casters, light));
            let frustum = frustum.context(NOTHING_BEFORE_THE_LIGHT)?;
            let data = LookupLight::new(&frustum, &self.parameters, scene);
            self.fit = Fit { light, frustum };
            stage.upload(&self.light_buffer, 0, bytemuck::bytes_of(&data))
        })
    }
}

impl PreparedMethod for PreparedMap {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        self.follow(frame)?;
        let scene = frame.scene();
        frame.stage("map", |stage| {
            let how = (&self.pipeline, &self.light);
            light_depth::draw(stage, &self.map, how, scene, &scene.casters);
        });
        self.lookup.record(frame);
        Ok(())
    }

    fn texels(&self) -> Option<Texels<'_>> {
        let view_projection = self.fit.frustum.view_projection.as_dmat4();
        let origin = self.fit.frustum.origin.as_dvec3();
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
        if self.fit.frustum.covered >= 1.0 {
            return Vec::new();
        }
        vec![format!(
            "the light is among the casters: one map covers {:.0} % of their vertices, and what it \
             leaves out is lit",
            100.0 * self.fit.frustum.covered
        )]
    }
}
