//! The area function of an indenter and the compliance of a frame from contacts with a body of known modulus.
//!
//! ```text
//! 1/S_measured = C_f + √π/(2 β E_r √A),     A(h_c) = c₀ h_c² + c₁ h_c + c₂ h_c^½ + …,     h_c = h − C_f P − ε P/S
//! ```
//!
//! For a compliance of the frame the coefficients are linear in the areas `π S²/(4 β² E_r²)`; the compliance is that
//! with the least squares of the relative residuals. W. C. Oliver and G. M. Pharr, J. Mater. Res. 19, 3 (2004).

use std::f64::consts::PI;

use super::area_function::AreaFunction;
use super::{IndentationError, Uncertain};
use crate::orthonormal_basis::{OrthonormalBasis, dot};

/// Points beyond the parameters that tell the scatter.
const SPARE: usize = 2;
/// The frame's compliance is sought up to this part of the least compliance measured.
const LARGEST_PART: f64 = 0.95;
/// Places at which it is tried first, and steps of the golden section after them.
const PLACES: u32 = 200;
const SECTIONS: usize = 80;

/// A contact as measured, with the compliance of the frame in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredContact {
    /// Largest depth, m.
    pub depth: f64,
    /// Largest force, N.
    pub force: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// ε of the contact depth.
    pub epsilon: f64,
}

/// What is sought in a calibration, and what is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CalibrationTask {
    /// `β E_r` of the known body and the indenter, Pa.
    pub modulus: f64,
    /// Number of coefficients of the area function.
    pub coefficients: usize,
    /// The compliance of the frame, m/N, if it is known.
    pub frame_compliance: Option<f64>,
}

/// A calibrated indenter and frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// Coefficients of the area function, m^(2 − power).
    pub coefficients: Vec<f64>,
    /// Their covariance.
    pub covariance: Vec<Vec<f64>>,
    /// Least and largest contact depth, m.
    pub depths: [f64; 2],
    /// Compliance of the frame, m/N.
    pub frame_compliance: Uncertain,
    /// Standard deviation of the measured areas relative to the area function.
    pub scatter: f64,
}

/// Calibrates an area function, and the frame if its compliance is not known.
///
/// # Errors
///
/// [`IndentationError::FewContacts`] for too few contacts, [`IndentationError::Area`] if the area function is not
/// positive at one of them.
pub fn calibrate(
    contacts: &[MeasuredContact],
    task: CalibrationTask,
) -> Result<Calibration, IndentationError> {
    let free = task.coefficients + usize::from(task.frame_compliance.is_none());
    let wanted = free + SPARE;
    if contacts.len() < wanted {
        let found = contacts.len();
        return Err(IndentationError::FewContacts { found, wanted });
    }
    let squares = |frame: f64| Areas::of(contacts, task, frame).fitted().squares;
    let frame = task.frame_compliance.unwrap_or_else(|| {
        let compliances = contacts.iter().map(|of| 1.0 / of.stiffness);
        let most = LARGEST_PART * compliances.fold(f64::INFINITY, f64::min);
        least(squares, most)
    });
    let areas = Areas::of(contacts, task, frame);
    let fitted = areas.fitted();
    let function = AreaFunction::Polynomial(fitted.coefficients.clone());
    for depth in &areas.depths {
        function.positive_area(*depth)?;
    }
    let degrees = (contacts.len() - free) as f64;
    let variance = fitted.squares / degrees;
    let mut columns = areas.columns();
    if task.frame_compliance.is_none() {
        // How the residuals follow the frame's compliance with the coefficients held.
        let step = 1e-4
            * contacts
                .iter()
                .map(|of| 1.0 / of.stiffness)
                .fold(0.0, f64::max);
        let at = |frame: f64| Areas::of(contacts, task, frame).residuals(&fitted.coefficients);
        let pairs = at(frame + step).into_iter().zip(at(frame - step));
        columns.push(
            pairs
                .map(|(above, below)| (below - above) / (2.0 * step))
                .collect(),
        );
    }
    let inverse = OrthonormalBasis::of(columns).inverse_gram();
    let covariance = |i: usize, j: usize| variance * inverse[i][j];
    let ends = areas.depths.iter();
    let ends = ends.fold([f64::INFINITY, 0.0], |[low, high], depth| {
        [f64::min(low, *depth), f64::max(high, *depth)]
    });
    let count = task.coefficients;
    Ok(Calibration {
        covariance: (0..count)
            .map(|i| (0..count).map(|j| covariance(i, j)).collect())
            .collect(),
        coefficients: fitted.coefficients,
        depths: ends,
        frame_compliance: Uncertain {
            value: frame,
            sd: match task.frame_compliance {
                Some(_) => 0.0,
                None => covariance(count, count).sqrt(),
            },
        },
        scatter: variance.sqrt(),
    })
}

/// The areas of contacts for a compliance of the frame.
struct Areas {
    depths: Vec<f64>,
    values: Vec<f64>,
    count: usize,
}

/// Coefficients, and the sum of squares of the relative residuals.
struct Fitted {
    coefficients: Vec<f64>,
    squares: f64,
}

impl Areas {
    fn of(contacts: &[MeasuredContact], task: CalibrationTask, frame: f64) -> Self {
        let one = |of: &MeasuredContact| {
            let stiffness = 1.0 / (1.0 / of.stiffness - frame);
            let depth = of.depth - frame * of.force - of.epsilon * of.force / stiffness;
            // A = π S²/(4 β² E_r²)
            (depth, PI * (stiffness / (2.0 * task.modulus)).powi(2))
        };
        let (depths, values) = contacts.iter().map(one).unzip();
        Self {
            depths,
            values,
            count: task.coefficients,
        }
    }

    /// The powers of the depths over the areas.
    fn columns(&self) -> Vec<Vec<f64>> {
        let column = |k: usize| {
            let pairs = self.depths.iter().zip(&self.values);
            pairs
                .map(|(depth, area)| depth.max(0.0).powf(AreaFunction::power(k)) / area)
                .collect()
        };
        (0..self.count).map(column).collect()
    }

    fn fitted(&self) -> Fitted {
        let basis = OrthonormalBasis::of(self.columns());
        let mut rest = vec![1.0; self.values.len()];
        let components = basis.remove_from(&mut rest);
        Fitted {
            coefficients: basis.coefficients(&components),
            squares: dot(&rest, &rest),
        }
    }

    /// `1 − A(h_c)/A` with these coefficients.
    fn residuals(&self, coefficients: &[f64]) -> Vec<f64> {
        let columns = self.columns();
        let row = |i: usize| -> f64 {
            let terms = columns.iter().zip(coefficients);
            1.0 - terms.map(|(column, c)| c * column[i]).sum::<f64>()
        };
        (0..self.values.len()).map(row).collect()
    }
}

/// The place of the least value of a function between 0 and `most`, by a scan and a golden section (J. Kiefer, Proc.
/// Am. Math. Soc. 4, 502 (1953)).
fn least(of: impl Fn(f64) -> f64, most: f64) -> f64 {
    let step = most / f64::from(PLACES);
    let places = (0..=PLACES).map(|k| step * f64::from(k));
    let best = places
        .min_by(|a, b| of(*a).total_cmp(&of(*b)))
        .unwrap_or(0.0);
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high) = ((best - step).max(0.0), (best + step).min(most));
    for _ in 0..SECTIONS {
        let inside = golden * (high - low);
        if of(high - inside) <= of(low + inside) {
            high = low + inside;
        } else {
            low = high - inside;
        }
    }
    f64::midpoint(low, high)
}
