//! The residual of a state: the largest line of its certificate.

use std::ops::Range;

use super::State;
use crate::{
    problem::gap_scale::GapScale,
    solver::gradient::load_control::LoadControl,
    vector::{by_parts, largest_of_part, sum_of_part},
};

impl State {
    /// The largest line of the certificate by the running `v`, infinite if a value is not finite; and whether no
    /// element pulls.
    ///
    /// The complementarity line is a mean of gaps in contact, so it is never the largest.
    pub fn residual(&self) -> (f64, bool) {
        self.residual_of(&self.v, self.penetration)
    }

    /// The same for another `v` and penetration at its pressure.
    pub fn residual_of(&self, v: &[f64], penetration: f64) -> (f64, bool) {
        let gaps = self.stretches.by_parts(|ranges| {
            let fields =
                |range: &Range<usize>| self.pressure[range.clone()].iter().zip(&v[range.clone()]);
            let pressing = ranges.iter().flat_map(fields).filter(|(p, _)| **p > 0.0);
            pressing.fold(0.0, |most: f64, (_, v)| most.max((v - penetration).abs()))
        });
        let overlaps = by_parts(self.elements(), |part| {
            let (v, can_touch) = (&v[part.clone()], &self.can_touch[part]);
            let overlap = largest_of_part([v; 2], can_touch, |v, _| penetration - v);
            [overlap, sum_of_part(v)]
        });
        let pulls = (self.stretches).any(&self.pressure, &self.pressure, |p, _| p < 0.0);
        let overlap = overlaps
            .iter()
            .fold(0.0, |most: f64, [overlap, _]| most.max(*overlap));
        let length = gaps.into_iter().fold(overlap, f64::max);
        // `max` drops a NaN, but a sum keeps it.
        let sum = overlaps.iter().map(|[_, sum]| sum).sum::<f64>() + self.total();
        let is_number = (sum + penetration).is_finite();
        let residual = if !is_number {
            f64::INFINITY
        } else if length == 0.0 {
            0.0
        } else {
            length / self.reference_length(v, penetration)
        };
        (residual, !pulls)
    }

    /// The reference length of the residual for this `v` and penetration.
    pub fn reference_length(&self, v: &[f64], penetration: f64) -> f64 {
        if self.gap_scale == GapScale::Penetration {
            return penetration.abs();
        }
        let total = match self.control {
            LoadControl::Total(total) => total,
            LoadControl::Penetration(_) => self.total(),
        };
        let mean_pressure = (total + self.held_total) / self.elements() as f64;
        self.gap_scale
            .length(penetration, mean_pressure, |mean| self.deformation(v, mean))
    }

    /// The largest `|v − g0 − m|` of the elements that can touch.
    fn deformation(&self, v: &[f64], mean: f64) -> f64 {
        let gap = if self.own_gap.is_empty() {
            &self.initial_gap
        } else {
            &self.own_gap
        };
        let parts = by_parts(self.elements(), |part| {
            let fields = [&v[part.clone()], &gap[part.clone()]];
            largest_of_part(fields, &self.can_touch[part], |v, g0| (v - g0 - mean).abs())
        });
        parts.into_iter().fold(0.0, f64::max)
    }
}
