//! The outline of a set of elements: the edges between elements inside and outside, joined into lines.

/// Right, up, left, down. The set lies on the left of an edge.
const DIRECTIONS: [(isize, isize); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// The edges by the corner that they leave: bit `d` of a corner stands for the edge in direction `d`.
struct BoundaryEdges {
    corners: usize,
    leaving: Vec<u8>,
}

/// Returns the outlines of the elements of a field of `cells` × `cells` for which `inside(i, j)` holds: lines through
/// corners of elements. A closed line ends at its first corner. The rim of the field is not an outline.
#[must_use]
pub fn trace(cells: usize, inside: impl Fn(usize, usize) -> bool) -> Vec<Vec<(usize, usize)>> {
    let mut edges = BoundaryEdges::new(cells, inside);
    let mut lines = Vec::new();
    // Start with the lines that begin at the rim, so that none is begun in its middle.
    for corner in edges.beginnings() {
        while edges.leaving[corner] != 0 {
            lines.push(edges.follow(corner));
        }
    }
    for corner in 0..edges.leaving.len() {
        while edges.leaving[corner] != 0 {
            lines.push(edges.follow(corner));
        }
    }
    lines
}

impl BoundaryEdges {
    fn new(cells: usize, inside: impl Fn(usize, usize) -> bool) -> Self {
        let corners = cells + 1;
        let leaving = vec![0; corners * corners];
        let mut edges = Self { corners, leaving };
        for i in 0..cells {
            for j in 0..cells {
                if inside(i, j) {
                    edges.add(0, (i, j), j > 0 && !inside(i, j - 1));
                    edges.add(1, (i + 1, j), i + 1 < cells && !inside(i + 1, j));
                    edges.add(2, (i + 1, j + 1), j + 1 < cells && !inside(i, j + 1));
                    edges.add(3, (i, j + 1), i > 0 && !inside(i - 1, j));
                }
            }
        }
        edges
    }

    fn add(&mut self, direction: usize, (i, j): (usize, usize), is_side: bool) {
        self.leaving[i * self.corners + j] |= u8::from(is_side) << direction;
    }

    /// Corners on the rim from which an edge starts.
    fn beginnings(&self) -> Vec<usize> {
        let last = self.corners - 1;
        let on_rim = |e: usize| {
            let (i, j) = (e / self.corners, e % self.corners);
            i == 0 || j == 0 || i == last || j == last
        };
        let leaves = |e: &usize| self.leaving[*e] != 0 && on_rim(*e);
        (0..self.leaving.len()).filter(leaves).collect()
    }

    /// Follows the edges from a corner until none continues or the corner is reached again, and removes them.
    fn follow(&mut self, start: usize) -> Vec<(usize, usize)> {
        let mut line = vec![self.place(start)];
        let (mut at, mut heading) = (start, None);
        while let Some(direction) = self.next(at, heading) {
            if heading.is_some_and(|before| before != direction) {
                line.push(self.place(at));
            }
            self.leaving[at] &= !(1 << direction);
            at = self.neighbour(at, direction);
            heading = Some(direction);
            if at == start {
                break;
            }
        }
        line.push(self.place(at));
        line
    }

    /// Returns the next edge, the leftmost if there are several, so that elements that meet at a corner stay apart.
    fn next(&self, at: usize, heading: Option<usize>) -> Option<usize> {
        let first = heading.map_or(0, |heading| heading + 1);
        let turns = [first, first + 3, first + 2, first + 1].map(|direction| direction % 4);
        turns
            .into_iter()
            .find(|direction| self.leaving[at] & (1 << direction) != 0)
    }

    fn neighbour(&self, at: usize, direction: usize) -> usize {
        let (i, j) = self.place(at);
        let (di, dj) = DIRECTIONS[direction];
        i.saturating_add_signed(di) * self.corners + j.saturating_add_signed(dj)
    }

    fn place(&self, corner: usize) -> (usize, usize) {
        (corner / self.corners, corner % self.corners)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outlines(rows: &[&str]) -> Vec<Vec<(usize, usize)>> {
        trace(rows.len(), |i, j| rows[j].as_bytes()[i] == b'x')
    }

    #[test]
    fn a_block_has_four_corners_and_is_closed() {
        let lines = outlines(&["....", ".xx.", ".xx.", "...."]);
        assert_eq!(lines, [[(1, 1), (3, 1), (3, 3), (1, 3), (1, 1)]]);
    }

    #[test]
    fn elements_that_meet_at_a_corner_have_separate_outlines() {
        let lines = outlines(&["....", ".x..", "..x.", "...."]);
        assert_eq!(lines.len(), 2);
        assert!(
            lines
                .iter()
                .all(|line| line.len() == 5 && line[0] == line[4])
        );
    }

    #[test]
    fn a_hole_has_an_outline_and_the_edge_of_the_grid_none() {
        assert_eq!(outlines(&["xxx", "x.x", "xxx"]).len(), 1);
        assert!(outlines(&["xx", "xx"]).is_empty());
    }

    #[test]
    fn an_outline_that_ends_at_the_edge_of_the_grid_is_one_open_line() {
        assert_eq!(
            outlines(&["xx..", "xx..", "xx..", "xx.."]),
            [[(2, 0), (2, 4)]]
        );
    }

    #[test]
    fn every_element_side_is_traced_once() {
        let inside = |i: usize, j: usize| (i * 7 + j * 5 + i * j).is_multiple_of(3);
        let lines = trace(20, inside);
        let length = |line: &Vec<(usize, usize)>| -> usize {
            let side = |pair: &[(usize, usize)]| {
                pair[0].0.abs_diff(pair[1].0) + pair[0].1.abs_diff(pair[1].1)
            };
            line.windows(2).map(side).sum()
        };
        let sides = (0..20).flat_map(|i| (0..19).map(move |j| (i, j)));
        let wanted: usize = sides
            .map(|(i, j)| {
                usize::from(inside(i, j) != inside(i, j + 1))
                    + usize::from(inside(j, i) != inside(j + 1, i))
            })
            .sum();
        assert_eq!(lines.iter().map(length).sum::<usize>(), wanted);
    }
}
