//! The boundary of a square element as seen from a field point.
//!
//! An area integral `∫ div(r P(r)/r²) dA` over the element is the boundary integral `Σ_e d_e ∫_e P(r)/r² dl`, with
//! `d_e` the outward signed distance from the field point to the line of edge e. Lengths are in units of half the
//! element's side, so that the element is 2 × 2 and the field point, the centre of another element of the same
//! grid, is never on an edge's line: `|d_e|` is an odd number.

/// One edge of the loaded element: the points at `distance` across and `from … to` along, measured from the field
/// point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Edge {
    /// Outward signed distance from the field point to the edge's line, in half sides.
    pub distance: f64,
    /// Nearer end along the line, in half sides (−1 where the field point faces the edge).
    pub from: f64,
    /// Farther end along the line, in half sides; `from` + 2.
    pub to: f64,
}

/// The four edges of the element `offset` elements away from the field point.
pub(crate) fn edges(offset: [usize; 2]) -> [Edge; 4] {
    let [x, y] = offset.map(|count| 2.0 * count as f64);
    let edge = |distance: f64, along: f64| Edge {
        distance,
        from: along - 1.0,
        to: along + 1.0,
    };
    [
        edge(x + 1.0, y),
        edge(1.0 - x, y),
        edge(y + 1.0, x),
        edge(1.0 - y, x),
    ]
}

#[cfg(test)]
mod tests {
    use super::edges;

    /// `P = r²/2` has div(r P/r²) = 1, so the boundary integral is the area, 4.
    #[test]
    fn boundary_integral_gives_the_area_at_every_offset() {
        for offset in [[0, 0], [1, 0], [1, 1], [7, 3], [0, 5]] {
            let area: f64 = edges(offset)
                .iter()
                .map(|edge| edge.distance * (edge.to - edge.from) / 2.0)
                .sum();
            assert!((area - 4.0).abs() < 1e-14, "{offset:?}: {area}");
        }
    }
}
