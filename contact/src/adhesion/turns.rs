//! The contacts at which the force or the penetration of an adhesive curve is least.

use std::collections::VecDeque;
use std::f64::consts::LN_2;

use super::contact::AdhesiveContact;
use crate::ContactError;

/// Relative width at which the search for a least value ends: such a value is flat, so its place is known to the root
/// of the accuracy.
const PLACE: f64 = 1e-7;

/// Most samples of the search for least values: factors of two that cross 90 decades.
const MOST_STEPS: usize = 300;

/// The contacts at which a quantity is least, from the widest inwards, each with a lower value than those before it.
///
/// On a stiff layer upon a soft body there are two: contacts narrow and wide beside the layer's thickness. A contact
/// that is withdrawn leaves the branch that ends at the first, falls back to the next, and jumps out at the last.
#[derive(Debug, Clone, Default)]
pub(super) struct Turns(Vec<AdhesiveContact>);

impl Turns {
    /// The turns of a value: bracketed by factors of two between two radii (m), those at pull-off on half-spaces of the
    /// stiffest and of the softest material, and as far beyond as the value falls; then by the golden section in the
    /// logarithm.
    pub(super) fn find(
        [narrowest, widest]: [f64; 2],
        contact: impl Fn(f64) -> Result<AdhesiveContact, ContactError>,
        value: impl Fn(&AdhesiveContact) -> f64,
    ) -> Result<Self, ContactError> {
        let at = |log: f64| {
            let contact = contact(log.exp())?;
            Ok::<_, ContactError>((log, value(&contact)))
        };
        let mut samples = VecDeque::from([at(narrowest.ln())?]);
        loop {
            let (log, least) = samples[0];
            let tried = at(log - LN_2)?;
            samples.push_front(tried);
            if tried.1 > least || samples.len() > MOST_STEPS {
                break;
            }
        }
        while samples.len() < MOST_STEPS {
            let [below, end] = [samples.len() - 2, samples.len() - 1].map(|place| samples[place]);
            let is_rising = end.1 > below.1;
            if is_rising && end.0 > widest.ln() {
                break;
            }
            match at(end.0 + LN_2) {
                Ok(tried) => samples.push_back(tried),
                // Layers are much thinner than so wide a contact, or the indenter ends.
                Err(_) if is_rising => break,
                Err(error) => return Err(error),
            }
        }
        let mut turns: Vec<AdhesiveContact> = Vec::new();
        for place in (1..samples.len() - 1).rev() {
            let [low, middle, high] = [place - 1, place, place + 1].map(|place| samples[place]);
            if middle.1 > low.1 || middle.1 >= high.1 {
                continue;
            }
            let found = contact(least_between([low, middle, high], at)?.exp())?;
            let before = turns.last();
            if before.is_none_or(|before| value(&found) < value(before)) {
                turns.push(found);
            }
        }
        Ok(Self(turns))
    }

    /// The only turn.
    pub(super) fn only(turn: AdhesiveContact) -> Self {
        Self(vec![turn])
    }

    /// The widest branch whose turn is wanted, and the radius (m) at which the next wider one begins.
    pub(super) fn branch(
        &self,
        is_wanted: impl Fn(&AdhesiveContact) -> bool,
    ) -> Option<(AdhesiveContact, f64)> {
        let place = self.0.iter().position(is_wanted)?;
        let wider = place.checked_sub(1).map(|wider| self.0[wider].radius);
        Some((self.0[place], wider.unwrap_or(f64::INFINITY)))
    }

    /// The turn of the widest contact.
    pub(super) fn first(&self) -> AdhesiveContact {
        self.0.first().copied().unwrap_or(AdhesiveContact::APART)
    }

    /// The turn with the least value.
    pub(super) fn last(&self) -> AdhesiveContact {
        self.0.last().copied().unwrap_or(AdhesiveContact::APART)
    }
}

/// A place and a value there.
type Sample = (f64, f64);

/// The place of the least value between three samples, of which the middle one is the lowest, by the golden section.
fn least_between(
    [mut low, mut middle, mut high]: [Sample; 3],
    at: impl Fn(f64) -> Result<Sample, ContactError>,
) -> Result<f64, ContactError> {
    while high.0 - low.0 > PLACE {
        // The longer part is divided.
        let golden = 0.381_966_011_250_105_1;
        let is_right = high.0 - middle.0 > middle.0 - low.0;
        let end = if is_right { high.0 } else { low.0 };
        let tried = at(middle.0 + golden * (end - middle.0))?;
        match (tried.1 < middle.1, is_right) {
            (true, true) => (low, middle) = (middle, tried),
            (true, false) => (high, middle) = (middle, tried),
            (false, true) => high = tried,
            (false, false) => low = tried,
        }
    }
    Ok(middle.0)
}
