//! MikkTSpace cases: the hardened tangent kernels on meshes that MikkTSpace has made, compared with its own tangents.
//!
//! MikkTSpace splits a vertex wherever its corners need different tangents; what is left at each vertex is a fan of triangles of
//! one handedness. Both methods then take a weighted mean of the fan's tangents, MikkTSpace by angles and `frame_from_uv` by
//! areas, so both lie inside of the cone that those tangents span, and cannot be further apart than the two of them that are
//! furthest apart. On flat fans that is rounding.
//!
//! Left out are vertices on which the two disagree by design: those of a triangle without area in space or in texture, and
//! those of a triangle wound against its normals, where MikkTSpace takes the handedness of the winding and `frame_from_uv` that
//! of the normals.

use bossage_assets::{Mesh, frame_mikktspace};
use bossage_shaders::Form;
use glam::{DVec2, DVec3};

use super::mesh::{MeshCase, meshes};
use crate::bench::Bench;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::module::Module;
use crate::verdict::Verdict;

/// Directions that agree but for rounding: some twenty roundings of 2⁻²⁴ in each method, on sums that may have lost up to
/// four bits to cancellation, in degrees.
const ROUNDING_DEG: f64 = 0.002;

/// One mesh.
struct MikktspaceCase {
    id: CaseId,
    mesh: Mesh,
}

/// One case a mesh of the mesh suite.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    meshes().into_iter().map(|(name, mesh)| {
        let id = CaseId::new("frame_mikktspace", None, "mesh").with("mesh", name);
        Box::new(MikktspaceCase { id, mesh }) as Box<dyn Case>
    })
}

/// How far two unit vectors are apart, in degrees.
fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

impl MikktspaceCase {
    /// The mesh with MikkTSpace's tangents, vertices split.
    fn made(&self) -> Result<Mesh, String> {
        let mut mesh = self.mesh.clone();
        frame_mikktspace::generate(&mut mesh).map_err(|error| with_causes(&error))?;
        Ok(mesh)
    }

    fn kernels(mesh: &Mesh, id: &CaseId) -> MeshCase {
        MeshCase::new(id.clone(), Form::Hardened, mesh.clone(), false)
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let mesh = self.made()?;
        let got = Self::kernels(&mesh, &self.id).tangents(bench)?;
        let fans = fans(&mesh);
        let (mut compared, mut furthest) = (0, 0.0_f64);
        for (v, fan) in fans.iter().enumerate() {
            let Some(spread) = fan.as_ref().and_then(|fan| spread_deg(fan)) else {
                continue;
            };
            let Some(&[x, y, z, w]) = got.get(4 * v..).and_then(|rest| rest.first_chunk::<4>()) else {
                return Err(format!("the kernel wrote no tangent of vertex {v}"));
            };
            let ours = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
            let theirs = mesh.tangents[v].as_dvec4();
            let apart = angle_deg(ours, theirs.truncate());
            if apart.is_nan() || apart > spread + ROUNDING_DEG || f64::from(w) != theirs.w {
                return Err(format!(
                    "vertex {v}: ({x}, {y}, {z}; {w}) is {apart:.4}° from MikkTSpace's {theirs}, and its triangles' tangents \
                     are {spread:.4}° apart"
                ));
            }
            compared += 1;
            furthest = furthest.max(apart);
        }
        let note = format!(
            "{compared} of {} vertices compared, at most {furthest:.4}° apart",
            fans.len()
        );
        Ok(Outcome {
            inputs: fans.len(),
            comparison: Comparison::of_property(4 * compared),
            verdict: Verdict::Pass,
            reason: Some(note),
        })
    }
}

/// The tangents of each vertex' triangles, projected onto its tangent plane and made unit; `None` where a triangle says nothing.
fn fans(mesh: &Mesh) -> Vec<Option<Vec<DVec3>>> {
    let mut fans = vec![Some(Vec::new()); mesh.positions.len()];
    for corners in mesh.indices.chunks_exact(3) {
        let corners = [corners[0] as usize, corners[1] as usize, corners[2] as usize];
        let triangle = triangle(mesh, corners);
        for vertex in corners {
            let normal = mesh.normals[vertex].as_dvec3();
            let outward = triangle.filter(|(facing, _)| normal.dot(*facing) > 0.05);
            let projected = outward.map(|(_, t)| t - normal * normal.dot(t));
            // Nearly along the normal, the projection is noise.
            let unit = projected.filter(|t| t.length() > 0.05).map(DVec3::normalize);
            fans[vertex] = fans[vertex].take().zip(unit).map(|(mut fan, unit)| {
                fan.push(unit);
                fan
            });
        }
    }
    fans
}

/// The unit normal and tangent of a triangle; `None` where its area in space or in texture cannot be told from rounding.
fn triangle(mesh: &Mesh, [a, b, c]: [usize; 3]) -> Option<(DVec3, DVec3)> {
    let position = |v: usize| mesh.positions[v].as_dvec3();
    let uv = |v: usize| mesh.uvs[v].as_dvec2();
    let (p, q): (DVec3, DVec3) = (position(b) - position(a), position(c) - position(a));
    let (s, t): (DVec2, DVec2) = (uv(b) - uv(a), uv(c) - uv(a));
    let flat = |area: f64, longest: f64| area.abs() < 1e-4 * longest * longest;
    if flat(p.cross(q).length(), p.length().max(q.length()))
        || flat(s.perp_dot(t), s.length().max(t.length()))
    {
        return None;
    }
    let tangent = (p * t.y - q * s.y) * s.perp_dot(t).signum();
    Some((p.cross(q).normalize(), tangent.normalize()))
}

/// The largest angle between two tangents of a fan; `None` for an empty one, or one so wide that its mean is no direction.
fn spread_deg(fan: &[DVec3]) -> Option<f64> {
    let pairs = fan.iter().flat_map(|a| fan.iter().map(|b| angle_deg(*a, *b)));
    let spread = pairs.fold(0.0, f64::max);
    (!fan.is_empty() && spread < 120.0).then_some(spread)
}

impl Case for MikktspaceCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec!["MikkTSpace", "the cone of the triangles' tangents"]
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Self::kernels(&self.mesh, &self.id).modules()
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

#[cfg(test)]
mod tests {
    use bossage_assets::{frame_mikktspace, primitives};
    use glam::DVec3;

    use super::{angle_deg, fans, spread_deg};

    #[test]
    fn a_flat_fan_leaves_no_room_and_a_curved_one_its_bend() {
        let spread = |mut mesh: bossage_assets::Mesh| {
            frame_mikktspace::generate(&mut mesh).unwrap();
            let fans = fans(&mesh);
            let spreads = fans.iter().flatten().filter_map(|fan| spread_deg(fan));
            spreads.fold(0.0, f64::max)
        };
        assert!(spread(primitives::cube(1.0)) < 1e-4);
        let torus = spread(primitives::torus(1.0, 0.25, 24, 12));
        // Two neighbouring segments of 15° meet in a vertex.
        assert!((14.0..40.0).contains(&torus), "{torus}");
    }

    #[test]
    fn angles_are_exact_where_cosines_are_not() {
        let small = DVec3::new(1.0, 1e-9, 0.0);
        assert!((angle_deg(DVec3::X, small).to_radians() - 1e-9).abs() < 1e-15);
    }
}
