//! Problems on part of a grid: a sector, a window, or the candidates in one.

use std::sync::Arc;

use pellicle_influence::{ScatteredOperator, SectorGrid};

use super::{DiscreteProblem, Identity};
use crate::{
    Boundary,
    grid::{candidates::Candidates, window::Window},
    problem::operator_source::OperatorSource,
};

impl DiscreteProblem {
    /// The same problem on a window of the grid, with an operator of the window's size; none if the elasticity is
    /// unknown, or for part of a periodic cell.
    ///
    /// The pressure outside is zero.
    pub(crate) fn window(&self, window: &Window) -> Option<Self> {
        let boundary = self.operators.boundary();
        if boundary == Boundary::Periodic && !window.is_whole() {
            return None;
        }
        let source = OperatorSource::of(self.elasticity()?.clone(), boundary);
        Some(self.part(window, source, None, |field| window.cut(field)))
    }

    /// The same problem restricted to the candidates of a window, with products accurate to about 1e-9; all fields hold
    /// the candidates' values. None if the elasticity is unknown or the window too small.
    pub(crate) fn among(&self, window: &Window, candidates: &Arc<Candidates>) -> Option<Self> {
        let elasticity = self.elasticity()?;
        let operator = elasticity.among(window.size(), candidates.elements())?;
        self.among_by(operator, window, candidates)
    }

    /// The same with a given operator among these candidates.
    pub(crate) fn among_by(
        &self,
        operator: ScatteredOperator,
        window: &Window,
        candidates: &Arc<Candidates>,
    ) -> Option<Self> {
        let elasticity = self.elasticity()?;
        let [above, left] = window.origin();
        let on_grid = |candidate: usize| {
            let [row, column] = candidates.place(candidate);
            (above + row) * self.size() + left + column
        };
        let gather = |field: &[f64]| (0..candidates.len()).map(|c| field[on_grid(c)]).collect();
        let source = OperatorSource::among(elasticity.clone(), operator);
        Some(self.part(window, source, Some(candidates.clone()), gather))
    }

    /// The same problem on a window or the candidates in it, with their operator and a function that extracts their
    /// values.
    fn part(
        &self,
        window: &Window,
        source: OperatorSource,
        candidates: Option<Arc<Candidates>>,
        values: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Self {
        Self {
            operators: source,
            grid: window.shape(),
            relief_compliance: values(&self.relief_compliance),
            softened: None,
            spring_law: self.spring_law,
            tangents: None,
            initial_gap: values(&self.initial_gap),
            element_area: self.element_area,
            hardness: self.hardness,
            held: None,
            scale: self.scale,
            grid_size: self.grid_size,
            candidates,
            identity: Identity::default(),
        }
    }

    /// Takes the operator among candidates out of the problem, if there is one.
    pub(crate) fn take_scattered(&mut self) -> Option<ScatteredOperator> {
        self.operators.take_scattered()
    }

    /// Puts the operator among candidates back.
    pub(crate) fn give_scattered(&mut self, operator: ScatteredOperator) {
        self.operators.give_scattered(operator);
    }

    /// The candidates of the fields; none if the fields cover all elements.
    pub(crate) fn candidates(&self) -> Option<&Arc<Candidates>> {
        self.candidates.as_ref()
    }

    /// The problem's grid, of which candidates are a subset.
    pub(crate) fn grid(&self) -> SectorGrid {
        self.grid
    }

    /// All of the problem's elements.
    pub(crate) fn everywhere(&self) -> Window {
        Window::all_of(self.grid)
    }

    /// Elements per side of the whole grid of which this one is all or a part.
    pub(crate) fn grid_size(&self) -> usize {
        self.grid_size
    }

    /// Whether the grid is a window of a larger one, so that contact on its border means that the window is too small.
    pub(crate) fn is_window(&self) -> bool {
        self.grid.whole_size() < self.grid_size && self.candidates.is_none()
    }
}
