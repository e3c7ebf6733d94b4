//! The working set: the elements in contact and those about to enter it.

use std::sync::Arc;

use rayon::prelude::*;

use crate::{
    solver::gradient::state::State,
    vector::{stretches::Stretches, update},
};

/// Elements per parallel chunk.
const PART: usize = 1 << 12;
/// Elements decided together.
const TOGETHER: usize = 64;

/// A mask over the grid of the elements whose pressures are free.
pub struct WorkingSet {
    mask: Vec<bool>,
    /// The stretches that hold its elements.
    stretches: Arc<Stretches>,
    /// The elements on the wrong side by the last [prediction](Self::predict_wrong_side).
    wrong: Vec<bool>,
    /// The revision of the set on which it was made.
    predicted_on: Option<u64>,
    len: usize,
    changed: usize,
    /// Number of revisions that changed the set.
    revision: u64,
    /// Elements that entered or left since the last query.
    moves: usize,
}

/// The result of a prediction.
#[derive(Debug, Clone, Copy, Default)]
pub struct Prediction {
    /// Elements on the wrong side.
    pub wrong: usize,
    /// Elements newly on the wrong side, or no longer on it.
    pub changed: usize,
}

impl Prediction {
    fn and(self, other: Self) -> Self {
        Self {
            wrong: self.wrong + other.wrong,
            changed: self.changed + other.changed,
        }
    }
}

impl WorkingSet {
    /// An empty working set for a grid of `elements` elements.
    pub fn new(elements: usize) -> Self {
        Self {
            mask: vec![false; elements],
            stretches: Arc::new(Stretches::none(elements)),
            wrong: vec![false; elements],
            predicted_on: None,
            len: 0,
            changed: 0,
            revision: 0,
            moves: 0,
        }
    }

    /// Takes the working set of a starting state. Every element counts as changed.
    pub fn start(&mut self, state: &mut State) {
        self.update(state);
        self.revision += 1;
        self.changed = self.mask.len();
        self.moves = self.len;
    }

    /// `I = {p > 0} ∪ {g < 0}`, for pressures that are not negative anywhere.
    #[expect(clippy::needless_bitwise_bool, reason = "without a branch")]
    pub fn update(&mut self, state: &mut State) {
        let penetration = state.penetration;
        self.revise_by(state, |_, _, p, v| (p > 0.0) | (v < penetration));
    }

    /// `I ← {p > 0 in I and not on the wrong side} ∪ {on the wrong side outside I}`, from the solution on `I`, which
    /// may have negative pressures: the semismooth Newton step of the set.
    pub fn exchange(&mut self, state: &mut State) {
        let wrong = std::mem::take(&mut self.wrong);
        self.revise_by(state, |element, member, p, _| {
            if member {
                p > 0.0 && !wrong[element]
            } else {
                wrong[element]
            }
        });
        self.wrong = wrong;
    }

    /// Finds the elements that will be on the wrong side once the correction `missing` is added to the pressure:
    /// members that will pull, and elements outside that overlap by more than a fraction `slack` of the penetration.
    /// Returns their number, and the number of changes since the last prediction on the same set.
    pub fn predict_wrong_side(&mut self, state: &State, missing: &[f64], slack: f64) -> Prediction {
        if self.predicted_on != Some(self.revision) {
            self.wrong.fill(false);
            self.predicted_on = Some(self.revision);
        }
        let lowest =
            state.penetration - slack * state.reference_length(&state.v, state.penetration);
        let fields = (state.pressure.par_chunks(PART)).zip(missing.par_chunks(PART));
        let fields = fields.zip(state.v.par_chunks(PART));
        let fields = fields.zip(self.mask.par_chunks(PART));
        let fields = fields.zip(state.can_touch().par_chunks(PART));
        let parts = self.wrong.par_chunks_mut(PART).zip(fields);
        let counts = parts.map(|(wrong, ((((pressure, missing), v), mask), can_touch))| {
            let mut predicted = Prediction::default();
            for (i, wrong) in wrong.iter_mut().enumerate() {
                let is_wrong = if mask[i] {
                    pressure[i] + missing[i] < 0.0
                } else {
                    can_touch[i] && v[i] < lowest
                };
                predicted.wrong += usize::from(is_wrong);
                predicted.changed += usize::from(is_wrong != *wrong);
                *wrong = is_wrong;
            }
            predicted
        });
        let counts: Vec<Prediction> = counts.collect();
        counts
            .into_iter()
            .fold(Prediction::default(), Prediction::and)
    }

    /// Keeps the members for which `belongs` holds, by index and pressure.
    pub fn keep(&mut self, state: &mut State, belongs: impl Fn(usize, f64) -> bool + Sync) {
        self.revise_by(state, |element, member, p, _| member && belongs(element, p));
    }

    /// `I ← {p > 0}`.
    pub fn keep_pressing(&mut self, state: &mut State) {
        self.revise_by(state, |_, _, p, _| p > 0.0);
    }

    /// Keeps the elements that can touch and for which `belongs` holds, by index, membership, pressure and `v`. The
    /// state may press only on them.
    fn revise_by(
        &mut self,
        state: &mut State,
        belongs: impl Fn(usize, bool, f64, f64) -> bool + Sync,
    ) {
        let (all_pressure, all_v, all_can_touch) = (&state.pressure, &state.v, state.can_touch());
        let revise = |part: usize, mask: &mut [bool]| {
            let own = part * PART..part * PART + mask.len();
            let (pressure, v) = (&all_pressure[own.clone()], &all_v[own.clone()]);
            let can_touch = &all_can_touch[own];
            let (mut len, mut changed) = (0, 0);
            for (first, mask) in (0..).step_by(TOGETHER).zip(mask.chunks_mut(TOGETHER)) {
                // Without branches, so that the processor decides on several at once.
                let now = |i: usize| {
                    let element = first + i;
                    let (p, v) = (pressure[element], v[element]);
                    can_touch[element] & belongs(part * PART + element, mask[i], p, v)
                };
                let mut members = [false; TOGETHER];
                let count = mask.len();
                (members[..count].iter_mut().enumerate()).for_each(|(i, member)| *member = now(i));
                let differ = members
                    .iter()
                    .zip(&*mask)
                    .filter(|(now, before)| now != before);
                changed += differ.count();
                len += members.iter().filter(|member| **member).count();
                mask.copy_from_slice(&members[..count]);
            }
            (len, changed)
        };
        let counts = revised(&mut self.mask, &revise);
        self.len = counts.iter().map(|(len, _)| len).sum();
        self.changed = counts.iter().map(|(_, changed)| changed).sum();
        self.moves += self.changed;
        self.revision += u64::from(self.changed > 0);
        if self.changed > 0 {
            self.stretches = Arc::new(Stretches::around(&self.mask));
        }
        state.press_on(&self.stretches);
    }

    /// Changes whenever the set does. Anything built for a set is valid while its revision is unchanged.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Returns the number of elements that entered or left since the last call or since [`Self::start`], which counts
    /// the whole set.
    pub fn take_moves(&mut self) -> usize {
        std::mem::take(&mut self.moves)
    }

    /// Whether the last revision changed nothing.
    pub fn is_unchanged(&self) -> bool {
        self.changed == 0
    }

    /// Number of elements in the set.
    pub fn len(&self) -> usize {
        self.len
    }

    pub fn mask(&self) -> &[bool] {
        &self.mask
    }

    /// The stretches that hold its elements.
    pub fn stretches(&self) -> &Arc<Stretches> {
        &self.stretches
    }

    /// Sets a field to 0 outside the set.
    pub fn clear_outside(&self, field: &mut [f64]) {
        update(field, &self.mask, |value, member| {
            if !member {
                *value = 0.0;
            }
        });
    }

    /// Multiplies a field that is 0 outside its stretches by `factor` on the set, and sets it to 0 elsewhere.
    pub fn scale_within(&self, field: &mut [f64], factor: f64) {
        (self.stretches).update(field, &self.mask, |value, member| {
            *value = if *member { factor * *value } else { 0.0 };
        });
    }

    /// Whether one of these elements is in the set.
    pub fn holds_any(&self, mut elements: impl Iterator<Item = usize>) -> bool {
        elements.any(|element| self.mask[element])
    }
}

/// Revises a part of a mask, by its number: how many belong to it, and how many changed.
type Revise<'a> = dyn Fn(usize, &mut [bool]) -> (usize, usize) + Sync + 'a;

/// Revises each part of a mask: how many belong to it, and how many changed. Compiled once for all rules.
fn revised(mask: &mut [bool], revise: &Revise<'_>) -> Vec<(usize, usize)> {
    let parts = mask.par_chunks_mut(PART).enumerate();
    parts.map(|(part, mask)| revise(part, mask)).collect()
}

#[cfg(test)]
mod tests {
    use crate::{
        Load,
        solver::{
            gradient::{load_control::LoadControl, tests::begun},
            tests::{RIGID, SIZE, paraboloid, problem},
        },
    };

    #[test]
    fn every_move_into_and_out_of_the_set_is_counted_once() {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let control = LoadControl::of(&problem, Load::Penetration(0.0));
        let pressure: Vec<f64> = (0..SIZE * SIZE)
            .map(|e| f64::from(u8::from(e < 7)))
            .collect();
        let (mut state, mut set) = begun(&mut problem, control, &pressure);
        set.keep_pressing(&mut state);
        assert_eq!(set.len(), 7);
        set.take_moves();
        let revision = set.revision();
        // Three leave, two others enter.
        state.pressure[..3].fill(0.0);
        state.pressure[7..9].fill(1.0);
        set.keep_pressing(&mut state);
        assert!(!set.is_unchanged() && set.revision() != revision);
        assert_eq!((set.len(), set.take_moves(), set.take_moves()), (6, 5, 0));
        assert!((0..SIZE * SIZE).all(|e| set.mask()[e] == (3..9).contains(&e)));
        // Nothing changes.
        let revision = set.revision();
        set.keep_pressing(&mut state);
        assert!(set.is_unchanged() && set.revision() == revision && set.take_moves() == 0);
        let mut field = vec![2.0; SIZE * SIZE];
        set.clear_outside(&mut field);
        set.scale_within(&mut field, 3.0);
        assert!((0..SIZE * SIZE).all(|e| field[e] == if set.mask()[e] { 6.0 } else { 0.0 }));
    }

    #[test]
    fn keeping_retains_only_members_and_a_new_set_has_no_prediction() {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let control = LoadControl::of(&problem, Load::Penetration(0.0));
        let pressure: Vec<f64> = (0..SIZE * SIZE)
            .map(|e| f64::from(u8::from(e < 9)))
            .collect();
        let (mut state, mut set) = begun(&mut problem, control, &pressure);
        set.keep_pressing(&mut state);
        // Element 20 satisfies the condition, but is not in the set.
        set.keep(&mut state, |element, p| {
            (element != 4 && p > 0.5) || element == 20
        });
        let members = |e: usize| e < 9 && e != 4;
        assert!((0..SIZE * SIZE).all(|e| set.mask()[e] == members(e)));
        // Two will pull, and outside the set three overlap by more than a tenth of the penetration.
        state.penetration = 1.0;
        state.v.fill(1.0);
        state.v[30..33].fill(0.85);
        state.v[33] = 0.95;
        let mut missing = vec![0.0; SIZE * SIZE];
        missing[0..2].fill(-2.0 * state.pressure[0]);
        let predicted = set.predict_wrong_side(&state, &missing, 0.1);
        assert_eq!((predicted.wrong, predicted.changed), (5, 5));
        let again = set.predict_wrong_side(&state, &missing, 0.1);
        assert_eq!((again.wrong, again.changed), (5, 0));
        // Only these change sides.
        set.exchange(&mut state);
        let exchanged = |e: usize| (members(e) && e > 1) || (30..33).contains(&e);
        assert!((0..SIZE * SIZE).all(|e| set.mask()[e] == exchanged(e)));
        // On the new set nothing has been predicted before.
        missing[2] = -2.0 * state.pressure[2];
        let on_another_set = set.predict_wrong_side(&state, &missing, 0.1);
        assert_eq!((on_another_set.wrong, on_another_set.changed), (1, 1));
    }
}
