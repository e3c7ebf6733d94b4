//! Panels as the cache keeps them.

use super::{CELL, Panel, Panels};
use crate::cache::encoding::{Decoder, Encoder};
use crate::whole;

impl Panels {
    pub(crate) fn encode(&self, encoder: &mut Encoder) {
        encoder.reals(&[self.start, self.end]);
        encoder.count(self.all.len());
        for panel in &self.all {
            encoder.reals(&[panel.centre, panel.half_width]);
            encoder.list(&panel.coefficients);
        }
    }

    /// What was written, or none if it is not in order.
    pub(crate) fn decode(decoder: &mut Decoder) -> Option<Self> {
        let [start, end] = decoder.array()?;
        let count = decoder.count()?;
        let panels = (0..count).map(|_| panel(decoder));
        let all: Vec<_> = panels.collect::<Option<_>>()?;
        let cells = cells(&all);
        let covered = cells.len() == whole::round((end - start) / CELL) && !cells.is_empty();
        covered.then_some(Self {
            start,
            end,
            cells,
            all,
        })
    }
}

fn panel(decoder: &mut Decoder) -> Option<Panel> {
    let [centre, half_width] = decoder.array()?;
    Some(Panel {
        centre,
        half_width,
        coefficients: decoder.list()?,
    })
}

/// The panel of each cell, from the widths of the panels.
fn cells(panels: &[Panel]) -> Vec<usize> {
    let width = |panel: &Panel| whole::round(2.0 * panel.half_width / CELL).min(super::FINEST);
    let repeated = |(index, panel)| std::iter::repeat_n(index, width(panel));
    panels.iter().enumerate().flat_map(repeated).collect()
}
