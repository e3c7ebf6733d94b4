//! Whether a length grows with the force where the force is large, which means contact.

/// The covariance of a length and the force over the points with a force in the upper half of its range: free of
/// adhesion, of drift before contact, and of a slow retract after it. Points that are not numbers do not count.
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
