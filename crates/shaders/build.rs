//! Rebuilds the crate when a shader file is added, removed or changed: the embedding macro alone does not see new files.

fn main() {
    println!("cargo::rerun-if-changed=../../shaders");
    println!("cargo::rerun-if-changed=build.rs");
}
