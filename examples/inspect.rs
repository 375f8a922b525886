use glam::*;
use svbench::bench::Verifier;
use svbench::frame::Stage;
use svbench::gpu::{Gpu, GpuOptions, readback};
use svbench::methods::{PrepareContext, parameters::parse_method};
use svbench::metrics::{MaskComparison, PixelResult, Place};
use svbench::reference::{BoundaryProbe, Reference, ReferenceCache, ReferenceView};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let m = &a[1];
    let gpu = Gpu::open(&GpuOptions {
        adapter: None,
        validation: false,
    })
    .unwrap();
    let cache = ReferenceCache::open(None);
    for s in &a[2..] {
        let seed: u64 = s.parse().unwrap();
        let scene = svbench::stress::random::case(seed);
        let view = scene.camera.view_at(0.0);
        let stage = Stage::new(&gpu, &scene, 160, 120);
        let context = PrepareContext::new(&gpu, &scene, &stage);
        let v = Verifier::new(&gpu, &scene, &stage, &cache).unwrap();
        let truth = v.truth(&view).unwrap();
        let p = parse_method(m).unwrap().prepare(&context).unwrap();
        let mask = v.draw_mask(p.as_ref(), &truth).unwrap();
        let vp = stage.view().view_projection;
        let rv = ReferenceView {
            width: 160,
            height: 120,
            view_projection: vp,
        };
        let reference =
            Reference::new(&scene.mesh.positions, &scene.mesh.triangles, |_| true).unwrap();
        let probe = BoundaryProbe::new(&reference, scene.light, &rv, &truth.mask, 10).unwrap();
        let c = MaskComparison::new(&mask, &truth.mask, |x, y| probe.near_boundary(x, y)).unwrap();
        let ids: Vec<u32> = bytemuck::pod_collect_to_vec(&{
            let mut f = svbench::gpu::FrameRecorder::untimed(&gpu);
            stage.record_gbuffer(&mut f);
            f.submit();
            readback::read_texture(&gpu, &stage.targets.triangle_ids).unwrap()
        });
        for (i, r) in c.results().iter().enumerate() {
            let bad = matches!(
                r,
                PixelResult::FalseLit(Place::Artifact)
                    | PixelResult::FalseShadowed(Place::Artifact)
            );
            if !bad {
                continue;
            }
            let (x, y) = (i % 160, i / 160);
            let sten = readback::read_texture(&gpu, &stage.targets.mask).unwrap()[i];
            println!(
                "seed {seed} px {x},{y} {r:?} id {} mask {sten} near {} light {}",
                ids[i], view.near, scene.light
            );
            if ids[i] > 0 {
                let t = scene.mesh.corners(ids[i] as usize - 1);
                let px = t.map(|p| {
                    let c = vp.as_dmat4() * p.as_dvec3().extend(1.0);
                    (
                        vec2((c.x / c.w) as f32, (-c.y / c.w) as f32) * 0.5 + 0.5,
                        c.w,
                    )
                });
                let ctr = dvec2(x as f64 + 0.5, y as f64 + 0.5);
                let q = px.map(|(p, _)| dvec2(p.x as f64 * 160.0, p.y as f64 * 120.0));
                for k in 0..3 {
                    let (p0, p1) = (q[k], q[(k + 1) % 3]);
                    let d = (p1 - p0).perp_dot(ctr - p0) / (p1 - p0).length();
                    println!(
                        "   edge {k}: {:?} -> {:?} dist {d:.5} px, w {}",
                        p0, p1, px[k].1
                    );
                }
                let n = (t[1] - t[0])
                    .as_dvec3()
                    .cross((t[2] - t[0]).as_dvec3())
                    .normalize();
                let c0 = ((t[0] + t[1] + t[2]) / 3.0).as_dvec3();
                let l = (scene.light.truncate().as_dvec3() - c0 * scene.light.w as f64).normalize();
                let e = (view.eye.as_dvec3() - c0).normalize();
                println!("   n.l {:.6} n.e {:.6} corners {:?}", n.dot(l), n.dot(e), t);
            }
        }
        let base = m.split(",push_back").next().unwrap();
        for pb in [
            0.0,
            0.001,
            0.002,
            1.0 / 256.0,
            0.0059,
            1.0 / 128.0,
            1.0 / 64.0,
            1.0 / 16.0,
        ] {
            for cnt in ["z_fail", "z_pass"] {
                let p = parse_method(&format!("{base},push_back_px={pb},counting={cnt}"))
                    .unwrap()
                    .prepare(&context)
                    .unwrap();
                let mask = v.draw_mask(p.as_ref(), &truth).unwrap();
                let e = v.judge(&mask, &truth, p.as_ref()).unwrap().error;
                print!("  {cnt} {pb:.4}: {}+{};", e.artifact_px, e.boundary_px);
            }
        }
        println!();
    }
}
