//! The contacts solved in the search for critical loads, which all criteria share.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::{ContactError, Domain, Load, LoadingPath, Model, Observer, SolverOptions, solve_path};

/// Number of elements on the finest grids of the paths that are kept in all; the last one always is.
const KEPT_ELEMENTS: usize = 100_000;

/// Contacts under single loads.
pub struct SolvedLoads<'a> {
    pub model: &'a Model,
    pub elements: usize,
    pub options: SolverOptions,
    pub observer: &'a mut dyn Observer,
    kept: VecDeque<(f64, Domain, Arc<LoadingPath>)>,
}

impl<'a> SolvedLoads<'a> {
    pub fn new(
        model: &'a Model,
        elements: usize,
        options: SolverOptions,
        observer: &'a mut dyn Observer,
    ) -> Self {
        Self {
            model,
            elements,
            options,
            observer,
            kept: VecDeque::new(),
        }
    }

    /// The forces of the paths that are kept.
    pub fn forces(&self) -> impl Iterator<Item = f64> {
        self.kept.iter().map(|(force, ..)| *force)
    }

    /// The path under a force, solved unless it is kept.
    pub fn solve(&mut self, force: f64, domain: Domain) -> Result<Arc<LoadingPath>, ContactError> {
        let is_it =
            |(other, on, _): &(f64, Domain, _)| other.total_cmp(&force).is_eq() && *on == domain;
        let known = self.kept.iter().position(is_it);
        let known = known.and_then(|index| self.kept.remove(index));
        let path = if let Some((.., path)) = known {
            path
        } else {
            let (loads, observer) = ([Load::Force(force)], &mut *self.observer);
            let (model, options) = (self.model, &self.options);
            let path = solve_path(model, domain, self.elements, &loads, options, observer)?;
            Arc::new(path)
        };
        self.kept.push_back((force, domain, path.clone()));
        let most = (KEPT_ELEMENTS / self.elements.pow(2)).max(1);
        while self.kept.len() > most {
            self.kept.pop_front();
        }
        Ok(path)
    }
}
