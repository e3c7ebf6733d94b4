//! The end of a contact that adhesion holds, by the lowest force: where the surfaces jump together or apart.

use super::baseline::is_pull_off;
use super::before_contact::BeforeContact;

/// The part of the points before the lowest force that are taken to be far from the contact: half of them, or fewer
/// where a neck stretches over many rows before it breaks.
const FAR: [usize; 3] = [2, 4, 8];

/// The end of a contact that adhesion holds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jump {
    /// The place of the contact's end: the lowest force, far below the line of those far from the contact; the first
    /// such force where a neck is stretched over more than half of the points before.
    pub(super) place: usize,
    /// The place of the first of the low forces in a row up to the lowest: that of a neck, if there is one.
    pub(super) neck: usize,
}

impl Jump {
    /// Finds the end; none if the lowest force is not far below the line of the others.
    pub(super) fn find(coordinate: &[f64], forces: &[f64]) -> Option<Self> {
        let lowest = (0..forces.len()).min_by(|a, b| forces[*a].total_cmp(&forces[*b]))?;
        let largest = forces.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let jump = |part: &usize| {
            let far = (lowest / part, coordinate[lowest]);
            let line =
                BeforeContact::along(coordinate, forces, far, [f64::NEG_INFINITY, f64::INFINITY])?;
            let deviation = line.noise.hypot(line.force_sd);
            let holds = |place: usize| {
                let below = line.force_at(coordinate[place]) - forces[place];
                is_pull_off(below, deviation, largest - line.force)
            };
            // The error of the line is known at the lowest force, and smaller before it.
            if !holds(lowest) {
                return None;
            }
            let first = (0..lowest).find(|place| holds(*place)).unwrap_or(lowest);
            Some(if *part == FAR[0] {
                let free = (0..lowest).rfind(|place| !holds(*place));
                let neck = free.map_or(0, |free| free + 1);
                Self {
                    place: lowest,
                    neck,
                }
            } else {
                Self {
                    place: first,
                    neck: first,
                }
            })
        };
        FAR.iter().find_map(jump)
    }
}
