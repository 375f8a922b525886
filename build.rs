//! Shaders, scenes and published papers are part of the program: build it again when one is added or changed.

fn main() {
    println!("cargo::rerun-if-changed=shaders");
    println!("cargo::rerun-if-changed=scenes");
    println!("cargo::rerun-if-changed=src/report/published");
    println!("cargo::rerun-if-changed=results/published");
    println!("cargo::rerun-if-changed=build.rs");
}
