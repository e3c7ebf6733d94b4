//! Secant pairs, steps and their images under the system from earlier sets of Newton's method, which correct the
//! inverse.
//!
//! The last sets of a solution differ by few elements, but conjugate gradients start again on each. With the steps
//! `s_i` taken on earlier sets and their images `y_i = (K + η) s_i`, an inverse `M` becomes (Nocedal 1980; Morales and
//! Nocedal 2000)
//!
//! ```text
//! the latest first:    a_i = s_i·r / s_i·y_i,   r ← r − a_i y_i
//!                      z = M r
//! the earliest first:  z ← z + (a_i − y_i·z / s_i·y_i) s_i
//! ```
//!
//! which is symmetric and positive for any pairs with `s_i·y_i > 0`. Pillars under a coating 30 times as stiff over a
//! layer take 39 products instead of 50 at N = 1024.
//!
//! A pair is restricted to the elements that stay. Its image is kept on all elements, so it is known on those that
//! enter, and the contributions of those that leave are subtracted. With images that were only restricted, pillars
//! under a coating 3000 times as stiff took up to 46 products instead of 32.

use rayon::prelude::*;

use crate::problem::discrete_problem::near_columns::NearColumns;
use crate::solver::gradient::working_set::WorkingSet;
use crate::vector::{by_parts, single, update};

/// Fraction of a set that may change before the pairs are discarded.
const MOST_CHANGED: f64 = 0.02;
/// Most elements that may leave at once: with 200, rough surfaces and films on coatings 5 to 50 times as stiff take up
/// to four products more at N = 1024; with 3000, as many as with 1000, in up to a fifth more time.
const MOST_LEAVING: usize = 1000;
/// Most coefficients for all leaving elements together: the contribution of each is subtracted on as many of the
/// nearest elements as this leaves for it. With 2²³ a bare coating 3000 times as stiff takes 39 products at N = 1024 on
/// the whole grid instead of 22, one 5000 times as stiff 643 instead of 24.
const MOST_COEFFICIENTS: usize = 1 << 29;
/// Most numbers in all pairs together: 256 MB.
const MOST_NUMBERS: usize = 1 << 26;

/// The pairs, on the elements of one set.
#[derive(Default)]
pub struct Secants {
    /// The elements of the set, in ascending order.
    elements: Vec<u32>,
    /// The revision of the set.
    revision: Option<u64>,
    pairs: Vec<Pair>,
    /// Number of pairs from earlier sets; those of the current one are not used until it changes.
    used: usize,
}

/// A step and its image, in the units of the problem's scale; single precision is enough to correct an approximation.
struct Pair {
    /// On the elements of the set; 0 elsewhere.
    step: Vec<f32>,
    /// On the elements of the set.
    image: Vec<f32>,
    /// On all elements.
    image_everywhere: Vec<f32>,
    /// `s·y > 0`.
    curvature: f64,
}

impl Secants {
    /// Discards all pairs.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Restricts the pairs to a set that may have changed, and begins to use those of the previous set.
    /// `columns` gives those of `K` up to a distance, if they are known.
    pub fn follow<'a>(
        &mut self,
        set: &WorkingSet,
        columns: impl FnOnce(usize) -> Option<NearColumns<'a>>,
    ) {
        if self.pairs.is_empty() || self.revision == Some(set.revision()) {
            return;
        }
        let elements = members(set);
        let places = places_before(&elements, &self.elements);
        let leaving = places_leaving(&elements, &self.elements);
        let entering = elements.len() + leaving.len() - self.elements.len();
        let changed = (entering + leaving.len()) as f64;
        if leaving.len() > MOST_LEAVING || changed > MOST_CHANGED * elements.len() as f64 {
            self.clear();
            return;
        }
        let most = self.most_pairs() / 2;
        if most == 0 {
            self.clear();
            return;
        }
        self.pairs.drain(..self.pairs.len().saturating_sub(most));
        if !leaving.is_empty() {
            let reach = (MOST_COEFFICIENTS / leaving.len()).isqrt() / 2;
            if let Some(columns) = columns(reach) {
                self.subtract_columns(&leaving, &columns);
            }
        }
        let cut = (self.pairs.drain(..)).filter_map(|pair| pair.cut(&elements, &places));
        self.pairs = cut.collect();
        (self.elements, self.revision, self.used) =
            (elements, Some(set.revision()), self.pairs.len());
    }

    /// Subtracts from the images the contributions of the steps on the elements at some places.
    fn subtract_columns(&mut self, places: &[usize], columns: &NearColumns<'_>) {
        for place in places {
            let column = columns.of(self.elements[*place] as usize);
            self.pairs.par_iter_mut().for_each(|pair| {
                let step = pair.step[*place];
                for stretch in &column {
                    let image = &mut pair.image_everywhere[stretch.first..];
                    for (image, k) in image.iter_mut().zip(stretch.entries) {
                        *image -= step * k;
                    }
                }
            });
        }
    }

    /// Records a step on the current set and its image.
    pub fn push(&mut self, set: &WorkingSet, step: &[f64], image: &[f64]) {
        if self.revision != Some(set.revision()) {
            self.clear();
            (self.elements, self.revision) = (members(set), Some(set.revision()));
        }
        if self.pairs.len() < self.most_pairs() {
            let step = self.gather(step).into_iter().map(single).collect();
            let image = image.iter().copied().map(single).collect();
            self.pairs.extend(Pair::of(&self.elements, step, image));
        }
    }

    /// Computes `z = M r` on a set, in place and corrected by the pairs; `inverse` applies `M` in place.
    pub fn apply(&self, set: &WorkingSet, field: &mut [f64], inverse: impl FnOnce(&mut [f64])) {
        let pairs = &self.pairs[..self.used];
        if pairs.is_empty() {
            return inverse(field);
        }
        set.clear_outside(field);
        let mut residual = self.gather(field);
        // a = s·r / s·y,  r ← r − a y
        let parts = pairs.iter().rev().map(|pair| {
            let part = dot(&pair.step, &residual) / pair.curvature;
            update(&mut residual, &pair.image, |r, y| {
                *r -= part * f64::from(*y);
            });
            part
        });
        let parts: Vec<f64> = parts.collect();
        self.scatter(&residual, field);
        inverse(field);
        let mut direction = self.gather(field);
        // z ← z + (a − y·z / s·y) s
        for (pair, part) in pairs.iter().zip(parts.iter().rev()) {
            let missing = part - dot(&pair.image, &direction) / pair.curvature;
            update(&mut direction, &pair.step, |z, s| {
                *z += missing * f64::from(*s);
            });
        }
        self.scatter(&direction, field);
    }

    /// Number of pairs that fit into the memory limit.
    fn most_pairs(&self) -> usize {
        let everywhere = self
            .pairs
            .first()
            .map_or(0, |pair| pair.image_everywhere.len());
        MOST_NUMBERS / (2 * self.elements.len() + everywhere).max(1)
    }

    fn gather(&self, field: &[f64]) -> Vec<f64> {
        let elements = self.elements.iter();
        elements.map(|element| field[*element as usize]).collect()
    }

    fn scatter(&self, values: &[f64], field: &mut [f64]) {
        for (element, value) in self.elements.iter().zip(values) {
            field[*element as usize] = *value;
        }
    }
}

impl Pair {
    /// The pair for a step on some elements; none without positive curvature.
    fn of(elements: &[u32], step: Vec<f32>, image_everywhere: Vec<f32>) -> Option<Self> {
        let image: Vec<f32> = (elements.iter())
            .map(|element| image_everywhere[*element as usize])
            .collect();
        let curvature = by_parts(step.len(), |part| {
            let terms = step[part.clone()].iter().zip(&image[part]);
            terms
                .map(|(s, y)| f64::from(*s) * f64::from(*y))
                .sum::<f64>()
        });
        let curvature = curvature.iter().sum();
        (curvature > 0.0).then_some(Self {
            step,
            image,
            image_everywhere,
            curvature,
        })
    }

    /// The pair on other elements, given their places among the elements of this one; the step is 0 on those that
    /// enter.
    fn cut(self, elements: &[u32], places: &[Option<u32>]) -> Option<Self> {
        let step = |place: &Option<u32>| place.map_or(0.0, |place| self.step[place as usize]);
        let step = places.iter().map(step).collect();
        Self::of(elements, step, self.image_everywhere)
    }
}

/// The elements of a set, in ascending order.
fn members(set: &WorkingSet) -> Vec<u32> {
    let elements = (0..).zip(set.mask());
    elements
        .filter_map(|(element, member)| member.then_some(element))
        .collect()
}

/// For each element, its place in an ascending list, if present.
fn places_before(elements: &[u32], before: &[u32]) -> Vec<Option<u32>> {
    let mut rest = (0..).zip(before).peekable();
    let place = |element: &u32| {
        while rest.next_if(|(_, other)| *other < element).is_some() {}
        rest.next_if(|(_, other)| *other == element)
            .map(|(place, _)| place)
    };
    elements.iter().map(place).collect()
}

/// The places in `before` of elements that are missing in `elements`; both ascend.
fn places_leaving(elements: &[u32], before: &[u32]) -> Vec<usize> {
    let places = places_before(before, elements).into_iter().enumerate();
    places
        .filter_map(|(place, after)| after.is_none().then_some(place))
        .collect()
}

/// `Σ aᵢ bᵢ`.
fn dot(a: &[f32], b: &[f64]) -> f64 {
    let parts = by_parts(a.len(), |part| {
        let terms = a[part.clone()].iter().zip(&b[part]);
        terms.map(|(a, b)| f64::from(*a) * b).sum::<f64>()
    });
    parts.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Load,
        solver::{
            gradient::{load_control::LoadControl, tests::begun},
            tests::{RIGID, SIZE, paraboloid, problem},
        },
        vector,
    };

    const ELEMENTS: usize = SIZE * SIZE;

    fn wave(rate: f64) -> Vec<f64> {
        (0..ELEMENTS).map(|e| (rate * e as f64).sin()).collect()
    }

    /// A diagonal system.
    fn system(field: &[f64]) -> Vec<f64> {
        let terms = field.iter().enumerate();
        terms
            .map(|(e, value)| (2.0 + (e % 5) as f64) * value)
            .collect()
    }

    /// The pairs of three steps on all elements, restricted to a set without the first few, and this set.
    fn cut_to_all_but(left: usize) -> (Secants, WorkingSet) {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let control = LoadControl::of(&problem, Load::Penetration(0.02));
        let (mut state, mut set) = begun(&mut problem, control, &[1.0; ELEMENTS]);
        set.keep_pressing(&mut state);
        let mut secants = Secants::default();
        for rate in [0.3, 0.7, 1.1] {
            secants.push(&set, &wave(rate), &system(&wave(rate)));
        }
        state.pressure[..left].fill(0.0);
        set.keep_pressing(&mut state);
        secants.follow(&set, |_| None);
        (secants, set)
    }

    fn apply(secants: &Secants, set: &WorkingSet, residual: &[f64]) -> Vec<f64> {
        let mut field = residual.to_vec();
        secants.apply(set, &mut field, |field| set.scale_within(field, 0.1));
        field
    }

    #[test]
    fn the_corrected_inverse_maps_the_image_of_the_last_step_to_the_step() {
        let (secants, set) = cut_to_all_but(1);
        let mut step = wave(1.1);
        set.clear_outside(&mut step);
        let found = apply(&secants, &set, &system(&step));
        // in single precision
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-6;
        assert!(found.iter().zip(&step).all(is_near));
    }

    #[test]
    fn images_remain_correct_when_one_element_enters_and_another_leaves() {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let control = LoadControl::of(&problem, Load::Penetration(0.02));
        let (mut state, mut set) = begun(&mut problem, control, &[1.0; ELEMENTS]);
        state.pressure[0] = 0.0;
        set.keep_pressing(&mut state);
        let mut step = wave(0.3);
        set.clear_outside(&mut step);
        let mut secants = Secants::default();
        let mut image = vec![0.0; ELEMENTS];
        problem.deform_to_scale(&step, &mut image);
        secants.push(&set, &step, &image);
        (state.pressure[0], state.pressure[1]) = (1.0, 0.0);
        set.keep_pressing(&mut state);
        secants.follow(&set, |reach| NearColumns::new(&problem, reach));
        set.clear_outside(&mut step);
        problem.deform_to_scale(&step, &mut image);
        let found = apply(&secants, &set, &image);
        // in single precision
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-5;
        assert!(found.iter().zip(&step).all(is_near));
    }

    #[test]
    fn the_corrected_inverse_is_symmetric_and_positive() {
        let (secants, set) = cut_to_all_but(1);
        let (mut a, mut b) = (wave(0.3), wave(0.75));
        set.clear_outside(&mut a);
        set.clear_outside(&mut b);
        let results = [&a, &b].map(|residual| apply(&secants, &set, residual));
        let crossed = [vector::dot(&a, &results[1]), vector::dot(&b, &results[0])];
        let own = [vector::dot(&a, &results[0]), vector::dot(&b, &results[1])];
        assert!((crossed[0] - crossed[1]).abs() < 1e-9 * own[0]);
        assert!(own.into_iter().all(|own| own > 0.0));
        // The uncorrected inverse gives a different result.
        assert!((own[0] - 0.1 * vector::dot(&a, &a)).abs() > 0.1 * own[0]);
    }

    #[test]
    fn pairs_are_used_once_the_set_changes_and_discarded_after_a_large_change() {
        for (left, used) in [(0, 0), (1, 3), (20, 3), (21, 0)] {
            let (secants, set) = cut_to_all_but(left);
            assert_eq!(secants.used, used, "{left}");
            let is_plain = apply(&secants, &set, &wave(0.3))
                .iter()
                .zip(wave(0.3))
                .skip(left)
                .all(|(found, value)| *found == 0.1 * value);
            assert_eq!(is_plain, used == 0, "{left}");
        }
    }

    #[test]
    fn elements_are_matched_to_their_previous_places() {
        let places = places_before(&[1, 3, 4, 8, 9], &[0, 3, 5, 8]);
        assert_eq!(places, [None, Some(1), None, Some(3), None]);
        assert_eq!(places_before(&[2], &[]), [None]);
    }
}
