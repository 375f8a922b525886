//! The facing decision is the same in Rust, in every native stage and in WGSL, bit for bit.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use glam::{Vec3, Vec4};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use svbench::geometry::Determinism;
use svbench::gpu::native::{
    BindingKind, Bindings, CountIn, NativePass, Pipeline, PipelineDesc, PrimitiveTopology, Raster,
    Target, VertexInput,
};
use svbench::gpu::{Capability, DepthDirection, Gpu, readback, shader};
use svbench::scene::mesh::canonical;
use wgpu::util::DeviceExt;

const CASES: usize = 1_000_000;

/// A triangle and a light, all canonical.
type Case = [Vec4; 4];

fn vector(random: &mut impl Rng, size: f32) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| random.random_range(-size..size)))
}

/// Random triangles, and every kind that could tell two implementations apart.
fn case(random: &mut impl Rng, kind: usize) -> Case {
    let size = 10f32.powi(random.random_range(-3..4));
    let mut p = [(); 3].map(|()| vector(random, size));
    let mut light = vector(random, 3.0 * size);
    let mut w = f32::from(random.random_range(0..8u8) > 0);
    let between =
        |random: &mut dyn Rng, a: Vec3, b: Vec3| a + (b - a) * random.random_range(-2.0..2.0);
    match kind {
        // Edge-on: the light in the plane of the triangle, but for rounding.
        1 | 2 => {
            let on_edge = between(random, p[0], p[1]);
            light = between(random, on_edge, p[2]);
            w = 1.0;
        }
        // Edge-on, a few steps of the last bit off.
        3 => {
            light = between(random, p[0], p[1]);
            light.x = f32::from_bits(light.x.to_bits().wrapping_add(random.random_range(0..4)));
            w = 1.0;
        }
        // Needles: a corner almost on another one.
        4 => p[1] = p[0] + vector(random, size * 1e-6),
        // Slivers: three corners almost in a line.
        5 => p[2] = between(random, p[0], p[1]) + vector(random, size * 1e-6),
        // Duplicates: of corners, and of the light.
        6 => p[random.random_range(0..3)] = p[random.random_range(0..3)],
        7 => light = p[random.random_range(0..3)],
        // Whole numbers: exact zeros and equal coordinates.
        8 => {
            p = [(); 3].map(|()| vector(random, 3.0).round());
            light = vector(random, 3.0).round();
        }
        // Huge: products that overflow.
        9 => {
            let scale = 10f32.powi(random.random_range(10..35));
            p = p.map(|p| p * scale);
            light *= scale;
        }
        // Tiny: down to the grid.
        10 => {
            let scale = 2f32.powi(random.random_range(-48..-10));
            p = p.map(|p| p / size * scale);
            light = light / size * scale;
        }
        // Huge and tiny in one.
        11 => {
            let mut scale = || 10f32.powi(random.random_range(-15..15));
            p = p.map(|p| p * Vec3::new(scale(), scale(), scale()));
        }
        _ => {}
    }
    [
        p[0].extend(0.0),
        p[1].extend(0.0),
        p[2].extend(0.0),
        light.extend(w),
    ]
    .map(|v| canonical(v.truncate()).extend(v.w))
}

fn cases() -> Vec<Case> {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    (0..CASES).map(|i| case(&mut random, i % 12)).collect()
}

fn expected(determinism: Determinism, case: &Case) -> i32 {
    let [a, b, c, light] = case;
    determinism.facing(a.truncate(), b.truncate(), c.truncate(), *light)
}

struct Buffers {
    cases: wgpu::Buffer,
    results: wgpu::Buffer,
    readable: wgpu::Buffer,
}

impl Buffers {
    fn new(gpu: &Gpu, cases: &[Case]) -> Self {
        let bytes = 4 * cases.len() as u64;
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: bytes,
                usage,
                mapped_at_creation: false,
            })
        };
        Self {
            cases: gpu
                .device
                .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: None,
                    contents: bytemuck::cast_slice(cases),
                    usage: wgpu::BufferUsages::STORAGE,
                }),
            results: buffer(
                wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
            ),
            readable: buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ),
        }
    }

    /// Submits `before` (fills the results with what no facing is), then `work`, and reads.
    fn results(&self, gpu: &Gpu, work: wgpu::CommandBuffer) -> Vec<i32> {
        let filler = vec![99i32; (self.results.size() / 4) as usize];
        gpu.queue
            .write_buffer(&self.results, 0, bytemuck::cast_slice(&filler));
        let mut copy = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        copy.copy_buffer_to_buffer(&self.results, 0, &self.readable, 0, self.readable.size());
        gpu.queue.submit([work]);
        gpu.wait_idle();
        gpu.queue.submit([copy.finish()]);
        bytemuck::pod_collect_to_vec(&readback::read_buffer(gpu, &self.readable).unwrap())
    }
}

fn native(
    gpu: &Gpu,
    buffers: &Buffers,
    shaders: &[&str],
    topology: PrimitiveTopology,
    determinism: Determinism,
) -> Vec<i32> {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: 8,
            height: 8,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Depth32FloatStencil8,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let target = Target::new(
        &gpu.device,
        &texture,
        CountIn::Stencil,
        DepthDirection::Reversed,
    )
    .unwrap();
    let bindings = Bindings::new(
        &gpu.device,
        &target,
        &[
            (BindingKind::Storage, &buffers.cases),
            (BindingKind::Storage, &buffers.results),
        ],
    )
    .unwrap();
    let paths = std::iter::once(&"methods/volumes/index.vert").chain(shaders);
    let stages: Vec<_> = paths
        .map(|path| shader::glsl(path, &[("DETERMINISM", determinism as u32)]))
        .collect();
    let desc = PipelineDesc {
        stages: &stages,
        input: VertexInput::Numbers,
        topology,
        raster: Raster::Discard,
        push_back_px: 0.0,
    };
    let pipeline = Pipeline::new(&gpu.device, &target, &bindings, &desc).unwrap();
    // A first pass of wgpu's brings the texture into the layout that native passes expect.
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view,
            depth_ops: Some(wgpu::Operations::default()),
            stencil_ops: Some(wgpu::Operations::default()),
        }),
        ..Default::default()
    }));
    gpu.queue.submit([encoder.finish()]);
    let (work, _) = NativePass::record(&gpu.device, &target, &bindings, |pass| {
        pass.set_pipeline(&pipeline);
        pass.draw(0..CASES as u32);
    });
    buffers.results(gpu, work)
}

fn wgsl(gpu: &Gpu, buffers: &Buffers) -> Vec<i32> {
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &shader::wgsl(&gpu.device, "tests/facing.wgsl"),
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
    let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: buffers.cases.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: buffers.results.as_entire_binding(),
            },
        ],
    });
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.dispatch_workgroups(1024, CASES.div_ceil(64 * 1024) as u32, 1);
    }
    buffers.results(gpu, encoder.finish())
}

/// The cases in which the device disagrees.
fn differences<'a>(
    determinism: Determinism,
    cases: &'a [Case],
    found: &[i32],
) -> Vec<(&'a Case, i32, i32)> {
    let rows = cases
        .iter()
        .zip(found)
        .map(|(case, &found)| (case, expected(determinism, case), found));
    rows.filter(|(_, expected, found)| expected != found)
        .collect()
}

#[test]
fn every_language_and_stage_decides_alike() {
    let gpu = device();
    let cases = cases();
    assert!(
        gpu.has(Capability::VertexStores),
        "this test writes buffers from geometry shaders"
    );
    let buffers = Buffers::new(&gpu, &cases);
    let stages: [(&str, &[&str], _); 2] = [
        (
            "geometry",
            &["tests/facing.geom"],
            PrimitiveTopology::Points,
        ),
        (
            "tessellation",
            &["tests/facing.tesc", "tests/facing.tese"],
            PrimitiveTopology::Patches(1),
        ),
    ];
    for determinism in [
        Determinism::ReferenceEdge,
        Determinism::ConsistentTriangle,
        Determinism::None,
    ] {
        let answers = [-1, 0, 1].map(|f| {
            let given = |case: &&Case| expected(determinism, case) == f;
            cases.iter().filter(given).count()
        });
        assert!(
            answers.iter().all(|&count| count > CASES / 20),
            "a one-sided test of {determinism:?}: {answers:?}"
        );
        for (name, shaders, topology) in stages {
            let found = native(&gpu, &buffers, shaders, topology, determinism);
            let wrong = differences(determinism, &cases, &found);
            assert!(
                wrong.is_empty(),
                "{name}, {determinism:?}: {} differ, first {:?}",
                wrong.len(),
                wrong.first()
            );
        }
    }
    let found = wgsl(&gpu, &buffers);
    let wrong = differences(Determinism::ReferenceEdge, &cases, &found);
    // A GPU's compiler may fuse WGSL's operations; Mesa's software driver does not.
    let allowed = if gpu.is_software() { 0 } else { CASES / 100 };
    assert!(
        wrong.len() <= allowed,
        "WGSL: {} differ, first {:?}",
        wrong.len(),
        wrong.first()
    );
}
