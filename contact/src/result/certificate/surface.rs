//! The surface under a pressure, row by row; gaps are computed on demand and never stored.

use crate::{grid::region::Region, vector::smallest};
use pellicle_texture::SpringLaw;

/// The surface under a pressure, on the examined part of the grid.
pub struct Surface<'a> {
    /// `g0` and `η` of the grid's elements, in m and m/Pa.
    pub initial_gap: &'a [f64],
    pub compliance: &'a [f64],
    pub spring_law: SpringLaw,
    /// Hardness, in Pa; infinite without one.
    pub limit: f64,
    /// The region of the pressure, within the reach.
    pub region: Region,
    /// The examined part of the grid.
    pub reach: Region,
    /// Pressure on the region, in Pa.
    pub pressure: &'a [f64],
    /// `K p` on the reach, in m.
    pub displacement: &'a [f64],
}

impl Surface<'_> {
    /// Returns `D = Σ p v / Σ p` with `v = K p + w* + g0`, over the elements with pressure below the limit (`g0` is
    /// infinite where the indenter ends). If there are none, returns the largest `v` of those at the limit. `total` is
    /// the sum of all pressures.
    pub fn multiplier(&self, total: f64) -> f64 {
        let limit = self.limit;
        let parts = self
            .reach
            .by_lines(self.displacement, |line, displacement| {
                let initial_gap = self.reach.line(self.initial_gap, line);
                let (mut sum, mut at_limit, mut highest) = (0.0, 0.0, f64::NEG_INFINITY);
                for Pressed {
                    column,
                    p,
                    shortening,
                } in self.pressed(line)
                {
                    let v = displacement[column] + shortening + initial_gap[column];
                    if p < limit {
                        sum += p * v;
                    } else {
                        at_limit += p;
                        highest = largest(highest, v);
                    }
                }
                (sum, at_limit, highest)
            });
        let (mut sum, mut at_limit, mut highest) = (0.0, 0.0, f64::NEG_INFINITY);
        for part in parts {
            sum += part.0;
            at_limit += part.1;
            highest = largest(highest, part.2);
        }
        if at_limit == 0.0 {
            return sum / total;
        }
        let free = self.region.by_lines(self.pressure, |_, pressure| {
            pressure.iter().filter(|p| **p < limit).sum::<f64>()
        });
        let free: f64 = free.into_iter().sum();
        if free > 0.0 { sum / free } else { highest }
    }

    /// Returns the largest `|K p + w* − m|` (m), for a mean displacement `m`, of the elements that can touch; NaN if
    /// one is NaN.
    pub fn deformation(&self, mean: f64) -> f64 {
        let parts = self
            .reach
            .by_lines(self.displacement, |line, displacement| {
                let mut deformed = displacement.to_vec();
                for pressed in self.pressed(line) {
                    deformed[pressed.column] += pressed.shortening;
                }
                let gaps = self.reach.line(self.initial_gap, line);
                let touching = deformed.iter().zip(gaps).filter(|(_, g0)| g0.is_finite());
                touching.fold(0.0, |most, (u, _)| largest(most, (u - mean).abs()))
            });
        parts.into_iter().fold(0.0, largest)
    }

    /// Returns the lines of the certificate that need the gaps, relative to the length `reference` (m).
    pub fn violations(&self, penetration: f64, reference: f64, total: f64) -> Violations {
        let parts = self
            .reach
            .by_lines(self.displacement, |line, displacement| {
                self.violations_of_line(line, displacement, penetration)
            });
        let found = parts
            .into_iter()
            .fold(Violations::default(), Violations::and);
        // Without pressure there are no weights. Without penetration there is no scale, and only zeros pass.
        let relative = |length: f64| {
            if length == 0.0 {
                0.0
            } else {
                length / reference
            }
        };
        Violations {
            complementarity: if total == 0.0 {
                0.0
            } else {
                relative(found.complementarity / total)
            },
            gap_in_contact: relative(found.gap_in_contact),
            overlap: relative(found.overlap),
            gap_at_limit: relative(found.gap_at_limit),
            over_limit: found.over_limit,
        }
    }

    fn violations_of_line(
        &self,
        line: usize,
        displacement: &[f64],
        penetration: f64,
    ) -> Violations {
        let limit = self.limit;
        // g = K p + w* + g0 − D
        let gaps = displacement
            .iter()
            .zip(self.reach.line(self.initial_gap, line));
        let mut gaps: Vec<f64> = gaps.map(|(u, g0)| u + g0 - penetration).collect();
        let mut found = Violations::default();
        for Pressed {
            column,
            p,
            shortening,
        } in self.pressed(line)
        {
            gaps[column] += shortening;
            found.add(p, limit, gaps[column]);
            if p >= limit {
                // This is the plastic depth, not an overlap.
                gaps[column] = f64::INFINITY;
            }
        }
        found.overlap = largest(0.0, -smallest(&gaps));
        found
    }

    /// The elements with pressure in a row of the reach, with the shortening `w*(p)` of their springs.
    fn pressed(&self, line: usize) -> impl Iterator<Item = Pressed> {
        let [above, left] = self.region.origin();
        let [rows, size] = self.region.lengths();
        let row = line.checked_sub(above).filter(|row| *row < rows);
        let pressure = row.map_or(&[][..], |row| &self.pressure[row * size..][..size]);
        let compliance = self.reach.line(self.compliance, line);
        let law = self.spring_law;
        let pressed = (left..).zip(pressure).filter(|(_, p)| **p != 0.0);
        pressed.map(move |(column, p)| Pressed {
            column,
            p: *p,
            shortening: law.shortening(compliance[column], *p),
        })
    }
}

/// An element with pressure.
struct Pressed {
    /// Column in the reach.
    column: usize,
    /// Pressure, in Pa.
    p: f64,
    /// `w*(p)`, in m; `η p` for linear springs.
    shortening: f64,
}

/// Sums and maxima of the gaps and pressures that violate a condition, by line of the certificate; NaN if a gap is NaN.
#[derive(Clone, Copy, Default)]
pub struct Violations {
    pub complementarity: f64,
    pub gap_in_contact: f64,
    pub gap_at_limit: f64,
    pub over_limit: f64,
    /// Largest overlap of the elements below the limit.
    pub overlap: f64,
}

impl Violations {
    /// Adds an element with pressure.
    fn add(&mut self, p: f64, limit: f64, gap: f64) {
        if p < limit {
            self.complementarity += p * gap.abs();
            self.gap_in_contact = largest(self.gap_in_contact, gap.abs());
        } else {
            self.complementarity += p * largest(0.0, gap);
            self.gap_at_limit = largest(self.gap_at_limit, gap);
            self.over_limit = largest(self.over_limit, p - limit);
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            complementarity: self.complementarity + other.complementarity,
            gap_in_contact: largest(self.gap_in_contact, other.gap_in_contact),
            gap_at_limit: largest(self.gap_at_limit, other.gap_at_limit),
            over_limit: largest(self.over_limit, other.over_limit),
            overlap: largest(self.overlap, other.overlap),
        }
    }
}

/// The larger of two numbers, NaN if either is NaN: `f64::max` drops NaN, which must not pass for a small number.
pub fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}
