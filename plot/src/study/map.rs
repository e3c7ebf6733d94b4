//! A number over two keys, as a map of colours, each cell with its number and ± where there is room.

use pellicle::display::significant;

use crate::axes::colour_bar::{self, BESIDE};
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colour_map::ColourScale;
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};
use crate::study::sample::{Sample, SampleError, SampledAxis, ends};

const LEFT: f64 = 112.0;
const TOP: f64 = heading::HEIGHT + 8.0;
const ASPECT: f64 = 0.9;
const BELOW: f64 = 84.0;
/// Height of a line of the legend, and size of its letters.
const ENTRY: f64 = 26.0;
const WORDS: f64 = 16.0;
/// Distance of the colour bar from the map, its width, and the room beside it.
const BAR: [f64; 3] = [18.0, 22.0, BESIDE + 4.0];
/// Most ticks of an axis, all of which have room for their labels.
const MOST_TICKS: usize = 10;
/// Size of the number in a cell, and the least width and height of a cell that holds it.
const NUMBER: f64 = 14.0;
const LEAST_CELL: [f64; 2] = [54.0, 36.0];
/// By how much a cell reaches below its neighbours, in pixels.
const OVERLAP: f64 = 0.4;
/// Below this part of full brightness a colour asks for white letters.
const DARK: f64 = 0.5;

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPicture {
    /// The two lines above.
    pub heading: [String; 2],
    /// The keys across and upwards.
    pub keys: [SampledAxis; 2],
    /// The values of each key, increasing.
    pub values: [Vec<f64>; 2],
    /// The title of the number.
    pub title: String,
    /// The numbers of all cases, the second key fastest; none without a case.
    pub samples: Vec<Option<Sample>>,
}

/// Draws the picture as SVG; `None` without a number, or with a single value of a key.
#[must_use]
pub fn draw(picture: &MapPicture, style: &Style) -> Option<String> {
    let shades = picture.shades(style)?;
    let [across, upwards] = [picture.edges(0)?, picture.edges(1)?];
    let width = style.drawn_width();
    let inside = width - LEFT - BAR.iter().sum::<f64>();
    let panel = Panel {
        place: Rect::at((LEFT, TOP), (inside, ASPECT * inside)),
        x: picture.axis(0, &across),
        y: picture.axis(1, &upwards),
    };
    let (place, legend) = (panel.place, picture.legend());
    let height = place.bottom() + BELOW + ENTRY * legend.len() as f64;
    let mut svg = style.sheet(width, height);
    if style.heading == Heading::Shown {
        let [title, numbers] = &picture.heading;
        heading::draw(&mut svg, LEFT, width - LEFT, title, numbers);
    }
    picture.draw_cells(&mut svg, &panel, [&across, &upwards], &shades);
    panel.draw_axes(&mut svg);
    let bar = Rect::at((place.right() + BAR[0], TOP), (BAR[1], place.height));
    colour_bar::draw(&mut svg, bar, &shades, &picture.title);
    for (i, words) in legend.iter().enumerate() {
        let y = place.bottom() + BELOW + ENTRY * i as f64;
        svg.text((LEFT, y), WORDS, Anchor::Start, words);
    }
    Some(svg.finish())
}

/// The edges of the cells around some values: halfway between them; none for a single value.
fn edges(values: &[f64], is_logarithmic: bool) -> Option<Vec<f64>> {
    let place = |value: &f64| if is_logarithmic { value.ln() } else { *value };
    let value = |place: f64| if is_logarithmic { place.exp() } else { place };
    let places: Vec<_> = values.iter().map(place).collect();
    let ([first, second, ..], [.., before, last]) = (&places[..], &places[..]) else {
        return None;
    };
    let between = places.windows(2).map(|pair| pair[0].midpoint(pair[1]));
    let first = first - 0.5 * (second - first);
    let last = last + 0.5 * (last - before);
    let edges = [first].into_iter().chain(between).chain([last]);
    Some(edges.map(value).collect())
}

/// A value of a key as it was given, as far as four digits tell.
fn label(value: f64) -> String {
    let rounded = significant(value, 4);
    let shortest = rounded.parse::<f64>().map(|value| value.to_string());
    shortest.map_or(rounded.clone(), |shortest| {
        if shortest.len() < rounded.len() {
            shortest
        } else {
            rounded
        }
    })
}

impl MapPicture {
    /// The axis of a key, from the first edge to the last, with ticks at values of cells.
    fn axis(&self, key: usize, edges: &[f64]) -> Axis {
        let values = &self.values[key];
        let stride = values.len().div_ceil(MOST_TICKS);
        let ticks = values.iter().step_by(stride);
        Axis {
            from: edges[0],
            to: edges[edges.len() - 1],
            title: self.keys[key].title.clone(),
            ticks: ticks.map(|value| (*value, label(*value))).collect(),
            is_logarithmic: self.keys[key].is_logarithmic,
        }
    }

    fn shades(&self, style: &Style) -> Option<ColourScale> {
        let samples = self.samples.iter().flatten();
        let [from, to] = ends(samples.filter_map(|sample| sample.value))?;
        let least = from + from.abs().max(f64::MIN_POSITIVE);
        Some(ColourScale {
            map: style.colours,
            from,
            to: if to > from { to } else { least },
        })
    }

    fn edges(&self, key: usize) -> Option<Vec<f64>> {
        edges(&self.values[key], self.keys[key].is_logarithmic)
    }

    /// The number of a cell with its ±.
    fn number(&self, i: usize, j: usize) -> Option<(f64, SampleError)> {
        let sample = (*self.samples.get(i * self.values[1].len() + j)?)?;
        Some((sample.value?, sample.error))
    }

    fn legend(&self) -> Vec<String> {
        let count = |is: &dyn Fn(Option<f64>, Option<SampleError>) -> bool| {
            let samples = self.samples.iter().map(|sample| {
                let sample = sample.as_ref();
                (sample.and_then(|of| of.value), sample.map(|of| of.error))
            });
            samples.filter(|(value, error)| is(*value, *error)).count()
        };
        let gaps = count(&|value, _| value.is_none());
        let open =
            count(&|value, error| value.is_some() && error == Some(SampleError::NotResolved));
        let told = [
            (gaps, "×", "no certified result"),
            (open, "±?", "error not resolved"),
        ];
        let told = told.into_iter().filter(|(count, ..)| *count > 0);
        let all = self.samples.len();
        told.map(|(count, sign, what)| format!("{sign} {count} of {all} cases: {what}"))
            .collect()
    }

    fn draw_cells(
        &self,
        svg: &mut Svg,
        panel: &Panel,
        [across, upwards]: [&[f64]; 2],
        shades: &ColourScale,
    ) {
        for (i, x) in across.windows(2).enumerate() {
            for (j, y) in upwards.windows(2).enumerate() {
                let [(left, bottom), (right, top)] = [panel.at(x[0], y[0]), panel.at(x[1], y[1])];
                // Neighbours overlap, so that no paper is seen between them.
                let (width, height) = (right - left + OVERLAP, bottom - top + OVERLAP);
                let cell = Rect::at((left, top - OVERLAP), (width, height));
                match self.number(i, j) {
                    Some(number) => draw_cell(svg, cell, number, shades.colour(number.0)),
                    None => draw_gap(svg, cell),
                }
            }
        }
    }
}

/// A cell in its colour, with its number and ± where there is room.
fn draw_cell(svg: &mut Svg, cell: Rect, (value, error): (f64, SampleError), colour: Colour) {
    svg.rectangle(cell, colour);
    let [width, height] = LEAST_CELL;
    if cell.width < width || cell.height < height {
        return;
    }
    let ink = if brightness(colour) < DARK {
        colours::WHITE
    } else {
        colours::INK
    };
    let middle = cell.left.midpoint(cell.right());
    let y = cell.top.midpoint(cell.bottom());
    let error = match error {
        SampleError::None => String::new(),
        SampleError::Known(error) => format!("± {}", significant(error, 1)),
        SampleError::NotResolved => "±?".to_owned(),
    };
    let shift = if error.is_empty() { 0.0 } else { 0.6 * NUMBER };
    svg.coloured_text((middle, y - shift), NUMBER, ink, &significant(value, 3));
    svg.coloured_text((middle, y + shift), 0.85 * NUMBER, ink, &error);
}

/// A cell without a number, crossed.
fn draw_gap(svg: &mut Svg, cell: Rect) {
    svg.rectangle(cell, colours::WHITE);
    let (left, right, top, bottom) = (cell.left, cell.right(), cell.top, cell.bottom());
    let stroke = Stroke::new(colours::RELIEF_OUTLINE, 1.0);
    svg.line(&[(left, top), (right, bottom)], stroke);
    svg.line(&[(left, bottom), (right, top)], stroke);
}

/// The brightness of a colour, from 0 to 1 (ITU-R BT.601).
fn brightness(Colour(red, green, blue): Colour) -> f64 {
    (0.299 * f64::from(red) + 0.587 * f64::from(green) + 0.114 * f64::from(blue)) / 255.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> MapPicture {
        let number = |value: f64, error| {
            Some(Sample {
                value: Some(value),
                error,
            })
        };
        let key = |title: &str, is_logarithmic| SampledAxis {
            title: title.into(),
            is_logarithmic,
        };
        MapPicture {
            heading: ["study".into(), "6 cases".into()],
            keys: [
                key("surface.period, µm", true),
                key("surface.area_fraction", false),
            ],
            values: [vec![1.0, 2.0, 4.0], vec![0.1, 0.3]],
            title: "max pressure, GPa".into(),
            samples: vec![
                number(1.25, SampleError::Known(0.02)),
                number(1.5, SampleError::NotResolved),
                number(2.0, SampleError::None),
                None,
                number(3.0, SampleError::None),
                number(4.0, SampleError::None),
            ],
        }
    }

    #[test]
    fn cells_have_their_numbers_and_gaps_are_told() {
        let svg = draw(&picture(), &Style::default()).expect("numbers");
        let gap = "× 1 of 6 cases: no certified result";
        for words in ["1.25", "± 0.02", "±?", gap] {
            assert!(svg.contains(words), "{words}");
        }
    }

    #[test]
    fn ticks_stand_at_the_values_of_cells_where_there_is_room() {
        let mut picture = picture();
        picture.values = [vec![0.125, 2.0, 1234.567], (0..25).map(f64::from).collect()];
        let axis = |key: usize| picture.axis(key, &picture.edges(key).expect("several values"));
        let labels: Vec<_> = axis(0).ticks.into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["0.125", "2", "1235"]);
        let ticks: Vec<_> = axis(1).ticks.into_iter().map(|(tick, _)| tick).collect();
        assert_eq!(ticks, [0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0, 21.0, 24.0]);
    }

    #[test]
    fn edges_are_halfway_between_the_values_on_their_scale() {
        let on_logarithms = edges(&[1.0, 4.0, 16.0], true).expect("three values");
        for (edge, wanted) in on_logarithms.iter().zip([0.5, 2.0, 8.0, 32.0]) {
            // A few roundings of logarithm and exponential.
            assert!((edge / wanted - 1.0).abs() < 1e-12, "{on_logarithms:?}");
        }
        assert_eq!(edges(&[1.0], false), None);
        assert_eq!(edges(&[1.0, 3.0], false), Some(vec![0.0, 2.0, 4.0]));
    }

    #[test]
    fn a_map_needs_two_values_of_each_key() {
        let mut line = picture();
        line.values[1].truncate(1);
        assert_eq!(draw(&line, &Style::default()), None);
    }
}
