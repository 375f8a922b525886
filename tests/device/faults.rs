//! A cell cannot take the run down: methods that ask for too much, panic, sleep or fail, each beside methods that do
//! not.

use std::process::ExitCode;
use std::time::Duration;
use svbench::cli;
use svbench::frame::{Frame, PreparedMethod};
use svbench::methods::{MethodError, MethodInfo, PrepareContext, Registry, ShadowMethod};
use svbench::record::{Status, Summary};
use svbench::wgpu;

static INFO: MethodInfo = MethodInfo {
    id: "trouble",
    title: "a method that goes wrong",
    source: "tests",
    needs: &[],
    limits: &[],
    clashes: &[],
    tolerated_share: 1.0,
};

const TOO_LARGE: u32 = 1;
const PANICS_IN_PREPARE: u32 = 2;
const PANICS_IN_RECORD: u32 = 3;
const SLEEPS: u32 = 4;
const FAILS: u32 = 5;

svbench::parameters! {
    /// What goes wrong.
    pub struct Trouble {
        kind: u32 = 0, in 0..=5, "what goes wrong";
    }
}

impl ShadowMethod for Trouble {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn prepare(&self, on: &PrepareContext<'_>) -> Result<Box<dyn PreparedMethod>, MethodError> {
        if self.kind == PANICS_IN_PREPARE {
            panic!("on purpose, while it is prepared");
        }
        if self.kind == TOO_LARGE {
            let _ = on.gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("too large"),
                size: wgpu::Extent3d {
                    width: 1 << 20,
                    height: 1,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::R8Unorm,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
        }
        Ok(Box::new(Prepared {
            kind: self.kind,
            frames: 0,
        }))
    }
}

struct Prepared {
    kind: u32,
    frames: u32,
}

impl PreparedMethod for Prepared {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        self.frames += 1;
        // One frame is verified, and one warms up.
        if self.frames > 3 {
            match self.kind {
                PANICS_IN_RECORD => panic!("on purpose, in frame {}", self.frames),
                SLEEPS => std::thread::sleep(Duration::from_millis(6_300)),
                FAILS => anyhow::bail!("nothing to draw"),
                _ => {}
            }
        }
        frame.stage("nothing", |_| ());
        Ok(())
    }
}

#[test]
fn each_failure_is_its_cells_reason_and_all_others_are_measured() {
    let registry = Registry::builtin().with::<Trouble>();
    let dir = tempfile::tempdir().unwrap();
    let config = dir.path().join("config.toml");
    let settings = "title = \"t\"\nsize = [64, 48]\nframes = 4\nwarmup_frames = 1\nverified_frames = 1\n\
        cell_timeout_s = 6\n[[scenes]]\nscene = \"sphere_grid\"\nslices = 8\n\
        [[methods]]\nid = \"trouble\"\nkind = [0, 1, 2, 3, 4, 5]\n\
        [[methods]]\nid = \"silhouette_gs\"\n[[methods]]\nid = \"shadow_map\"\nresolution = 256\n";
    std::fs::write(&config, settings).unwrap();
    let out = dir.path().join("run");
    let line = ["svbench", "run", config.to_str().unwrap(), "--out"];
    let line = line.into_iter().chain([out.to_str().unwrap()]);
    assert_eq!(cli::main_with(line, &registry), ExitCode::from(1));
    let mut table = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    let rows: Vec<Summary> = table.deserialize().map(Result::unwrap).collect();
    let of = |kind: u32| {
        let variant = format!("kind={kind}");
        let mut rows = rows.iter();
        rows.find(|row| row.method == "trouble" && row.variant.to_string() == variant)
            .unwrap()
    };
    for (kind, frames, reason) in [
        (TOO_LARGE, 0, "1048576"),
        (
            PANICS_IN_PREPARE,
            0,
            "it panicked: on purpose, while it is prepared (tests/device/faults.rs:",
        ),
        (PANICS_IN_RECORD, 1, "it panicked: on purpose, in frame 4"),
        (SLEEPS, 1, "longer than the 6 s that a cell has"),
        (FAILS, 1, "nothing to draw"),
    ] {
        let row = of(kind);
        assert_eq!(row.status, Status::Failed, "{kind}");
        assert!(row.reason.contains(reason), "{kind}: {}", row.reason);
        // What was still under way when it failed is not kept.
        assert!(row.frames <= frames, "{kind}: {}", row.frames);
    }
    let others = rows.iter().filter(|row| row.status == Status::Ok);
    let others: Vec<_> = others.map(|row| (&*row.method, row.frames)).collect();
    assert_eq!(
        others,
        [("trouble", 4), ("silhouette_gs", 4), ("shadow_map", 4)]
    );
}
