//! A field of lengths over the surface (heights of a measured surface, gap or displacement), as a map with the outline
//! of the contact.

use crate::axes::labels;
use crate::sheet::colour_map::ColourScale;
use crate::sheet::colours;
use crate::sheet::raster::Raster;
use crate::sheet::svg::Stroke;
use crate::step::crop::Crop;
use crate::step::pressure_map;
use crate::step::subject::Subject;
use pellicle::result::fields::Fields;

/// A field of lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldMap {
    /// Heights of the relief below its highest point.
    Heights,
    /// The gap between indenter and surface.
    Gap,
    /// The displacement of the body's surface.
    Displacement,
}

impl FieldMap {
    /// Describes the field in words.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Heights => "height f*",
            Self::Gap => "gap g",
            Self::Displacement => "displacement u",
        }
    }

    fn values<'a>(self, fields: &Fields<'a>) -> &'a [f64] {
        match self {
            Self::Heights => fields.profile,
            Self::Gap => fields.gap,
            Self::Displacement => fields.displacement,
        }
    }

    /// Draws the picture as SVG.
    #[must_use]
    pub fn draw(self, subject: &Subject<'_>) -> String {
        let fields = &subject.fields;
        let crop = Crop::around_contact(fields.pressure, fields.size);
        let blocks = CoarseValues::new(fields, self.values(fields), &crop);
        let [from, to] = blocks.extent();
        let scale = subject.metres(from.abs().max(to.abs()));
        let shades = ColourScale {
            map: subject.style.colours,
            from,
            to,
        };
        let mut svg = subject
            .style
            .sheet(pressure_map::WIDTH, pressure_map::HEIGHT);
        let left = pressure_map::MAP.left;
        subject.draw_heading(&mut svg, left, pressure_map::WIDTH - left, "");
        let (panel, metres) = pressure_map::panel(subject, blocks.ends);
        let place = pressure_map::within(&panel, blocks.ends, metres);
        let cells = blocks.cells;
        let colour = |i: usize, j: usize| {
            let value = blocks.values[i * cells + cells - 1 - j];
            if value.is_finite() {
                shades.colour(value)
            } else {
                colours::BARE
            }
        };
        svg.image(place, &Raster::of(cells, cells, colour));
        let contact = |i, j| blocks.contact[i * cells + j];
        // Black on white, so that the outline is visible at both ends of the colour scale.
        let [halo, line] = [colours::WHITE, colours::INK].map(pressure_map::pen);
        let halo = Stroke {
            width: 3.0 * halo.width,
            ..halo
        };
        for stroke in [halo, line] {
            pressure_map::draw_outline(&mut svg, place, cells, contact, stroke);
        }
        panel.draw_axes(&mut svg);
        let in_its_unit = ColourScale {
            from: from / scale.divisor,
            to: to / scale.divisor,
            ..shades
        };
        let title = labels::axis_title(self.title(), &scale.label);
        pressure_map::draw_bar(&mut svg, &in_its_unit, &title);
        svg.finish()
    }
}

/// The part of a field that is shown, averaged over blocks if it is finer than the picture.
struct CoarseValues {
    /// Cells per side.
    cells: usize,
    /// Ends of the sides along x and along y, m.
    ends: [[f64; 2]; 2],
    /// Mean of the finite values of each block; NaN if there are none.
    values: Vec<f64>,
    /// Whether an element of the block carries pressure.
    contact: Vec<bool>,
}

impl CoarseValues {
    fn new(fields: &Fields<'_>, values: &[f64], crop: &Crop) -> Self {
        let block = crop.x.len().div_ceil(pressure_map::CELLS).max(1);
        let cells = crop.x.len().div_ceil(block);
        let range = |start: usize, i: usize| {
            let first = start + i * block;
            first..(first + block).min(fields.size)
        };
        let mut blocks = Self {
            cells,
            ends: [crop.x.start, crop.y.start]
                .map(|start| [start, start + cells * block].map(|i| fields.edge(i))),
            values: Vec::with_capacity(cells * cells),
            contact: Vec::with_capacity(cells * cells),
        };
        for e in 0..cells * cells {
            let (rows, columns) = (
                range(crop.x.start, e / cells),
                range(crop.y.start, e % cells),
            );
            let elements = rows.flat_map(|i| columns.clone().map(move |j| i * fields.size + j));
            let (mut sum, mut count, mut presses) = (0.0, 0, false);
            for e in elements {
                presses |= fields.pressure[e] > 0.0;
                if values[e].is_finite() {
                    sum += values[e];
                    count += 1;
                }
            }
            blocks.values.push(sum / f64::from(count));
            blocks.contact.push(presses);
        }
        blocks
    }

    /// Returns the smallest and the largest value, or an interval around them if they are equal.
    fn extent(&self) -> [f64; 2] {
        let finite = || {
            self.values
                .iter()
                .copied()
                .filter(|value| value.is_finite())
        };
        let low = finite().fold(f64::INFINITY, f64::min);
        let high = finite().fold(f64::NEG_INFINITY, f64::max);
        match (high - low).partial_cmp(&0.0) {
            Some(std::cmp::Ordering::Greater) if (high - low).is_finite() => [low, high],
            Some(std::cmp::Ordering::Equal) if low != 0.0 => [low.min(0.0), low.max(0.0)],
            _ => [0.0, 1.0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_hold_the_mean_of_their_finite_values_and_the_extent_covers_all() {
        let size = 2 * pressure_map::CELLS;
        let mut gap = vec![1.0; size * size];
        // The first block holds 3, 5, an infinity and a NaN.
        (gap[0], gap[1]) = (3.0, 5.0);
        (gap[size], gap[size + 1]) = (f64::INFINITY, f64::NAN);
        let zeros = vec![0.0; size * size];
        let mask = vec![false; size * size];
        let fields = Fields {
            side: 1.0,
            size,
            pressure: &zeros,
            displacement: &zeros,
            gap: &gap,
            shortening: &zeros,
            plastic_depth: &[],
            profile: &zeros,
            mask: &mask,
        };
        let crop = Crop {
            x: 0..size,
            y: 0..size,
        };
        let blocks = CoarseValues::new(&fields, &gap, &crop);
        assert_eq!((blocks.cells, blocks.values[0]), (pressure_map::CELLS, 4.0));
        assert_eq!(blocks.extent(), [1.0, 4.0]);
        assert_eq!(
            CoarseValues::new(&fields, &zeros, &crop).extent(),
            [0.0, 1.0]
        );
        assert!(!blocks.contact[0]);
    }
}
