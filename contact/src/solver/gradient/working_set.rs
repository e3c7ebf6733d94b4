//! The working set: the elements in contact and those about to be.

use super::iterate::State;

/// `I = {p > 0} ∪ {g < 0}` as a mask over the grid.
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

    /// Brings the set up to date with the state and counts what changed.
    pub fn update(&mut self, state: &State) {
        (self.len, self.changed) = (0, 0);
        for ((member, p), v) in self.mask.iter_mut().zip(&state.pressure).zip(&state.v) {
            let belongs = *p > 0.0 || *v < state.penetration;
            self.changed += usize::from(belongs != *member);
            self.len += usize::from(belongs);
            *member = belongs;
        }
    }

    /// Whether the last update changed nothing.
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
}
