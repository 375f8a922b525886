use super::super::Verdict;
use super::super::fixtures::of_verdicts;
use super::*;
use glam::{Mat4, Vec4};
use std::convert::Infallible;

const LIGHT: Light = Light::at(Vec4::ONE);
const VIEW: ReferenceView = ReferenceView {
    width: 2,
    height: 2,
    view_projection: Mat4::IDENTITY,
};
const IDS: [u32; 4] = [0, 1, 2, 3];

fn key() -> CacheKey {
    CacheKey::new("scene", LIGHT, &VIEW, &IDS)
}

fn mask() -> ReferenceMask {
    let verdicts = vec![
        Verdict::Background,
        Verdict::Lit,
        Verdict::Shadowed,
        Verdict::Ambiguous,
    ];
    of_verdicts(2, 2, verdicts)
}

/// Asks for the mask, and says whether it had to be traced.
fn ask(cache: &ReferenceCache) -> bool {
    let mut traced = false;
    let found = cache.get_or_trace(&key(), &VIEW, || {
        traced = true;
        Ok::<_, Infallible>(mask())
    });
    assert_eq!(found.unwrap(), mask());
    traced
}

#[test]
fn a_mask_is_traced_once() {
    let dir = tempfile::tempdir().unwrap();
    let cache = ReferenceCache::open(Some(dir.path().join("new")));
    assert!(ask(&cache));
    assert!(!ask(&cache));
    assert_eq!(
        std::fs::read_dir(dir.path().join("new")).unwrap().count(),
        1
    );
}

#[test]
fn a_damaged_file_is_traced_anew_and_replaced() {
    let dir = tempfile::tempdir().unwrap();
    let cache = ReferenceCache::open(Some(dir.path().into()));
    ask(&cache);
    let path = cache.path(&key()).unwrap();
    let whole = std::fs::read(&path).unwrap();
    for damage in [&whole[..whole.len() / 2], b"no picture", b""] {
        std::fs::write(&path, damage).unwrap();
        assert!(ask(&cache));
        assert!(!ask(&cache));
    }
    assert_eq!(std::fs::read(&path).unwrap(), whole);
}

#[test]
fn no_folder_or_one_that_cannot_be_made_is_no_error() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("file");
    std::fs::write(&file, "").unwrap();
    for dir in [None, Some(file.join("below"))] {
        let cache = ReferenceCache::open(dir);
        assert!(ask(&cache));
        assert!(ask(&cache));
    }
}

#[test]
fn all_that_a_mask_depends_on_is_in_its_key() {
    let view = ReferenceView { height: 3, ..VIEW };
    let moved = ReferenceView {
        view_projection: Mat4::from_scale(2.0 * glam::Vec3::ONE),
        ..VIEW
    };
    let ball = Light {
        radius: 0.1,
        ..LIGHT
    };
    let others = [
        CacheKey::new("scene2", LIGHT, &VIEW, &IDS),
        CacheKey::new("scene", Light::at(Vec4::X), &VIEW, &IDS),
        CacheKey::new("scene", ball, &VIEW, &IDS),
        CacheKey::new("scene", LIGHT, &view, &IDS),
        CacheKey::new("scene", LIGHT, &moved, &IDS),
        CacheKey::new("scene", LIGHT, &VIEW, &[0, 1, 2, 4]),
    ];
    assert!(others.iter().all(|other| *other != key()));
}

/// Of all pictures that fit, only the one that was written under this key is believed.
#[test]
fn a_file_of_other_verdicts_size_or_key_is_traced_anew() {
    let dir = tempfile::tempdir().unwrap();
    let cache = ReferenceCache::open(Some(dir.path().into()));
    ask(&cache);
    let path = cache.path(&key()).unwrap();
    let whole = std::fs::read(&path).unwrap();
    let lit = |width, height| {
        let verdicts = vec![Verdict::Lit; (width * height) as usize];
        of_verdicts(width, height, verdicts)
    };
    let other_key = CacheKey::new("other scene", LIGHT, &VIEW, &IDS);
    for (other, sealed_by) in [
        (lit(2, 2), other_key),
        (lit(1, 1), key()),
        (mask(), other_key),
    ] {
        write_png(&path, &sealed_by, &other).unwrap();
        assert!(ask(&cache));
        assert_eq!(std::fs::read(&path).unwrap(), whole);
    }
    // A picture that nobody sealed, as any program writes it.
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[0; 4]).unwrap();
    writer.finish().unwrap();
    std::fs::write(&path, bytes).unwrap();
    assert!(ask(&cache));
    assert!(!ask(&cache));
}

#[test]
fn a_damaged_file_that_says_it_is_huge_takes_no_memory() {
    let dir = tempfile::tempdir().unwrap();
    let cache = ReferenceCache::open(Some(dir.path().into()));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1 << 30, 1 << 30);
    encoder.set_color(png::ColorType::Grayscale);
    drop(encoder.write_header().unwrap());
    std::fs::write(cache.path(&key()).unwrap(), bytes).unwrap();
    assert!(ask(&cache));
    assert!(!ask(&cache));
}

fn keep(cache: &ReferenceCache, scene: &str) {
    let key = CacheKey::new(scene, LIGHT, &VIEW, &IDS);
    let kept = cache.get_or_trace(&key, &VIEW, || Ok::<_, Infallible>(mask()));
    assert_eq!(kept.unwrap(), mask());
}

fn age(cache: &ReferenceCache, scene: &str, age_s: u64) {
    let key = CacheKey::new(scene, LIGHT, &VIEW, &IDS);
    let file = File::options().append(true).open(cache.path(&key).unwrap());
    let then = SystemTime::now() - std::time::Duration::from_secs(age_s);
    file.unwrap().set_modified(then).unwrap();
}

#[test]
fn the_folder_stays_within_its_bound_and_what_is_used_stays() {
    let dir = tempfile::tempdir().unwrap();
    let open =
        |most_bytes| ReferenceCache::open(Some(dir.path().into())).with_most_bytes(most_bytes);
    let cache = open(u64::MAX);
    for (scene, age_s) in [("one", 300), ("two", 200), ("three", 100)] {
        keep(&cache, scene);
        age(&cache, scene, age_s);
    }
    let files = || std::fs::read_dir(dir.path()).unwrap().flatten();
    let bytes = files()
        .map(|file| file.metadata().unwrap().len())
        .max()
        .unwrap();
    // Read, not written anew: now the last used.
    keep(&cache, "one");
    assert_eq!(files().count(), 3);
    let cache = open(2 * bytes);
    keep(&cache, "four");
    let is_kept = |scene| {
        let key = CacheKey::new(scene, LIGHT, &VIEW, &IDS);
        cache.path(&key).unwrap().exists()
    };
    let kept = ["one", "two", "three", "four"].map(is_kept);
    assert_eq!(kept, [true, false, false, true]);
    // In one process too, which looks through the folder only once.
    for scene in ["five", "six", "seven"] {
        keep(&cache, scene);
        assert_eq!(files().count(), 2);
    }
    keep(&open(0), "eight");
    assert_eq!(files().count(), 0);
}

#[test]
fn several_caches_may_share_a_folder() {
    let dir = tempfile::tempdir().unwrap();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let cache = ReferenceCache::open(Some(dir.path().into())).with_most_bytes(500);
                for round in 0..50 {
                    keep(&cache, &format!("scene {}", round % 7));
                }
            });
        }
    });
    let unfinished = std::fs::read_dir(dir.path()).unwrap().flatten();
    let unfinished = unfinished.filter(|file| {
        file.file_name()
            .to_string_lossy()
            .starts_with(output::PARTIAL_PREFIX)
    });
    assert_eq!(unfinished.count(), 0);
}
