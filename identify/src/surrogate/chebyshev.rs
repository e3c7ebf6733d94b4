//! Products of Chebyshev polynomials up to a total degree.

/// `Π_j T_{n_j}(t_j)` for all `Σ n_j` up to a degree.
#[derive(Debug, Clone)]
pub(super) struct Products {
    degree: usize,
    orders: Vec<Vec<usize>>,
}

impl Products {
    pub fn new(dimensions: usize, degree: usize) -> Self {
        let mut orders = vec![Vec::new()];
        for _ in 0..dimensions {
            orders = orders
                .iter()
                .flat_map(|start: &Vec<usize>| {
                    let left = degree - start.iter().sum::<usize>();
                    (0..=left).map(|order| [start.as_slice(), &[order]].concat())
                })
                .collect();
        }
        Self { degree, orders }
    }

    /// The total degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of products.
    pub fn count(&self) -> usize {
        self.orders.len()
    }

    /// The products at a point.
    pub fn values(&self, at: &[f64]) -> Vec<f64> {
        let tables: Vec<Vec<f64>> = at.iter().map(|&t| first_kind(t, self.degree)).collect();
        self.multiplied(&tables)
    }

    /// Their derivatives with respect to one coordinate.
    pub fn derivatives(&self, at: &[f64], axis: usize) -> Vec<f64> {
        let mut tables: Vec<Vec<f64>> = at.iter().map(|&t| first_kind(t, self.degree)).collect();
        tables[axis] = derivatives(at[axis], self.degree);
        self.multiplied(&tables)
    }

    fn multiplied(&self, tables: &[Vec<f64>]) -> Vec<f64> {
        let product = |orders: &Vec<usize>| {
            let pairs = orders.iter().zip(tables);
            pairs.map(|(&order, table)| table[order]).product()
        };
        self.orders.iter().map(product).collect()
    }
}

/// `T_0 … T_n`, by `T_{k+1} = 2t T_k − T_{k−1}`.
fn first_kind(t: f64, degree: usize) -> Vec<f64> {
    let mut table = vec![1.0, t];
    for k in 1..degree {
        table.push(2.0 * t * table[k] - table[k - 1]);
    }
    table
}

/// `T_0′ … T_n′`, by differentiating the same recurrence.
fn derivatives(t: f64, degree: usize) -> Vec<f64> {
    let values = first_kind(t, degree);
    let mut table = vec![0.0, 1.0];
    for k in 1..degree {
        table.push(2.0 * values[k] + 2.0 * t * table[k] - table[k - 1]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_cosines_and_their_derivatives_sines() {
        let angle = 0.7_f64;
        let (t, n) = (angle.cos(), 6);
        for k in 0..=n {
            let order = k as f64;
            // Rounding over six steps.
            assert!((first_kind(t, n)[k] - (order * angle).cos()).abs() < 1e-14);
            let slope = order * (order * angle).sin() / angle.sin();
            assert!((derivatives(t, n)[k] - slope).abs() < 1e-13);
        }
    }

    #[test]
    fn there_are_as_many_products_as_monomials_of_that_degree() {
        // C(n + d, d).
        assert_eq!(Products::new(1, 5).count(), 6);
        assert_eq!(Products::new(3, 4).count(), 35);
        assert_eq!(Products::new(4, 0).count(), 1);
    }
}
