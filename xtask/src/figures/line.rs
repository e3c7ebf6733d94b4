//! A curve: what it is called, how it is drawn, and its points.

use std::fmt::Write as _;

use pellicle_cli::drawing::Colour;
use pellicle_cli::drawing::Dash;

/// A curve in one or more parts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    /// What it is, in the legend and in the table.
    pub name: String,
    pub colour: Colour,
    pub dash: Dash,
    /// In pixels.
    pub width: f64,
    /// Whether its points are marked.
    pub is_marked: bool,
    /// The parts, each a list of points.
    pub parts: Vec<Vec<(f64, f64)>>,
}

impl Line {
    /// The width of most lines.
    pub(super) const WIDTH: f64 = 2.2;

    /// All its points.
    pub(super) fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.parts.iter().flatten().copied()
    }
}

/// A table of the points of curves: panel, curve, x, y, every bit of the numbers.
pub(super) fn csv<'a>(panels: impl IntoIterator<Item = (&'a str, &'a [Line])>) -> String {
    let mut text = String::from("panel,curve,x,y\n");
    for (panel, lines) in panels {
        for line in lines {
            let name = quoted(&line.name);
            for (x, y) in line.points() {
                // Writing to a string does not fail.
                let _ = writeln!(text, "{},{name},{x:e},{y:e}", quoted(panel));
            }
        }
    }
    text
}

/// A text as a cell of a table.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_holds_every_bit_of_every_point() {
        let third = 1.0 / 3.0;
        let line = Line {
            name: "a, b".into(),
            colour: Colour(0, 0, 0),
            dash: Dash::Solid,
            width: Line::WIDTH,
            is_marked: false,
            parts: vec![vec![(1.0, third)], vec![(2.0, -third)]],
        };
        let table = csv([("p", [line].as_slice())]);
        let rows: Vec<_> = table.lines().collect();
        assert_eq!(rows.len(), 3);
        assert!(rows[1].starts_with("\"p\",\"a, b\",1e0,"));
        let last: f64 = rows[2].rsplit(',').next().unwrap().parse().unwrap();
        assert_eq!(last.to_bits(), (-third).to_bits());
    }
}
