//! The radial functions as the cache keeps them.

use super::{RadialFunctions, Worst};
use crate::cache::encoding::{Decoder, Encoder};
use crate::far_field::FarField;
use crate::panels::Panels;
use crate::product_rule::Borders;

impl RadialFunctions {
    pub(crate) fn encode(&self, encoder: &mut Encoder) {
        let Worst { error, t } = self.worst;
        encoder.reals(&[self.limit, self.slope, self.constant, error, t]);
        encoder.real(self.rule_floor);
        encoder.reals(&self.ends);
        encoder.reals(&self.series);
        self.panels.encode(encoder);
        encoder.count(self.integrals.len());
        self.integrals.iter().for_each(|p| encoder.list(p));
        encoder.count(self.reduced_from);
        encoder.count(usize::from(self.far_field.is_some()));
        if let Some(far_field) = &self.far_field {
            far_field.encode(encoder);
        }
    }

    /// What was written, or none if it is not in order.
    pub(crate) fn decode(decoder: &mut Decoder) -> Option<Self> {
        let [limit, slope, constant, error, t] = decoder.array()?;
        let rule_floor = decoder.real()?;
        let (ends, series) = (decoder.array()?, decoder.array()?);
        let panels = Panels::decode(decoder)?;
        let integrals: Vec<_> = (0..decoder.count()?)
            .map(|_| decoder.list())
            .collect::<Option<_>>()?;
        let reduced_from = decoder.index()?;
        let far_field = match decoder.index()? {
            0 => None,
            _ => Some(FarField::decode(decoder)?),
        };
        (integrals.len() == panels.panels().len()).then_some(Self {
            limit,
            slope,
            panels,
            integrals,
            ends,
            series,
            reduced_from,
            constant,
            worst: Worst { error, t },
            rule_floor,
            borders: Borders::new(rule_floor),
            far_field,
        })
    }
}
