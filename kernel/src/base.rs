//! The base of a foundation.

use crate::Material;

/// The body below the last layer.
///
/// Every base reaches to infinity or does not move at all, so nothing above it can float away:
/// there is deliberately no free base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Base {
    /// An elastic half-space.
    HalfSpace(Material),
    /// A body that does not deform.
    Rigid,
}
