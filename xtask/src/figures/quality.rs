//! How fine the grids of the figures are.

/// Elements per side, and when they are enough.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quality {
    /// Elements per side of a run whose fields are drawn.
    pub fields: usize,
    /// Elements per side with which a loading path begins.
    pub path: usize,
    /// Elements per side to which a loading path is refined at most, as long as its grid error is above the bound.
    pub finest_path: usize,
    /// Whether the pictures are for a look only, and say so.
    pub is_quick: bool,
}

impl Quality {
    /// For print.
    pub const FULL: Self = Self {
        fields: 1024,
        path: 512,
        finest_path: 1024,
        is_quick: false,
    };

    /// For a look.
    pub const QUICK: Self = Self {
        fields: 256,
        path: 256,
        finest_path: 256,
        is_quick: true,
    };

    /// What a subtitle says of it.
    #[must_use]
    pub fn mark(self) -> &'static str {
        if self.is_quick {
            "QUICK, COARSE GRIDS.  "
        } else {
            ""
        }
    }
}
