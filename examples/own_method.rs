//! A method of one's own, outside of the crate: every object casts the shadow of the sphere around
//! it. All of svbench runs with it, for example
//! `cargo run --release --example own_method -- run examples/own_method.toml --out own_run`.

use svbench::frame::fullscreen::{buffer_binding, texture_binding};
use svbench::frame::{Frame, MaskPass, MaskShader, PreparedMethod};
use svbench::gpu::shader;
use svbench::methods::{Limit, MethodError, MethodInfo, PrepareContext, Registry, ShadowMethod};
use svbench::{bytemuck, glam, wgpu};

static INFO: MethodInfo = MethodInfo {
    id: "sphere_shadow",
    title: "the shadow of a sphere around each object",
    source: "an example of a method outside of the crate",
    needs: &[],
    limits: &[&[Limit::in_words(
        "exact for spheres that do not meet each other, and for nothing else",
    )]],
    clashes: &[],
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
        let spheres = on.resources.extents.casters.iter().map(|around| {
            let radius = 0.5 * self.scale * (around.high - around.low).max_element();
            (0.5 * (around.low + around.high)).extend(radius).as_vec4()
        });
        let spheres: Vec<glam::Vec4> = spheres.collect();
        let (contents, usage) = (bytemuck::cast_slice(&spheres), wgpu::BufferUsages::STORAGE);
        let spheres = on.gpu.buffer("the spheres", contents, usage)?;
        let depth = wgpu::BindingResource::TextureView(&on.resources.targets.depth_only_view);
        let storage = wgpu::BufferBindingType::Storage { read_only: true };
        let shader = MaskShader {
            module: &shader::wgsl_text(device, INFO.id, include_str!("own_method.wgsl")),
            fragment: "sphere_shadow",
            constants: &[],
            inputs: &[
                (texture_binding(wgpu::TextureSampleType::Depth), depth),
                (buffer_binding(storage), spheres.as_entire_binding()),
            ],
        };
        Ok(Box::new(Prepared(MaskPass::new(
            device,
            on.resources,
            &shader,
        ))))
    }
}

/// The method, ready for the frames of one scene.
struct Prepared(MaskPass);

impl PreparedMethod for Prepared {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let resources = frame.resources();
        frame.stage("spheres", |stage| self.0.record(stage, resources));
        Ok(())
    }
}

/// The methods of the program, and this one.
pub(crate) fn registry() -> Registry {
    Registry::builtin().with::<SphereShadow>()
}

#[allow(dead_code, reason = "the test of this example calls svbench itself")]
fn main() -> std::process::ExitCode {
    svbench::cli::main(&registry())
}
