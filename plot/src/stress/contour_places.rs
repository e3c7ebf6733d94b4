//! Places for the labels of contours, chosen so that no two overlap.

use crate::sheet::colours;
use crate::sheet::svg::{Anchor, Rect, Svg};
use crate::stress::contour_lines::Polyline;

/// Font size, width of a letter relative to it, and margin around a text, in pixels.
const SIZE: f64 = 14.0;
const LETTER: f64 = 0.62;
const MARGIN: f64 = 3.0;

/// A line shorter than this many label widths has no label.
const MIN_LENGTH: f64 = 2.5;

/// Most labels of one level in one body.
const MAX_LABELS: usize = 3;

/// Positions of a label along its line, as parts of the length, best first.
const PARTS: [f64; 7] = [0.5, 0.35, 0.65, 0.25, 0.75, 0.15, 0.85];

/// Distance of a mark from its text, in pixels.
const FROM_MARK: f64 = 10.0;

/// The occupied places within a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct ContourPlaces {
    panel: Rect,
    taken: Vec<Rect>,
}

/// The rectangle that a text centred on a place occupies.
fn rectangle((x, y): (f64, f64), text: &str) -> Rect {
    let width = LETTER * SIZE * text.chars().count() as f64 + 2.0 * MARGIN;
    let height = SIZE + 2.0 * MARGIN;
    Rect::at((x - width / 2.0, y - height / 2.0), (width, height))
}

/// Draws a text on white, centred on a place.
pub fn boxed(svg: &mut Svg, place: (f64, f64), text: &str) {
    svg.rectangle(rectangle(place, text), colours::WHITE);
    svg.text(place, SIZE, Anchor::Middle, text);
}

impl ContourPlaces {
    /// Returns a panel without any text.
    #[must_use]
    pub fn new(panel: Rect) -> Self {
        Self {
            panel,
            taken: Vec::new(),
        }
    }

    /// Returns the centre of a text beside a mark, within the panel: on the right of the mark, or on its left if there
    /// is no room.
    #[must_use]
    pub fn beside_mark(&self, (x, y): (f64, f64), text: &str) -> (f64, f64) {
        let Rect { width, height, .. } = rectangle((x, y), text);
        let shift = FROM_MARK + width / 2.0;
        let x = if x + shift + width / 2.0 < self.panel.right() {
            x + shift
        } else {
            x - shift
        };
        let half = height / 2.0 + 2.0;
        (
            x,
            y.clamp(self.panel.top + half, self.panel.bottom() - half),
        )
    }

    /// Reserves the place of a mark and its text.
    pub fn reserve_mark(&mut self, place: (f64, f64), text: &str) {
        let beside = self.beside_mark(place, text);
        self.taken.push(rectangle(beside, text));
        self.taken.push(rectangle(place, "oo"));
    }

    /// Reserves the place of a text in the corner left of and below a point, or on the left side of the panel if that
    /// is occupied, and returns its centre.
    pub fn in_corner(&mut self, (right, top): (f64, f64), text: &str) -> (f64, f64) {
        let Rect { width, height, .. } = rectangle((right, top), text);
        let y = top + 4.0 + height / 2.0;
        let on_right = (right - 4.0 - width / 2.0, y);
        let on_left = (self.panel.left + 4.0 + width / 2.0, y);
        let place = if self.is_free(&rectangle(on_right, text)) {
            on_right
        } else {
            on_left
        };
        self.taken.push(rectangle(place, text));
        place
    }

    /// Reserves a horizontal line across the panel.
    pub fn reserve_line(&mut self, y: f64) {
        let Rect { left, width, .. } = self.panel;
        self.taken.push(Rect::at((left, y - 1.0), (width, 2.0)));
    }

    /// Reserves the place of a text on a horizontal line, at the left side of the panel, and returns its centre.
    pub fn on_left(&mut self, y: f64, text: &str) -> (f64, f64) {
        let width = rectangle((0.0, y), text).width;
        let place = (self.panel.left + 8.0 + width / 2.0, y);
        self.taken.push(rectangle(place, text));
        place
    }

    /// Draws the label on the longest of these lines, where there is room.
    pub fn draw_labels(&mut self, svg: &mut Svg, lines: &[Polyline], label: &str) {
        let width = rectangle((0.0, 0.0), label).width;
        let mut long: Vec<_> = (lines.iter().map(|line| (length(line), line)))
            .filter(|(length, _)| *length > MIN_LENGTH * width)
            .collect();
        long.sort_by(|one, other| other.0.total_cmp(&one.0));
        for (length, line) in long.into_iter().take(MAX_LABELS) {
            let places = PARTS.iter().filter_map(|part| point(line, part * length));
            let free = places
                .into_iter()
                .find(|place| self.is_free(&rectangle(*place, label)));
            if let Some(place) = free {
                self.taken.push(rectangle(place, label));
                boxed(svg, place, label);
            }
        }
    }

    /// Whether a rectangle lies within the panel and overlaps nothing.
    fn is_free(&self, place: &Rect) -> bool {
        let panel = &self.panel;
        let is_within = place.left >= panel.left
            && place.right() <= panel.right()
            && place.top >= panel.top
            && place.bottom() <= panel.bottom();
        let meets = |other: &Rect| {
            place.left < other.right()
                && other.left < place.right()
                && place.top < other.bottom()
                && other.top < place.bottom()
        };
        is_within && !self.taken.iter().any(meets)
    }
}

fn distance(one: &(f64, f64), other: &(f64, f64)) -> f64 {
    (other.0 - one.0).hypot(other.1 - one.1)
}

fn length(line: &[(f64, f64)]) -> f64 {
    let pieces = line.windows(2).map(|pair| distance(&pair[0], &pair[1]));
    pieces.fold(0.0, |sum, piece| sum + piece)
}

/// Returns the first point of a line at least `far` from its beginning.
fn point(line: &[(f64, f64)], mut far: f64) -> Option<(f64, f64)> {
    for pair in line.windows(2) {
        far -= distance(&pair[0], &pair[1]);
        if far <= 0.0 {
            return Some(pair[1]);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const PANEL: Rect = Rect {
        left: 0.0,
        top: 0.0,
        width: 400.0,
        height: 100.0,
    };

    #[test]
    fn contour_labels_do_not_overlap_and_short_contours_have_none() {
        let mut svg = Svg::new(400.0, 100.0);
        let mut places = ContourPlaces::new(PANEL);
        let line = |y: f64, to: f64| vec![(0.0, y), (to / 2.0, y), (to, y)];
        places.draw_labels(&mut svg, &[line(50.0, 400.0)], "1.5");
        // The same place again, one at the rim, and a line that is too short.
        places.draw_labels(&mut svg, &[line(50.0, 400.0)], "2");
        places.draw_labels(&mut svg, &[line(1.0, 400.0)], "3");
        places.draw_labels(&mut svg, &[line(80.0, 30.0)], "4");
        assert_eq!(places.taken.len(), 1, "{places:?}");
        assert_eq!(svg.finish().matches("<text").count(), 1);
    }

    #[test]
    fn the_text_of_a_mark_stays_inside_the_panel() {
        let places = ContourPlaces::new(PANEL);
        let right = places.beside_mark((50.0, 50.0), "1.2 GPa");
        assert!(right.0 > 50.0 && right.1 == 50.0);
        let left = places.beside_mark((390.0, 0.0), "1.2 GPa");
        assert!(left.0 < 390.0 && left.1 > 8.0);
    }

    #[test]
    fn a_name_moves_to_the_other_corner_if_its_own_is_occupied() {
        let mut places = ContourPlaces::new(PANEL);
        let first = places.in_corner((400.0, 0.0), "layer");
        let second = places.in_corner((400.0, 0.0), "layer");
        assert!(first.0 > 300.0 && second.0 < 100.0);
    }
}
