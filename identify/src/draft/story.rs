//! What happens in the curves of a group, in sentences.

use pellicle::display::{Unit, significant};

use super::group::Group;
use super::history::{History, Hold};
use super::words::{quantity, seconds};

impl Group {
    /// What happens in the first file, in sentences.
    pub(super) fn story(&self) -> Vec<String> {
        let mut story: Vec<String> = Vec::new();
        if let Some(history) = &self.survey.history {
            story.push(happened(history));
            if self.survey.is_unloading && history.cycles > 1 {
                story.push(format!(
                    "{} cycles of loading and unloading: each that goes beyond the ones before is evaluated.",
                    history.cycles
                ));
            }
            if history.is_plastic() && !self.is_soft {
                let part = significant(100.0 * history.returned.unwrap_or(0.0), 2);
                let then = match (self.survey.is_unloading, history.pop_in) {
                    (true, _) => "it is evaluated by Oliver and Pharr.",
                    (false, Some(_)) => {
                        "pellicle init fit-unloading evaluates it by Oliver and Pharr."
                    }
                    (false, None) => "the loading is more than elastic contact.",
                };
                story.push(format!(
                    "The unloading gives back {part} % of the work, so an imprint is left: {then}"
                ));
            }
        }
        story.extend(self.approach());
        story.extend(self.doubts());
        story
    }

    /// What else the file may hold: other tables, other columns of a quantity.
    fn doubts(&self) -> Vec<String> {
        let tables = self.survey.tables;
        let others = (tables > 1).then(|| {
            format!(
                "The first of {tables} tables is taken: text.table in [[data]] chooses another."
            )
        });
        let columns = self.survey.columns.iter().filter_map(|column| {
            let others = column.other_columns()?;
            Some(format!(
                "The {} may as well be column {others}.",
                column.channel.key()
            ))
        });
        others.into_iter().chain(columns).collect()
    }

    /// The stretch before the contact.
    fn approach(&self) -> Option<String> {
        let before = self.curve.before_contact?;
        let forces = self.curve.force()?.iter().copied();
        let largest = forces.fold(0.0, f64::max);
        let adhesion = before.adhesion(largest).map(|pull_off| {
            format!(
                " It is pulled back by {} on the way out: adhesion, which this model lacks.",
                quantity(pull_off, Unit::Newton)
            )
        });
        Some(format!(
            "The contact begins near row {}, at {}; before it {} points lie about a line with {} of noise.{}",
            before.contact_row,
            quantity(before.contact, Unit::Metre),
            before.line.points,
            quantity(before.line.noise, Unit::Newton),
            adhesion.unwrap_or_default()
        ))
    }
}

fn happened(history: &History) -> String {
    let (force, row) = history.peak;
    let hold = |hold: &Hold| {
        let [from, to] = hold.rows;
        let time = hold.seconds.map(|time| format!(" of {}", seconds(time)));
        let force = quantity(hold.force, Unit::Newton);
        format!(
            "; hold{} at {force} (rows {from} to {to})",
            time.unwrap_or_default()
        )
    };
    let holds: String = history.holds.iter().map(hold).collect();
    let force = quantity(force, Unit::Newton);
    format!(
        "{} rows: the largest force is {force} in row {row}{holds}.",
        history.rows
    )
}
