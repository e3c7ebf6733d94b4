//! How curves are evaluated.

use super::area_function::AreaFunction;
use super::calibration::{Calibration, CalibrationTask, MeasuredContact};
use super::uncertain::Uncertain;
use super::{IndentationNumber, IndentationNumbers};

/// How curves are evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluationSettings {
    /// The area function of the indenter; none where the instrument gives the radius of every contact.
    pub area: Option<AreaFunction>,
    /// Covariance of the coefficients of a polynomial; empty for exact ones.
    pub area_covariance: Vec<Vec<f64>>,
    /// The contact depths for which it was calibrated, m, if it was.
    pub area_range: Option<[f64; 2]>,
    /// β of `E_r = √π S/(2 β √A)`.
    pub beta: Uncertain,
    /// ε of the contact depth.
    pub epsilon: Epsilon,
    /// The part of the unloading that is fitted, from above, as parts of the largest force.
    pub unloading: [f64; 2],
    /// Compliance of the frame, m/N.
    pub frame_compliance: Uncertain,
    /// The drift of the depth.
    pub drift: Drift,
    /// The zero of the depth.
    pub depth_zero: DepthZero,
    /// Poisson's ratio of the body.
    pub poisson_ratio: Uncertain,
    /// The material of the indenter; none for a rigid one.
    pub indenter: Option<IndenterMaterial>,
    /// The part of the contact depth by which an imprint thins the top layer of a film, in a fit to a layered body.
    pub thinning: f64,
    /// The body is known, and the area function is sought.
    pub calibrate: Option<KnownBody>,
}

/// A body of known modulus, on which an indenter is calibrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownBody {
    /// Its Young's modulus, Pa.
    pub young_modulus: f64,
    /// Number of coefficients of the area function.
    pub coefficients: usize,
    /// Whether the compliance of the frame is sought, too.
    pub seeks_frame: bool,
}

impl EvaluationSettings {
    /// What a calibration seeks, if there is one: `β E_r` of the known body and the indenter.
    #[must_use]
    pub fn calibration_task(&self) -> Option<CalibrationTask> {
        let known = self.calibrate?;
        let compliance = |modulus: f64, ratio: f64| (1.0 - ratio * ratio) / modulus;
        let indenter = self.indenter.map_or(0.0, |of| {
            compliance(of.young_modulus.value, of.poisson_ratio.value)
        });
        let body = compliance(known.young_modulus, self.poisson_ratio.value);
        Some(CalibrationTask {
            modulus: self.beta.value / (body + indenter),
            coefficients: known.coefficients,
            frame_compliance: (!known.seeks_frame).then_some(self.frame_compliance.value),
        })
    }

    /// The contact as measured that this evaluation has found, with the frame in it.
    #[must_use]
    pub fn measured_contact(&self, found: &IndentationNumbers) -> Option<MeasuredContact> {
        let value = |of| found.get(of).map(|of| of.value);
        let frame = self.frame_compliance.value;
        let force = value(IndentationNumber::MaxForce)?;
        let stiffness = value(IndentationNumber::ContactStiffness)?;
        let depth = value(IndentationNumber::MaxDepth)?;
        Some(MeasuredContact {
            depth: depth + frame * force,
            force,
            stiffness: 1.0 / (1.0 / stiffness + frame),
            epsilon: (depth - value(IndentationNumber::ContactDepth)?) * stiffness / force,
        })
    }

    /// The same settings with a calibrated indenter and frame.
    #[must_use]
    pub fn calibrated(&self, found: &Calibration) -> Self {
        Self {
            area: Some(AreaFunction::Polynomial(found.coefficients.clone())),
            area_covariance: found.covariance.clone(),
            area_range: Some(found.depths),
            frame_compliance: found.frame_compliance,
            ..self.clone()
        }
    }
}

/// ε of the contact depth `h_max − ε P_max/S`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Epsilon {
    /// A number.
    Fixed(Uncertain),
    /// `ε(m) = m (1 − 2(m−1)/√π · Γ(m/(2(m−1)))/Γ(1/(2(m−1))))` of the exponent.
    Exponent,
}

/// The drift of the depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drift {
    /// None is taken out.
    Off,
    /// That of a hold at a small force.
    Hold,
    /// That of such a hold if the curve has one, otherwise none.
    OfHoldIfFound,
    /// A rate, m/s.
    Rate(Uncertain),
}

/// The zero of the depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DepthZero {
    /// That of the file.
    AsRecorded,
    /// Where the contact begins after the stretch before it.
    FirstContact,
    /// That place if the curve shows it, otherwise the zero of the file.
    FirstContactIfFound,
    /// A depth of the file, m.
    At(Uncertain),
}

/// An elastic indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndenterMaterial {
    /// Young's modulus, Pa.
    pub young_modulus: Uncertain,
    /// Poisson's ratio.
    pub poisson_ratio: Uncertain,
}

impl EvaluationSettings {
    /// The standard uncertainty of the area (m²) at a depth (m).
    pub(super) fn area_sd(&self, depth: f64) -> f64 {
        let powers: Vec<f64> = (0..self.area_covariance.len())
            .map(|k| depth.powf(AreaFunction::power(k)))
            .collect();
        let rows = self.area_covariance.iter().zip(&powers);
        let variance: f64 = rows
            .flat_map(|(row, p)| row.iter().zip(&powers).map(move |(c, q)| p * c * q))
            .sum();
        variance.max(0.0).sqrt()
    }
}
