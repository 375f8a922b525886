//! A real picture with its truth, to plant errors in: a sphere above a floor. For tests.

use glam::{DVec3, Vec3, Vec4};

use super::{Analysis, EdgeDistances, FrameContext, Label, MaskComparison, TexelLookup, analyse};
use crate::reference::fixtures::{Scene, sphere, square, view};
use crate::reference::{BoundaryProbe, EvidenceProbe, Reference, ReferenceMask, ReferenceView};
use crate::scene::Light;

pub(super) const WIDTH: usize = 320;
pub(super) const HEIGHT: usize = 240;
pub(super) const CENTRE: DVec3 = DVec3::new(0.0, 1.2, 0.0);
pub(super) const RADIUS: f64 = 0.8;
pub(super) const LIGHT: Vec4 = Vec4::new(2.0, 6.0, 1.0, 1.0);

/// A scene, seen and traced.
pub(super) struct Shot {
    pub(super) scene: Scene,
    pub(super) reference: Reference,
    pub(super) light: Light,
    pub(super) view: ReferenceView,
    pub(super) ids: Vec<u32>,
    pub(super) truth: ReferenceMask,
}

impl Shot {
    pub(super) fn new(scene: Scene, light: Vec4, eye: Vec3) -> Self {
        let view = view(eye, Vec3::new(0.0, 0.5, 0.0), WIDTH as u32, HEIGHT as u32);
        let (reference, light) = (scene.reference(), Light::at(light));
        let ids = reference.visible_ids(&view).unwrap();
        let truth = reference.trace(light, &view, &ids).unwrap();
        Self {
            scene,
            reference,
            light,
            view,
            ids,
            truth,
        }
    }

    pub(super) fn sphere(light: Vec4) -> Self {
        let scene = Scene::default()
            .cast(&sphere(CENTRE.as_vec3(), RADIUS as f32, 240))
            .receive(&square(8.0, 0.0));
        Self::new(scene, light, Vec3::new(2.0, 3.0, 4.0))
    }

    pub(super) fn probe(&self) -> EvidenceProbe<'_> {
        self.reference
            .evidence(self.light, &self.view, &self.ids)
            .unwrap()
    }

    pub(super) fn is_floor(&self, pixel: usize) -> bool {
        self.ids[pixel] > self.scene.casters
    }

    pub(super) fn compare(&self, mask: &[u8]) -> MaskComparison<'_> {
        let probe =
            BoundaryProbe::new(&self.reference, self.light, &self.view, &self.truth, 0).unwrap();
        MaskComparison::new(mask, &self.truth, |x, y| probe.near_boundary(x, y)).unwrap()
    }

    pub(super) fn analyse(&self, mask: &[u8], texel: Option<&TexelLookup<'_>>) -> Analysis {
        let context = FrameContext {
            reference: &self.reference,
            light: self.light,
            view: &self.view,
            triangle_ids: &self.ids,
            edges: &EdgeDistances::new(&self.truth),
            texel,
            texel_reach: 0,
        };
        analyse(&self.compare(mask), &context).unwrap()
    }

    /// The truth, wrong where `wrong` says so of column and row.
    pub(super) fn plant(&self, wrong: impl Fn(usize, usize) -> bool) -> Vec<u8> {
        let turned = |(pixel, grey): (usize, u8)| match wrong(pixel % WIDTH, pixel / WIDTH) {
            true => 255 - grey,
            false => grey,
        };
        self.truth
            .to_grey()
            .into_iter()
            .enumerate()
            .map(turned)
            .collect()
    }

    /// The label of all artifact pixels; fails if they have several.
    pub(super) fn only_label(&self, mask: &[u8]) -> Label {
        let analysis = self.analyse(mask, None);
        let label = analysis.regions[0].label;
        assert!(
            analysis.regions.iter().all(|region| region.label == label),
            "{:?}",
            analysis.label_counts().collect::<Vec<_>>()
        );
        label
    }
}
