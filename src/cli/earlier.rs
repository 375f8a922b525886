//! What an earlier `svbench minimise` left where this one would write.

use crate::config::ConfigError;
use crate::scene::{ModelSearch, Scene, SceneFile};
use std::path::Path;

/// The scene that is at `path`, which answers the same question as this search; `None` if nothing is there.
///
/// # Errors
/// When there is something else, which must not be lost.
pub(super) fn read(path: &Path, searched: &Scene) -> Result<Option<Scene>, ConfigError> {
    let refuse = |what: String| {
        let path = path.display();
        ConfigError(format!(
            "--out: {path} is there already and {what}; name another folder, or remove the file"
        ))
    };
    if !path.exists() && !path.with_extension("obj").exists() {
        return Ok(None);
    }
    let load = || SceneFile::read(path)?.load(&ModelSearch::for_scene_file(path));
    let scene = load().map_err(|error| {
        let error = anyhow::Error::new(error);
        refuse(format!("cannot be read as an earlier result ({error:#})"))
    })?;
    if scene.title != searched.title {
        let title = &scene.title;
        return Err(refuse(format!("answers another question, `{title}`")));
    }
    Ok(Some(scene))
}
