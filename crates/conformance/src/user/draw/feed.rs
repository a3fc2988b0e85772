//! The inputs of stages: chosen for four invocations at a time, and as the words that generated stages read.

use bossage_bounds::ranges::{Inputs, Point, Seed, Style, Target, Values};
use bossage_bounds::{Kind, Slot};
use bossage_translate::Stage;

use super::{Draw, LANES};

/// The corners of a triangle that covers the four pixels, in pixels from the upper left: seen from its front.
const AROUND: [[f64; 2]; 3] = [[0.0, 0.0], [0.0, 4.0], [4.0, 0.0]];

/// The same around the centre of one pixel.
const WITHIN: [[f64; 2]; 3] = [[0.0, 0.0], [0.0, 1.5], [1.5, 0.0]];

/// Bits that the number of a slope keeps, so that every way of interpolating it is exact.
const SLOPED_BITS: i32 = 12;

/// Four vertices over the bindings of the first.
pub(in crate::user) fn vertices(inputs: &Inputs, seed: &mut Seed, style: Style) -> Vec<Point> {
    let first = inputs.sample(seed, style);
    let other = |seed: &mut Seed| {
        let sampled = inputs.sample(seed, style);
        let mut point = first.clone();
        for (k, scalar) in inputs.scalars.iter().enumerate() {
            if let Target::Stage { .. } = scalar.target {
                point.values[k] = sampled.values[k];
            }
        }
        point
    };
    let rest: Vec<Point> = (1..LANES).map(|_| other(seed)).collect();
    std::iter::once(first).chain(rest).collect()
}

/// The four pixels of a quad: all equal, or on slopes toward two further choices, between which every pixel lies.
pub(in crate::user) fn lanes(draw: &Draw, inputs: &Inputs, seed: &mut Seed, number: usize) -> Vec<Point> {
    let style = if number.is_multiple_of(2) {
        Style::Edge
    } else {
        Style::Random
    };
    let mut lanes = vec![inputs.sample(seed, style); LANES];
    if matches!(number % 4, 1 | 2) {
        let toward = [
            inputs.sample(seed, Style::Random),
            inputs.sample(seed, Style::Random),
        ];
        let share = [2 + seed.below(7) as i32, 2 + seed.below(7) as i32].map(|n| (-f64::from(n)).exp2());
        for group in inputs
            .groups
            .iter()
            .filter(|group| !matches!(group.values, Values::OneOf(_)))
        {
            let sloped = |k: usize| match inputs.scalars[k].target {
                Target::Stage { slot, .. } => {
                    draw.is_sloped(slot) && matches!(inputs.scalars[k].kind, Kind::Float(_))
                }
                Target::Buffer { .. } => false,
            };
            if group.scalars.clone().all(sloped) {
                slope(&mut lanes, group.scalars.clone(), &toward, share, &group.values);
            }
        }
    }
    lanes
}

/// Puts some scalars of four equal pixels on slopes, if the range has them.
fn slope(
    lanes: &mut [Point],
    scalars: std::ops::Range<usize>,
    toward: &[Point; 2],
    share: [f64; 2],
    range: &Values,
) {
    for k in scalars {
        let from = lanes[0].values[k];
        let steps = [0, 1].map(|axis| (toward[axis].values[k] - from) * share[axis]);
        let most = steps.iter().fold(from.abs(), |most, step| most.max(step.abs()));
        let unit = (most.log2().floor() - f64::from(SLOPED_BITS)).exp2();
        if !(unit.is_normal() && most < 1e30 && most > 1e-20) {
            continue;
        }
        let rounded = |x: f64| (x / unit).round() * unit;
        let ([x, y], base) = (steps.map(rounded), rounded(from));
        let values = [base, base + x, base + y, base + x + y];
        let within = match range {
            Values::Between(_) | Values::Unit => true,
            Values::OneOf(_) => false,
        };
        if within {
            for (point, value) in lanes.iter_mut().zip(values) {
                point.values[k] = value;
            }
        }
    }
}

/// The words of all corners of all triangles.
pub(super) fn bytes(draw: &Draw, inputs: &Inputs, lanes: &[Point]) -> Vec<u8> {
    let mut words: Vec<[u32; 4]> = Vec::new();
    match draw.stage {
        Stage::Vertex => {
            for (lane, point) in lanes.iter().enumerate() {
                let pixel = [lane % 2, lane / 2].map(|n| n as f64);
                for corner in WITHIN {
                    words.push(place([pixel[0] + corner[0], pixel[1] + corner[1]], 0.5));
                    words.extend(
                        draw.inputs
                            .iter()
                            .map(|port| value(port, inputs, |k| point.values[k])),
                    );
                }
            }
        }
        Stage::Fragment | Stage::Compute => {
            let first = &lanes[0];
            let depth = of_slot(inputs, Slot::Position, 2).map_or(0.5, |k| first.values[k].clamp(0.0, 1.0));
            let faces_away = of_slot(inputs, Slot::FrontFacing, 0).is_some_and(|k| first.values[k] < 0.5);
            let [a, b, c] = AROUND;
            for corner in if faces_away { [a, c, b] } else { [a, b, c] } {
                words.push(place(corner, depth));
                let at = |k: usize| {
                    let of = |lane: usize| lanes[lane].values[k];
                    // The pixels' centres lie half a pixel from the corner.
                    let [x, y] = corner.map(|pixels| pixels - 0.5);
                    of(0) + (of(1) - of(0)) * x + (of(2) - of(0)) * y
                };
                let located = draw.inputs.iter().filter(|port| port.is_located());
                words.extend(located.map(|port| value(port, inputs, at)));
            }
        }
    }
    words
        .iter()
        .flatten()
        .flat_map(|word| word.to_le_bytes())
        .collect()
}

/// A place in pixels of the 2 × 2 target, in clip space.
fn place([x, y]: [f64; 2], depth: f64) -> [u32; 4] {
    [x - 1.0, 1.0 - y, depth, 1.0].map(|value| (value as f32).to_bits())
}

fn value(port: &super::Port, inputs: &Inputs, at: impl Fn(usize) -> f64) -> [u32; 4] {
    let mut words = [0; 4];
    for (component, word) in words.iter_mut().enumerate().take(port.components) {
        *word = of_slot(inputs, port.slot, component).map_or(0, |k| port.word(at(k)));
    }
    words
}

/// The number of a stage input's scalar.
fn of_slot(inputs: &Inputs, slot: Slot, component: usize) -> Option<usize> {
    inputs
        .scalars
        .iter()
        .position(|scalar| scalar.target == Target::Stage { slot, component })
}
