//! The columns that a `[[data]]` table needs for its observable and for the bounds of its segment.

use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::table_reader::TableReader;

use super::DataTable;
use crate::Observable;
use crate::measured::channel::Channel;
use crate::measured::curve_segment::{Branch, SegmentEnd, Until};

impl DataTable {
    /// Checks that the observable and the bounds of the segment have their columns.
    pub(super) fn require_columns(
        &self,
        table: &TableReader<'_>,
        columns: &TableReader<'_>,
    ) -> Result<(), Diagnosis> {
        let need = |channel: Channel, why: &str| {
            let comes_from_deflection =
                channel == Channel::Force && self.columns.has(Channel::Deflection);
            if self.columns.has(channel) || comes_from_deflection {
                return Ok(());
            }
            Err(columns.missing(channel.key(), format!("its column, {why}")))
        };
        match self.observe {
            Observable::UnloadingStiffness => {
                need(Channel::Force, "since the unloading is evaluated")?;
                self.require_depth(table, columns)?;
            }
            Observable::DepthAtForce | Observable::ForceAtDepth => {
                need(Channel::Force, "since depth and force are observed")?;
                self.require_depth(table, columns)?;
            }
            Observable::StiffnessAtContactRadius
            | Observable::StiffnessAtForce
            | Observable::StiffnessAtDepth => {
                let abscissa = self.observe.abscissa();
                let why = format!("since the stiffness at a {} is observed", abscissa.name());
                need(Channel::Stiffness, &why)?;
                need(Channel::from(abscissa), &why)?;
                if let Some(field) = table.optional("spring_constant") {
                    let wanted = "none: the stiffness of a contact is not read by a cantilever";
                    return Err(field.wanted(wanted));
                }
            }
        }
        for end in [&self.segment.from, &self.segment.to].into_iter().flatten() {
            let why = "since it bounds the segment";
            match end {
                SegmentEnd::Force(_) => need(Channel::Force, why)?,
                SegmentEnd::Time(_) => need(Channel::Time, why)?,
                SegmentEnd::Marker(_) if self.columns.marker.is_none() => {
                    return Err(columns.missing("marker", format!("its column, {why}")));
                }
                SegmentEnd::Marker(_) | SegmentEnd::Row(_) => {}
            }
        }
        if self.segment.value.is_some() && self.columns.segment.is_none() {
            let wanted = "the column that has the value of the segment".into();
            return Err(columns.missing("segment", wanted));
        }
        if self.segment.until == Until::LargestDepthStep && !self.columns.has(Channel::Height) {
            need(Channel::Depth, "since its largest step ends the segment")?;
        }
        match self.segment.part {
            Branch::Unloading => need(Channel::Force, "since the unloading is used"),
            Branch::Loading | Branch::Whole => Ok(()),
        }
    }

    /// Checks that the depth has its column, or can be computed from the height of a piezo, the force or deflection,
    /// and a spring constant.
    fn require_depth(
        &self,
        table: &TableReader<'_>,
        columns: &TableReader<'_>,
    ) -> Result<(), Diagnosis> {
        let has = |channel| self.columns.has(channel);
        let is_cantilever = has(Channel::Height) || has(Channel::Deflection);
        if !is_cantilever && self.spring_constant.is_none() {
            let wanted = "its column, or that of height, the piezo's, with a spring_constant";
            if has(Channel::Depth) {
                return Ok(());
            }
            return Err(columns.missing("depth", wanted.into()));
        }
        if self.spring_constant.is_none() {
            let wanted = "the spring constant of the cantilever, such as \"0.04 N/m\"";
            return Err(table.missing("spring_constant", wanted.into()));
        }
        if !has(Channel::Height) {
            let wanted = "that of the piezo, since there is a spring_constant";
            return Err(columns.missing("height", wanted.into()));
        }
        refuse_both(columns, ["depth", "height"])?;
        refuse_both(columns, ["force", "deflection"])
    }
}

/// Rejects two columns if one follows from the other.
fn refuse_both(columns: &TableReader<'_>, keys: [&'static str; 2]) -> Result<(), Diagnosis> {
    match (columns.optional(keys[0]), columns.optional(keys[1])) {
        (Some(_), Some(field)) => Err(field.diagnosis(Fault::Wrong {
            found: format!("{} and {}", keys[0], keys[1]),
            wanted: "one of them".into(),
        })),
        _ => Ok(()),
    }
}
