//! Where model files are looked up.

use std::env;
use std::path::{Path, PathBuf};

/// The environment variable with further folders of models, separated as in `PATH`.
pub const MODELS_VARIABLE: &str = "SVBENCH_MODELS";

/// The folders in which a model file is looked up, after its path as given.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ModelSearch {
    /// In the order of the search.
    pub folders: Vec<PathBuf>,
}

impl ModelSearch {
    /// The folder of the scene file, `scenes/models`, then each folder in `SVBENCH_MODELS`.
    pub fn for_scene_file(scene_file: &Path) -> Self {
        let from_environment = env::var_os(MODELS_VARIABLE).unwrap_or_default();
        let folders = scene_file
            .parent()
            .map(Path::to_owned)
            .into_iter()
            .chain([PathBuf::from("scenes/models")])
            // An empty entry would mean the working folder, where the path as given is looked up.
            .chain(env::split_paths(&from_environment).filter(|f| !f.as_os_str().is_empty()))
            .collect();
        Self { folders }
    }

    /// The first of all [candidates](Self::candidates) that is a file.
    pub fn find(&self, file: &Path) -> Option<PathBuf> {
        self.candidates(file)
            .into_iter()
            .find(|path| path.is_file())
    }

    /// Every path that a model file may have, in the order of the search, none twice.
    pub fn candidates(&self, file: &Path) -> Vec<PathBuf> {
        let mut paths = vec![file.to_owned()];
        for path in self.folders.iter().map(|folder| folder.join(file)) {
            if !paths.contains(&path) {
                paths.push(path);
            }
        }
        paths
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_as_given_comes_first_and_each_place_once() {
        let search = ModelSearch {
            folders: ["", "a", "b", "a"].map(PathBuf::from).to_vec(),
        };
        assert_eq!(
            search.candidates(Path::new("m.obj")),
            ["m.obj", "a/m.obj", "b/m.obj"].map(PathBuf::from)
        );
        // An absolute path is the same in every folder.
        assert_eq!(
            search.candidates(Path::new("/m.obj")),
            [PathBuf::from("/m.obj")]
        );
    }

    #[test]
    fn the_folder_of_the_scene_file_comes_before_the_common_one() {
        let search = ModelSearch::for_scene_file(Path::new("x/y.toml"));
        assert_eq!(
            search.folders[..2],
            ["x", "scenes/models"].map(PathBuf::from)
        );
    }

    #[test]
    fn a_folder_is_no_model() {
        let folder = tempfile::tempdir().unwrap();
        let search = ModelSearch {
            folders: vec![folder.path().to_owned()],
        };
        std::fs::create_dir(folder.path().join("m.obj")).unwrap();
        assert_eq!(search.find(Path::new("m.obj")), None);
        std::fs::write(folder.path().join("n.obj"), "").unwrap();
        assert_eq!(
            search.find(Path::new("n.obj")),
            Some(folder.path().join("n.obj"))
        );
    }
}
