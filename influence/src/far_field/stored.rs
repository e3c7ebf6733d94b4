//! The far field as the cache keeps it.

use super::FarField;
use crate::cache::encoding::{Decoder, Encoder};

impl FarField {
    pub(crate) fn encode(&self, encoder: &mut Encoder) {
        encoder.count(self.first);
        encoder.real(self.error);
        encoder.count(self.panels.len());
        self.panels.iter().for_each(|panel| encoder.reals(panel));
    }

    /// What was written, or none if it is not in order.
    pub(crate) fn decode(decoder: &mut Decoder) -> Option<Self> {
        let first = decoder.index()?;
        let error = decoder.real()?;
        let count = decoder.count()?;
        let panels = (0..count).map(|_| decoder.array());
        let panels = panels.collect::<Option<_>>()?;
        Some(Self {
            first,
            panels,
            error,
        })
    }
}
