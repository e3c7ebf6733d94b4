//! The stresses on a plane, and the peaks of a quantity there.
//!
//! Mean stress and von Mises' stress bound every principal stress, so that few of these are computed.

use pellicle_influence::SubsurfaceState;

use super::is_nearly;
use crate::stress::quantity::StressQuantity;

/// Largest number of peaks of a quantity that are followed, on one plane and in all.
pub const PEAKS: usize = 4;

/// Stresses at places on a square lattice, row by row; without displacements.
pub struct PlaneStresses {
    /// Places along a side.
    side: usize,
    stresses: [Vec<f64>; 6],
    mean: Vec<f64>,
    mises: Vec<f64>,
}

impl PlaneStresses {
    /// No stress at `side` × `side` places.
    pub fn zeros(side: usize) -> Self {
        let zeros = || vec![0.0; side * side];
        Self {
            side,
            stresses: std::array::from_fn(|_| zeros()),
            mean: zeros(),
            mises: zeros(),
        }
    }

    /// Takes one of the six stresses; once all are taken, the [invariants](Self::find_invariants) are to be found.
    pub fn take(&mut self, stress: usize, values: &[f64]) {
        self.stresses[stress].copy_from_slice(values);
    }

    /// Adds the same stress to `σ_xx` and `σ_yy` everywhere.
    pub fn add_equibiaxial(&mut self, own: f64) {
        if own != 0.0 {
            let [xx, yy, ..] = &mut self.stresses;
            xx.iter_mut().chain(yy).for_each(|stress| *stress += own);
        }
    }

    /// Computes what bounds the quantities.
    pub fn find_invariants(&mut self) {
        let [xx, yy, zz, xy, xz, yz] = &self.stresses;
        let invariants = self.mean.iter_mut().zip(&mut self.mises);
        for (i, (mean, mises)) in invariants.enumerate() {
            *mean = (xx[i] + yy[i] + zz[i]) / 3.0;
            let differences = [xx[i] - yy[i], yy[i] - zz[i], zz[i] - xx[i]];
            let squares = differences.map(|difference| difference * difference);
            let shears = xy[i] * xy[i] + xz[i] * xz[i] + yz[i] * yz[i];
            *mises = (0.5 * (squares[0] + squares[1] + squares[2]) + 3.0 * shears).sqrt();
        }
    }

    /// The state at a place.
    pub fn state(&self, place: usize) -> SubsurfaceState {
        SubsurfaceState {
            displacement: [0.0; 3],
            stress: std::array::from_fn(|stress| self.stresses[stress][place]),
        }
    }

    /// The largest peaks of a quantity with their rows and columns, unless all are far below a largest value that is
    /// known from other planes.
    pub fn peaks(&self, quantity: StressQuantity, known: f64) -> Vec<(f64, [usize; 2])> {
        let bounds = self.bounds(quantity);
        let mut most = 0;
        for (place, bound) in bounds.iter().enumerate() {
            if *bound > bounds[most] {
                most = place;
            }
        }
        if bounds.is_empty() || !is_nearly(bounds[most], known) {
            return Vec::new();
        }
        let value = |place: usize| quantity.roughly(&self.state(place));
        let mut largest = known.max(value(most));
        for (place, bound) in bounds.iter().enumerate() {
            if *bound > largest {
                largest = largest.max(value(place));
            }
        }
        let mut values = vec![f64::NEG_INFINITY; bounds.len()];
        let mut near = Vec::new();
        for (place, bound) in bounds.iter().enumerate() {
            if is_nearly(*bound, largest) {
                values[place] = value(place);
                if is_nearly(values[place], largest) {
                    near.push(place);
                }
            }
        }
        let of = |place: usize| [place / self.side, place % self.side];
        let peaks = near.into_iter().filter(|at| self.is_peak(&values, of(*at)));
        let mut peaks: Vec<_> = peaks.map(|at| (values[at], of(at))).collect();
        peaks.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        peaks.truncate(PEAKS);
        peaks
    }

    /// Upper bounds on a quantity at all places.
    fn bounds(&self, quantity: StressQuantity) -> Vec<f64> {
        match quantity.bound() {
            Some([of_mean, of_mises]) => {
                let invariants = self.mean.iter().zip(&self.mises);
                invariants
                    .map(|(mean, mises)| of_mean * mean + of_mises * mises)
                    .collect()
            }
            None => (0..self.mean.len())
                .map(|place| quantity.of(&self.state(place)))
                .collect(),
        }
    }

    /// Whether no neighbour is larger.
    fn is_peak(&self, values: &[f64], [i, j]: [usize; 2]) -> bool {
        let last = self.side - 1;
        let rows = i.saturating_sub(1)..=(i + 1).min(last);
        let columns = j.saturating_sub(1)..=(j + 1).min(last);
        let mut around = rows.flat_map(|i| columns.clone().map(move |j| [i, j]));
        around.all(|[m, n]| values[m * self.side + n] <= values[i * self.side + j])
    }
}
