//! The fields on planes under a pressure on a grid, by convolution.
//!
//! The pressure is transformed once. For each plane the fields of one element are tabulated at the offsets of a quarter
//! of the grid, transformed, multiplied and transformed back. Under a pressure `u_y`, `σ_yy` and `σ_yz` are `u_x`,
//! `σ_xx` and `σ_xz` with x and y exchanged, and so are their spectra; a traction in any direction is the sum of one
//! along x and one along y.

use pellicle_kernel::Foundation;

use super::depth::Depth;
use super::element_table::{ElementTable, TRANSPOSED};
use super::parity::{ParityPart, UNDER_PRESSURE, under_traction};
use super::point_kernels::{NORMAL, Pressure, TANGENTIAL, Traction};
use super::rough::{RoughDepths, RoughPressure, RoughTraction};
use super::state::SurfaceLoad;
use super::traction_steps::TractionSteps;
use super::transformed_pressure::{Squares, TransformedPressure};
use super::under_load::{DepthWaves, UnderLoad};
use super::waves::Waves;
use crate::element::check_element_side;
use crate::error::InfluenceError;
use crate::operator::{QuarterTransform, Spectrum};

/// The loads on a square of elements, transformed, and the buffers for the fields on planes below.
pub struct PlaneFields {
    waves: Waves,
    /// Factors of a traction along x and y per pressure.
    friction: [f64; 2],
    pressed: TransformedPressure,
    /// The transform of the tables of an element, for their number of offsets.
    quarter: QuarterTransform,
    /// The fields of one element under a pressure and, where there is friction, under a traction.
    normal: ElementTable,
    tangential: Option<ElementTable>,
    spectra: Spectra,
    /// One field on the plane.
    shown: Vec<f64>,
}

/// The spectra of two fields that become each other when x and y are exchanged, or of one that is unchanged.
struct Spectra {
    /// Under a pressure.
    normal: [Spectrum; 2],
    /// Under a traction along x, and along y; empty without friction.
    along_x: Vec<Spectrum>,
    along_y: Vec<Spectrum>,
}

impl PlaneFields {
    /// Loads a foundation by the `pressure` (Pa) on a square of elements of side `element_side` (m), and by a traction
    /// of `friction` times the pressure along x and y, which drags the surface with it.
    ///
    /// If the pressure is symmetric in x and y, to the last bit, and the squares have one centre and even numbers of
    /// elements, only a quadrant is transformed: a third of the work and memory of each field.
    ///
    /// # Panics
    /// If the pressure does not have one value per loaded element, or the loaded square does not lie
    /// within the shown one.
    #[must_use]
    pub fn new(
        foundation: &Foundation,
        element_side: f64,
        squares: Squares,
        pressure: &[f64],
        friction: [f64; 2],
    ) -> Self {
        let Squares {
            loaded,
            shown,
            before,
        } = squares;
        assert!(
            before.iter().all(|before| before + loaded <= shown),
            "{loaded} loaded elements from {before:?} on within {shown}"
        );
        assert_eq!(
            pressure.len(),
            loaded * loaded,
            "a pressure of every loaded element"
        );
        let offsets = squares.offsets();
        let (pressed, half) = TransformedPressure::new(squares, pressure);
        let room = || Spectrum::zeros(half);
        let along = |is_wanted: bool| {
            if is_wanted {
                vec![room(), room()]
            } else {
                Vec::new()
            }
        };
        let slides = friction.iter().any(|factor| *factor != 0.0);
        Self {
            waves: Waves::new(foundation, element_side),
            friction,
            pressed,
            quarter: QuarterTransform::new(offsets, half),
            normal: ElementTable::new(offsets, SurfaceLoad::Pressure),
            tangential: slides.then(|| ElementTable::new(offsets, SurfaceLoad::Traction)),
            spectra: Spectra {
                normal: [room(), room()],
                along_x: along(slides),
                along_y: along(friction[1] != 0.0),
            },
            shown: vec![0.0; shown * shown],
        }
    }

    /// Calls `take` with each of the nine fields at a depth, in the order of
    /// [`SubsurfaceState`](super::SubsurfaceState): at the centres of the shown elements, row by row, displacements in
    /// m and stresses in Pa; NaN where they are unbounded.
    ///
    /// # Errors
    /// As [`ElementFields::new`](super::ElementFields::new).
    pub fn fields_on(
        &mut self,
        depth: Depth,
        take: impl FnMut(usize, &[f64]),
    ) -> Result<(), InfluenceError> {
        self.chosen_fields_on(depth, &[0, 1, 2, 3, 4, 5, 6, 7, 8], take)
    }

    /// As [`Self::fields_on`], but only with some of the nine, given by their indices there; each costs the same.
    ///
    /// # Errors
    /// As [`ElementFields::new`](super::ElementFields::new).
    pub fn chosen_fields_on(
        &mut self,
        depth: Depth,
        chosen: &[usize],
        mut take: impl FnMut(usize, &[f64]),
    ) -> Result<(), InfluenceError> {
        self.tabulate(depth)?;
        self.convolve(depth, chosen, &mut take);
        Ok(())
    }

    /// As [`Self::chosen_fields_on`] with [rough](RoughDepths) stresses, for searches: near the surface a traction
    /// holds what its steps take from stresses under centres.
    ///
    /// # Errors
    /// As [`ElementFields::new`](super::ElementFields::new).
    pub fn rough_fields_on(
        &mut self,
        depths: &mut RoughDepths,
        depth: Depth,
        chosen: &[usize],
        mut take: impl FnMut(usize, &[f64]),
    ) -> Result<(), InfluenceError> {
        let side = self.waves.unit();
        let offsets = (self.normal.size() + 1) as f64;
        let kernels = depths.at(depth, side, std::f64::consts::SQRT_2 * side * offsets)?;
        (self.normal).fill_with(&RoughPressure::under_pressure(&kernels, side));
        let traction = RoughTraction::under_traction(&kernels, side);
        if let (Some(tangential), Some(traction)) = (&mut self.tangential, traction) {
            tangential.fill_with(&traction);
            let steps = TractionSteps::of(self.waves.foundation(), depth, side);
            steps
                .into_iter()
                .for_each(|steps| tangential.add_steps(steps));
        }
        self.convolve(depth, chosen, &mut take);
        Ok(())
    }

    /// Calls `take` with chosen fields, from the tables of an element.
    fn convolve(&mut self, depth: Depth, chosen: &[usize], take: &mut impl FnMut(usize, &[f64])) {
        let is_held_laterally = depth.is_held_laterally(self.waves.foundation());
        for of_pair in PAIRS {
            let wanted = |field: &&usize| chosen.contains(field);
            if !of_pair.iter().any(|field| wanted(&field)) {
                continue;
            }
            self.transform_tables(of_pair);
            for field in of_pair.iter().filter(wanted) {
                let parts = self.spectra.of(*field, self.friction);
                self.pressed.convolve(&parts, &mut self.shown);
                // Where nothing holds the body, the displacements under a traction are unbounded.
                if self.tangential.is_some() && !is_held_laterally && *field < 2 {
                    self.shown.fill(f64::NAN);
                }
                take(*field, &self.shown);
            }
        }
    }

    /// Fills the tables of an element's fields at a depth.
    fn tabulate(&mut self, depth: Depth) -> Result<(), InfluenceError> {
        check_element_side(self.waves.unit())?;
        depth.check(self.waves.foundation())?;
        let offsets = self.normal.size() as f64;
        let diagonal = std::f64::consts::SQRT_2 * self.waves.unit() * offsets;
        let waves = DepthWaves::new(&mut self.waves, depth, diagonal)?;
        self.normal
            .fill::<Pressure, NORMAL>(&UnderLoad::new(&waves));
        if let Some(tangential) = &mut self.tangential {
            tangential.fill::<Traction, TANGENTIAL>(&UnderLoad::new(&waves));
        }
        Ok(())
    }

    /// Transforms the tables of a pair of fields.
    fn transform_tables(&mut self, pair: &[usize]) {
        let Self {
            quarter,
            normal,
            tangential,
            spectra,
            ..
        } = self;
        let field = pair[0];
        let [own, other] = &mut spectra.normal;
        quarter.transform(
            |m, n| normal.side_by_side(field, m, n),
            UNDER_PRESSURE[field],
            own,
        );
        if pair.len() == 2 {
            own.transpose_into(other);
        }
        let Some(tangential) = tangential else {
            return;
        };
        for (field, spectrum) in pair.iter().zip(&mut spectra.along_x) {
            let table = |m, n| tangential.side_by_side(*field, m, n);
            quarter.transform(table, under_traction(*field), spectrum);
        }
        // The fields under a traction along y are those along x with x and y exchanged.
        let along_x = spectra.along_x[..pair.len()].iter().rev();
        along_x
            .zip(&mut spectra.along_y)
            .for_each(|(one, other)| one.transpose_into(other));
    }
}

/// Fields that become each other when x and y are exchanged, and those that are unchanged.
const PAIRS: [&[usize]; 6] = [&[0, 1], &[2], &[3, 4], &[5], &[6], &[7, 8]];

impl Spectra {
    /// The parts of a field with these spectra.
    fn of(&self, field: usize, [along_x, along_y]: [f64; 2]) -> Vec<ParityPart<'_>> {
        // The second of a pair follows the first.
        let place = usize::from(TRANSPOSED[field] < field);
        let mut parts = vec![ParityPart {
            spectrum: &self.normal[place],
            parities: UNDER_PRESSURE[field],
            factor: 1.0,
        }];
        parts.extend(self.along_x.get(place).map(|spectrum| ParityPart {
            spectrum,
            parities: under_traction(field),
            factor: along_x,
        }));
        parts.extend(self.along_y.get(place).map(|spectrum| {
            let [y, x] = under_traction(TRANSPOSED[field]);
            ParityPart {
                spectrum,
                parities: [x, y],
                factor: along_y,
            }
        }));
        parts
    }
}
