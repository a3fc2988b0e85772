//! FLIP: how strongly a viewer who flips between two pictures sees a difference at each pixel, from 0 (none) to 1.
//!
//! Andersson et al., *FLIP: A Difference Evaluator for Alternating Images*, HPG 2020, in its form for pictures of low dynamic range. Both
//! pictures are filtered as the eye filters at this distance, compared as colours (HyAB distance in a Hunt-adjusted L*a*b*) and
//! as features (edges and points), and the two are joined. NVIDIA's own program is the oracle of the tests.

mod colour;
mod filter;

use image::{Rgb, RgbImage};

use colour::{Colour, YCxCz};
use filter::{Features, Plane};

/// Pixels a degree of the authors' own set-up: 0.7 m away from a screen 0.7 m and 3840 pixels wide.
pub const PIXELS_PER_DEGREE: f64 = 0.7 * 3840.0 / 0.7 * std::f64::consts::PI / 180.0;

/// Exponents and knees of the paper.
const COLOUR_EXPONENT: f64 = 0.7;
const FEATURE_EXPONENT: f64 = 0.5;
const KNEE_COST: f64 = 0.4;
const KNEE: f64 = 0.95;

/// The difference of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Flip {
    /// Mean over all pixels, in [0, 1]; the one number that the authors recommend.
    pub mean: f64,
    /// Pixels in a row.
    pub width: u32,
    /// The difference at each pixel, row by row, in [0, 1].
    pub errors: Vec<f64>,
}

/// Why two pictures can't be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// They have different sizes.
    #[error("one picture has {} x {} pixels, the other {} x {}", .0.0, .0.1, .1.0, .1.1)]
    Sizes((u32, u32), (u32, u32)),
    /// They have no pixels.
    #[error("the pictures have no pixels")]
    Empty,
    /// A number of pixels a degree that no viewer has.
    #[error("{0} pixels a degree; it must be a number from 1 to 1000")]
    PixelsPerDegree(String),
}

/// Compares two sRGB pictures, seen at so many pixels a degree of the viewer's field.
///
/// ```
/// use bossage_study::flip::{PIXELS_PER_DEGREE, flip};
/// use image::{Rgb, RgbImage};
///
/// let grey = RgbImage::from_pixel(16, 16, Rgb([128; 3]));
/// let white = RgbImage::from_pixel(16, 16, Rgb([255; 3]));
/// assert_eq!(flip(&grey, &grey, PIXELS_PER_DEGREE)?.mean, 0.0);
/// assert!(flip(&grey, &white, PIXELS_PER_DEGREE)?.mean > 0.1);
/// # Ok::<(), bossage_study::flip::Error>(())
/// ```
///
/// # Errors
/// [`Error::Sizes`] and [`Error::Empty`] for pictures that can't be compared; [`Error::PixelsPerDegree`] outside of [1, 1000].
pub fn flip(reference: &RgbImage, test: &RgbImage, pixels_per_degree: f64) -> Result<Flip, Error> {
    if reference.dimensions() != test.dimensions() {
        return Err(Error::Sizes(reference.dimensions(), test.dimensions()));
    }
    if reference.is_empty() {
        return Err(Error::Empty);
    }
    if !(1.0..=1000.0).contains(&pixels_per_degree) {
        return Err(Error::PixelsPerDegree(pixels_per_degree.to_string()));
    }
    let ((colours, features), (test_colours, test_features)) = rayon::join(
        || seen(reference, pixels_per_degree),
        || seen(test, pixels_per_degree),
    );
    let scale = ColourScale::new();
    let colour = colours
        .iter()
        .zip(&test_colours)
        .map(|(a, b)| scale.difference(a, b));
    let feature = features
        .iter()
        .zip(&test_features)
        .map(|(a, b)| feature_difference(*a, *b));
    let errors: Vec<f64> = colour
        .zip(feature)
        .map(|(colour, feature)| colour.powf(1.0 - feature))
        .collect();
    Ok(Flip {
        mean: errors.iter().sum::<f64>() / errors.len() as f64,
        width: reference.width(),
        errors,
    })
}

impl Flip {
    /// The differences in the colours of the paper: black for none, through purple and orange to pale yellow.
    #[must_use]
    pub fn map(&self) -> RgbImage {
        let height = (self.errors.len() as u32).checked_div(self.width).unwrap_or(0);
        RgbImage::from_fn(self.width, height, |x, y| {
            let error = self.errors[(y * self.width + x) as usize];
            let colour = colorous::MAGMA.eval_continuous(error.clamp(0.0, 1.0));
            Rgb(colour.as_array())
        })
    }
}

/// What the eye has of a picture: filtered colours, Hunt-adjusted; and the features.
fn seen(picture: &RgbImage, pixels_per_degree: f64) -> (Vec<Colour>, Vec<Features>) {
    let (width, height) = picture.dimensions();
    let opponent: Vec<YCxCz> = picture.pixels().map(|pixel| colour::from_srgb(pixel.0)).collect();
    let channel = |index: usize| {
        let values = opponent.iter().map(|pixel| pixel.0[index]).collect();
        Plane::new(width as usize, height as usize, values)
    };
    let channels = [0, 1, 2].map(channel);
    let features = filter::features(&channels[0], pixels_per_degree);
    let [y, cx, cz] = filter::contrast_sensitivity(&channels, pixels_per_degree);
    let colours = (0..opponent.len())
        .map(|index| YCxCz([y.values[index], cx.values[index], cz.values[index]]).perceived())
        .collect();
    (colours, features)
}

/// Greatest colour difference, by which others are scaled.
struct ColourScale {
    greatest: f64,
}

impl ColourScale {
    fn new() -> Self {
        let [green, blue] = [[0, 255, 0], [0, 0, 255]].map(|rgb| colour::from_srgb(rgb).perceived());
        Self {
            greatest: green.hyab(&blue).powf(COLOUR_EXPONENT),
        }
    }

    /// Small differences take most of the range: up to the knee they grow evenly.
    fn difference(&self, a: &Colour, b: &Colour) -> f64 {
        let difference = a.hyab(b).powf(COLOUR_EXPONENT);
        let knee = KNEE_COST * self.greatest;
        if difference < knee {
            return KNEE / knee * difference;
        }
        KNEE + (difference - knee) / (self.greatest - knee) * (1.0 - KNEE)
    }
}

fn feature_difference(a: Features, b: Features) -> f64 {
    let greatest = (a.edge - b.edge).abs().max((a.point - b.point).abs());
    (greatest / std::f64::consts::SQRT_2)
        .powf(FEATURE_EXPONENT)
        .clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: u32 = 48;

    /// Smooth colours with a hard edge and a few points, so that every part of the measure has something to see.
    fn scene() -> RgbImage {
        RgbImage::from_fn(SIZE, SIZE, |x, y| {
            let edge = if x + 2 * y < 70 { 60 } else { 0 };
            let point = if x % 13 == 5 && y % 11 == 4 { 90 } else { 0 };
            Rgb([
                (4 * x) as u8 + edge,
                (3 * y) as u8 + point,
                200 - (2 * x + y) as u8,
            ])
        })
    }

    fn changed(change: impl Fn(u32, u32, [u8; 3]) -> [u8; 3]) -> RgbImage {
        let scene = scene();
        RgbImage::from_fn(SIZE, SIZE, |x, y| Rgb(change(x, y, scene.get_pixel(x, y).0)))
    }

    /// By NVIDIA's own program, which computes in f32.
    fn by_nvidia(reference: &RgbImage, test: &RgbImage, pixels_per_degree: f64) -> Vec<f32> {
        let image = |picture: &RgbImage| {
            nv_flip::FlipImageRgb8::with_data(picture.width(), picture.height(), picture)
        };
        nv_flip::flip(image(reference), image(test), pixels_per_degree as f32).to_vec()
    }

    fn worst(reference: &RgbImage, test: &RgbImage, pixels_per_degree: f64) -> f64 {
        let ours = flip(reference, test, pixels_per_degree).unwrap().errors;
        let theirs = by_nvidia(reference, test, pixels_per_degree);
        assert_eq!(ours.len(), theirs.len());
        ours.iter()
            .zip(theirs)
            .map(|(a, b)| (a - f64::from(b)).abs())
            .fold(0.0, f64::max)
    }

    /// Differences of f32 sums reach the result through a root of the feature difference, whose slope is unbounded at 0: 1e-7 there is
    /// 3e-4 here.
    const F32_ALLOWANCE: f64 = 1e-3;

    #[test]
    fn every_pixel_is_as_in_nvidias_program() {
        let tests = [
            changed(|_, _, [r, g, b]| [r.saturating_add(30), g, b]),
            changed(|x, _, rgb| {
                if x % 2 == 0 {
                    rgb.map(|value| value / 2)
                } else {
                    rgb
                }
            }),
            changed(|x, y, rgb| if (x, y) == (20, 20) { [255, 0, 255] } else { rgb }),
            changed(|_, _, [r, g, b]| [b, r, g]),
        ];
        for (number, test) in tests.iter().enumerate() {
            for pixels_per_degree in [PIXELS_PER_DEGREE, 20.0] {
                let worst = worst(&scene(), test, pixels_per_degree);
                assert!(
                    worst < F32_ALLOWANCE,
                    "picture {number} at {pixels_per_degree}: {worst}"
                );
            }
        }
    }

    #[test]
    fn another_distance_is_seen_by_the_comparison_with_nvidia() {
        let test = changed(|x, _, rgb| {
            if x % 2 == 0 {
                rgb.map(|value| value / 2)
            } else {
                rgb
            }
        });
        let near = flip(&scene(), &test, 20.0).unwrap().errors;
        let far = by_nvidia(&scene(), &test, PIXELS_PER_DEGREE);
        let worst = near
            .iter()
            .zip(far)
            .map(|(a, b)| (a - f64::from(b)).abs())
            .fold(0.0, f64::max);
        assert!(worst > 10.0 * F32_ALLOWANCE, "{worst}");
    }

    #[test]
    fn equal_pictures_do_not_differ_and_order_does_not_matter() {
        let test = changed(|_, _, [r, g, b]| [g, r, b]);
        assert_eq!(flip(&scene(), &scene(), PIXELS_PER_DEGREE).unwrap().mean, 0.0);
        let there = flip(&scene(), &test, PIXELS_PER_DEGREE).unwrap();
        let back = flip(&test, &scene(), PIXELS_PER_DEGREE).unwrap();
        assert!((there.mean - back.mean).abs() < 1e-12 && there.mean > 0.05);
        assert!(there.errors.iter().all(|error| (0.0..=1.0).contains(error)));
    }

    #[test]
    fn maps_have_a_pixel_each_and_are_black_where_nothing_differs() {
        let map = flip(&scene(), &scene(), PIXELS_PER_DEGREE).unwrap().map();
        assert_eq!(map.dimensions(), (SIZE, SIZE));
        let black = colorous::MAGMA.eval_continuous(0.0).as_array();
        assert!(map.pixels().all(|pixel| pixel.0 == black));
    }

    #[test]
    fn what_cannot_be_compared_is_refused() {
        let error = flip(&scene(), &RgbImage::new(2, 3), PIXELS_PER_DEGREE).unwrap_err();
        assert_eq!(
            error.to_string(),
            "one picture has 48 x 48 pixels, the other 2 x 3"
        );
        assert_eq!(
            flip(&RgbImage::new(0, 0), &RgbImage::new(0, 0), 67.0),
            Err(Error::Empty)
        );
        assert!(matches!(
            flip(&scene(), &scene(), f64::NAN),
            Err(Error::PixelsPerDegree(_))
        ));
    }
}
