//! The source of a problem's operators: a given one, or coefficients and the boundary condition of the domain, from
//! which they are built when needed.

use std::sync::Arc;

use pellicle_influence::{
    ElasticOperator, ScatteredOperator, SectorGrid, SurfaceElasticity, WindowOperator,
};

use crate::grid::window::Window;

/// The boundary condition of a square domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// The surface continues without load.
    #[default]
    Free,
    /// The square repeats periodically.
    Periodic,
}

/// The operators of the elastic body under a grid, a window or a sector of one.
pub enum OperatorSource {
    /// A given operator without known coefficients.
    Operator(Box<dyn ElasticOperator>),
    /// Coefficients from which operators are built.
    Coefficients(CoefficientSource),
}

/// Coefficients and the operators built from them so far.
pub struct CoefficientSource {
    elasticity: Arc<SurfaceElasticity>,
    boundary: Boundary,
    operator: Option<Box<dyn ElasticOperator>>,
    /// From pressures on one window to displacements on another around it.
    spread: Option<([Window; 2], Box<WindowOperator>)>,
    /// The operator of a problem on scattered elements only.
    among: Option<Box<ScatteredOperator>>,
}

impl OperatorSource {
    pub fn of(elasticity: Arc<SurfaceElasticity>, boundary: Boundary) -> Self {
        Self::Coefficients(CoefficientSource {
            elasticity,
            boundary,
            operator: None,
            spread: None,
            among: None,
        })
    }

    /// A source for scattered elements of a free surface.
    pub fn among(elasticity: Arc<SurfaceElasticity>, operator: ScatteredOperator) -> Self {
        Self::Coefficients(CoefficientSource {
            elasticity,
            boundary: Boundary::Free,
            operator: None,
            spread: None,
            among: Some(Box::new(operator)),
        })
    }

    /// Takes the operator among scattered elements out of the source, if there is one.
    pub fn take_scattered(&mut self) -> Option<ScatteredOperator> {
        match self {
            Self::Operator(_) => None,
            Self::Coefficients(source) => source.among.take().map(|among| *among),
        }
    }

    /// Puts the operator among scattered elements back.
    pub fn give_scattered(&mut self, operator: ScatteredOperator) {
        if let Self::Coefficients(source) = self {
            source.among = Some(Box::new(operator));
        }
    }

    /// The elasticity from which the operators are built, if known.
    pub fn elasticity(&self) -> Option<&Arc<SurfaceElasticity>> {
        match self {
            Self::Operator(_) => None,
            Self::Coefficients(source) => Some(&source.elasticity),
        }
    }

    /// The boundary condition of the grid.
    pub fn boundary(&self) -> Boundary {
        match self {
            Self::Operator(_) => Boundary::Free,
            Self::Coefficients(source) => source.boundary,
        }
    }

    /// The displacement of an element in the middle of a grid of `size` elements per side under a unit pressure on
    /// itself, in m/Pa: one product if the coefficients are unknown.
    pub fn own_coefficient(&mut self, size: usize) -> f64 {
        match self {
            Self::Operator(operator) => {
                let (mut unit, mut displacement) = (vec![0.0; size * size], vec![0.0; size * size]);
                let middle = (size / 2) * (size + 1);
                unit[middle] = 1.0;
                operator.apply_into(&unit, &mut displacement);
                displacement[middle]
            }
            Self::Coefficients(source) => source.elasticity.coefficient([0, 0]),
        }
    }

    /// The operator on a whole grid or sector.
    pub fn operator_on(&mut self, grid: SectorGrid) -> &mut dyn ElasticOperator {
        match self {
            Self::Operator(operator) => operator.as_mut(),
            Self::Coefficients(source) => source.operator_on(grid),
        }
    }

    /// Writes the displacement due to a pressure on all elements, or on the scattered ones.
    pub fn displace(&mut self, grid: SectorGrid, pressure: &[f64], displacement: &mut [f64]) {
        match self {
            Self::Coefficients(CoefficientSource {
                among: Some(among), ..
            }) => among.apply_into(pressure, displacement),
            _ => self.operator_on(grid).apply_into(pressure, displacement),
        }
    }

    /// Writes the displacement on a `reach` around a window due to a pressure on the window that is 0 outside.
    pub fn displace_into(
        &mut self,
        [window, reach]: [&Window; 2],
        pressure: &[f64],
        displacement: &mut [f64],
    ) {
        match self {
            Self::Coefficients(source) if !window.is_whole() => {
                let spread = source.spread_of([*window, *reach]);
                spread.apply_into(pressure, displacement);
            }
            _ => self
                .operator_on(window.grid())
                .apply_into(pressure, displacement),
        }
    }

    /// Frees the memory of operators that can be rebuilt.
    pub fn release(&mut self) {
        if let Self::Coefficients(source) = self {
            (source.operator, source.spread) = (None, None);
        }
    }
}

impl CoefficientSource {
    fn operator_on(&mut self, grid: SectorGrid) -> &mut dyn ElasticOperator {
        let elasticity = &self.elasticity;
        let made = || -> Box<dyn ElasticOperator> {
            match self.boundary {
                Boundary::Free => Box::new(elasticity.operator_on(grid)),
                Boundary::Periodic => Box::new(elasticity.periodic_operator(grid.size())),
            }
        };
        self.operator.get_or_insert_with(made).as_mut()
    }

    fn spread_of(&mut self, windows: [Window; 2]) -> &mut WindowOperator {
        let known = self.spread.take_if(|(of, _)| *of == windows);
        let made = || {
            let [window, reach] = windows;
            let origin = window.within(&reach).origin();
            let operator = (self.elasticity).under_window(reach.shape(), origin, window.size());
            (windows, Box::new(operator))
        };
        let (_, operator) = self.spread.insert(known.unwrap_or_else(made));
        operator
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3 × 3 elements on independent springs, each softer than the last.
    struct Springs;

    impl ElasticOperator for Springs {
        fn size(&self) -> usize {
            3
        }

        fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
            for (e, (u, p)) in displacement.iter_mut().zip(pressure).enumerate() {
                *u = (e + 1) as f64 * p;
            }
        }
    }

    #[test]
    fn the_own_coefficient_of_an_operator_is_that_of_its_central_element() {
        let mut source = OperatorSource::Operator(Box::new(Springs));
        assert_eq!(source.own_coefficient(3), 5.0);
    }
}
