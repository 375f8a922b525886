//! A method of one's own, outside of the crate: every object casts the shadow of the sphere around it. All of svbench
//! runs with it: `cargo run --release --example own_method -- run examples/own_method.toml`, or `-- list methods`.
use glam::Vec4;
use svbench::frame::fullscreen::{self, FullscreenDesc, bind_group, bind_group_layout};
use svbench::frame::{FrameResources, targets::MASK_FORMAT};
use svbench::gpu::{FrameRecorder, shader};
use svbench::methods::{
    Limit, MethodError, MethodInfo, PrepareContext, PreparedMethod, Registry, ShadowMethod,
};

static INFO: MethodInfo = MethodInfo {
    id: "sphere_shadow",
    title: "the shadow of a sphere around each object",
    source: "an example of a method outside of the crate",
    needs: &[],
    limits: &[&[Limit::in_words("right only for spheres, none in another")]],
    tolerated_share: 0.01,
};

svbench::parameters! {
    /// The method with its parameters: from this come `Default`, what a configuration may say, and what `list` prints.
    pub struct SphereShadow {
        scale: f64 = 1.0, in 0.1..=10.0, "radius of the spheres, times half the longest side of the object's box";
    }
}

impl ShadowMethod for SphereShadow {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn prepare(&self, on: &PrepareContext<'_>) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let device = &on.gpu.device;
        let spheres = on.stage.extents.casters.iter().map(|around| {
            let radius = 0.5 * self.scale * (around.high - around.low).max_element();
            (0.5 * (around.low + around.high)).extend(radius).as_vec4()
        });
        let spheres: Vec<Vec4> = spheres.collect();
        let usage = wgpu::BufferUsages::STORAGE;
        let spheres = on
            .gpu
            .buffer("the spheres", bytemuck::cast_slice(&spheres), usage)?;
        let depth = fullscreen::texture_binding(wgpu::TextureSampleType::Depth);
        let ty = wgpu::BufferBindingType::Storage { read_only: true };
        let storage = wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let inputs = bind_group_layout(
            device,
            "spheres",
            wgpu::ShaderStages::FRAGMENT,
            &[depth, storage],
        );
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            bind_group_layouts: &[Some(&on.stage.uniform.layout), Some(&inputs)],
            ..Default::default()
        });
        let module = shader::wgsl_text(device, INFO.id, include_str!("own_method.wgsl"));
        let pipeline = FullscreenDesc::new(&module, "sphere_shadow", &layout, MASK_FORMAT);
        let depth = wgpu::BindingResource::TextureView(&on.stage.targets.depth_only_view);
        Ok(Box::new(Prepared {
            pipeline: fullscreen::pipeline(device, &pipeline),
            inputs: bind_group(device, &inputs, &[depth, spheres.as_entire_binding()]),
        }))
    }
}

struct Prepared {
    pipeline: wgpu::RenderPipeline,
    inputs: wgpu::BindGroup,
}

impl PreparedMethod for Prepared {
    fn record(&self, frame: &mut FrameRecorder<'_>, stage: &FrameResources) {
        frame.stage("spheres", |encoder| {
            let (mask, load) = (&stage.targets.mask_view, wgpu::LoadOp::Load);
            let mut pass = fullscreen::pass(encoder, "spheres", mask, load, None);
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &stage.uniform.bind_group, &[]);
            pass.set_bind_group(1, &self.inputs, &[]);
            pass.draw(0..3, 0..1);
            1 // draw call
        });
    }
}

/// The methods of the program, and this one.
pub fn registry() -> Registry {
    Registry::builtin().with::<SphereShadow>()
}

#[allow(dead_code, reason = "the test of this example calls svbench itself")]
fn main() -> std::process::ExitCode {
    svbench::cli::main(&registry())
}
