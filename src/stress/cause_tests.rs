use super::*;
use crate::reference::{Reference, ReferenceMask, ReferenceView, Verdict};
use crate::scene::Moment;
use crate::scene::mesh::canonical;

const FILE: &str = "title = \"T\"\nfamily = \"fan\"\nnumber = \"pages\"\nwhy = \"w\"\n";

fn error(text: &str) -> String {
    Cause::parse(text, "my/own.toml").unwrap_err().to_string()
}

fn truth(scene: &Scene) -> ReferenceMask {
    let (width, height) = (160, 120);
    let Moment { view, light } = scene.flight.at(0.0);
    let view = ReferenceView {
        width,
        height,
        view_projection: view.view_projection(width as f32 / height as f32),
    };
    let mesh = &scene.mesh;
    let reference = Reference::new(&mesh.positions, &mesh.triangles, |_| true).unwrap();
    let ids = reference.visible_ids(&view).unwrap();
    reference.trace(light, &view, &ids).unwrap()
}

#[test]
fn a_file_is_read_and_its_mistakes_are_placed() {
    let cause = Cause::parse(&format!("{FILE}values = [1, 2.0]"), "my/own.toml").unwrap();
    assert_eq!(
        (cause.id.as_str(), &cause.values[..]),
        ("own", &[1.0, 2.0][..])
    );
    assert!(cause.refusal(0.5).is_some() && cause.refusal(3.0).is_none());

    assert_eq!(
        error(&format!("{FILE}values = [1, 2.5]")),
        "my/own.toml:5:14: this family takes whole numbers from 1 to 10000, not 2.5"
    );
    assert!(error(&format!("{FILE}values = [-1]")).contains("not -1"));
    assert!(error(&format!("{FILE}values = [nan]")).contains("not NaN"));
    assert!(error(&format!("{FILE}values = [3, 2]")).contains(":5:14: the values must ascend"));
    assert!(error(&format!("{FILE}values = []")).contains("at least one value"));
    assert!(error(&format!("{FILE}values = [1]\ncolour = 1")).contains("unknown field `colour`"));
    let misspelt = FILE.replace("fan", "fans") + "values = [1]";
    assert!(
        error(&misspelt).contains("did you mean `fan`?"),
        "{}",
        error(&misspelt)
    );
}

#[test]
fn the_corpus_is_in_order_and_found_by_id() {
    let corpus = corpus();
    assert!(corpus.is_sorted_by_key(|cause| cause.id.clone()));
    assert_eq!(find_cause("fan").unwrap().id, "fan");
    assert_eq!(find_cause("no such cause"), None);
    for cause in corpus {
        let texts = [&cause.title, &cause.number, &cause.why];
        assert!(texts.iter().all(|text| !text.is_empty()), "{}", cause.id);
        let why = &cause.why;
        assert!(why.trim() == why && !why.contains("  "), "{why}");
    }
}

#[test]
fn every_value_makes_a_scene_that_can_be_drawn() {
    for cause in corpus() {
        for &value in &cause.values {
            let scene = cause.scene(value, 1);
            let name = format!("{}_{value}", cause.id);
            assert_eq!(scene.name, name);
            assert_eq!(scene, cause.scene(value, 1), "{name}");
            assert_eq!(scene.flight.camera.keys.len(), 1);
            assert_eq!(scene.flight.at(0.0).validate(), Ok(()), "{name}");
            let mesh = &scene.mesh;
            assert!(!mesh.triangles.is_empty(), "{name}");
            let is_canonical = |p: &glam::Vec3| p.is_finite() && canonical(*p) == *p;
            assert!(mesh.positions.iter().all(is_canonical), "{name}");
            assert_eq!(mesh.caster_object_count(), mesh.objects.len(), "{name}");
        }
    }
}

/// A picture that is all background, all light, all shadow or all doubt says nothing about a method.
#[test]
fn every_picture_has_something_to_get_wrong() {
    for cause in corpus() {
        for (i, &value) in cause.values.iter().enumerate() {
            let scene = cause.scene(value, 0);
            let mask = truth(&scene);
            let count = |verdict| mask.count(verdict);
            let (lit, shadowed) = (count(Verdict::Lit), count(Verdict::Shadowed));
            let pixels = 160 * 120;
            let what = format!("{}: {lit} lit, {shadowed} shadowed", scene.name);
            assert!(lit + shadowed >= pixels / 10, "{what}");
            if i == 0 {
                assert!(lit.min(shadowed) >= pixels / 80, "{what}");
            }
        }
    }
}
