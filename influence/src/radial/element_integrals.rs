//! `∫ T/ρ dA` over one element: along its edges if it is near, by a product rule if it is far.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use super::functions::{Area, RadialFunctions, Worst, Yardstick};
use super::tabulate::NEAR;
use crate::element::edges::{Edge, edges};
use crate::element::product_rule::{AtBorder, ProductRule};
use crate::numerics::quadrature::{Node, legendre_of};

/// Largest error of the rules before their borders are moved outwards.
const LARGEST_RULE_ERROR: f64 = 2e-13;

/// Number of times the borders are moved outwards before the remaining error is accepted.
const ATTEMPTS: usize = 4;

/// Ratio of the element sizes with which a rule is tested: the error of a rule of p points, `κ^(2p) e^(−κρ)`, has a
/// maximum half a decade wide.
const STEP: f64 = 1.5;

/// Size of the smallest elements with which the rules are tested, as a fraction of the top layer's thickness; smaller
/// ones see a homogeneous body.
const SMALLEST: f64 = 0.1;

/// Bound on the rounding of the sums over points and edges, measured at the loaded element, where it is largest.
const ROUNDING: f64 = 2e-14;

/// `∫ T/ρ dA` over a far element, in half sides; `scale` is half a side over the thickness.
pub(crate) fn far_integral(
    functions: &RadialFunctions,
    rule: &ProductRule,
    scale: f64,
    offset: [usize; 2],
) -> f64 {
    let squared = scale * scale;
    // T/ρ = (a/H) T/t
    let term = |(square, weight): (f64, f64)| weight * functions.over_root(squared * square);
    scale * rule.points(offset).map(term).sum::<f64>()
}

/// Twenty points per edge: `1/ρ²` seen from half a side away is singular at ±i, which leaves (1+√2)^(−40) = 5e-16.
static LINE: LazyLock<Vec<Node>> = LazyLock::new(legendre_of::<20>);

/// `∫ T/ρ dA` over a near element, in half sides; `scale` is half a side over the thickness.
///
/// `Σ_e d_e ∫_e P/ρ² dl`. A constant in P adds `2π` times itself for the loaded element and nothing for any other, so
/// where the constant is most of P it is left out and added exactly.
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

/// Moves the borders of the rules to where their errors are small, and adds these errors to that of the functions.
pub(crate) fn fit_borders(functions: &mut RadialFunctions) {
    let mut worst = error_of_rules(functions);
    for _ in 0..ATTEMPTS {
        if worst.error <= LARGEST_RULE_ERROR || !worst.error.is_finite() {
            break;
        }
        functions.tighten_borders(LARGEST_RULE_ERROR / worst.error / 2.0);
        worst = error_of_rules(functions);
    }
    worst.error += ROUNDING;
    functions.add_error(worst);
}

/// The largest difference between each rule and the next finer one, at the border between them.
fn error_of_rules(functions: &RadialFunctions) -> Worst {
    let borders = functions.borders().each();
    let errors = borders.map(|border| error_at_border(functions, &border));
    errors.fold(Worst::NONE, Worst::larger)
}

fn error_at_border(functions: &RadialFunctions, border: &AtBorder) -> Worst {
    let [start, end] = functions.ends();
    let distance = 2.0 * border.offset[0] as f64;
    let mut yardstick = Yardstick::new(functions);
    // The panels start at NEAR thicknesses of the top layer.
    let smallest = SMALLEST * start / NEAR;
    let scales = std::iter::successors(Some(smallest), |scale| Some(STEP * scale));
    let errors = scales
        .take_while(|scale| scale * distance < end)
        .map(|scale| {
            let integral = |rule| far_integral(functions, rule, scale, border.offset);
            let better = match border.finer {
                Some(finer) => integral(finer),
                None => near_integral(functions, scale, border.offset),
            };
            // The integral over an element is 4/ρ times T.
            let error = (integral(border.rule) - better).abs() * distance / 4.0;
            let t = scale * distance;
            let scale = yardstick.at(t, better.abs() * distance / 4.0);
            Worst {
                error: error / scale,
                t,
            }
        });
    errors.fold(Worst::NONE, Worst::larger)
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

    use super::{LARGEST_RULE_ERROR, error_of_rules, fit_borders};
    use crate::radial::RadialFunctions;

    fn functions(layers: &[[f64; 3]], base: [f64; 2]) -> RadialFunctions {
        let material = |modulus, ratio| Material::new(modulus, ratio).unwrap();
        let layers = layers.iter().map(|[thickness, modulus, ratio]| {
            Layer::new(*thickness, material(*modulus, *ratio), Interface::Bonded).unwrap()
        });
        let base = Base::HalfSpace(material(base[0], base[1]));
        RadialFunctions::new(&Foundation::new(layers.collect(), base).unwrap())
    }

    #[test]
    fn the_usual_borders_are_not_moved() {
        let mut functions = functions(&[[1.0, 10.0, 0.3]], [1.0, 0.3]);
        let borders = *functions.borders();
        fit_borders(&mut functions);
        assert_eq!(*functions.borders(), borders);
    }

    #[test]
    fn a_buried_soft_layer_moves_the_borders_outward() {
        let layers = [
            [0.52, 1.4, 0.14],
            [0.25, 0.83, 0.25],
            [0.65, 20.0, 0.5],
            [1.45, 0.016, 0.5],
        ];
        let mut functions = functions(&layers, [230.0, 0.02]);
        assert!(error_of_rules(&functions).error > 10.0 * LARGEST_RULE_ERROR);
        fit_borders(&mut functions);
        assert!(error_of_rules(&functions).error <= LARGEST_RULE_ERROR);
    }
}
