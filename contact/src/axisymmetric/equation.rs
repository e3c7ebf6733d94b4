//! The integral equation at a contact radius, and its solutions.
//!
//! The solution is `g = r + h` with the right-hand side r, known in closed form, and a smooth h, the polynomial through
//! its values at the nodes of each piece. Pieces shrink to three thicknesses of the top layer towards the edge and a
//! kink of r, where alone h varies so fast; the integrals are taken on finer pieces.

use std::sync::LazyLock;

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::layer_kernel::LayerKernel;
use super::quadrature::{POINTS, RULE, composite, halved};
use crate::ContactError;

/// Length of a piece at the edge, in thicknesses of the top layer. The kernel is analytic up to two thicknesses from
/// the real axis, so 16 points leave an error of 5e-16.
const PIECE: f64 = 3.0;

/// The shortest piece towards a kink of the right-hand side, over the contact radius: on it a right-hand side in
/// proportion to the distance is integrated to 1e-13.
const SHORTEST: f64 = 1e-5;

/// The equation at a contact radius, ready for any right-hand side.
#[derive(Debug)]
pub(super) struct Equation {
    /// Nodes and weights of the integrals.
    fine: Vec<(f64, f64)>,
    layers: Option<Layers>,
}

/// The contribution of layers.
#[derive(Debug)]
struct Layers {
    /// Values at the fine nodes of the polynomials through values at the nodes of their pieces: the first node of the
    /// piece and the weights.
    polynomials: Vec<(usize, [f64; POINTS])>,
    /// The kernel's integral with the values at the fine nodes, one row per node and one for the edge.
    kernel: DMatrix<f64>,
    system: LU<f64, Dyn, Dyn>,
}

/// A solution of the equation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Density {
    /// t, weight of the rule and g at the nodes.
    pub nodes: Vec<(f64, f64, f64)>,
    /// g(a), or with springs `Σ n cₙ`: in proportion to the pressure at the edge.
    pub edge: f64,
}

impl Equation {
    /// The equation at a contact radius (m); the rule has pieces of at most `widest` (m), shorter ones towards a kink.
    ///
    /// # Errors
    /// [`ContactError::AxisymmetricRadius`] if the radius is beyond the kernel's reach, or the system has no solution.
    pub fn new(
        kernel: Option<&LayerKernel>,
        radius: f64,
        widest: f64,
        kink: Option<f64>,
    ) -> Result<Self, ContactError> {
        let unit = kernel.map_or(f64::INFINITY, |kernel| PIECE * kernel.thickness);
        let to_kink = |[start, end]: [f64; 2]| {
            kink.map_or(f64::INFINITY, |at| (start - at).max(at - end).max(0.0))
        };
        let pieces = halved([0.0, radius], &|[start, end]| {
            end - start > unit.max(to_kink([start, end]).min(radius - end))
        });
        let too_wide = |ends: [f64; 2]| {
            let width = ends[1] - ends[0];
            width > unit.min(widest) || width > to_kink(ends).max(SHORTEST * radius)
        };
        let mut borders = vec![0.0];
        let mut piece_of_part = Vec::new();
        for (piece, ends) in pieces.windows(2).enumerate() {
            let parts = halved([ends[0], ends[1]], &too_wide);
            piece_of_part.extend(parts.iter().skip(1).map(|_| piece));
            borders.extend(parts.into_iter().skip(1));
        }
        let fine = composite(&borders);
        let layers =
            kernel.map(|kernel| Layers::new(kernel, radius, &pieces, &fine, &piece_of_part));
        let layers = layers.transpose()?;
        Ok(Self { fine, layers })
    }

    /// Solves the equation for a right-hand side.
    ///
    /// # Errors
    /// [`ContactError::AxisymmetricRadius`] if the system has no solution.
    pub fn solve(
        &self,
        radius: f64,
        right_side: &dyn Fn(f64) -> f64,
    ) -> Result<Density, ContactError> {
        let right = self.fine.iter().map(|(t, _)| right_side(*t));
        let right = DVector::from_iterator(self.fine.len(), right);
        let (smooth, edge) = match &self.layers {
            None => (DVector::zeros(right.len()), 0.0),
            Some(layers) => layers.solve(&right).ok_or(no_solution(radius))?,
        };
        let values = (right + smooth).into_iter().copied().collect::<Vec<_>>();
        let nodes = self.fine.iter().zip(values);
        Ok(Density {
            nodes: nodes.map(|((t, weight), g)| (*t, *weight, g)).collect(),
            edge: right_side(radius) + edge,
        })
    }
}

impl Layers {
    fn new(
        kernel: &LayerKernel,
        radius: f64,
        pieces: &[f64],
        fine: &[(f64, f64)],
        piece_of_part: &[usize],
    ) -> Result<Self, ContactError> {
        if 2.0 * radius > kernel.reach() {
            let wanted = "at most 2048 thicknesses of the top layer";
            return Err(ContactError::AxisymmetricRadius { radius, wanted });
        }
        let nodes = composite(pieces);
        let table = kernel.up_to(2.0 * radius);
        let places = nodes
            .iter()
            .map(|(x, _)| *x)
            .chain([radius])
            .collect::<Vec<_>>();
        let kernel = DMatrix::from_fn(places.len(), fine.len(), |i, f| {
            fine[f].1 * table.pair(places[i], fine[f].0)
        });
        let parts = fine.chunks(POINTS).zip(piece_of_part);
        let polynomials: Vec<_> = parts
            .flat_map(|(part, piece)| {
                let ends = [pieces[*piece], pieces[piece + 1]];
                part.iter()
                    .map(move |(t, _)| (POINTS * piece, basis(ends, *t)))
            })
            .collect();
        let mut system = DMatrix::identity(nodes.len(), nodes.len());
        for (f, (first, weights)) in polynomials.iter().enumerate() {
            for (j, weight) in weights.iter().enumerate() {
                let column = kernel.column(f);
                system
                    .column_mut(first + j)
                    .axpy(*weight, &column.rows(0, nodes.len()), 1.0);
            }
        }
        let system = system.lu();
        Ok(Self {
            polynomials,
            kernel,
            system,
        })
    }

    /// h at the fine nodes and at the edge.
    fn solve(&self, right: &DVector<f64>) -> Option<(DVector<f64>, f64)> {
        let size = self.kernel.nrows() - 1;
        let mut values = -(self.kernel.rows(0, size) * right);
        if !self.system.solve_mut(&mut values) {
            return None;
        }
        let at_nodes = self.polynomials.iter().map(|(first, weights)| {
            let terms = weights.iter().zip(values.iter().skip(*first));
            terms.map(|(weight, value)| weight * value).sum::<f64>()
        });
        let smooth = DVector::from_iterator(right.len(), at_nodes);
        let edge = -(self.kernel.row(size) * (right + &smooth))[0];
        Some((smooth, edge))
    }
}

impl Density {
    /// `∫ g(t) f(t) dt`.
    pub fn integral(&self, f: impl Fn(f64) -> f64) -> f64 {
        let terms = self.nodes.iter();
        terms.map(|(t, weight, g)| weight * g * f(*t)).sum()
    }

    /// Adds a multiple of another solution of the same equation.
    pub fn plus(&self, other: &Self, factor: f64) -> Self {
        let nodes = self.nodes.iter().zip(&other.nodes);
        Self {
            nodes: nodes
                .map(|((t, weight, g), (_, _, more))| (*t, *weight, g + factor * more))
                .collect(),
            edge: self.edge + factor * other.edge,
        }
    }
}

/// Barycentric weights of the rule's nodes.
static WEIGHTS: LazyLock<[f64; POINTS]> = LazyLock::new(|| {
    // 1/Π (xⱼ − xᵢ)
    std::array::from_fn(|j| {
        let others = RULE.iter().enumerate().filter(|(i, _)| *i != j);
        let differences = others.map(|(_, (node, _))| RULE[j].0 - node);
        differences.product::<f64>().recip()
    })
});

/// The values at t of the polynomials that are 1 at one node of a piece and 0 at the others.
fn basis([start, end]: [f64; 2], t: f64) -> [f64; POINTS] {
    let place = (t - f64::midpoint(start, end)) / ((end - start) / 2.0);
    let mut values = [0.0; POINTS];
    for (j, (node, _)) in RULE.iter().enumerate() {
        let difference = place - node;
        if difference == 0.0 {
            values = [0.0; POINTS];
            values[j] = 1.0;
            return values;
        }
        values[j] = WEIGHTS[j] / difference;
    }
    let sum: f64 = values.iter().sum();
    values.map(|value| value / sum)
}

pub(super) fn no_solution(radius: f64) -> ContactError {
    let wanted = "one for which the integral equation has a solution";
    ContactError::AxisymmetricRadius { radius, wanted }
}
