//! The quantities that decide the claims: pure functions of fields and curves, one file a topic.

pub(super) mod edges;
pub(super) mod film;
pub(super) mod growth;
pub(super) mod incomplete;
pub(super) mod loading;
pub(super) mod section;
