//! Whether a method draws the same shadow when the same scene is written another way.
//!
//! No truth is needed to see that two masks differ; it is asked only which of the differing pixels mean
//! something. Where the two pictures show different triangles (coincident ones, of which the order of
//! drawing decides), or where the truth itself cannot decide, a mask may go either way.

use super::{Change, Changed, Keeps};
use crate::frame::DepthSetup;
use crate::judge::{DeviceScene, Judge, NoPicture, PixelTruth, Verifier};
use crate::methods::ShadowMethod;
use crate::metrics::{Label, MaskComparison};
use crate::reference::{ReferenceCache, Verdict};
use crate::scene::{Mesh, Scene};
use rand::Rng;
use std::collections::{BTreeMap, BTreeSet};

/// Pixels of two masks of one scene, told in two ways.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct DifferingPixels {
    /// Those that differ.
    pub differing_px: u64,
    /// Of these, those that show the same triangle in both pictures, are not ambiguous in either, and are no
    /// seams of a method that declares them.
    pub decided_px: u64,
    /// Of these in turn, those farther than a pixel from the true shadow boundary in both pictures.
    pub beyond_boundary_px: u64,
    /// Column and row of the first that is decided, and of those the first beyond the boundary if any is.
    pub example: Option<(u32, u32)>,
}

/// What a change did to the mask of one method.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// The change.
    pub change: Change,
    /// The method, with the parameters that are not at their defaults.
    pub method: String,
    /// The pixels that differ, or why the method cannot draw one of the scenes.
    pub pixels: Result<DifferingPixels, NoPicture>,
}

impl Difference {
    /// Pixels that differ and may not.
    pub fn wrong_px(&self) -> u64 {
        let Ok(pixels) = &self.pixels else { return 0 };
        match self.change.keeps() {
            Keeps::EveryPixel => pixels.decided_px,
            Keeps::AllButBoundary => pixels.beyond_boundary_px,
        }
    }
}

/// What is true of a pixel before and after a change.
type PixelTruths = (PixelTruth, PixelTruth);

/// A mask, or why there is none.
type Mask = Result<Vec<u8>, NoPicture>;

/// A scene as it is told first, and the masks that methods draw of it.
pub struct Original<'a> {
    judge: &'a Judge,
    scene: &'a Scene,
    methods: &'a [Box<dyn ShadowMethod>],
    masks: Vec<Mask>,
}

/// Draws the first view of `scene` with every method, as it is and after every change that applies, and
/// compares the masks: one row for each change and method.
///
/// # Errors
/// When the device is lost, or the scene cannot be traced.
pub fn check(
    judge: &Judge,
    scene: &Scene,
    methods: &[Box<dyn ShadowMethod>],
    random: &mut impl Rng,
) -> anyhow::Result<Vec<Difference>> {
    let original = Original::draw(judge, scene, methods);
    let mut rows = Vec::new();
    for change in Change::ALL {
        let Some(changed) = change.apply(scene, random) else {
            continue;
        };
        let all = original.compare(&changed)?.into_iter().zip(methods);
        rows.extend(all.map(|(pixels, method)| Difference {
            change,
            method: method.name(),
            pixels,
        }));
    }
    Ok(rows)
}

impl<'a> Original<'a> {
    /// Draws the first view of `scene` with every method.
    pub fn draw(judge: &'a Judge, scene: &'a Scene, methods: &'a [Box<dyn ShadowMethod>]) -> Self {
        Self {
            judge,
            scene,
            methods,
            masks: judge.masks(scene, methods),
        }
    }

    /// What is different in the masks of `changed`, for each method; an error is the reason why a method
    /// cannot draw one of the scenes.
    ///
    /// # Errors
    /// When the device is lost, or a scene cannot be traced.
    pub fn compare(
        &self,
        changed: &Changed,
    ) -> anyhow::Result<Vec<Result<DifferingPixels, NoPicture>>> {
        let masks = self.judge.masks(&changed.scene, self.methods);
        let differing: Vec<Result<Vec<usize>, &NoPicture>> = self
            .masks
            .iter()
            .zip(&masks)
            .map(|(before, after)| Ok(differing(before.as_ref()?, after.as_ref()?)))
            .collect();
        // Methods mostly differ at the same pixels, and the truth of a large scene takes a while.
        let mut known: Vec<(DepthSetup, BTreeMap<usize, PixelTruths>)> = Vec::new();
        let mut rows = Vec::with_capacity(masks.len());
        for (pixels, method) in differing.iter().zip(self.methods) {
            let pixels = match pixels {
                Ok(pixels) => pixels,
                Err(reason) => {
                    rows.push(Err((*reason).clone()));
                    continue;
                }
            };
            let depth = method.depth_setup();
            let truths = match known.iter().position(|(setup, _)| *setup == depth) {
                Some(i) => &known[i].1,
                None => {
                    let alike = differing.iter().zip(self.methods);
                    let alike = alike.filter(|(_, method)| method.depth_setup() == depth);
                    let pixels: BTreeSet<usize> = alike
                        .flat_map(|(pixels, _)| pixels.iter().flatten().copied())
                        .collect();
                    known.push((depth, self.truths(changed, depth, &pixels)?));
                    &known[known.len() - 1].1
                }
            };
            let variant = method.variant();
            let mut limits = method.info().limits_of(&variant);
            let has_seams = limits.any(|limit| limit.kinds.contains(&Label::Seam));
            rows.push(Ok(self.count(changed, pixels, truths, has_seams)));
        }
        Ok(rows)
    }

    /// What is true of some pixels in both scenes.
    fn truths(
        &self,
        changed: &Changed,
        depth: DepthSetup,
        pixels: &BTreeSet<usize>,
    ) -> anyhow::Result<BTreeMap<usize, PixelTruths>> {
        if pixels.is_empty() {
            return Ok(BTreeMap::new());
        }
        let pixels: Vec<_> = pixels.iter().copied().collect();
        let before = look(self.judge, self.scene, depth, &pixels)?;
        let after = look(self.judge, &changed.scene, depth, &pixels)?;
        let both = before.into_iter().zip(after);
        Ok(pixels.into_iter().zip(both).collect())
    }

    /// Counts differing pixels by what they mean.
    fn count(
        &self,
        changed: &Changed,
        pixels: &[usize],
        truths: &BTreeMap<usize, PixelTruths>,
        has_seams: bool,
    ) -> DifferingPixels {
        let mut counts = DifferingPixels {
            differing_px: pixels.len() as u64,
            ..DifferingPixels::default()
        };
        let width = self.judge.size_px.0;
        let (mut decided, mut beyond) = (None, None);
        for pixel in pixels {
            let (before, after) = &truths[pixel];
            let origin = after.triangle.map(|t| changed.origins[t as usize]);
            let is_same = same_triangle(&self.scene.mesh, before.triangle, origin);
            let undecided =
                |p: &&PixelTruth| p.verdict == Verdict::Ambiguous || has_seams && p.at_seam;
            if !is_same || [before, after].iter().any(undecided) {
                continue;
            }
            let place = (*pixel as u32 % width, *pixel as u32 / width);
            counts.decided_px += 1;
            decided = decided.or(Some(place));
            if !at_boundary(before, after) {
                counts.beyond_boundary_px += 1;
                beyond = beyond.or(Some(place));
            }
        }
        counts.example = beyond.or(decided);
        counts
    }
}

/// Whether the true boundary passes near, or did so in between.
fn at_boundary(before: &PixelTruth, after: &PixelTruth) -> bool {
    before.at_boundary || after.at_boundary || before.verdict != after.verdict
}

/// The pixels that one mask has in shadow and the other has not.
fn differing(before: &[u8], after: &[u8]) -> Vec<usize> {
    let shadowed = MaskComparison::is_shadowed;
    let pixels = before.iter().zip(after).enumerate();
    let differs = |(_, (before, after)): &(_, (&u8, &u8))| shadowed(**before) != shadowed(**after);
    pixels.filter(differs).map(|(pixel, _)| pixel).collect()
}

/// What is true of some pixels of the first view of `scene`.
fn look(
    judge: &Judge,
    scene: &Scene,
    depth: DepthSetup,
    pixels: &[usize],
) -> anyhow::Result<Vec<PixelTruth>> {
    let gpu = judge.gpu()?;
    let stage = DeviceScene::new(&gpu, scene, judge.size_px)?.resources(depth)?;
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(&gpu, scene, &stage, &cache)?;
    let truth = verifier.truth(&scene.flight.at(0.0))?;
    verifier.look(&truth, pixels)
}

/// Whether two triangles are one, or have the same corners.
fn same_triangle(mesh: &Mesh, one: Option<u32>, other: Option<u32>) -> bool {
    let corners = |triangle: u32| -> BTreeSet<_> {
        let corners = mesh.corners(triangle as usize);
        corners
            .into_iter()
            .map(|p| p.to_array().map(f32::to_bits))
            .collect()
    };
    one == other || one.map(corners) == other.map(corners)
}
