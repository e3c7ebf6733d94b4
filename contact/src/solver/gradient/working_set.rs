//! The working set: the elements in contact and those about to be.

use super::iterate::State;

/// A mask over the grid of the elements whose pressures are free.
pub struct WorkingSet {
    mask: Vec<bool>,
    len: usize,
    changed: usize,
}

impl WorkingSet {
    /// The working set of a state; counts as changed throughout.
    pub fn of(state: &State) -> Self {
        let mut set = Self {
            mask: vec![false; state.elements()],
            len: 0,
            changed: 0,
        };
        set.update(state);
        set.changed = set.mask.len();
        set
    }

    /// `I = {p > 0} ∪ {g < 0}`, for pressures that are nowhere negative.
    pub fn update(&mut self, state: &State) {
        let penetration = state.penetration;
        self.revise_by(state, |_, p, v| p > 0.0 || v < penetration);
    }

    /// `I ← {p > 0 in I} ∪ {g < 0 outside I}`, from the solution on `I`, which may pull: the semismooth Newton step of the set.
    pub fn exchange(&mut self, state: &State) {
        let penetration = state.penetration;
        self.revise_by(
            state,
            |member, p, v| {
                if member { p > 0.0 } else { v < penetration }
            },
        );
    }

    /// `I ← {p > 0}`.
    pub fn keep_pressing(&mut self, state: &State) {
        self.revise_by(state, |_, p, _| p > 0.0);
    }

    fn revise_by(&mut self, state: &State, belongs: impl Fn(bool, f64, f64) -> bool) {
        (self.len, self.changed) = (0, 0);
        for ((member, p), v) in self.mask.iter_mut().zip(&state.pressure).zip(&state.v) {
            let belongs = belongs(*member, *p, *v);
            self.changed += usize::from(belongs != *member);
            self.len += usize::from(belongs);
            *member = belongs;
        }
    }

    /// Whether the last revision changed nothing.
    pub fn stands_still(&self) -> bool {
        self.changed == 0
    }

    /// Number of elements in the set.
    pub fn len(&self) -> usize {
        self.len
    }

    pub fn mask(&self) -> &[bool] {
        &self.mask
    }

    /// Whether an element of the set lies on the border of the grid of `size` elements per side.
    pub fn touches_border(&self, size: usize) -> bool {
        let last = size * (size - 1);
        (0..size).any(|i| {
            let places = [i, last + i, i * size, i * size + size - 1];
            places.into_iter().any(|e| self.mask[e])
        })
    }
}
