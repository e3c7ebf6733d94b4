//! The rows of the factor: the small dense systems of elements and their earlier neighbours.

use pellicle_influence::SurfaceElasticity;

use crate::solver::gradient::preconditioner::sparse_factor::local_system::{
    NearCoefficients, compliance_of,
};

/// The system of one element, last, and its neighbours before it.
pub struct LocalSystem<'a> {
    pub elasticity: &'a SurfaceElasticity,
    pub near: &'a NearCoefficients,
    /// The spacing of places is 2^level elements.
    pub level: u32,
    /// Where the neighbours lie.
    pub places: &'a [[i32; 2]],
    /// Class of compliance of each neighbour.
    pub classes: &'a [u16],
    /// Class of the element itself.
    pub own_class: u16,
}

/// Systems that are solved side by side, so that their arithmetic fills the registers.
pub const AT_ONCE: usize = 8;

/// One number of each of them.
type Lane = [f64; AT_ONCE];

fn subtract_product(value: &mut Lane, x: &Lane, y: &Lane) {
    for (value, (x, y)) in value.iter_mut().zip(x.iter().zip(y)) {
        *value -= x * y;
    }
}

/// Memory for systems solved side by side.
pub struct SystemBatch {
    order: usize,
    /// The lower triangle, by rows.
    triangle: Vec<Lane>,
    g: Vec<Lane>,
}

impl SystemBatch {
    /// For systems of so many neighbours at most.
    pub fn new(neighbours: usize) -> Self {
        let order = neighbours + 1;
        Self {
            order,
            triangle: vec![[0.0; AT_ONCE]; order * (order + 1) / 2],
            g: vec![[0.0; AT_ONCE]; order],
        }
    }

    /// `g` of `Lᵀ g = e_last` for each system `L Lᵀ`: the last row of the inverse of `L`.
    ///
    /// A system that is not positive definite up to rounding gives the element's own `1/√(K₀₀ + η)` and nothing else.
    pub fn rows(&mut self, systems: &[LocalSystem<'_>]) -> Vec<Vec<f64>> {
        let used = systems.iter().map(LocalSystem::order).max().unwrap_or(0);
        debug_assert!(used <= self.order && systems.len() <= AT_ONCE);
        for lane in 0..AT_ONCE {
            self.fill(lane, systems.get(lane), used);
        }
        self.factorise(used);
        self.substitute(used);
        let rows = systems.iter().enumerate();
        rows.map(|(lane, system)| self.row(lane, system, used))
            .collect()
    }

    /// Writes one system, the last of `used` unknowns, with those of the identity before it.
    fn fill(&mut self, lane: usize, system: Option<&LocalSystem<'_>>, used: usize) {
        let order = system.map_or(0, LocalSystem::order);
        let first = used - order;
        for a in 0..used {
            let row = &mut self.triangle[a * (a + 1) / 2..][..=a];
            match system {
                Some(system) if a >= first => {
                    row[..first].iter_mut().for_each(|value| value[lane] = 0.0);
                    system.row_into(a - first, &mut row[first..], lane);
                }
                _ => {
                    row.iter_mut().for_each(|value| value[lane] = 0.0);
                    row[a][lane] = 1.0;
                }
            }
        }
    }

    /// `L`, in place, with the reciprocals of its diagonal.
    fn factorise(&mut self, used: usize) {
        for a in 0..used {
            let (above, rest) = self.triangle.split_at_mut(a * (a + 1) / 2);
            let row_a = &mut rest[..=a];
            for b in 0..a {
                let row_b = &above[b * (b + 1) / 2..][..=b];
                let mut value = row_a[b];
                for (x, y) in row_a[..b].iter().zip(&row_b[..b]) {
                    subtract_product(&mut value, x, y);
                }
                value
                    .iter_mut()
                    .zip(&row_b[b])
                    .for_each(|(value, r)| *value *= r);
                row_a[b] = value;
            }
            let mut diagonal = row_a[a];
            for x in &row_a[..a] {
                subtract_product(&mut diagonal, x, x);
            }
            row_a[a] = diagonal.map(|square| 1.0 / square.sqrt());
        }
    }

    /// `g` from the last unknown to the first.
    fn substitute(&mut self, used: usize) {
        let g = &mut self.g[..used];
        g.fill([0.0; AT_ONCE]);
        g[used - 1] = [1.0; AT_ONCE];
        for a in (0..used).rev() {
            let row = &self.triangle[a * (a + 1) / 2..][..=a];
            let (before, from_a) = g.split_at_mut(a);
            let value = &mut from_a[0];
            value
                .iter_mut()
                .zip(&row[a])
                .for_each(|(value, r)| *value *= r);
            for (g, l) in before.iter_mut().zip(row) {
                subtract_product(g, l, value);
            }
        }
    }

    /// The `g` of one system.
    fn row(&self, lane: usize, system: &LocalSystem<'_>, used: usize) -> Vec<f64> {
        let order = system.order();
        let g = self.g[used - order..used].iter().map(|g| g[lane]);
        let mut g: Vec<f64> = g.collect();
        if !g.iter().all(|g| g.is_finite()) {
            g.fill(0.0);
            g[order - 1] = 1.0 / system.own(order - 1).sqrt();
        }
        g
    }
}

impl LocalSystem<'_> {
    /// Unknowns.
    fn order(&self) -> usize {
        self.places.len() + 1
    }

    /// Writes the entries up to the diagonal of a row.
    fn row_into(&self, a: usize, row: &mut [Lane], lane: usize) {
        let [x, y] = self.place(a);
        for (value, [other_x, other_y]) in row.iter_mut().zip(self.places) {
            let offset = [x.abs_diff(*other_x) as usize, y.abs_diff(*other_y) as usize];
            value[lane] = self.near.coefficient(offset).unwrap_or_else(|| {
                self.elasticity
                    .coefficient(offset.map(|along| along << self.level))
            });
        }
        row[a][lane] = self.own(a);
    }

    /// Where an unknown lies, in the spacing of the level.
    fn place(&self, a: usize) -> [i32; 2] {
        self.places.get(a).copied().unwrap_or_default()
    }

    /// `K₀₀ + η` of an unknown.
    fn own(&self, a: usize) -> f64 {
        let class = self.classes.get(a).copied().unwrap_or(self.own_class);
        self.elasticity.coefficient([0, 0]) * (1.0 + compliance_of(class))
    }
}

#[cfg(test)]
mod tests {
    use pellicle_influence::{CoefficientTable, RadialTables};
    use pellicle_kernel::{Foundation, Material};
    use std::sync::Arc;

    use super::*;

    #[test]
    fn a_row_solves_the_system_of_its_element_with_springs() {
        let [coat, base] = [10.0, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
        let body = Foundation::coated(0.05, coat, base).unwrap();
        let tables = RadialTables::build(&body).unwrap();
        let table = CoefficientTable::assemble(&tables, 1.0 / 32.0, 32).unwrap();
        let elasticity = SurfaceElasticity::new(Arc::new(table), body);
        let near = NearCoefficients::of(&elasticity, 1);
        // Neighbours of every second element.
        let (places, classes) = ([[2, 1], [-1, 0], [0, -1], [1, 1]], [0, 150, 60, 3]);
        let system = |count: usize| LocalSystem {
            elasticity: &elasticity,
            near: &near,
            level: 1,
            places: &places[..count],
            classes: &classes[..count],
            own_class: 100,
        };
        let systems = [4, 0, 2].map(system);
        for (system, g) in systems.iter().zip(SystemBatch::new(4).rows(&systems)) {
            let last = system.places.len();
            let place = |k: usize| system.places.get(k).copied().unwrap_or_default();
            for a in 0..=last {
                // A g = e/g_last, with A = L Lᵀ and Lᵀ g = e
                let mut sum = 0.0;
                for (b, g) in g.iter().enumerate() {
                    let [p, q] = [a, b].map(place);
                    let offset = [0, 1].map(|axis: usize| 2 * p[axis].abs_diff(q[axis]) as usize);
                    sum += elasticity.coefficient(offset) * g;
                    if a == b {
                        let class = system.classes.get(a).unwrap_or(&100);
                        sum += elasticity.coefficient([0, 0]) * compliance_of(*class) * g;
                    }
                }
                let wanted = f64::from(u8::from(a == last));
                assert!((sum * g[last] - wanted).abs() < 1e-13, "{a}");
            }
        }
    }
}
