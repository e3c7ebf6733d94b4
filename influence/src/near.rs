//! The integral over a near element, by its edges.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use crate::edges::{Edge, edges};
use crate::gauss::{Node, legendre_of};
use crate::radial::{Area, RadialFunctions};

/// Twenty points an edge: `1/ρ²` seen from half a side away is singular at ±i, which leaves (1+√2)^(−40) = 5e-16.
static LINE: LazyLock<Vec<Node>> = LazyLock::new(legendre_of::<20>);

/// `∫ T/ρ dA` over a near element, in half sides; `scale` is half a side over the thickness.
///
/// `Σ_e d_e ∫_e P/ρ² dl`. A constant in P adds `2π` times itself for the loaded element, and nothing for any other, so where the constant
/// is most of P it is left out and added exactly.
pub(crate) fn near_integral(functions: &RadialFunctions, scale: f64, offset: [usize; 2]) -> f64 {
    let edges = edges(offset);
    let nearest = edges.iter().map(nearest).fold(f64::INFINITY, f64::min);
    let form = functions.area_from(scale * nearest);
    let sum: f64 = edges
        .iter()
        .map(|edge| edge_integral(functions, scale, edge, form))
        .sum();
    let own = match form {
        Area::Reduced if offset == [0, 0] => TAU * functions.constant(),
        _ => 0.0,
    };
    (sum + own) / scale
}

/// `d ∫ P/ρ² dl` along one edge.
fn edge_integral(functions: &RadialFunctions, scale: f64, edge: &Edge, form: Area) -> f64 {
    let middle = f64::midpoint(edge.from, edge.to);
    let term = |node: &Node| {
        let square = edge.distance.powi(2) + (middle + node.position).powi(2);
        node.weight * functions.area(scale * square.sqrt(), form) / square
    };
    edge.distance * LINE.iter().map(term).sum::<f64>()
}

/// Distance of the edge's nearest point.
fn nearest(edge: &Edge) -> f64 {
    edge.distance.hypot(0_f64.max(edge.from))
}
