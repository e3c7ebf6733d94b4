//! The stresses under the centres of elements at one depth, by sums over the loaded elements.
//!
//! The fields of one element are tabulated at the offsets of a quarter of a grid, once for each depth. A stress is then
//! a sum of products over the loaded elements: for a few places this is less work than a plane by FFT.

use pellicle_kernel::Foundation;

use super::depth::Depth;
use super::element_table::{ElementStates, ElementTable};
use super::parity::{UNDER_PRESSURE, under_traction};
use super::point_kernels::{NORMAL, Pressure, TANGENTIAL, Traction};
use super::rough::{RoughDepths, RoughPressure, RoughTraction};
use super::state::{FIELDS, SubsurfaceState, SurfaceLoad};
use super::traction_steps::TractionSteps;
use super::under_load::{DepthWaves, UnderLoad};
use super::waves::Waves;
use crate::element::check_element_side;
use crate::error::InfluenceError;
use crate::transform::{LINES, Parity};

/// Number of fields before the stresses.
const DISPLACEMENTS: usize = 3;
/// Number of sums computed side by side.
const LANES: usize = 8;

/// Six stresses at the offsets of a quarter, row by row.
type Rows = Vec<Vec<f64>>;

/// The stresses of one element at the centres of those around it, and their sums under a pressure and friction.
pub struct CentreStresses {
    waves: Waves,
    offsets: usize,
    /// Factors of a traction along x and y per pressure.
    friction: [f64; 2],
    normal: ElementTable,
    tangential: Option<ElementTable>,
    under_pressure: Rows,
    /// Under a traction along x, at (m, n) and at (n, m); empty if there is none.
    along_x: Rows,
    swapped: Rows,
}

impl CentreStresses {
    /// Buffers for the stresses of elements of side `element_side` (m) at offsets below `offsets` along x and y, under
    /// a pressure and a traction of `friction` times the pressure along x and y.
    #[must_use]
    pub fn new(
        foundation: &Foundation,
        element_side: f64,
        offsets: usize,
        friction: [f64; 2],
    ) -> Self {
        let slides = friction.iter().any(|factor| *factor != 0.0);
        Self {
            waves: Waves::new(foundation, element_side),
            offsets,
            friction,
            normal: ElementTable::new(offsets, SurfaceLoad::Pressure),
            tangential: slides.then(|| ElementTable::new(offsets, SurfaceLoad::Traction)),
            under_pressure: Rows::new(),
            along_x: Rows::new(),
            swapped: Rows::new(),
        }
    }

    /// Offsets along x and y.
    #[must_use]
    pub fn offsets(&self) -> usize {
        self.offsets
    }

    /// Tabulates the stresses of an element at a depth, replacing the previous ones.
    ///
    /// # Errors
    /// As [`ElementFields::new`](super::ElementFields::new).
    pub fn move_to(&mut self, depth: Depth) -> Result<(), InfluenceError> {
        check_element_side(self.waves.unit())?;
        depth.check(self.waves.foundation())?;
        let diagonal = std::f64::consts::SQRT_2 * self.waves.unit() * self.offsets as f64;
        let waves = DepthWaves::new(&mut self.waves, depth, diagonal)?;
        let tangential = self.tangential.is_some();
        let tangential = tangential.then(|| UnderLoad::<Traction, TANGENTIAL>::new(&waves));
        let normal = UnderLoad::<Pressure, NORMAL>::new(&waves);
        self.tabulate(depth, &normal, tangential);
        Ok(())
    }

    /// The same with [rough](RoughDepths) stresses.
    ///
    /// # Errors
    /// As [`ElementFields::new`](super::ElementFields::new).
    pub fn move_roughly_to(
        &mut self,
        depths: &mut RoughDepths,
        depth: Depth,
    ) -> Result<(), InfluenceError> {
        let side = self.waves.unit();
        let diagonal = std::f64::consts::SQRT_2 * side * (self.offsets + 1) as f64;
        let kernels = depths.at(depth, side, diagonal)?;
        let tangential = RoughTraction::under_traction(&kernels, side);
        let normal = RoughPressure::under_pressure(&kernels, side);
        self.tabulate(depth, &normal, tangential);
        Ok(())
    }

    fn tabulate(
        &mut self,
        depth: Depth,
        normal: &impl ElementStates,
        traction: Option<impl ElementStates>,
    ) {
        self.normal.fill_with(normal);
        take_rows(&mut self.under_pressure, &self.normal, Axes::Own);
        if let (Some(tangential), Some(traction)) = (&mut self.tangential, traction) {
            tangential.fill_with(&traction);
            let steps = TractionSteps::of(self.waves.foundation(), depth, self.waves.unit());
            steps
                .into_iter()
                .for_each(|steps| tangential.add_steps(steps));
            take_rows(&mut self.along_x, tangential, Axes::Own);
            if self.friction[1] != 0.0 {
                take_rows(&mut self.swapped, tangential, Axes::Swapped);
            }
        }
    }

    /// The stress under the centre of the element at `place`, counted from the first of a square of `size` × `size`
    /// loaded elements, under their pressures (Pa), row by row along x; without displacements.
    ///
    /// # Panics
    /// If an element with pressure is farther away than the offsets.
    #[must_use]
    pub fn at(&self, pressure: &[f64], size: usize, place: [isize; 2]) -> SubsurfaceState {
        let mut sums = [[0.0; FIELDS]; 3];
        for (row, pressures) in pressure.chunks_exact(size).enumerate() {
            let Some(line) = Line::of(pressures, row, place, self.offsets) else {
                continue;
            };
            for field in DISPLACEMENTS..FIELDS {
                let stress = field - DISPLACEMENTS;
                sums[0][field] += line.sum(&self.under_pressure[stress], UNDER_PRESSURE[field]);
                let [x, y] = under_traction(field);
                if let Some(values) = self.along_x.get(stress) {
                    sums[1][field] += line.sum(values, [x, y]);
                }
                if let Some(values) = self.swapped.get(stress) {
                    sums[2][field] += line.sum(values, [y, x]);
                }
            }
        }
        let [normal, along_x, along_y] = sums.map(SubsurfaceState::from_fields);
        normal + along_x * self.friction[0] + along_y.transposed() * self.friction[1]
    }
}

/// The axes in which the offsets of a table are read.
#[derive(Clone, Copy)]
enum Axes {
    Own,
    /// x and y exchanged.
    Swapped,
}

/// Copies the stresses of a table, row by row.
fn take_rows(rows: &mut Rows, table: &ElementTable, axes: Axes) {
    let size = table.size();
    rows.resize_with(FIELDS - DISPLACEMENTS, || vec![0.0; size * size]);
    for (rows, field) in rows.iter_mut().zip(DISPLACEMENTS..) {
        for first in (0..size).step_by(LINES) {
            for along in 0..size {
                let values = table.side_by_side(field, first, along);
                for (i, value) in (first..size).zip(values) {
                    let place = match axes {
                        Axes::Own => i * size + along,
                        Axes::Swapped => along * size + i,
                    };
                    rows[place] = value;
                }
            }
        }
    }
}

/// A row of loaded elements as seen from a place.
pub struct Line<'a> {
    pressures: &'a [f64],
    /// Index of the place, counted from the first element.
    place: isize,
    /// −1 where the place lies before the row along x.
    mirror: f64,
    /// The range of the row in the tables.
    row: std::ops::Range<usize>,
}

impl<'a> Line<'a> {
    /// The row of these pressures, the `row`-th of a square, as seen from a place that is counted from the first
    /// element of the square, in tables of some offsets along a side; none without pressure.
    pub fn of(pressures: &'a [f64], row: usize, place: [isize; 2], offsets: usize) -> Option<Self> {
        let first = pressures.iter().position(|p| *p > 0.0)?;
        let end = pressures.iter().rposition(|p| *p > 0.0).unwrap_or(first) + 1;
        let m = place[0] - row.cast_signed();
        Some(Self {
            pressures: &pressures[first..end],
            place: place[1] - first.cast_signed(),
            mirror: if m < 0 { -1.0 } else { 1.0 },
            row: m.unsigned_abs() * offsets..(m.unsigned_abs() + 1) * offsets,
        })
    }

    /// The sum of a field of these parities.
    pub fn sum(&self, table: &[f64], [x, y]: [Parity; 2]) -> f64 {
        let values = &table[self.row.clone()];
        let (place, count) = (self.place, self.pressures.len());
        // Elements up to the place have decreasing offsets, those after it increasing ones.
        let split = (place + 1).clamp(0, count.cast_signed()).unsigned_abs();
        let (before, after) = self.pressures.split_at(split);
        let falling = (place + 1 - split.cast_signed()).unsigned_abs();
        let rising = (split.cast_signed() - place).unsigned_abs();
        let mut sum = 0.0;
        if !before.is_empty() {
            sum += dot_reversed(before, &values[falling..falling + before.len()]);
        }
        if !after.is_empty() {
            sum += mirrored(y, -1.0) * dot(after, &values[rising..rising + after.len()]);
        }
        mirrored(x, self.mirror) * sum
    }
}

/// The factor of a value at a mirror image, whose sign is −1.
fn mirrored(parity: Parity, sign: f64) -> f64 {
    match parity {
        Parity::Even => 1.0,
        Parity::Odd => sign,
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a, b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest = a.remainder().iter().zip(b.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum::<f64>() + rest
}

/// The product of one list with the reverse of the other.
fn dot_reversed(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a, b) = (a.chunks_exact(LANES), b.rchunks_exact(LANES));
    let rest = a.remainder().iter().zip(b.remainder().iter().rev());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[LANES - 1 - lane];
        }
    }
    lanes.iter().sum::<f64>() + rest
}
