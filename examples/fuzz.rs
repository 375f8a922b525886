use std::time::Instant;
use svbench::bench::Verifier;
use svbench::frame::Stage;
use svbench::gpu::{Gpu, GpuOptions};
use svbench::methods::{PrepareContext, parameters::parse_method};
use svbench::reference::ReferenceCache;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let from: u64 = a[1].parse().unwrap();
    let to: u64 = a[2].parse().unwrap();
    let methods: Vec<&str> = a[3..].iter().map(|s| s.as_str()).collect();
    let gpu = Gpu::open(&GpuOptions {
        adapter: None,
        validation: false,
    })
    .unwrap();
    let cache = ReferenceCache::open(None);
    let mut sums = vec![(0u64, 0u64, 0u64, 0u64); methods.len()];
    let mut t = [0f64; 5];
    for seed in from..to {
        let t0 = Instant::now();
        let scene = svbench::stress::random::case(seed);
        let view = scene.camera.view_at(0.0);
        let stage = Stage::new(&gpu, &scene, 160, 120);
        let context = PrepareContext::new(&gpu, &scene, &stage);
        let v = Verifier::new(&gpu, &scene, &stage, &cache).unwrap();
        t[0] += t0.elapsed().as_secs_f64();
        let t0 = Instant::now();
        let truth = match v.truth(&view) {
            Ok(t) => t,
            Err(e) => {
                println!("{seed}: {e:#}");
                continue;
            }
        };
        t[1] += t0.elapsed().as_secs_f64();
        for (i, m) in methods.iter().enumerate() {
            let t0 = Instant::now();
            let p = parse_method(m).unwrap().prepare(&context).unwrap();
            t[2] += t0.elapsed().as_secs_f64();
            let t0 = Instant::now();
            let mask = v.draw_mask(p.as_ref(), &truth).unwrap();
            t[3] += t0.elapsed().as_secs_f64();
            let t0 = Instant::now();
            let e = v.judge(&mask, &truth, p.as_ref()).unwrap().error;
            t[4] += t0.elapsed().as_secs_f64();
            sums[i].0 += u64::from(e.artifact_px > 0);
            sums[i].1 += e.artifact_px;
            sums[i].2 += e.boundary_px;
            sums[i].3 += e.ambiguous_px;
            if e.artifact_px > 0 {
                println!(
                    "{seed} {m}: {} art ({} lit {} shadowed), {} amb; tris {} light {} near {}",
                    e.artifact_px,
                    e.false_lit,
                    e.false_shadowed,
                    e.ambiguous_px,
                    scene.mesh.triangles.len(),
                    scene.light,
                    view.near
                );
            }
        }
    }
    for (m, s) in methods.iter().zip(&sums) {
        println!(
            "{m}: {} cases, {} artifact px, {} boundary, {} amb",
            s.0, s.1, s.2, s.3
        );
    }
    println!("{t:?}");
}
