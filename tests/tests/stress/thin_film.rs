//! Formulas for paraboloids on thin layers, against the integral equation.
