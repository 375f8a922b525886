//! An omnidirectional shadow map: the casters' depth seen from the light in six views, one for each face
//! of a cube (Greene 1986 for the projection), looked up once a pixel. For a light among the casters, where
//! Milet et al. 2014 had no shadow map to compare with.

use super::depth_map::{self, DepthMap, MapKind, MapParameters};
use super::frustum::NEAR_BY_FAR;
use super::light_depth::{self, LightView, Lookup, Rounding};
use super::{Bound, Limit, MethodError, MethodInfo, PrepareContext};
use crate::frame::fullscreen::bind_group;
use crate::frame::{Frame, FrameResources, PreparedMethod, SceneExtents, Texels};
use crate::geometry::Bounds;
use crate::metrics::Label;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Mat4, Vec3, Vec4};
use std::ops::Range;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "cube_shadow_map",
    title: "an omnidirectional shadow map of six faces",
    source: "Greene 1986, Williams 1978; beyond Milet et al. 2014, who had none",
    needs: &[],
    limits: &[
        depth_map::LIMITS,
        &[
            Limit::in_words("needs a light at a point"),
            Limit {
                text: "a light much farther away than the scene is large: the whole scene falls into a few texels, and \
                       its shadows are coarse or missing",
                with: &[],
                unless: &[],
                fails: &[("light_distance", 3.0)],
                kinds: &[Label::Staircase, Label::DetachedShadow],
                at_most: Bound::Share(0.5),
            },
        ],
    ],
    clashes: &[],
    tolerated_share: depth_map::TOLERATED_SHARE,
};

/// The map, in six views.
#[derive(Debug, Clone)]
pub(super) struct SixViews;

/// The method with its parameters.
pub(super) type CubeShadowMap = DepthMap<SixViews>;

impl MapKind for SixViews {
    fn info() -> &'static MethodInfo {
        &INFO
    }

    const RESOLUTION: u32 = 2048;
    const RESOLUTION_WORDS: &'static str =
        "side of each of the six faces in texels, up to the device's limit";

    fn prepare(
        context: &PrepareContext<'_>,
        map: &MapParameters,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let light = context.scene.flight.at(0.0).light.place;
        if light.w == 0.0 {
            return Err(MethodError::Unavailable(NO_POINT.to_owned()));
        }
        let cube = PreparedCube::new(context, map, light.truncate())?;
        Ok(Box::new(cube))
    }
}

const NO_POINT: &str =
    "needs a light at a point; this one is at infinity, or too far away to tell from it";

/// Twin of `Cube` in shaders/methods/cube_shadow_map/lookup.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct CubeData {
    right: [Vec4; 6],
    up: [Vec4; 6],
    forward: [Vec4; 6],
    light: Vec4,
    rounding: Vec4,
}

/// The axes of one face: x right, y up, and the direction that it looks in.
struct FaceAxes {
    right: Vec3,
    up: Vec3,
    forward: Vec3,
}

/// The faces, in the order of the map's layers.
fn faces() -> [FaceAxes; 6] {
    [
        (Vec3::X, Vec3::Y),
        (Vec3::NEG_X, Vec3::Y),
        (Vec3::Y, Vec3::Z),
        (Vec3::NEG_Y, Vec3::Z),
        (Vec3::Z, Vec3::Y),
        (Vec3::NEG_Z, Vec3::Y),
    ]
    .map(|(forward, up)| FaceAxes {
        right: forward.cross(up),
        up,
        forward,
    })
}

impl FaceAxes {
    /// To clip space of a view of 90 degrees, from places relative to the light; reversed infinite depth:
    /// z = near.
    fn view_projection(&self, near: f32) -> Mat4 {
        let rows = [
            self.right.extend(0.0),
            self.up.extend(0.0),
            Vec4::new(0.0, 0.0, 0.0, near),
            self.forward.extend(0.0),
        ];
        Mat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose()
    }

    /// Whether something in the box may be seen on this face from `light`. Errs to true.
    fn may_see(&self, bounds: Bounds, light: DVec3) -> bool {
        let [right, up, forward] = [self.right, self.up, self.forward].map(|axis| axis.as_dvec3());
        [right, -right, up, -up].into_iter().all(|side| {
            // What is seen lies on the positive side of all four planes through the light.
            let inward = forward + side;
            let (_, farthest) = bounds.range_along(inward);
            farthest >= inward.dot(light) - 1e-6 * light.abs().max_element()
        })
    }
}

/// One face of the map.
struct Face {
    layer: wgpu::TextureView,
    /// Holds a [`LightView`].
    buffer: wgpu::Buffer,
    light: wgpu::BindGroup,
    /// The casters that may be seen on it.
    objects: Vec<Range<u32>>,
}

/// The map of one scene.
struct PreparedCube {
    faces: Vec<Face>,
    cube: wgpu::Buffer,
    pipeline: wgpu::RenderPipeline,
    lookup: Lookup,
    light: Vec3,
    parameters: MapParameters,
}

/// What the shaders know of a light.
struct CubeLight {
    views: [LightView; 6],
    cube: CubeData,
}

impl CubeLight {
    fn new(light: Vec3, extents: &SceneExtents, parameters: &MapParameters) -> Self {
        let near = near_distance(extents.all_casters, light.as_dvec3());
        let rounding = Rounding::new(parameters.constant_bias, extents.scene, light);
        let axes = faces();
        Self {
            views: axes.each_ref().map(|axes| LightView {
                view_projection: axes.view_projection(near),
                origin: light.extend(1.0),
            }),
            cube: CubeData {
                right: axes.each_ref().map(|face| face.right.extend(0.0)),
                up: axes.each_ref().map(|face| face.up.extend(0.0)),
                forward: axes.each_ref().map(|face| face.forward.extend(0.0)),
                light: light.extend(near),
                rounding: rounding.for_shader(),
            },
        }
    }
}

/// The casters that a face may see of `light`.
fn objects_on(axes: &FaceAxes, light: Vec3, resources: &FrameResources) -> Vec<Range<u32>> {
    let casters = resources.scene.casters.iter();
    casters
        .zip(&resources.extents.casters)
        .filter(|(_, bounds)| axes.may_see(**bounds, light.as_dvec3()))
        .map(|(object, _)| object.clone())
        .collect()
}

impl PreparedCube {
    fn new(
        context: &PrepareContext<'_>,
        parameters: &MapParameters,
        light: Vec3,
    ) -> Result<Self, MethodError> {
        let (gpu, resources) = (context.gpu, context.resources);
        let data = CubeLight::new(light, &resources.extents, parameters);
        let uniform = |contents: &[u8]| {
            let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
            gpu.buffer("a light", contents, usage)
        };
        let pipeline = light_depth::pipeline(gpu, parameters.slope_bias);
        let layout = pipeline.get_bind_group_layout(0);
        let map = light_depth::texture(gpu, parameters.resolution, 6)?;
        let face = |((layer, axes), view): ((u32, &FaceAxes), &LightView)| {
            let buffer = uniform(bytemuck::bytes_of(view))?;
            Ok::<_, MethodError>(Face {
                layer: map.create_view(&wgpu::TextureViewDescriptor {
                    dimension: Some(wgpu::TextureViewDimension::D2),
                    base_array_layer: layer,
                    array_layer_count: Some(1),
                    ..Default::default()
                }),
                light: bind_group(&gpu.device, &layout, &[buffer.as_entire_binding()]),
                objects: objects_on(axes, light, resources),
                buffer,
            })
        };
        let axes = faces();
        let all = (0..).zip(&axes).zip(&data.views);
        let cube = uniform(bytemuck::bytes_of(&data.cube))?;
        let dimension = wgpu::TextureViewDimension::D2Array;
        let whole = map.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(dimension),
            ..Default::default()
        });
        let shader = "methods/cube_shadow_map/lookup.wgsl";
        Ok(Self {
            faces: all.map(face).collect::<Result<_, _>>()?,
            lookup: Lookup::new(context, shader, (&whole, dimension), &cube, parameters.pcf),
            cube,
            pipeline,
            light,
            parameters: *parameters,
        })
    }

    /// Turns the faces to a light that has moved.
    fn follow(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let light = frame.view().light.place;
        anyhow::ensure!(light.w != 0.0, NO_POINT);
        let light = light.truncate();
        if light == self.light {
            return Ok(());
        }
        let resources = frame.resources();
        frame.stage("fit", |stage| {
            self.light = light;
            let data = stage.on_processor(|| {
                for (face, axes) in self.faces.iter_mut().zip(&faces()) {
                    face.objects = objects_on(axes, light, resources);
                }
                CubeLight::new(light, &resources.extents, &self.parameters)
            });
            for (face, view) in self.faces.iter().zip(&data.views) {
                stage.upload(&face.buffer, 0, bytemuck::bytes_of(view))?;
            }
            stage.upload(&self.cube, 0, bytemuck::bytes_of(&data.cube))
        })
    }
}

/// Distance of the near plane of every face.
fn near_distance(casters: Bounds, light: DVec3) -> f32 {
    let corner = (casters.low - light)
        .abs()
        .max((casters.high - light).abs());
    let far = if casters.is_empty() {
        1.0
    } else {
        corner.length()
    };
    (far * NEAR_BY_FAR).max(f64::from(f32::MIN_POSITIVE)) as f32
}

impl PreparedMethod for PreparedCube {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        self.follow(frame)?;
        let scene = frame.scene();
        frame.stage("map", |stage| {
            for face in &self.faces {
                let how = (&self.pipeline, &face.light);
                light_depth::draw(stage, &face.layer, how, scene, &face.objects);
            }
        });
        self.lookup.record(frame);
        Ok(())
    }

    fn texels(&self) -> Option<Texels<'_>> {
        let axes = faces().map(|face| [face.right, face.up, face.forward].map(|a| a.as_dvec3()));
        let of = move |point: DVec3| {
            let from_light = point - self.light.as_dvec3();
            let along = |(_, axes): &(i64, [DVec3; 3])| axes[2].dot(from_light);
            let (layer, [right, up, forward]) = (0..)
                .zip(axes)
                .max_by(|a, b| along(a).total_cmp(&along(b)))?;
            let ndc = [right, up].map(|axis| axis.dot(from_light) / forward.dot(from_light));
            let side = self.parameters.resolution;
            Some(light_depth::texel_at(layer, ndc[0], ndc[1], side))
        };
        Some(Texels {
            of: Box::new(of),
            reach: self.parameters.pcf / 2,
        })
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        let drawn = self.faces.iter().map(|face| face.objects.len() as u64);
        vec![("objects_on_faces", drawn.sum())]
    }
}

#[cfg(test)]
#[path = "cube_shadow_map_tests.rs"]
mod tests;
