//! What a frame promises to a method: stages on both clocks, commands in order whoever recorded them, answers within
//! the frame and frames later, and state that ends where a sequence of frames does.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use std::collections::VecDeque;
use std::time::Duration;
use svbench::frame::fullscreen::{self, FullscreenDesc, bind_group};
use svbench::frame::targets::COLOUR_FORMAT;
use svbench::frame::{
    DepthSetup, Frame, FrameResources, GBUFFER_STAGE, PreparedMethod, RESOLVE_STAGE, SHADE_STAGE,
    StencilResolve,
};
use svbench::gpu::native::{
    BindingKind, Bindings, CountIn, IndirectDraws, Pipeline, PipelineDesc, PrimitiveTopology,
    Raster, Target, VertexInput,
};
use svbench::gpu::{FrameRecorder, FrameTimer, FrameTimes, Gpu, Ticket, readback, shader};
use svbench::scene::{Light, Moment};

const SIZE_PX: (u32, u32) = (96, 64);
const PIXELS: usize = (SIZE_PX.0 * SIZE_PX.1) as usize;

fn resources(gpu: &Gpu) -> FrameResources {
    let triangle = [Vec3::ZERO, Vec3::X, Vec3::Z].map(|corner| corner + Vec3::Y);
    let light = Vec4::new(1.0, 9.0, 2.0, 1.0);
    let scene = scene_over_ground(&[triangle], 0.0, light, &view());
    let resources = FrameResources::new(gpu, &scene, SIZE_PX.0, SIZE_PX.1).unwrap();
    let light = Light::at(light);
    resources.set_view(
        gpu,
        &Moment {
            view: view(),
            light,
        },
    );
    resources
}

/// Draws a frame that follows the one before, and gives its mask.
fn next_mask(gpu: &Gpu, resources: &FrameResources, method: &mut dyn PreparedMethod) -> Vec<u8> {
    resources.draw_next_mask(gpu, method).unwrap()
}

/// The times of so many frames.
fn times(
    gpu: &Gpu,
    resources: &FrameResources,
    method: &mut dyn PreparedMethod,
    frames: usize,
) -> Vec<FrameTimes> {
    let mut timer = FrameTimer::new(gpu);
    let mut done = Vec::new();
    for _ in 0..frames {
        let frame = timer.frame(gpu, |recorder| resources.record(recorder, method));
        done.extend(frame.unwrap());
    }
    done.extend(timer.finish(gpu).unwrap());
    done
}

fn triangle_ids(gpu: &Gpu, resources: &FrameResources) -> Vec<u32> {
    let bytes = readback::read_texture(gpu, &resources.targets.triangle_ids).unwrap();
    bytemuck::pod_collect_to_vec(&bytes)
}

/// Adds nothing.
struct NoShadows;

impl PreparedMethod for NoShadows {
    fn record(&mut self, _: &mut Frame<'_>) -> anyhow::Result<()> {
        Ok(())
    }
}

/// Works for 5 ms on the processor, and writes the mask.
struct OnProcessor;

const WORK: Duration = Duration::from_millis(5);

fn stripes() -> Vec<u8> {
    (0..PIXELS).map(|i| ((i / 7) % 3) as u8 * 100).collect()
}

impl PreparedMethod for OnProcessor {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let mask = &frame.targets().mask;
        frame.stage("think", |stage| {
            let stripes = stage.on_processor(|| {
                std::thread::sleep(WORK);
                stripes()
            });
            stage.upload_texture(mask, &stripes)
        })
    }
}

#[test]
fn a_method_on_the_processor_is_timed_by_its_clock() {
    let gpu = device();
    let resources = resources(&gpu);
    assert_eq!(next_mask(&gpu, &resources, &mut OnProcessor), stripes());
    for times in times(&gpu, &resources, &mut OnProcessor, 6) {
        let names: Vec<_> = times.stages.iter().map(|stage| stage.name).collect();
        assert_eq!(names, [GBUFFER_STAGE, "think", SHADE_STAGE]);
        let think = times.stages[1];
        assert!((5.0..25.0).contains(&think.processor_ms), "{think:?}");
        assert!(think.device_ms > 0.0, "the copy into the mask: {think:?}");
        // The device's work comes after the processor's: nothing overlaps.
        let sum = |time: fn(&svbench::gpu::StageTime) -> f64| -> f64 {
            times.stages.iter().map(time).sum()
        };
        let both = sum(|stage| stage.device_ms) + sum(|stage| stage.processor_ms);
        assert!((times.frame_ms() - both).abs() < 1e-9, "{times:?}");
        assert!(
            (times.stage_ms("think") - think.device_ms - think.processor_ms).abs() < 1e-9,
            "{times:?}"
        );
        assert!(
            times.record_ms < 5.0,
            "the work is not recording: {times:?}"
        );
    }
}

/// Reads the ids of what is visible within the frame.
struct ReadsIds;

impl PreparedMethod for ReadsIds {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let targets = frame.targets();
        let [ids] = frame.stage("ids", |stage| stage.read_now([&targets.triangle_ids]))?;
        frame.stage("answer", |stage| {
            let mask: Vec<_> = stage.on_processor(|| {
                std::thread::sleep(WORK);
                let ids = ids.chunks_exact(4);
                ids.map(|id| 40 * id[0]).collect()
            });
            stage.upload_texture(&targets.mask, &mask)
        })
    }
}

#[test]
fn ids_are_read_within_the_frame_and_waiting_is_on_no_clock() {
    let gpu = device();
    let resources = resources(&gpu);
    let mask = next_mask(&gpu, &resources, &mut ReadsIds);
    let ids = triangle_ids(&gpu, &resources);
    assert!(ids.contains(&0) && ids.contains(&1) && ids.contains(&2));
    let expected: Vec<_> = ids.iter().map(|id| 40 * *id as u8).collect();
    assert_eq!(mask, expected);
    for times in times(&gpu, &resources, &mut ReadsIds, 5) {
        let [gbuffer, ids, answer, shade] = times.stages[..] else {
            panic!("four stages: {times:?}")
        };
        assert!(times.wait_ms > 0.0, "{times:?}");
        assert!(gbuffer.device_ms > 0.0 && ids.device_ms > 0.0, "{times:?}");
        assert!(answer.processor_ms >= 5.0, "{times:?}");
        // While the processor thinks, the device has nothing to do, and its clock does not run.
        assert!(answer.device_ms + shade.device_ms < 5.0, "{times:?}");
        assert!(times.stage_ms("answer") >= 5.0, "{times:?}");
    }
}

/// Finds one half of the picture by a compute pass, left and right in turns, and counts it by native draws whose
/// numbers and corners the compute pass has written.
struct ComputeThenDraw {
    find: wgpu::ComputePipeline,
    buffers: wgpu::BindGroup,
    frame_number: wgpu::Buffer,
    target: Target,
    bindings: Bindings,
    draws: IndirectDraws,
    pipeline: Pipeline,
    resolve: StencilResolve,
}

impl ComputeThenDraw {
    fn new(gpu: &Gpu, resources: &FrameResources) -> Self {
        let device = &gpu.device;
        let buffer = |bytes: usize, usage| {
            let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | usage;
            gpu.buffer("a test", &vec![0; bytes], usage).unwrap()
        };
        let corners = buffer(6 * 16, wgpu::BufferUsages::empty());
        let draw = buffer(16, wgpu::BufferUsages::INDIRECT);
        let frame_number = buffer(4, wgpu::BufferUsages::empty());
        let find = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &shader::wgsl(device, "tests/contract.wgsl"),
            entry_point: Some("find_half"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let buffers = bind_group(
            device,
            &find.get_bind_group_layout(0),
            &[
                corners.as_entire_binding(),
                draw.as_entire_binding(),
                frame_number.as_entire_binding(),
            ],
        );
        let depth = DepthSetup::default();
        let target = Target::new(
            device,
            &resources.targets.depth,
            CountIn::Stencil,
            depth.direction,
        )
        .unwrap();
        let bindings = Bindings::new(device, &target, &[(BindingKind::Storage, &corners)]).unwrap();
        let desc = PipelineDesc {
            stages: &[shader::glsl("tests/contract.vert", &[])],
            input: VertexInput::Numbers,
            topology: PrimitiveTopology::Triangles,
            raster: Raster::CountAll,
            push_back_px: 0.0,
        };
        Self {
            pipeline: Pipeline::new(device, &target, &bindings, &desc).unwrap(),
            draws: IndirectDraws::new(device, &draw).unwrap(),
            resolve: StencilResolve::new(gpu, depth),
            find,
            buffers,
            frame_number,
            target,
            bindings,
        }
    }
}

impl PreparedMethod for ComputeThenDraw {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        frame.stage("find", |stage| {
            let mut pass = stage
                .encoder()
                .begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.find);
            pass.set_bind_group(0, &self.buffers, &[]);
            pass.dispatch_workgroups(1, 1, 1);
        });
        frame.stage("volumes", |stage| {
            stage.native(&self.target, &self.bindings, |pass| {
                pass.set_pipeline(&self.pipeline);
                pass.draw_indirect(&self.draws, 0);
            });
        });
        self.resolve.record(frame, RESOLVE_STAGE, 0, 256);
        Ok(())
    }
}

#[test]
fn native_draws_see_what_compute_passes_and_uploads_wrote() {
    let gpu = device();
    let resources = resources(&gpu);
    let dark = next_mask(&gpu, &resources, &mut NoShadows);
    let ids = triangle_ids(&gpu, &resources);
    let mut method = ComputeThenDraw::new(&gpu, &resources);
    let expected = |is_left: bool| -> Vec<u8> {
        let in_half = |i: usize| (i as u32 % SIZE_PX.0 < SIZE_PX.0 / 2) == is_left;
        let shadow = (0..PIXELS).map(|i| u8::from(ids[i] > 0 && in_half(i)) * 255);
        shadow
            .zip(&dark)
            .map(|(mask, dark)| mask.max(*dark))
            .collect()
    };
    for frame in 0..8 {
        let mask = next_mask(&gpu, &resources, &mut method);
        assert!(mask == expected(frame % 2 == 0), "frame {frame}");
    }
    // The same frames without anybody between them who waits: the last mask is that of the last frame.
    let times = times(&gpu, &resources, &mut method, 7);
    assert!(times.iter().all(|times| times.stages.len() == 5));
    let mask = readback::read_texture(&gpu, &resources.targets.mask).unwrap();
    assert!(mask == expected(true), "after seven frames more");
    // An upload within the frame comes before the compute pass that reads it: the right half again and again.
    struct Restarts(ComputeThenDraw);
    impl PreparedMethod for Restarts {
        fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
            frame.stage("restart", |stage| {
                stage.upload(&self.0.frame_number, 0, &1_u32.to_le_bytes())
            })?;
            self.0.record(frame)
        }
    }
    let mut restarts = Restarts(method);
    for frame in 0..3 {
        let mask = next_mask(&gpu, &resources, &mut restarts);
        assert!(mask == expected(false), "restarted frame {frame}");
    }
}

/// Asks in every frame whether anything was drawn, which is so in every other one, and darkens all of the picture
/// where the answer of three frames ago says so.
struct AsksLater {
    queries: wgpu::QuerySet,
    pipeline: wgpu::RenderPipeline,
    frame: u32,
    asked: VecDeque<Ticket>,
    /// What was answered.
    answers: Vec<bool>,
}

impl AsksLater {
    fn new(gpu: &Gpu) -> Self {
        let module = shader::wgsl(&gpu.device, "tests/contract.wgsl");
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor::default());
        let desc = FullscreenDesc::new(&module, "plain", &layout, COLOUR_FORMAT);
        Self {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Occlusion,
                count: 1,
            }),
            pipeline: fullscreen::pipeline(&gpu.device, &desc),
            frame: 0,
            asked: VecDeque::new(),
            answers: Vec::new(),
        }
    }

    fn ask(&mut self, frame: &mut Frame<'_>) {
        let view = &frame.targets().colour_view;
        let draws = self.frame.is_multiple_of(2);
        self.frame += 1;
        let ticket = frame.stage("query", |stage| {
            let mut pass = stage
                .encoder()
                .begin_render_pass(&wgpu::RenderPassDescriptor {
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations::default(),
                    })],
                    occlusion_query_set: Some(&self.queries),
                    ..Default::default()
                });
            pass.set_pipeline(&self.pipeline);
            pass.begin_occlusion_query(0);
            if draws {
                pass.draw(0..3, 0..1);
            }
            pass.end_occlusion_query();
            drop(pass);
            stage.read_queries(&self.queries, 0..1)
        });
        self.asked.push_back(ticket);
    }
}

impl PreparedMethod for AsksLater {
    fn begin(&mut self) {
        self.frame = 0;
        self.asked.clear();
        self.answers.clear();
    }

    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        if self.asked.len() == 3 {
            let answer = self.asked[0].poll(frame.gpu())?;
            self.asked.pop_front();
            let answer = answer.ok_or_else(|| anyhow::anyhow!("no answer after three frames"))?;
            let is_dark = answer != [0; 8];
            self.answers.push(is_dark);
            if is_dark {
                let mask = &frame.targets().mask;
                frame.stage("answer", |stage| stage.upload_texture(mask, &[255; PIXELS]))?;
            }
        }
        self.ask(frame);
        Ok(())
    }
}

#[test]
fn a_query_answers_three_frames_later_and_begin_forgets_it() {
    let gpu = device();
    let resources = resources(&gpu);
    let lit = next_mask(&gpu, &resources, &mut NoShadows);
    let mut method = AsksLater::new(&gpu);
    // Frames 0, 2, 4 draw: frames 3, 5, 7 know it.
    for round in 0..2 {
        method.begin();
        for frame in 0..8 {
            let mask = next_mask(&gpu, &resources, &mut method);
            match frame {
                3 | 5 | 7 => assert!(mask == [255; PIXELS], "{round}: frame {frame}"),
                _ => assert!(mask == lit, "{round}: frame {frame}"),
            }
        }
    }
    // With frames in flight, and nobody who waits for them.
    method.begin();
    times(&gpu, &resources, &mut method, 9);
    assert_eq!(method.answers, [true, false, true, false, true, false]);
}

#[test]
fn a_ticket_of_a_frame_that_was_never_submitted_says_so() {
    let gpu = device();
    let resources = resources(&gpu);
    let mut ticket = {
        let mut frame = FrameRecorder::untimed(&gpu);
        let buffer = &resources.scene.positions;
        frame.stage("lost", |stage| stage.read_back(buffer, 0..16))
    };
    let error = ticket.poll(&gpu).unwrap_err().to_string();
    assert!(error.contains("was not submitted"), "{error}");
}
