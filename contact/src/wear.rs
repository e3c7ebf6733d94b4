//! Wear of the surface that an indenter slides over: Archard's law at every element.
//!
//! Over the sliding distance s the surface loses the depth d, with the coefficient k of the wear (m²/N):
//!
//! ```text
//! dd/ds = k p,    g = K p + η(d) p + g0 + d − D
//! ```
//!
//! The heights of a relief fall, and springs as long as the relief is high, `η = (h − d)/E`, become shorter; where they
//! are worn through, wear ends, and the body below does not wear. A surface that is the body's own, bare or rough, and
//! springs of a given compliance wear without end. The load stays as it is prescribed.
//!
//! An implicit step of length Δ has `d = d₀ + k γ Δ p`: this is the contact itself with springs of the additional
//! compliance `k γ Δ` under every element, so that each stage is one solution of the same problem, stable whatever Δ,
//! and under a force Q the worn volume is `k Q s` as exactly as the pressures carry the force. Steps are those of the
//! diagonally implicit method of two stages, L-stable and of second order, `γ = 1 − 1/√2` (R. Alexander, SIAM J.
//! Numer. Anal. 14, 1977, 1006–1021); its
//! difference from the quadrature of third order through the pressures at the start and the two stages chooses their
//! length. A stage starts from the pressure continued from those before.

mod run;
mod stage;
mod worn_relief;

use self::run::WearRun;
pub use crate::result::step_wear::StepWear;

use crate::path::warnings::warnings;
use crate::result::cut_off::CutOff;
use crate::{
    ContactError, Domain, Load, LoadingPath, Model, Observer, Progress, Signal, SolverOptions,
    Step, solve_path,
};

/// Factor by which a chosen domain is enlarged, and how often at most, if the contact outgrows it.
const ENLARGEMENT: f64 = 1.5;
const ENLARGEMENTS: usize = 8;

/// A wear to compute.
#[derive(Debug, Clone, PartialEq)]
pub struct Wear {
    /// Depth of wear per pressure and sliding distance, m²/N.
    pub coefficient: f64,
    /// The sliding distances of the results, m, from 0 and rising.
    pub distances: Vec<f64>,
    /// Error of the depths in each step, over the largest depth.
    pub tolerance: f64,
}

impl Wear {
    /// The usual tolerance: half of it changes depths by less than this part of the largest.
    ///
    /// *Measured*: with it and steps somewhat longer, depths under a ball and on pillars of 64² and 96² elements erred
    /// by 1.2e-3, those of a film at the edge of what is worn through by 2.7e-3. The grid errs by more.
    pub const TOLERANCE: f64 = 5e-3;

    /// Checks the numbers.
    ///
    /// # Errors
    /// [`ContactError::Wear`] with the first that is not valid.
    pub fn checked(&self) -> Result<(), ContactError> {
        let refuse = |quantity, found, wanted| {
            Err(ContactError::Wear {
                quantity,
                found,
                wanted,
            })
        };
        let positive = "a positive finite number";
        if !(self.coefficient > 0.0 && self.coefficient.is_finite()) {
            return refuse("coefficient", self.coefficient, positive);
        }
        if !(self.tolerance > 0.0 && self.tolerance <= 0.1) {
            return refuse("tolerance", self.tolerance, "a number above 0, up to 0.1");
        }
        let mut before = 0.0;
        for distance in &self.distances {
            if !(*distance >= before && distance.is_finite()) {
                return refuse("distance", *distance, "distances from 0 that do not fall");
            }
            before = *distance;
        }
        Ok(())
    }
}

/// Solves the contact after each sliding distance, on `elements` × `elements` elements: a path of one step a distance.
/// If the observer cancels, it holds those solved so far.
///
/// # Errors
/// [`ContactError::Wear`] for invalid numbers; [`ContactError::WearOfStiffening`] for springs that stiffen;
/// [`ContactError::WithHardness`] with a hardness; those of [`solve_path`].
pub fn solve_wear(
    model: &Model,
    domain: Domain,
    elements: usize,
    load: Load,
    wear: &Wear,
    options: &SolverOptions,
    observer: &mut dyn Observer,
) -> Result<LoadingPath, ContactError> {
    wear.checked()?;
    if options.hardness.is_finite() {
        return Err(ContactError::WithHardness { what: "wear" });
    }
    if !model.relief.spring_law().is_linear() {
        return Err(ContactError::WearOfStiffening);
    }
    let mut watch = OfDistance {
        observer,
        step: 0,
        steps: wear.distances.len(),
        is_cancelled: false,
    };
    let unworn = solve_path(model, domain, elements, &[load], options, &mut watch)?;
    let (mut domain, mut enlargements) = match domain {
        Domain::Automatic | Domain::Chosen(_) => (Domain::Side(unworn.grid.side()), ENLARGEMENTS),
        other => (other, 0),
    };
    let mut unworn = Some(unworn);
    loop {
        let first = match unworn.take() {
            Some(first) => first,
            None => solve_path(model, domain, elements, &[load], options, &mut watch)?,
        };
        let mut run = WearRun::new(model, (domain, elements), load, (wear, *options), &first)?;
        let is_too_small = |step: &Step| enlargements > 0 && step.cut_off == Some(CutOff::Domain);
        let mut found = run.until(is_too_small, first, &mut watch)?;
        found.interrupted |= watch.is_cancelled;
        if found.interrupted || !found.steps.iter().any(is_too_small) {
            let loads = vec![load; found.steps.len()];
            found.warnings = warnings(model, &found.grid, domain, &loads, &found.steps);
            return Ok(found);
        }
        enlargements -= 1;
        if let Domain::Side(side) = &mut domain {
            *side *= ENLARGEMENT;
        }
    }
}

/// Tells the observer of a path the number of the distance.
struct OfDistance<'a> {
    observer: &'a mut dyn Observer,
    step: usize,
    steps: usize,
    is_cancelled: bool,
}

impl Observer for OfDistance<'_> {
    fn progress(&mut self, progress: &Progress) -> Signal {
        let signal = self.observer.progress(&Progress {
            step: self.step,
            finished: self.step,
            steps: self.steps,
            ..*progress
        });
        self.is_cancelled |= signal == Signal::Cancel;
        signal
    }
}
