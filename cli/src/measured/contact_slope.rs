//! The sign of the change of a length with the force where the force is large, that is, in contact.

/// Returns the covariance of a length and the force over the points in the upper half of the force range. These are not
/// affected by adhesion, drift before contact, or a slow retract after it. Points with NaN are ignored.
pub(super) fn contact_slope(lengths: &[f64], forces: &[f64]) -> f64 {
    let is_valid = |(length, force): &(&f64, &f64)| length.is_finite() && force.is_finite();
    let valid = || lengths.iter().zip(forces).filter(is_valid);
    let highest = valid()
        .map(|(_, force)| *force)
        .fold(f64::NEG_INFINITY, f64::max);
    let lowest = valid()
        .map(|(_, force)| *force)
        .fold(f64::INFINITY, f64::min);
    let middle = 0.5 * (highest + lowest);
    let contact: Vec<_> = valid().filter(|(_, force)| **force > middle).collect();
    let count = contact.len() as f64;
    let mean_length = contact.iter().map(|(length, _)| *length).sum::<f64>() / count;
    let mean_force = contact.iter().map(|(_, force)| *force).sum::<f64>() / count;
    let product = |(length, force): &(&f64, &f64)| (*length - mean_length) * (*force - mean_force);
    contact.iter().map(product).sum()
}
