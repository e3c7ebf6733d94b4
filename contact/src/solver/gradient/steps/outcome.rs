//! What a step came to.

/// What a step came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepOutcome {
    /// The whole step was taken without a bound: the set stays.
    Free,
    /// The whole step was taken, with pressures held at zero that would have become negative: the set may have changed,
    /// and the next step must not be conjugate.
    Clipped,
    /// The step ends at the minimum of the energy on its segment.
    Cut,
    /// Elements were exchanged.
    Exchanged,
    /// The linear system does not converge.
    Failed,
}
