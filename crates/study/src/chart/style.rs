//! How things look: inks with a light and a dark form, markers, and which technique has which.
//!
//! Colour never carries meaning alone: each series has a marker of its own too, and any two that share a colour differ in shape. The inks
//! of series keep a contrast of 3 to their background in both forms, and stay apart for eyes without one kind of cone (tests
//! below).

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use plotters::style::RGBColor;

/// A colour for light backgrounds and one for dark ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Ink {
    /// Charts are drawn with this one.
    light: [u8; 3],
    dark: [u8; 3],
}

impl Ink {
    const fn new(light: u32, dark: u32) -> Self {
        Self {
            light: bytes_of(light),
            dark: bytes_of(dark),
        }
    }

    pub(super) const fn color(self) -> RGBColor {
        let [r, g, b] = self.light;
        RGBColor(r, g, b)
    }
}

const fn bytes_of(rgb: u32) -> [u8; 3] {
    [(rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8]
}

/// The page behind everything.
pub(super) const BACK: Ink = Ink::new(0xFFFFFF, 0x161616);
/// Words and axes.
pub(super) const TEXT: Ink = Ink::new(0x1B1B1B, 0xECECEC);
/// Lines of the grid.
pub(super) const GRID: Ink = Ink::new(0xDCDCDC, 0x383838);
/// The band of the floor.
pub(super) const FLOOR: Ink = Ink::new(0xF1F1F2, 0x242425);
/// The line of the front.
pub(super) const FRONT: Ink = Ink::new(0x9A9A9A, 0x8C8C8C);

/// Colours of series, found by a search for the greatest least distance under all four kinds of sight.
const SERIES: [Ink; 8] = [
    Ink::new(0x0893F6, 0x8589F6),
    Ink::new(0xA71818, 0xDF5A0D),
    Ink::new(0x24646B, 0x12D58A),
    Ink::new(0xC05CB3, 0xAE7997),
    Ink::new(0x60895D, 0xFFFC2F),
    Ink::new(0x180A51, 0x6C52CE),
    Ink::new(0xFF1E09, 0xCAB6FF),
    Ink::new(0x303A5D, 0x9AFFEB),
];

/// Rules that turn a chart dark: each ink's light form, wherever it stands, becomes its dark one. `scope` selects the chart.
pub(super) fn dark_rules(scope: &str) -> String {
    let mut rules = String::new();
    for ink in [BACK, TEXT, GRID, FLOOR, FRONT].iter().chain(&SERIES) {
        let (light, dark) = (hex(ink.light), hex(ink.dark));
        for property in ["fill", "stroke"] {
            let _ = writeln!(
                rules,
                "{scope} [{property}=\"{light}\"] {{ {property}: {dark}; }}"
            );
        }
    }
    rules
}

/// As plotters writes colours.
fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02X}{g:02X}{b:02X}")
}

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Circle,
    Square,
    Up,
    Diamond,
    Down,
    Plus,
    Cross,
}

impl Marker {
    const ALL: [Self; 7] = [
        Self::Circle,
        Self::Square,
        Self::Up,
        Self::Diamond,
        Self::Down,
        Self::Plus,
        Self::Cross,
    ];

    /// The outline around (0, 0), about 12 pixels wide; none is a circle.
    pub(super) fn outline(self) -> Option<Vec<(i32, i32)>> {
        let plus = [
            (-2, -6),
            (2, -6),
            (2, -2),
            (6, -2),
            (6, 2),
            (2, 2),
            (2, 6),
            (-2, 6),
            (-2, 2),
            (-6, 2),
            (-6, -2),
            (-2, -2),
        ];
        let outline = match self {
            Self::Circle => return None,
            Self::Square => vec![(-5, -5), (5, -5), (5, 5), (-5, 5)],
            Self::Up => vec![(0, -6), (6, 5), (-6, 5)],
            Self::Down => vec![(0, 6), (6, -5), (-6, -5)],
            Self::Diamond => vec![(0, -7), (7, 0), (0, 7), (-7, 0)],
            Self::Plus => plus.to_vec(),
            // Turned by 45°, in whole pixels.
            Self::Cross => plus
                .iter()
                .map(|(x, y)| ((x - y) * 3 / 4, (x + y) * 3 / 4))
                .collect(),
        };
        Some(outline)
    }
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Look {
    pub(super) ink: Ink,
    pub(super) marker: Marker,
}

impl Look {
    /// Lengths 8 and 7 have no common factor, so 56 looks differ.
    pub(super) fn of(number: usize) -> Self {
        Self {
            ink: SERIES[number % SERIES.len()],
            marker: Marker::ALL[number % Marker::ALL.len()],
        }
    }
}

/// Techniques with a look that is the same in every study.
const KNOWN: [&str; 10] = [
    "exact",
    "parallax_occlusion",
    "relief",
    "relaxed_cone_step",
    "cone_step",
    "steep_parallax",
    "parallax_iterative",
    "parallax_offset",
    "parallax_offset_limited",
    "displacement",
];

/// The look of each technique of a study.
#[derive(Clone, Debug)]
pub(super) struct Looks(BTreeMap<String, (usize, Look)>);

impl Looks {
    /// Known techniques have their own, others come after them by name.
    pub(super) fn of<'a>(techniques: impl IntoIterator<Item = &'a str>) -> Self {
        let techniques: BTreeSet<&str> = techniques.into_iter().collect();
        let known = |technique: &str| KNOWN.iter().position(|known| *known == technique);
        let mut next = KNOWN.len();
        let numbered = techniques.into_iter().map(|technique| {
            let number = known(technique).unwrap_or_else(|| {
                next += 1;
                next - 1
            });
            (technique.to_owned(), (number, Look::of(number)))
        });
        Self(numbered.collect())
    }

    /// The look of a technique of the study.
    pub(super) fn look(&self, technique: &str) -> Look {
        self.0.get(technique).map_or(Look::of(0), |(_, look)| *look)
    }

    /// These techniques in the order in which legends name them.
    pub(super) fn legend<'a>(&self, techniques: impl IntoIterator<Item = &'a str>) -> Vec<(&'a str, Look)> {
        let techniques: BTreeSet<&str> = techniques.into_iter().collect();
        let mut ordered: Vec<(usize, &str, Look)> = techniques
            .into_iter()
            .filter_map(|technique| {
                self.0
                    .get(technique)
                    .map(|(number, look)| (*number, technique, *look))
            })
            .collect();
        ordered.sort_by_key(|(number, ..)| *number);
        ordered
            .into_iter()
            .map(|(_, technique, look)| (technique, look))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn linear(rgb: [u8; 3]) -> [f64; 3] {
        rgb.map(|byte| bossage_reference::srgb::decode(f64::from(byte) / 255.0))
    }

    fn times(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// WCAG 2.2: (L + 0.05) / (L' + 0.05).
    fn contrast(a: [u8; 3], b: [u8; 3]) -> f64 {
        let luminance = |rgb| times([[0.2126, 0.7152, 0.0722]; 3], linear(rgb))[0] + 0.05;
        let (a, b) = (luminance(a), luminance(b));
        a.max(b) / a.min(b)
    }

    /// Machado, Oliveira and Fernandes 2009, severity 1: no, protan, deutan, tritan deficiency.
    const SIGHTS: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ],
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ],
    ];

    /// Ottosson 2020, from linear sRGB.
    fn oklab(rgb: [f64; 3]) -> [f64; 3] {
        let lms = times(
            [
                [0.4122214708, 0.5363325363, 0.0514459929],
                [0.2119034982, 0.6806995451, 0.1073969566],
                [0.0883024619, 0.2817188376, 0.6299787005],
            ],
            rgb,
        );
        times(
            [
                [0.2104542553, 0.7936177850, -0.0040720468],
                [1.9779984951, -2.4285922050, 0.4505937099],
                [0.0259040371, 0.7827717662, -0.8086757660],
            ],
            lms.map(f64::cbrt),
        )
    }

    /// The least distance of two colours over all kinds of sight, in OKLab.
    fn apart(colours: &[[u8; 3]]) -> f64 {
        let mut least = f64::INFINITY;
        for sight in SIGHTS {
            let seen: Vec<[f64; 3]> = colours
                .iter()
                .map(|rgb| oklab(times(sight, linear(*rgb)).map(|value| value.clamp(0.0, 1.0))))
                .collect();
            for (index, a) in seen.iter().enumerate() {
                for b in &seen[..index] {
                    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
                    least = least.min(squares.sqrt());
                }
            }
        }
        least
    }

    #[test]
    fn series_stand_out_from_both_backgrounds() {
        for ink in SERIES {
            assert!(contrast(ink.light, BACK.light) >= 3.0, "{ink:?}");
            assert!(contrast(ink.dark, BACK.dark) >= 3.0, "{ink:?}");
        }
        for (light, dark) in [(BACK.light, BACK.dark), (FLOOR.light, FLOOR.dark)] {
            assert!(contrast(TEXT.light, light) >= 7.0 && contrast(TEXT.dark, dark) >= 7.0);
        }
        assert!(
            contrast(SERIES[0].light, [0x0A, 0x90, 0xF0]) < 3.0,
            "the measure tells colours apart"
        );
    }

    #[test]
    fn series_stay_apart_without_one_kind_of_cone() {
        // Five times the step of 0.02 that is called just noticeable in OKLab.
        assert!(apart(&SERIES.map(|ink| ink.light)) >= 0.1);
        assert!(apart(&SERIES.map(|ink| ink.dark)) >= 0.1);
        let red_and_green = [[0xD0, 0x40, 0x40], [0x80, 0x80, 0x38]];
        assert!(
            apart(&red_and_green) < 0.1,
            "a bad pair is seen: {}",
            apart(&red_and_green)
        );
    }

    #[test]
    fn inks_are_told_apart_by_their_light_form() {
        let all: Vec<Ink> = [BACK, TEXT, GRID, FLOOR, FRONT]
            .into_iter()
            .chain(SERIES)
            .collect();
        let distinct: BTreeSet<[u8; 3]> = all.iter().map(|ink| ink.light).collect();
        assert_eq!(distinct.len(), all.len());
        assert!(dark_rules(".chart").contains(".chart [fill=\"#FFFFFF\"] { fill: #161616; }"));
    }

    #[test]
    fn looks_differ_and_known_techniques_keep_theirs() {
        let looks: Vec<Look> = (0..56).map(Look::of).collect();
        assert!(
            looks
                .iter()
                .enumerate()
                .all(|(index, look)| !looks[..index].contains(look))
        );
        let few = Looks::of(["relief", "user:mine"]);
        let many = Looks::of(["exact", "relief", "user:another", "user:mine"]);
        assert_eq!(few.look("relief"), many.look("relief"));
        let names: Vec<&str> = many
            .legend(["user:mine", "relief", "exact"])
            .into_iter()
            .map(|(name, _)| name)
            .collect();
        assert_eq!(names, ["exact", "relief", "user:mine"]);
    }
}
