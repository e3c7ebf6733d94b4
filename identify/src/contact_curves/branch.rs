//! Readings of axisymmetric contacts off polynomials through a few of them.

use super::axisymmetric::Circle;
use super::chebyshev::{ChebyshevNodes, Pair};
use super::curve::{Observable, Reading};
use crate::Prediction;

/// What the polynomials are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// The quantities.
    Linear,
    /// Their logarithms.
    Logarithmic,
}

/// Contacts along a branch.
#[derive(Debug)]
pub struct Branch {
    pub observable: Observable,
    /// Compliance in series, m/N.
    pub series: f64,
    /// In ascending order.
    pub pieces: Vec<Piece>,
    pub scale: Scale,
    /// What is prescribed where a contact with adhesion jumps out.
    pub end: Option<f64>,
    /// Whether abscissae below the first piece are negligible.
    pub is_cut: bool,
}

/// The contacts at some nodes.
#[derive(Debug)]
pub struct Piece {
    pub nodes: ChebyshevNodes,
    pub circles: Vec<Circle>,
    /// What is prescribed and what is read.
    pub pairs: Vec<Pair>,
    /// Their derivatives by each number sought.
    pub columns: Vec<Vec<Pair>>,
}

impl Scale {
    pub fn to(self, pair: Pair) -> Pair {
        match self {
            Self::Linear => pair,
            Self::Logarithmic => pair.map(f64::ln),
        }
    }
}

impl Branch {
    /// Number of contacts.
    pub fn len(&self) -> usize {
        self.pieces.iter().map(|piece| piece.circles.len()).sum()
    }

    /// Whether these abscissae lie where the branch was solved.
    pub fn covers(&self, abscissae: &[f64]) -> bool {
        let ends = |piece: &Piece| ChebyshevNodes::span(&piece.pairs);
        let (first, last) = (&self.pieces[0], &self.pieces[self.pieces.len() - 1]);
        let (first, last) = (*ends(first).start(), *ends(last).end());
        let is_within = |x: &f64| {
            let [x, _] = self.scale.to([*x; 2]);
            x.is_nan() || x <= last && (x >= first || self.is_cut || self.end.is_some())
        };
        abscissae
            .iter()
            .filter(|x| self.end.is_some() || **x > 0.0)
            .all(is_within)
    }

    /// Reads the points, their slopes and their derivatives.
    pub fn read(&self, abscissae: &[f64]) -> Prediction {
        let columns = self.pieces[0].columns.len();
        let mut found = Prediction {
            derivatives: vec![Vec::with_capacity(abscissae.len()); columns],
            ..Prediction::default()
        };
        for abscissa in abscissae {
            let (value, slope, changes) = self.at(*abscissa);
            found.value.push(value);
            found.slope.push(slope);
            for (to, change) in found.derivatives.iter_mut().zip(changes) {
                to.push(change);
            }
        }
        if self.observable == Observable::DepthAtForce {
            let slopes = found.slope.iter_mut();
            slopes.for_each(|slope| *slope += self.series);
        }
        found
    }

    fn at(&self, abscissa: f64) -> (f64, f64, Vec<f64>) {
        if self.scale == Scale::Logarithmic && abscissa <= 0.0 {
            return self.apart();
        }
        let [x, _] = self.scale.to([abscissa; 2]);
        let piece = self.piece(x);
        let place = piece.nodes.place(x, &piece.pairs);
        let [given, read] = piece.nodes.at(place, &piece.pairs);
        let slope = piece.nodes.slope(place, &piece.pairs);
        // Beyond the nodes, along the tangent.
        let read = read + slope * (x - given);
        let changes = piece.columns.iter().map(|column| {
            let [given, read] = piece.nodes.at(place, column);
            read - given * slope
        });
        match self.scale {
            Scale::Linear => (read, slope, changes.collect()),
            Scale::Logarithmic => {
                let value = read.exp();
                let changes = changes.map(|change| value * change);
                (value, slope * value / abscissa, changes.collect())
            }
        }
    }

    /// The piece in which an abscissa lies, or the nearest one.
    fn piece(&self, x: f64) -> &Piece {
        let is_before = |piece: &&Piece| *ChebyshevNodes::span(&piece.pairs).end() < x;
        let before = self.pieces.iter().filter(is_before).count();
        &self.pieces[before.min(self.pieces.len() - 1)]
    }

    /// Before the contact, whatever the parameters: a penetration still changes with its force as at the first node.
    fn apart(&self) -> (f64, f64, Vec<f64>) {
        let piece = &self.pieces[0];
        let slope = if self.observable.observed() == Reading::Depth {
            let [given, read] = piece.pairs[0].map(f64::exp);
            piece.nodes.slope(-1.0, &piece.pairs) * read / given
        } else {
            0.0
        };
        (0.0, slope, vec![0.0; piece.columns.len()])
    }

    /// The forces (N) of the contacts without adhesion of the same radii; none beyond the end of the branch.
    pub fn forces_without(&self, abscissae: &[f64]) -> Vec<Option<f64>> {
        let at = |abscissa: &f64| {
            let piece = self.piece(*abscissa);
            let place = piece.nodes.place(*abscissa, &piece.pairs);
            let without: Vec<Pair> = piece.circles.iter().map(|of| of.without).collect();
            let is_there = self.end.is_none_or(|end| *abscissa >= end);
            is_there.then(|| piece.nodes.at(place, &without)[0])
        };
        abscissae.iter().map(at).collect()
    }
}
