//! Contour lines of a field on a rectangular mesh, by marching squares.

use std::collections::{BTreeMap, BTreeSet};

/// A line through a sequence of points.
pub type Polyline = Vec<(f64, f64)>;

/// Values at the nodes of a mesh, with `columns` nodes in each row, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Nodes in a row.
    pub columns: usize,
    /// The values.
    pub values: Vec<f64>,
}

/// The corners of a square, in cyclic order: side i leads from corner i to the next.
const CORNERS: [(usize, usize); 4] = [(0, 0), (1, 0), (1, 1), (0, 1)];

/// A side of a square, shared by two squares: its lower node, and whether it runs along a column.
type GridEdge = (usize, bool);

impl Mesh {
    fn rows(&self) -> usize {
        self.values.len() / self.columns.max(1)
    }

    /// Returns the lines on which the field has this value, as positions in columns and rows. The field is taken as
    /// linear along the sides of the squares. A closed line ends at its first point.
    #[must_use]
    pub fn lines_at(&self, level: f64) -> Vec<Polyline> {
        let mut next = BTreeMap::new();
        for row in 1..self.rows() {
            for column in 1..self.columns {
                self.cross([column - 1, row - 1], level, &mut next);
            }
        }
        let entered: BTreeSet<GridEdge> = next.values().copied().collect();
        // Start with the lines that begin at the rim, so that none is begun in its middle.
        let starts = next.keys().copied();
        let (inner, rim): (Vec<_>, Vec<_>) = starts.partition(|edge| entered.contains(edge));
        let mut lines = Vec::new();
        for start in rim.into_iter().chain(inner) {
            let mut line = vec![start];
            let mut at = start;
            while let Some(edge) = next.remove(&at) {
                line.push(edge);
                at = edge;
            }
            if line.len() > 1 {
                lines.push(line.iter().map(|edge| self.place(*edge, level)).collect());
            }
        }
        lines
    }

    /// Adds the line segments within a square, directed so that higher values always lie on the same side.
    fn cross(
        &self,
        [column, row]: [usize; 2],
        level: f64,
        next: &mut BTreeMap<GridEdge, GridEdge>,
    ) {
        let node = |corner: usize| {
            let (right, down) = CORNERS[corner % 4];
            (row + down) * self.columns + column + right
        };
        let is_high = |corner: usize| self.values[node(corner)] >= level;
        let edge = |side: usize| {
            let (one, other) = (node(side), node(side + 1));
            (one.min(other), side % 2 == 1)
        };
        // A line enters where the circuit passes to higher values, and leaves by the next side where it passes to lower
        // ones.
        for side in (0..4).filter(|side| !is_high(*side) && is_high(side + 1)) {
            let leaving = (side + 1..side + 4).find(|side| is_high(*side) && !is_high(side + 1));
            if let Some(leaving) = leaving {
                next.insert(edge(side), edge(leaving % 4));
            }
        }
    }

    /// Returns the point of a side at which the field has the value.
    fn place(&self, (node, is_down): GridEdge, level: f64) -> (f64, f64) {
        let other = if is_down {
            node + self.columns
        } else {
            node + 1
        };
        let [one, other] = [node, other].map(|node| self.values[node]);
        let part = ((level - one) / (other - one)).clamp(0.0, 1.0);
        let (column, row) = ((node % self.columns) as f64, (node / self.columns) as f64);
        if is_down {
            (column, row + part)
        } else {
            (column + part, row)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(columns: usize, rows: usize, value: impl Fn(f64, f64) -> f64) -> Mesh {
        let values = (0..rows)
            .flat_map(|row| (0..columns).map(move |column| (column as f64, row as f64)))
            .map(|(x, y)| value(x, y));
        Mesh {
            columns,
            values: values.collect(),
        }
    }

    #[test]
    fn a_plane_has_one_straight_contour_from_edge_to_edge() {
        let lines = mesh(9, 5, |x, y| x + 0.5 * y).lines_at(3.2);
        assert_eq!(lines.len(), 1);
        for (x, y) in &lines[0] {
            assert!((x + 0.5 * y - 3.2).abs() < 1e-12);
        }
        let ends = [lines[0][0].1, lines[0][lines[0].len() - 1].1];
        assert!(ends.contains(&0.0) && ends.contains(&4.0), "{ends:?}");
    }

    #[test]
    fn a_hill_has_a_closed_contour_of_its_radius() {
        let lines = mesh(41, 41, |x, y| -(x - 20.0).hypot(y - 20.0)).lines_at(-12.3);
        assert_eq!(lines.len(), 1);
        let line = &lines[0];
        assert_eq!(line[0], line[line.len() - 1]);
        // A cone is not linear along a side: the error is at most 1/8 of its second derivative, 1/12.3.
        for (x, y) in line {
            assert!(((x - 20.0).hypot(y - 20.0) - 12.3).abs() < 0.011);
        }
    }

    #[test]
    fn a_saddle_has_two_contours_and_values_outside_the_range_have_none() {
        let saddle = mesh(2, 2, |x, y| (x - 0.5) * (y - 0.5));
        assert_eq!(saddle.lines_at(0.0).len(), 2);
        assert!(saddle.lines_at(1.0).is_empty());
        assert!(saddle.lines_at(-1.0).is_empty());
        assert!(mesh(1, 5, |_, y| y).lines_at(2.5).is_empty());
    }
}
