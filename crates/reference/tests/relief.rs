//! The truth of relief against a march that knows nothing of cells, over maps of all shapes, edges and views.
//!
//! The march is another way to the first hit: at a gap g over the surface, nothing is met within g / (1 + |steepest slope along the
//! ray|), so steps of that length never pass the surface. It ends where the gap is 1e-9, so it may stop at a crest that the ray
//! clears by less: its answer lies between the hit on the surface lifted by that and the hit.

use bossage_assets::{EdgeMode, HeightField};
use bossage_reference::relief_grazing::Surface;
use bossage_reference::relief_ray::{Entry, Layer, Ray, Status};
use bossage_reference::relief_truth::{first_hit, first_hit_lifted, gradient_at, trace};
use bossage_reference::{cone_step, parallax_occlusion, relief, self_shadow, steep_parallax};
use glam::{DVec2, DVec3};

const EDGES: [EdgeMode; 3] = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];

/// Gap at which the march ends.
const STOP: f64 = 1e-9;

/// A generator with a fixed seed: the tests are the same every time.
struct Lot(u64);

impl Lot {
    /// Evenly in [0, 1).
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn view(&mut self, degrees: f64) -> DVec3 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (s, c) = (std::f64::consts::TAU * self.next()).sin_cos();
        DVec3::new(sin * c, sin * s, cos)
    }

    fn uv(&mut self) -> DVec2 {
        DVec2::new(4.0 * self.next() - 2.0, 4.0 * self.next() - 2.0)
    }
}

/// The bilinear interpolant, written here again.
fn height(field: &HeightField, edge: EdgeMode, uv: DVec2) -> f64 {
    let (x, y) = (
        uv.x * f64::from(field.width) - 0.5,
        uv.y * f64::from(field.height) - 0.5,
    );
    let texel = |i: f64, j: f64| {
        f64::from(field.texel(
            edge.resolve(i as i64, field.width),
            edge.resolve(j as i64, field.height),
        ))
    };
    let (i, j) = (x.floor(), y.floor());
    let (fx, fy) = (x - i, y - j);
    let weights = [
        (0.0, 0.0, (1.0 - fx) * (1.0 - fy)),
        (1.0, 0.0, fx * (1.0 - fy)),
        (0.0, 1.0, (1.0 - fx) * fy),
        (1.0, 1.0, fx * fy),
    ];
    weights
        .iter()
        .map(|(di, dj, weight)| weight * texel(i + di, j + dj))
        .sum()
}

/// The greatest change of height a unit of t along a ray: by the greatest difference of any two neighbours.
fn steepest(field: &HeightField, ray: &Ray) -> f64 {
    let (w, h) = (field.width, field.height);
    let texel = |x: u32, y: u32| f64::from(field.texel(x % w, y % h));
    let (mut along_x, mut along_y) = (0.0f64, 0.0f64);
    for (x, y) in (0..h).flat_map(|y| (0..w).map(move |x| (x, y))) {
        along_x = along_x.max((texel(x + 1, y) - texel(x, y)).abs());
        along_y = along_y.max((texel(x, y + 1) - texel(x, y)).abs());
    }
    let travel = (ray.delta * DVec2::new(f64::from(w), f64::from(h))).abs();
    along_x * travel.x + along_y * travel.y
}

fn march(field: &HeightField, edge: EdgeMode, ray: &Ray) -> f64 {
    let rate = 1.0 + steepest(field, ray);
    let mut t = 0.0;
    while t < 1.0 {
        let gap = (1.0 - t) - height(field, edge, ray.at(t));
        if gap <= STOP {
            return t;
        }
        t += gap / rate;
    }
    1.0
}

fn fields() -> Vec<HeightField> {
    let noise = |w, h, seed: u32| {
        HeightField::from_fn(w, h, |x, y| {
            let n =
                (x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed).wrapping_mul(0xC2B2_AE3D);
            ((n ^ (n >> 15)) % 256) as f32 / 255.0
        })
    };
    let waves = |w: u32, h: u32| {
        HeightField::from_fn(w, h, |x, y| {
            0.5 + 0.4 * (0.9 * x as f32).sin() * (0.7 * y as f32).cos()
        })
    };
    let steps = HeightField::from_fn(16, 16, |x, y| if (x / 4 + y / 4) % 2 == 0 { 1.0 } else { 0.0 });
    vec![
        noise(1, 1, 1),
        noise(1, 7, 2),
        noise(5, 3, 3),
        noise(13, 8, 4),
        noise(24, 24, 5),
        waves(31, 17),
        waves(32, 32),
        steps,
    ]
}

#[test]
fn no_march_finds_an_earlier_hit_and_every_hit_is_one() {
    let mut lot = Lot(2024);
    let (mut rays, mut same) = (0u32, 0u32);
    for field in fields() {
        for edge in EDGES {
            for degrees in [0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 90.0, 120.0] {
                for _ in 0..12 {
                    let layer = Layer {
                        scale: 0.02 + 0.1 * lot.next(),
                        bias: -0.1 * lot.next(),
                        v_factor: 0.5 + lot.next(),
                    };
                    let (uv, view) = (lot.uv(), lot.view(degrees));
                    let ray = Entry::new(uv, view, &layer).ray;
                    let hit = first_hit(&field, edge, &ray);
                    let lifted = first_hit_lifted(&field, edge, &ray, 2.0 * STOP);
                    let slow = march(&field, edge, &ray);
                    let context = format!("{}x{} {edge:?} {degrees}° {ray:?}", field.width, field.height);
                    // Positions up to 3 tiles of 32 texels are rounded by 2⁻⁴⁶ texels; a slope of 1 a texel: heights by 2e-14.
                    assert!(lifted.t <= slow + 1e-12, "{context}: met before the march allows");
                    assert!(
                        slow <= hit.t + 1e-12,
                        "{context}: {} behind the march's {slow}",
                        hit.t
                    );
                    let over = height(&field, edge, hit.uv) - (1.0 - hit.t);
                    assert!(
                        over.abs() < 1e-12 || hit.t == 0.0,
                        "{context}: {over} off the surface"
                    );
                    rays += 1;
                    same += u32::from((hit.t - slow).abs() < 1e-6);
                }
            }
        }
    }
    // All but rays along a slope: 1e-9 of gap is 1e-6 of t only where ray and surface are within 1e-3 of parallel.
    assert!(same * 100 >= rays * 99, "{same} of {rays}");
}

#[test]
fn the_check_sees_a_walk_that_is_wrong() {
    // Controls: marching techniques in the place of the truth are refused by the comparison above.
    let field = &fields()[4];
    let mut lot = Lot(7);
    let (mut late, mut off) = (0, 0);
    for _ in 0..200 {
        let ray = Entry::new(lot.uv(), lot.view(75.0), &Layer::below(0.1)).ray;
        let of = |uv| height(field, EdgeMode::Wrap, uv);
        let slow = march(field, EdgeMode::Wrap, &ray);
        late += u32::from(parallax_occlusion::secant(&ray, 16, of) > slow + 1e-12);
        let t = relief::bisect(&ray, 16, 5, of);
        off += u32::from((of(ray.at(t)) - (1.0 - t)).abs() >= 1e-12);
    }
    assert!(late > 100 && off > 190, "{late} late, {off} off the surface");
}

#[test]
fn grazing_rays_are_few_and_their_answers_are_hits_of_their_neighbours() {
    let mut lot = Lot(11);
    let (mut rays, mut grazing) = (0u32, 0u32);
    for field in fields() {
        let surface = Surface::new(&field, EdgeMode::Wrap);
        for degrees in [60.0, 75.0, 85.0] {
            for _ in 0..1500 {
                let ray = Entry::new(lot.uv(), lot.view(degrees), &Layer::below(0.05)).ray;
                let answers = surface.answers(&ray);
                rays += 1;
                grazing += u32::from(answers.is_grazing());
                for hit in &answers.others {
                    let over = height(&field, EdgeMode::Wrap, hit.uv) - (1.0 - hit.t);
                    // The neighbour's own ray differs by up to 4 ULPs of 2⁻²² tiles, where slopes are up to 32 heights a tile.
                    assert!(over.abs() < 1e-4, "{over}");
                }
            }
        }
    }
    assert!(grazing * 1000 <= rays, "{grazing} of {rays}");
}

#[test]
fn the_ladder_climbs() {
    // More layers and steps come nearer, and cones of a safe map never pass the hit. The map: waves, whose cones are bounded by slope.
    let field = HeightField::from_fn(64, 64, |x, y| {
        let phase = |i: u32| std::f32::consts::TAU * (i as f32 + 0.5) / 64.0;
        0.5 + 0.25 * phase(x).sin() + 0.2 * (2.0 * phase(y)).cos()
    });
    let mut lot = Lot(5);
    let mut sums = [0.0f64; 5];
    for _ in 0..300 {
        let ray = Entry::new(lot.uv(), lot.view(60.0), &Layer::below(0.1)).ray;
        let of = |uv| height(&field, EdgeMode::Wrap, uv);
        let truth = first_hit(&field, EdgeMode::Wrap, &ray).t;
        // h changes by at most 0.25·2π along u and 0.4·2π along v a tile, so cones as steep as both together are free.
        let ratio = 1.0 / (0.65 * std::f64::consts::TAU);
        let cone = |uv| cone_step::Sample {
            height: of(uv),
            ratio,
        };
        let (cone, _) = cone_step::step(&ray, cone_step::reach(&ray, DVec2::splat(64.0)), 12, cone);
        assert!(cone <= truth + 1e-12, "{cone} behind {truth}");
        let found = [
            steep_parallax::first_below(&ray, 16, of),
            steep_parallax::first_below(&ray, 128, of),
            parallax_occlusion::secant(&ray, 128, of),
            relief::bisect(&ray, 128, 12, of),
            cone,
        ];
        found
            .iter()
            .zip(&mut sums)
            .for_each(|(t, sum)| *sum += (t - truth).abs() / 300.0);
    }
    let [steep_16, steep_128, occlusion, bisected, _] = sums;
    assert!(
        steep_128 < 0.25 * steep_16 && occlusion < 0.1 * steep_128 && bisected < 0.1 * steep_128,
        "{sums:?}"
    );
}

#[test]
fn what_faces_away_from_the_light_stands_in_its_own_way() {
    let field = &fields()[6];
    let (mut lot, mut shaded, mut facing_away) = (Lot(3), 0, 0);
    for _ in 0..3000 {
        let layer = Layer::below(0.1);
        let hit = trace(field, EdgeMode::Wrap, lot.uv(), lot.view(30.0), &layer);
        assert_eq!(hit.status, Status::Hit);
        let light = lot.view(60.0);
        let Some(ray) = self_shadow::light_ray(&hit, light, &layer) else {
            unreachable!("60° is above the horizon")
        };
        let is_shaded = self_shadow::is_shaded(field, EdgeMode::Wrap, &hit, light, &layer);
        // The surface rises faster than the ray to the light.
        if gradient_at(field, EdgeMode::Wrap, hit.uv).dot(ray.delta) > 1.5 && hit.t > 0.1 {
            facing_away += 1;
            // By however little before the slope ends: whether that shades is a question of the bias.
            assert!(
                self_shadow::obstruction(field, EdgeMode::Wrap, &hit, &ray) > 0.0,
                "{hit:?}"
            );
        }
        shaded += u32::from(is_shaded);
    }
    assert!(
        facing_away > 20 && shaded > facing_away && shaded < 3000,
        "{facing_away}, {shaded}"
    );
}
