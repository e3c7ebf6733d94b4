//! `stress.body`: the body inside which stresses are computed.

use std::borrow::Cow;

use pellicle_influence::ElasticBody;
use serde::Serialize;

use super::foundation::FoundationCase;
use super::foundation::substrate::SubstrateCase;
use super::indenter::IndenterCase;

/// The body inside which stresses are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum StressedBody {
    /// The foundation.
    #[default]
    Foundation,
    /// The indenter.
    Indenter,
    /// Both: extremes and critical loads of each, and the planes of the foundation.
    Both,
}

/// The words of `stress.body`.
pub(super) const BODIES: &[(&str, StressedBody)] = &[
    ("foundation", StressedBody::Foundation),
    ("indenter", StressedBody::Indenter),
    ("both", StressedBody::Both),
];

impl StressedBody {
    /// Whether it is the foundation.
    #[must_use]
    pub fn is_foundation(&self) -> bool {
        *self == Self::Foundation
    }

    /// The bodies whose extremes are wanted.
    #[must_use]
    pub fn each(self) -> &'static [Self] {
        match self {
            Self::Foundation => &[Self::Foundation],
            Self::Indenter => &[Self::Indenter],
            Self::Both => &[Self::Foundation, Self::Indenter],
        }
    }

    /// This body of a case, the foundation of both; a rigid one if the indenter is rigid.
    #[must_use]
    pub fn of<'a>(
        self,
        foundation: &'a FoundationCase,
        indenter: Option<&'a IndenterCase>,
    ) -> Cow<'a, FoundationCase> {
        let rigid = || {
            Cow::Owned(FoundationCase {
                substrate: SubstrateCase::Rigid,
                layer: Vec::new(),
            })
        };
        match self {
            Self::Foundation | Self::Both => Cow::Borrowed(foundation),
            Self::Indenter => indenter
                .and_then(IndenterCase::foundation)
                .unwrap_or_else(rigid),
        }
    }

    /// What precedes the names of its layers in results.
    #[must_use]
    pub fn prefix(self) -> &'static str {
        match self {
            Self::Foundation | Self::Both => "",
            Self::Indenter => "indenter.",
        }
    }
}

impl From<StressedBody> for ElasticBody {
    fn from(body: StressedBody) -> Self {
        match body {
            StressedBody::Foundation | StressedBody::Both => Self::Foundation,
            StressedBody::Indenter => Self::Counterbody,
        }
    }
}
