//! Where kept data came from.

/// Where data came from. The largest of several origins is that of all of them together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// Computed, and never on disk, because reading would be no faster: a homogeneous body's radial tables, a small grid.
    Immediate,
    /// In memory already.
    Memory,
    /// Read from disk.
    Disk,
    /// Computed.
    Computed,
}

impl Origin {
    /// Whether a computation was saved.
    #[must_use]
    pub fn is_cache(self) -> bool {
        matches!(self, Self::Memory | Self::Disk)
    }
}

/// Data, and where they came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cached<T> {
    /// The data.
    pub value: T,
    /// Where they came from.
    pub origin: Origin,
}

impl<T> Cached<T> {
    /// Other data of the same origin.
    pub fn map<U>(self, function: impl FnOnce(T) -> U) -> Cached<U> {
        Cached {
            value: function(self.value),
            origin: self.origin,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Origin::{Computed, Disk, Immediate, Memory};

    #[test]
    fn a_whole_is_from_the_cache_if_no_part_was_computed_and_one_was_kept() {
        assert!(Immediate.max(Memory).max(Disk).is_cache());
        assert!(!Immediate.max(Immediate).is_cache());
        assert!(!Disk.max(Computed).is_cache());
    }
}
