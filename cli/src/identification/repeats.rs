//! What a reader of a fit must know of its curves: repeats left out, repeats far from the others, the same data twice,
//! and the one curve that carries the misfit of several.

use std::path::Path;

use pellicle::display::{count, significant};
use pellicle_identify::{Fit, FitVerdict, OddRepeat, WithoutOdd};

use super::curve_source::CurveSource;
use super::findings::WarningResult;
use super::{Identification, units};

/// A curve carries the misfit if its residuals are this many times as large as those of the others together.
const CARRIES: f64 = 2.0;

impl Identification {
    /// The warnings about single curves among several.
    pub(super) fn curve_warnings(&self, fit: &Fit) -> Vec<WarningResult> {
        let warning = |code: &str, message: String| WarningResult {
            code: code.into(),
            message,
        };
        let same = self.same_data().into_iter();
        let left_out = self.left_out(fit).into_iter();
        let odd = self.odd_repeats(fit).into_iter();
        let carrier = self.carrier(fit).into_iter();
        same.map(|message| warning("same-data", message))
            .chain(left_out.map(|message| warning("repeat-left-out", message)))
            .chain(odd.map(|message| warning("odd-repeat", message)))
            .chain(carrier.map(|message| warning("one-curve-misfits", message)))
            .collect()
    }

    fn file_of(&self, curve: usize) -> std::path::Display<'_> {
        self.sources[curve].measured.file.display()
    }

    /// A sentence for each repeat left out.
    fn left_out(&self, fit: &Fit) -> Vec<String> {
        let others = count(self.sources.len() - fit.excluded.len(), "curve");
        let sentence = |out: &pellicle_identify::Exclusion| {
            format!(
                "{} is left out: its residuals are {} times as large as those of the other repeats. Values, intervals \
                 and scatter are those of the other {others}",
                self.file_of(out.curve),
                significant(out.roughness, 2),
            )
        };
        fit.excluded.iter().map(sentence).collect()
    }

    /// A sentence for each repeat far from the others, then what the others give.
    fn odd_repeats(&self, fit: &Fit) -> Vec<String> {
        let Some(odd) = &fit.odd else {
            return Vec::new();
        };
        let each = odd.curves.iter().map(|one| self.odd_repeat(fit, one));
        let without = odd.without.iter().map(|of| self.without_odd(fit, of));
        let without: Vec<String> = without.collect();
        let without = (!without.is_empty()).then(|| {
            format!(
                "without {}: {}",
                if odd.curves.len() == 1 { "it" } else { "them" },
                without.join("; ")
            )
        });
        each.chain(without).collect()
    }

    fn odd_repeat(&self, fit: &Fit, odd: &OddRepeat) -> String {
        let estimate = &fit.estimates[odd.unknown];
        let values = estimate.between_curves.iter().flat_map(|of| &of.values);
        let own = values.filter(|(curve, _)| *curve == odd.curve);
        let own = own.map(|(_, value)| *value).next().unwrap_or(f64::NAN);
        let scale = units::scale(own, self.file.unit(odd.unknown));
        format!(
            "{} alone gives {} = {} {}, {} standard deviations {} the other repeats. It is in the fit: another place of \
             the specimen, or a wrong measurement",
            self.file_of(odd.curve),
            estimate.name,
            significant(own / scale.divisor, 4),
            scale.label,
            significant(odd.deviation.abs(), 3),
            if odd.deviation > 0.0 {
                "above"
            } else {
                "below"
            },
        )
    }

    fn without_odd(&self, fit: &Fit, of: &WithoutOdd) -> String {
        let estimate = &fit.estimates[of.unknown];
        let scale = units::scale(of.value, self.file.unit(of.unknown));
        let number = |value: f64| significant(value / scale.divisor, 4);
        let between = estimate.between_curves.as_ref();
        let with = between.map_or(f64::NAN, |of| of.standard_deviation);
        format!(
            "{} = {} [{}, {}] {}, with a scatter of {} instead of {}",
            estimate.name,
            number(of.value),
            number(of.interval[0]),
            number(of.interval[1]),
            scale.label,
            number(of.scatter),
            number(with),
        )
    }

    /// A sentence for each group of files with the same points.
    fn same_data(&self) -> Vec<String> {
        let is_same = |one: &CurveSource, other: &CurveSource| {
            one.abscissa == other.abscissa && one.observed == other.observed
        };
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for (index, source) in self.sources.iter().enumerate() {
            let same = |group: &&mut Vec<usize>| is_same(&self.sources[group[0]], source);
            match groups.iter_mut().find(same) {
                Some(group) => group.push(index),
                None => groups.push(vec![index]),
            }
        }
        let name = |index: &usize| {
            let path: &Path = &self.sources[*index].measured.file;
            path.display().to_string()
        };
        let twice = groups.into_iter().filter(|group| group.len() > 1);
        let sentence = |group: Vec<usize>| {
            let names: Vec<String> = group.iter().map(name).collect();
            format!(
                "{} have the same points: each counts as a measurement of its own, so the intervals are too narrow",
                names.join(", ")
            )
        };
        twice.map(sentence).collect()
    }

    /// The curve whose residuals are far larger than those of the others, where several have the same parameters.
    fn carrier(&self, fit: &Fit) -> Option<String> {
        if fit.verdict != FitVerdict::Misfit || self.problem.has_scatter() {
            return None;
        }
        // Not whitened: an estimated correlation has absorbed most of a misfit.
        let mut rest = &fit.points.residual[..];
        let sizes = self.sources.iter().map(|source| {
            let (own, others) = rest.split_at(source.abscissa.len().min(rest.len()));
            rest = others;
            (own.iter().map(|r| r * r).sum::<f64>(), own.len() as f64)
        });
        let sizes: Vec<(f64, f64)> = sizes.collect();
        let (squares, points) = sizes
            .iter()
            .fold((0.0, 0.0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
        let ratio = |of: &(f64, f64)| {
            let others = (squares - of.0) / (points - of.1);
            (of.0 / of.1 / others).sqrt()
        };
        let ratios = sizes.iter().map(ratio).enumerate();
        let (curve, largest) = ratios.max_by(|one, other| one.1.total_cmp(&other.1))?;
        (largest.is_finite() && largest > CARRIES).then(|| {
            format!(
                "{} carries the misfit: its residuals are {} times as large as those of the other curves",
                self.file_of(curve),
                significant(largest, 2),
            )
        })
    }
}
