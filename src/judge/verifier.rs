//! Checking a method's mask against the ray-traced truth, in frames that nobody times.

use crate::frame::PreparedMethod;
use crate::frame::{FrameResources, FrameView};
use crate::gpu::{FrameRecorder, Gpu, readback};
use crate::memory;
use crate::metrics::{
    Analysis, Distances, EdgeDistances, Flicker, FrameContext, MaskComparison, MaskError,
    SEAM_STEPS, analyse, mean_flip,
};
use crate::reference::{
    BoundaryProbe, CacheKey, Motion, Reference, ReferenceCache, ReferenceMask, ReferenceView,
    Verdict,
};
use crate::scene::{Moment, Scene};
use anyhow::Context;
use rayon::prelude::*;
use std::rc::Rc;

/// What the processor needs for a pixel of a picture that is compared with the truth: numbers of triangles,
/// verdicts, distances to the edge, masks and pictures.
const TRUTH_BYTES_PER_PIXEL: u64 = 64;

/// Draws single frames of one scene on one stage and judges their masks.
pub struct Verifier<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    stage: &'a FrameResources,
    reference: Rc<Reference>,
    cache: &'a ReferenceCache,
}

/// What is true at one moment.
pub struct Truth {
    moment: Moment,
    view: ReferenceView,
    triangle_ids: Vec<u32>,
    /// The verdict of each pixel.
    pub mask: ReferenceMask,
    edges: EdgeDistances,
}

/// What is true of one pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelTruth {
    /// The triangle that it shows.
    pub triangle: Option<u32>,
    /// Whether that is in shadow there.
    pub verdict: Verdict,
    /// Whether the true shadow boundary passes within a pixel of its centre.
    pub at_boundary: bool,
    /// Whether an edge of the triangle passes it as near as at a [`crate::metrics::Label::Seam`].
    pub at_seam: bool,
}

/// How a method did at one view.
pub struct Judgement {
    /// Counts of wrong pixels.
    pub error: MaskError,
    /// How far they are from the true edge.
    pub distances: Distances,
    /// What kind of errors they are.
    pub analysis: Analysis,
    /// RGB, rows from the top: where they are.
    pub error_map: Vec<u8>,
}

impl<'a> Verifier<'a> {
    /// Prepares the reference of `scene`.
    ///
    /// # Errors
    /// When the scene has a triangle that cannot be traced.
    pub fn new(
        gpu: &'a Gpu,
        scene: &'a Scene,
        stage: &'a FrameResources,
        cache: &'a ReferenceCache,
    ) -> anyhow::Result<Self> {
        let mesh = &scene.mesh;
        let mut casts = vec![false; mesh.triangles.len()];
        for object in mesh.casters() {
            casts[object.triangle_range()].fill(true);
        }
        let reference = Reference::new(&mesh.positions, &mesh.triangles, |triangle| {
            casts[triangle as usize]
        })
        .with_context(|| format!("scene `{}` cannot be traced", scene.name))?;
        Ok(Self {
            gpu,
            scene,
            stage,
            reference: Rc::new(reference),
            cache,
        })
    }

    /// The same for frames that are drawn on another stage of the scene.
    pub fn on(&self, stage: &'a FrameResources) -> Self {
        Self {
            stage,
            reference: Rc::clone(&self.reference),
            ..*self
        }
    }

    /// The truth at `moment`, from the cache or traced.
    ///
    /// # Errors
    /// When the device is lost, memory is short, or there is no picture of that moment.
    pub fn truth(&self, moment: &Moment) -> anyhow::Result<Truth> {
        moment.validate()?;
        let (width, height) = (self.stage.targets.width, self.stage.targets.height);
        memory::check(TRUTH_BYTES_PER_PIXEL * u64::from(width) * u64::from(height))
            .with_context(|| format!("the truth of {width} × {height} pixels is too large"))?;
        let FrameView {
            view_projection, ..
        } = self.stage.set_view(self.gpu, moment);
        let ids = self.gpu.attempt(|| {
            let mut frame = FrameRecorder::untimed(self.gpu);
            self.stage.record_gbuffer(&mut frame);
            frame.submit();
            readback::read_texture(self.gpu, &self.stage.targets.triangle_ids)
        })?;
        let triangle_ids: Vec<u32> = bytemuck::pod_collect_to_vec(&ids);
        let view = ReferenceView {
            width,
            height,
            view_projection,
        };
        let light = moment.light;
        let key = CacheKey::new(&self.scene.mesh_hash, light, &view, &triangle_ids);
        let trace = || self.reference.trace(light, &view, &triangle_ids);
        let mask = self.cache.get_or_trace(&key, &view, trace)?;
        Ok(Truth {
            moment: *moment,
            edges: EdgeDistances::new(&mask),
            view,
            triangle_ids,
            mask,
        })
    }

    /// Draws the frame with `method` at the moment of `truth`, and returns the mask: 0 lit to 255 in shadow.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn draw_mask(
        &self,
        method: &mut dyn PreparedMethod,
        truth: &Truth,
    ) -> anyhow::Result<Vec<u8>> {
        self.stage.set_view(self.gpu, &truth.moment);
        self.stage.draw_mask(self.gpu, method)
    }

    /// RGBA of the frame drawn last.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn read_picture(&self) -> anyhow::Result<Vec<u8>> {
        readback::read_texture(self.gpu, &self.stage.targets.colour)
    }

    /// RGBA of the frame as it is with the true shadows; ambiguous pixels are lit, see [`Self::flip`].
    ///
    /// # Errors
    /// When the device is lost.
    pub fn true_picture(&self, truth: &Truth) -> anyhow::Result<Vec<u8>> {
        let gpu = self.gpu;
        self.stage.set_view(gpu, &truth.moment);
        let in_shadow = |verdict: Verdict| u8::from(verdict == Verdict::Shadowed) * u8::MAX;
        let mask: Vec<u8> = truth.mask.verdicts().map(in_shadow).collect();
        gpu.attempt(|| {
            let mut frame = FrameRecorder::untimed(gpu);
            self.stage.record_gbuffer(&mut frame);
            frame.submit();
            self.stage.targets.write_mask(gpu, &mask);
            let mut frame = FrameRecorder::untimed(gpu);
            self.stage.record_shade(&mut frame);
            frame.submit();
            self.read_picture()
        })
    }

    /// Compares a mask with the truth of the same view. `method`, which drew it, may know its shadow map's
    /// texels.
    ///
    /// # Errors
    /// When mask and truth differ in size.
    pub fn judge(
        &self,
        mask: &[u8],
        truth: &Truth,
        method: &dyn PreparedMethod,
    ) -> anyhow::Result<Judgement> {
        let light = truth.moment.light;
        let wrong_px = wrong_px(mask, &truth.mask);
        let probe = BoundaryProbe::new(&self.reference, light, &truth.view, &truth.mask, wrong_px)?;
        let comparison = MaskComparison::new(mask, &truth.mask, |x, y| probe.near_boundary(x, y))?;
        let texels = method.texels();
        let context = FrameContext {
            reference: &self.reference,
            light,
            view: &truth.view,
            triangle_ids: &truth.triangle_ids,
            edges: &truth.edges,
            texel: texels.as_ref().map(|texels| &*texels.of as _),
            texel_reach: texels.as_ref().map_or(0, |texels| texels.reach),
        };
        Ok(Judgement {
            error: comparison.error(),
            distances: comparison.distances(&truth.edges),
            analysis: analyse(&comparison, &context)?,
            error_map: comparison.error_map(),
        })
    }

    /// What is true of some pixels, which are counted by rows from the top.
    ///
    /// # Errors
    /// When the view is no perspective.
    pub fn look(&self, truth: &Truth, pixels: &[usize]) -> anyhow::Result<Vec<PixelTruth>> {
        let (reference, mask) = (&self.reference, &truth.mask);
        let probe = BoundaryProbe::new(
            reference,
            truth.moment.light,
            &truth.view,
            mask,
            pixels.len(),
        )?;
        let evidence = reference.evidence(truth.moment.light, &truth.view, &truth.triangle_ids)?;
        let look = |&pixel: &usize| PixelTruth {
            triangle: truth.triangle_ids[pixel].checked_sub(1),
            verdict: mask.verdict(pixel),
            at_boundary: probe.near_boundary(pixel as u32 % mask.width, pixel as u32 / mask.width),
            at_seam: evidence.at_inner_edge(pixel, SEAM_STEPS),
        };
        Ok(pixels.iter().map(look).collect())
    }

    /// The pixels of a mask that are wrong although the truth is the same all around their centre, counted by
    /// rows from the top: no tie excuses them, be they [ambiguous](Verdict::Ambiguous) or not.
    ///
    /// # Errors
    /// When the view is no perspective.
    pub fn hard_errors(&self, mask: &[u8], truth: &Truth) -> anyhow::Result<Vec<usize>> {
        let probe = self
            .reference
            .surroundings(truth.moment.light, &truth.view)?;
        let width = truth.mask.width;
        let is_hard = |pixel: &usize| {
            let is_shadowed = MaskComparison::is_shadowed(mask[*pixel]);
            let verdict = truth.mask.verdict(*pixel);
            let differs = |verdict| is_shadowed != (verdict == Verdict::Shadowed);
            (verdict == Verdict::Ambiguous || differs(verdict)) && {
                let (x, y) = (*pixel as u32 % width, *pixel as u32 / width);
                probe
                    .drawn(x, y, truth.triangle_ids[*pixel])
                    .is_some_and(differs)
                    && probe.unanimous(x, y).is_some_and(differs)
            }
        };
        let pixels = (0..mask.len()).into_par_iter();
        Ok(pixels.filter(is_hard).collect())
    }

    /// Where the surface points seen at one view appear at another.
    ///
    /// # Errors
    /// When a view is no perspective.
    pub fn motion(&self, from: &Truth, to: &Truth) -> anyhow::Result<Motion> {
        let from = (&from.view, &from.triangle_ids[..]);
        let to = (&to.view, &to.triangle_ids[..]);
        Ok(self.reference.follow(from, to)?)
    }

    /// Mean FLIP of a picture of the frame against the one with the true shadows, RGBA: 0 alike to 1.
    /// Ambiguous pixels are taken to be right.
    ///
    /// # Errors
    /// When they differ in size.
    pub fn flip(&self, truth: &Truth, true_picture: &[u8], picture: &[u8]) -> anyhow::Result<f64> {
        let mut expected = true_picture.to_vec();
        let pixels = expected.chunks_exact_mut(4).zip(picture.chunks_exact(4));
        for ((expected, found), verdict) in pixels.zip(truth.mask.verdicts()) {
            if verdict == Verdict::Ambiguous {
                expected.copy_from_slice(found);
            }
        }
        let size = [self.stage.targets.width, self.stage.targets.height];
        Ok(mean_flip(size, &expected, picture)?)
    }
}

/// Pixels that are wrong, wherever.
fn wrong_px(mask: &[u8], truth: &ReferenceMask) -> usize {
    let is_wrong = |(value, verdict): &(&u8, Verdict)| {
        MaskComparison::is_shadowed(**value) != (*verdict == Verdict::Shadowed)
    };
    mask.iter().zip(truth.verdicts()).filter(is_wrong).count()
}

/// Which errors of a method's masks come or go from one view to the next.
///
/// # Errors
/// When a mask and its truth differ in size.
pub(crate) fn flicker(
    motion: &Motion,
    (mask, truth): (&[u8], &Truth),
    (next_mask, next): (&[u8], &Truth),
) -> anyhow::Result<Flicker> {
    // How far an error is from the edge does not matter here.
    let before = MaskComparison::new(mask, &truth.mask, |_, _| true)?;
    let after = MaskComparison::new(next_mask, &next.mask, |_, _| true)?;
    Ok(Flicker::between(motion, &before, &after))
}
