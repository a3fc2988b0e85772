//! Rebuilds the crate when a file of the corpus is added, removed or changed: the embedding macro alone does not see new files.

fn main() {
    println!("cargo::rerun-if-changed=corpus");
    println!("cargo::rerun-if-changed=build.rs");
}
