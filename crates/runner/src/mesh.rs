//! Meshes as a draw gives them: named vertex attributes and triangles.

use std::collections::BTreeMap;

use bossage_translate::manifest::Entry;

use crate::error::Error;
use crate::layout;

/// One vertex attribute.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Floats a vertex, 1 to 4.
    pub components: u32,
    /// The values, vertex by vertex.
    pub values: Vec<f32>,
}

/// Triangles over named attributes. Attributes that a shader doesn't read are not uploaded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The attributes, by the names that the vertex stage's inputs have in the manifest.
    pub attributes: BTreeMap<String, Attribute>,
    /// Three a triangle, counter-clockwise seen from its front.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// A mesh of triangles without attributes yet.
    #[must_use]
    pub fn new(indices: Vec<u32>) -> Self {
        Self {
            attributes: BTreeMap::new(),
            indices,
        }
    }

    /// Adds an attribute of `N` floats a vertex.
    #[must_use]
    pub fn with<const N: usize>(mut self, name: &str, values: &[[f32; N]]) -> Self {
        let attribute = Attribute {
            components: N as u32,
            values: values.as_flattened().to_vec(),
        };
        self.attributes.insert(name.to_owned(), attribute);
        self
    }

    /// Checks that everything the vertex stage reads is there, in the right shape, and that no index points beyond it.
    ///
    /// # Errors
    /// [`Error::Mesh`], naming the attribute.
    pub fn validate(&self, job: &str, entry: &Entry) -> Result<(), Error> {
        let wrong = |attribute: &str, problem: String| {
            Err(Error::Mesh {
                job: job.to_owned(),
                attribute: attribute.to_owned(),
                problem,
            })
        };
        if self.indices.is_empty() || !self.indices.len().is_multiple_of(3) {
            return wrong(
                "indices",
                format!("{} indices make no whole triangles", self.indices.len()),
            );
        }
        let highest = self.indices.iter().copied().max().unwrap_or(0) as usize;
        for input in layout::located(entry, &entry.inputs)? {
            let Some(attribute) = self.attributes.get(&input.name) else {
                let known: Vec<_> = self.attributes.keys().map(String::as_str).collect();
                return wrong(
                    &input.name,
                    format!("the mesh doesn't have it; it has: {}", known.join(", ")),
                );
            };
            if attribute.components != input.components {
                let (given, read) = (attribute.components, input.components);
                return wrong(
                    &input.name,
                    format!("it has {given} components a vertex, the shader reads {read}"),
                );
            }
            let vertices = attribute.values.len() / attribute.components as usize;
            if !attribute
                .values
                .len()
                .is_multiple_of(attribute.components as usize)
            {
                return wrong(
                    &input.name,
                    format!("{} floats make no whole vertices", attribute.values.len()),
                );
            }
            if highest >= vertices {
                return wrong(
                    &input.name,
                    format!("index {highest} points beyond its {vertices} vertices"),
                );
            }
        }
        Ok(())
    }

    /// What the vertex stage reads of it, by location. The mesh has been [validated](Self::validate).
    ///
    /// # Errors
    /// [`Error::Interface`] for an input that is not of floats.
    pub fn located(&self, entry: &Entry) -> Result<Vec<(u32, &Attribute)>, Error> {
        let inputs = layout::located(entry, &entry.inputs)?;
        let given = inputs
            .iter()
            .filter_map(|input| Some((input.location, self.attributes.get(&input.name)?)));
        Ok(given.collect())
    }
}
