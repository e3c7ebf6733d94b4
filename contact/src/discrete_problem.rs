//! The contact problem on one grid, as a solver sees it: an operator, `η`, `g0` and an element area.
//!
//! Find `p ≥ 0` and `D` with `g = K p + η p + g0 − D ≥ 0` and `p g = 0`: the conditions (2.1)–(2.2) of the
//! paper in our signs. It is the minimum of the energy `½ p·(K + η) p + g0·p` over the pressures of the given
//! force, or of that energy less `D Σ p` where the penetration is given.

use pellicle_influence::{ElasticOperator, PeriodicSymbol};

use crate::ContactError;

/// One grid's problem. Fields hold N² values, index `i N + j`, first index along x.
pub struct DiscreteProblem {
    operator: Box<dyn ElasticOperator>,
    symbol: Option<PeriodicSymbol>,
    relief_compliance: Vec<f64>,
    initial_gap: Vec<f64>,
    element_area: f64,
}

impl DiscreteProblem {
    /// The problem of the operator `K` (m/Pa on N² elements), the relief's compliance `η` (m/Pa, ≥ 0), the
    /// initial gap `g0` (m; +∞ where nothing can touch) and the area `4a²` of an element (m²).
    ///
    /// # Errors
    /// A field of another length than N², a compliance that is negative or not finite, a gap that is NaN or −∞,
    /// an area that is not positive, or a gap that is infinite everywhere.
    pub fn new(
        operator: Box<dyn ElasticOperator>,
        relief_compliance: Vec<f64>,
        initial_gap: Vec<f64>,
        element_area: f64,
    ) -> Result<Self, ContactError> {
        let elements = operator.size() * operator.size();
        check_length("relief compliance", relief_compliance.len(), elements)?;
        check_length("initial gap", initial_gap.len(), elements)?;
        check_values(
            "relief compliance",
            &relief_compliance,
            "finite and ≥ 0",
            |eta| eta >= 0.0 && eta.is_finite(),
        )?;
        check_values("initial gap", &initial_gap, "a number or +∞", |gap| {
            gap > f64::NEG_INFINITY
        })?;
        if !(element_area > 0.0 && element_area.is_finite()) {
            return Err(ContactError::ElementArea { area: element_area });
        }
        if initial_gap.iter().all(|gap| gap.is_infinite()) {
            return Err(ContactError::NothingCanTouch { elements });
        }
        Ok(Self {
            operator,
            symbol: None,
            relief_compliance,
            initial_gap,
            element_area,
        })
    }

    /// The same problem with the operator's symbol on the periodic grid, which solvers may precondition with.
    #[must_use]
    pub fn with_symbol(mut self, symbol: PeriodicSymbol) -> Self {
        self.symbol = Some(symbol);
        self
    }

    /// The symbol of `K` on the periodic grid, where one was given.
    #[must_use]
    pub fn symbol(&self) -> Option<&PeriodicSymbol> {
        self.symbol.as_ref()
    }

    /// Elements per side, N.
    #[must_use]
    pub fn size(&self) -> usize {
        self.operator.size()
    }

    /// Number of elements, N².
    #[must_use]
    pub fn elements(&self) -> usize {
        self.initial_gap.len()
    }

    /// The relief's compliance `η`, in m/Pa.
    #[must_use]
    pub fn relief_compliance(&self) -> &[f64] {
        &self.relief_compliance
    }

    /// The initial gap `g0 = f − f*`, in m.
    #[must_use]
    pub fn initial_gap(&self) -> &[f64] {
        &self.initial_gap
    }

    /// The area `4a²` of an element, in m².
    #[must_use]
    pub fn element_area(&self) -> f64 {
        self.element_area
    }

    /// The operator `K`; exclusive, because a product uses the operator's own buffers.
    pub fn operator_mut(&mut self) -> &mut dyn ElasticOperator {
        self.operator.as_mut()
    }

    /// Writes `(K + η) p` (m) of the pressure `p` (Pa) into `deformation`: one product with `K`.
    pub fn deform_into(&mut self, pressure: &[f64], deformation: &mut [f64]) {
        self.operator.apply_into(pressure, deformation);
        for ((v, eta), p) in deformation
            .iter_mut()
            .zip(&self.relief_compliance)
            .zip(pressure)
        {
            *v += eta * p;
        }
    }
}

/// Refuses a field that has not one value per element.
fn check_length(field: &'static str, found: usize, wanted: usize) -> Result<(), ContactError> {
    if found == wanted {
        Ok(())
    } else {
        Err(ContactError::FieldLength {
            field,
            found,
            wanted,
        })
    }
}

/// Refuses a field with a value that is not `legal`.
fn check_values(
    field: &'static str,
    values: &[f64],
    wanted: &'static str,
    legal: impl Fn(f64) -> bool,
) -> Result<(), ContactError> {
    match values.iter().position(|value| !legal(*value)) {
        None => Ok(()),
        Some(element) => Err(ContactError::FieldValue {
            field,
            element,
            wanted,
            found: values[element],
        }),
    }
}
