//! Radial tables as the cache keeps them: without the foundation, which belongs to the key.

use pellicle_kernel::Foundation;

use super::{RadialTables, is_homogeneous};
use crate::cache::encoding::{Decoder, Encoder};
use crate::radial::RadialFunctions;

impl RadialTables {
    /// Whether there is anything to tabulate.
    pub(crate) fn are_needed_for(foundation: &Foundation) -> bool {
        !is_homogeneous(foundation)
    }

    /// Everything but the foundation, as bytes.
    pub(crate) fn encode(&self) -> Vec<u8> {
        let mut encoder = Encoder::default();
        if let Some(functions) = &self.functions {
            functions.encode(&mut encoder);
        }
        encoder.into_bytes()
    }

    /// The tables of this foundation, or none if what is read is not in order.
    pub(crate) fn decode(foundation: &Foundation, decoder: &mut Decoder<'_>) -> Option<Self> {
        let functions = RadialFunctions::decode(decoder)?;
        decoder.finish(Self {
            foundation: foundation.clone(),
            functions: Some(functions),
            factor: 1.0,
        })
    }
}
