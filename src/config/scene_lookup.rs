//! Finding a scene file: by path, or by the name of one that comes with the program.

use super::{ConfigError, ScenePlan};
use crate::scene::{ModelSearch, SceneFile};
use crate::toml_error::nearest;
use include_dir::{Dir, include_dir};
use std::path::Path;

static SCENES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes");

/// Names of the scenes that come with the program.
pub fn builtin_scenes() -> Vec<&'static str> {
    let stem = |path: &'static Path| path.file_stem()?.to_str();
    let is_scene = |path: &Path| {
        path.extension()
            .is_some_and(|extension| extension == "toml")
    };
    let mut names: Vec<_> = SCENES
        .files()
        .filter(|file| is_scene(file.path()))
        .filter_map(|file| stem(file.path()))
        .collect();
    names.sort_unstable();
    names
}

/// The scene called `name`: a path to a scene file (as given, or from `base`, the folder of the
/// configuration), else a scene that comes with the program.
///
/// # Errors
/// When there is none, or its file is wrong.
pub fn find_scene(name: impl AsRef<Path>, base: &Path) -> Result<ScenePlan, ConfigError> {
    let name = name.as_ref();
    let candidates = [name.to_owned(), base.join(name)];
    if let Some(path) = candidates.iter().find(|path| path.is_file()) {
        let file = SceneFile::read(path).map_err(|error| ConfigError(chain(&error)))?;
        return Ok(ScenePlan {
            file,
            search: ModelSearch::for_scene_file(path),
            size_px: None,
        });
    }
    // What comes with the program has plain names.
    let name = &*name.to_string_lossy();
    let path = Path::new("scenes").join(format!("{name}.toml"));
    let builtin = SCENES
        .get_file(format!("{name}.toml"))
        .and_then(|file| file.contents_utf8());
    let Some(text) = builtin else {
        let known = builtin_scenes();
        let hint = nearest(name, known.iter().copied())
            .map(|nearest| format!("; did you mean `{nearest}`?"))
            .unwrap_or_default();
        return Err(ConfigError(format!(
            "no scene file `{name}`, and no scene of that name comes with the program{hint} \
             (known: {})",
            known.join(", ")
        )));
    };
    let file = SceneFile::parse(text, &path.to_string_lossy())
        .map_err(|error| ConfigError(chain(&error)))?;
    Ok(ScenePlan {
        file,
        search: ModelSearch::for_scene_file(&path),
        size_px: None,
    })
}

/// The error with its causes, in one line.
pub(super) fn chain(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(error.source(), |cause| cause.source());
    causes.fold(error.to_string(), |text, cause| format!("{text}: {cause}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_of_the_program_is_valid() {
        let names = builtin_scenes();
        assert!(
            names.contains(&"sphere_grid") && names.contains(&"sponza"),
            "{names:?}"
        );
        for name in names {
            let plan = find_scene(name, Path::new("")).expect("a valid scene");
            assert_eq!(plan.file.name, name);
        }
    }

    #[test]
    fn a_misspelt_scene_gets_a_hint() {
        let error = find_scene("sponsa", Path::new(""))
            .err()
            .expect("no such scene")
            .to_string();
        assert!(error.contains("did you mean `sponza`"), "{error}");
    }
}
