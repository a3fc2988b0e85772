//! Colour spaces of FLIP: sRGB, an opponent space that is linear in light (YCxCz), and L*a*b* with the Hunt effect.

use bossage_reference::srgb;

/// Linear sRGB to XYZ, rows.
const TO_XYZ: [[f64; 3]; 3] = [
    [
        10135552.0 / 24577794.0,
        8788810.0 / 24577794.0,
        4435075.0 / 24577794.0,
    ],
    [
        2613072.0 / 12288897.0,
        8788810.0 / 12288897.0,
        887015.0 / 12288897.0,
    ],
    [
        1425312.0 / 73733382.0,
        8788810.0 / 73733382.0,
        70074185.0 / 73733382.0,
    ],
];

/// Luminance, red against green, blue against yellow; linear in light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct YCxCz(pub(super) [f64; 3]);

/// L*, a*, b* where dark colours are less colourful.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Colour([f64; 3]);

/// The opponent colour of an sRGB pixel.
pub(super) fn from_srgb(rgb: [u8; 3]) -> YCxCz {
    let [x, y, z] = relative(times(TO_XYZ, rgb.map(srgb::decode_byte)));
    YCxCz([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)])
}

impl YCxCz {
    /// As a colour that a screen can show, and as it is perceived.
    pub(super) fn perceived(self) -> Colour {
        let [luminance, cx, cz] = self.0;
        let y = (luminance + 16.0) / 116.0;
        let white = white();
        let xyz = [
            (y + cx / 500.0) * white[0],
            y * white[1],
            (y - cz / 200.0) * white[2],
        ];
        let shown = times(inverse(TO_XYZ), xyz).map(|value| value.clamp(0.0, 1.0));
        let [x, y, z] = relative(times(TO_XYZ, shown)).map(lightness_curve);
        let lightness = 116.0 * y - 16.0;
        let hunt = 0.01 * lightness;
        Colour([lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z)])
    }
}

impl Colour {
    /// City block in lightness, straight in colour.
    pub(super) fn hyab(&self, other: &Self) -> f64 {
        let [l, a, b] = [0, 1, 2].map(|channel| self.0[channel] - other.0[channel]);
        l.abs() + a.hypot(b)
    }
}

/// XYZ of white.
fn white() -> [f64; 3] {
    times(TO_XYZ, [1.0; 3])
}

fn relative(xyz: [f64; 3]) -> [f64; 3] {
    let white = white();
    [0, 1, 2].map(|channel| xyz[channel] / white[channel])
}

/// CIE: a cube root with a straight start.
fn lightness_curve(t: f64) -> f64 {
    const DELTA: f64 = 6.0 / 29.0;
    if t > DELTA * DELTA * DELTA {
        t.cbrt()
    } else {
        t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
    }
}

fn times(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// By cross products of the rows.
fn inverse(rows: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let [a, b, c] = rows;
    let columns = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = a[0] * columns[0][0] + a[1] * columns[0][1] + a[2] * columns[0][2];
    [0, 1, 2].map(|row| columns.map(|column| column[row] / determinant))
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_undoes_the_matrix() {
        let back = times(inverse(TO_XYZ), times(TO_XYZ, [0.25, 0.5, 0.75]));
        assert!(
            back.iter()
                .zip([0.25, 0.5, 0.75])
                .all(|(a, b)| (a - b).abs() < 1e-12),
            "{back:?}"
        );
    }

    #[test]
    fn white_and_black_are_the_ends_of_lightness() {
        let Colour(white) = from_srgb([255; 3]).perceived();
        let Colour(black) = from_srgb([0; 3]).perceived();
        assert!(
            (white[0] - 100.0).abs() < 1e-9 && white[1].abs() < 1e-9 && white[2].abs() < 1e-9,
            "{white:?}"
        );
        assert!(black.iter().all(|value| value.abs() < 1e-9), "{black:?}");
    }
}
