//! One file a bug, named by what was seen.

mod random_scenes;
mod specks_of_light_in_shadow;
