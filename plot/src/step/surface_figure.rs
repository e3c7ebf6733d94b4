//! The pressure of one loading step as data for the script of a page, which draws it.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use pellicle::display;

use super::coarse_field::CoarseField;
use super::crop::Crop;
use super::subject::Subject;
use crate::axes::labels;
use crate::sheet::colour_map::ColourMap;
use crate::sheet::colours::Colour;

/// The values of a cell: bare, relief without pressure, the first and the last pressure.
const BARE: u16 = 0;
const RELIEF: u16 = 1;
const PRESSURES: [u16; 2] = [2, u16::MAX];

/// The data of a figure that the script draws.
#[derive(Debug, Clone)]
pub struct SurfaceFigure {
    /// Cells per side.
    pub cells: usize,
    /// Two bytes per cell, in base 64.
    pub values: String,
    /// Three bytes per colour, in base 64.
    pub palette: String,
    /// The labels of the axes, as JSON.
    pub labels: String,
}

impl SurfaceFigure {
    /// Creates the figure of the pressure of a step, of at most so many cells per side.
    #[must_use]
    pub fn new(subject: &Subject<'_>, most: usize) -> Self {
        let fields = &subject.fields;
        let crop = Crop::around_contact(fields.pressure, fields.size);
        let coarse = CoarseField::new(fields, &crop, most);
        let (scale, shades) = subject.pressures();
        let fraction = |pressure: f64| shades.fraction(pressure / scale.divisor);
        Self {
            cells: coarse.cells,
            values: STANDARD.encode(values(&coarse, fraction)),
            palette: STANDARD.encode(palette(shades.map)),
            labels: labels(subject, &coarse).to_string(),
        }
    }
}

/// Encodes the cells, two bytes each, little-endian.
fn values(coarse: &CoarseField, fraction: impl Fn(f64) -> f64) -> Vec<u8> {
    let cells = (0..coarse.cells).flat_map(|i| (0..coarse.cells).map(move |j| (i, j)));
    let value = |(i, j)| {
        let pressure = coarse.pressure(i, j);
        let fraction = fraction(pressure);
        value((pressure > 0.0).then_some(fraction), coarse.is_relief(i, j))
    };
    cells.flat_map(|cell| value(cell).to_le_bytes()).collect()
}

/// The value of a cell whose pressure, if any, is this fraction of the largest.
fn value(fraction: Option<f64>, is_relief: bool) -> u16 {
    let [first, last] = PRESSURES.map(f64::from);
    match (fraction, is_relief) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the numbers of pressures"
        )]
        (Some(fraction), _) => (first + (last - first) * fraction).clamp(first, last) as u16,
        (None, true) => RELIEF,
        (None, false) => BARE,
    }
}

fn palette(map: ColourMap) -> Vec<u8> {
    let shade = |shade: u8| {
        let Colour(red, green, blue) = map.at(f64::from(shade) / 255.0);
        [red, green, blue]
    };
    (0..=u8::MAX).flat_map(shade).collect()
}

/// The end labels and the names of the axes.
fn labels(subject: &Subject<'_>, coarse: &CoarseField) -> serde_json::Value {
    let metres = subject.metres(coarse.farthest());
    let (pascals, shades) = subject.pressures();
    let along = |[from, to]: [f64; 2], symbol| {
        let end = |x: f64| labels::tick(x / metres.divisor, (to - from) / metres.divisor);
        [
            end(from),
            end(to),
            labels::axis_title(symbol, &metres.label),
        ]
    };
    let top = display::significant(shades.to, 4);
    serde_json::json!({
        "p": format!("p up to {}", format!("{top} {}", pascals.label).trim_end()),
        "x": along(coarse.x, "x"),
        "y": along(coarse.y, "y"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pressures_are_distinguished_from_unloaded_elements() {
        assert_eq!(value(None, false), BARE);
        assert_eq!(value(None, true), RELIEF);
        assert_eq!(value(Some(1e-9), false), PRESSURES[0]);
        assert_eq!(value(Some(1.0), true), PRESSURES[1]);
    }
}
