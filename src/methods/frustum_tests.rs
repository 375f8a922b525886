use super::*;
use crate::scene::sphere_grid::SphereGrid;

fn clip(frustum: &LightFrustum, p: Vec3) -> Vec3 {
    let clip = frustum.view_projection * (p - frustum.origin).extend(1.0);
    clip.truncate() / clip.w
}

#[test]
fn every_caster_is_inside_and_the_rim_is_used() {
    let mesh = SphereGrid {
        rows: 3,
        columns: 4,
        slices: 8,
        shells: 1,
    }
    .mesh()
    .expect("valid grid");
    for light in [
        Vec4::new(3.0, 40.0, 5.0, 1.0),
        Vec4::new(0.3, 1.0, 0.2, 0.0),
    ] {
        let frustum = LightFrustum::around(&CasterVertices::of(&mesh), light).expect("covers");
        assert_eq!(frustum.covered, 1.0);
        let casters = mesh
            .casters()
            .flat_map(|o| &mesh.positions[o.vertex_range()]);
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for p in casters {
            let ndc = clip(&frustum, *p);
            low = low.min(ndc);
            high = high.max(ndc);
        }
        assert!(low.cmpge(Vec3::new(-1.0, -1.0, 0.0)).all(), "{low}");
        assert!(high.cmple(Vec3::ONE).all(), "{high}");
        assert!((high - low).truncate().min_element() > 1.99, "{low} {high}");
    }
}

#[test]
fn a_light_among_the_casters_covers_a_part() {
    let mesh = SphereGrid {
        rows: 10,
        columns: 10,
        slices: 8,
        shells: 1,
    }
    .mesh()
    .expect("valid grid");
    let light = Vec4::new(0.0, 3.0, 0.0, 1.0);
    let frustum = LightFrustum::around(&CasterVertices::of(&mesh), light).expect("covers some");
    assert!(
        frustum.covered > 0.1 && frustum.covered < 1.0,
        "{}",
        frustum.covered
    );
}
