//! The picture of a study: a number of its results over one or two of its keys.

use pellicle::display::{DisplayUnit, count, short};
use pellicle::input::quantity;
use pellicle::input::units::Units;
use pellicle_plot::study::curves::{CurvesPanel, CurvesPicture};
use pellicle_plot::study::map::MapPicture;
use pellicle_plot::study::sample::{Sample, SampleError, SampledAxis};
use pellicle_study::result_column::ResultColumn;
use pellicle_study::series::{KeyColumn, NumberError, StudySeries};

use crate::failure::Failure;

/// The most curves of a picture, unless curves are asked for: more are not told apart.
const MOST_CURVES: usize = 6;

/// The least ratio of the largest to the smallest number that asks for a logarithmic axis.
const WIDE: f64 = 10.0;

/// The form of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Form {
    /// Curves over one key, one for each value of another.
    Curves,
    /// Colours over two keys.
    Map,
}

/// The picture of a study.
#[derive(Debug, Clone, PartialEq)]
pub enum StudyPicture {
    /// Curves.
    Curves(CurvesPicture),
    /// A map.
    Map(MapPicture),
}

/// What is asked for.
#[derive(Debug, Clone, Copy, Default)]
pub struct StudyPictureOptions<'a> {
    /// Names of the numbers.
    pub results: &'a [String],
    /// The keys, that of the axis below first.
    pub over: &'a [String],
    /// The form.
    pub form: Option<Form>,
}

/// Values in a unit for reading, with the title of their axis.
pub struct Scaled {
    /// What values are divided by.
    pub divisor: f64,
    /// The title, with the unit.
    pub title: String,
}

impl Scaled {
    /// Returns the scale of values in a unit of a table.
    pub fn of(name: &str, unit: Option<&str>, values: impl Iterator<Item = f64>) -> Self {
        let largest = values.fold(0.0, |most: f64, value| most.max(value.abs()));
        let scale = unit.map(|unit| scale(largest, unit));
        let title = match &scale {
            None => name.to_owned(),
            Some(scale) => pellicle_plot::axes::labels::axis_title(name, &scale.label),
        };
        Self {
            divisor: scale.map_or(1.0, |scale| scale.divisor),
            title,
        }
    }
}

/// The scale of values up to `largest` in a unit of a table.
fn scale(largest: f64, unit: &str) -> DisplayUnit {
    let dimension = quantity::dimension_of(&format!("1 {unit}"));
    match dimension {
        Some(_) => DisplayUnit::of_dimension(largest, dimension, Units::Si),
        None => DisplayUnit::of(largest, pellicle::display::Unit::Metre, Units::Consistent),
    }
}

fn wrong(found: impl std::fmt::Display, wanted: impl std::fmt::Display) -> Failure {
    Failure::StudyPicture {
        message: format!("found {found}, wanted {wanted}"),
    }
}

/// Makes the picture of a study.
///
/// # Errors
///
/// [`Failure::StudyPicture`] if there is no such number or key, or more keys vary than are drawn.
pub fn of(series: &StudySeries, options: StudyPictureOptions<'_>) -> Result<StudyPicture, Failure> {
    let default = ["max_pressure".to_owned()];
    let names = if options.results.is_empty() {
        &default[..]
    } else {
        options.results
    };
    let results = names.iter().map(|name| result(series, name));
    let results = results.collect::<Result<Vec<_>, _>>()?;
    let keys = keys(series, options.over)?;
    let is_map = |second: &KeyColumn| {
        let has_many = || {
            let values = series.numbers(second);
            values.is_some_and(|values| distinct(values).len() > MOST_CURVES)
        };
        options.form.map_or_else(has_many, |form| form == Form::Map)
    };
    match &keys[..] {
        [first, second] if is_map(second) => map(series, &results, [first, second]),
        [_] if options.form == Some(Form::Map) => {
            Err(wrong("one key that varies", "two for a map"))
        }
        [first, rest @ ..] => Ok(curves(series, &results, first, rest.first())),
        [] => Err(wrong("no key that varies as a number", "one or two")),
    }
}

fn result(series: &StudySeries, name: &str) -> Result<ResultColumn, Failure> {
    ResultColumn::named(name, &series.header).map_err(|(found, wanted)| {
        let close = ResultColumn::closest(name, &series.header);
        let hint = close.map_or_else(String::new, |close| format!("; did you mean `{close}`?"));
        wrong(format!("--result {found}"), wanted + &hint)
    })
}

/// The keys that are drawn, that of the axis below first: numbers, the one with the most values first.
fn keys(series: &StudySeries, over: &[String]) -> Result<Vec<KeyColumn>, Failure> {
    let count = |key: &KeyColumn| {
        let mut words: Vec<_> = (0..series.cases())
            .map(|case| series.word(case, key))
            .collect();
        words.sort_unstable();
        words.dedup();
        words.len()
    };
    let varying: Vec<_> = series
        .keys
        .iter()
        .filter(|key| count(key) > 1)
        .cloned()
        .collect();
    let names = |keys: &[KeyColumn]| {
        let names: Vec<_> = keys.iter().map(|key| key.name.as_str()).collect();
        names.join(", ")
    };
    let mut keys = Vec::new();
    for name in over {
        let key = varying.iter().find(|key| key.name == *name);
        let wanted = || format!("a key that varies: {}", names(&varying));
        keys.push(
            key.ok_or_else(|| wrong(format!("--over {name}"), wanted()))?
                .clone(),
        );
    }
    if over.is_empty() {
        keys.clone_from(&varying);
        keys.sort_by_key(|key| (series.numbers(key).is_none(), std::cmp::Reverse(count(key))));
    }
    if keys.len() > 2 || varying.iter().any(|key| !keys.contains(key)) {
        let found = format!("{} keys that vary ({})", varying.len(), names(&varying));
        return Err(wrong(found, "one or two, as many as a picture shows"));
    }
    match keys.first() {
        Some(first) if series.numbers(first).is_none() => Err(wrong(
            format!("words as values of {}", first.name),
            "numbers for the axis below",
        )),
        _ => Ok(keys),
    }
}

/// Numbers in increasing order, each once.
fn distinct(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// Whether the steps between values are more even in ratio than in difference.
fn is_logarithmic(values: &[f64]) -> bool {
    let [first, .., last] = values else {
        return false;
    };
    let unevenness = |place: &dyn Fn(f64) -> f64| {
        let steps = values
            .windows(2)
            .map(|pair| place(pair[1]) - place(pair[0]));
        let ends = pellicle_plot::study::sample::ends(steps);
        ends.map_or(f64::INFINITY, |[least, most]| most / least)
    };
    values.len() > 2
        && *first > 0.0
        && *last / *first >= 3.0
        && unevenness(&f64::ln) < unevenness(&|value| value)
}

fn sample(series: &StudySeries, case: usize, result: &ResultColumn, divisor: f64) -> Sample {
    let number = series.number(case, result);
    Sample {
        value: number.map(|number| number.value / divisor),
        error: match number.map(|number| number.error) {
            None | Some(NumberError::None) => SampleError::None,
            Some(NumberError::Resolved(error)) => SampleError::Known(error / divisor),
            Some(NumberError::NotResolved) => SampleError::NotResolved,
        },
    }
}

fn scaled(series: &StudySeries, result: &ResultColumn) -> Scaled {
    let cases = 0..series.cases();
    let numbers = cases.filter_map(|case| Some(series.number(case, result)?.value));
    Scaled::of(&result.name, result.unit.as_deref(), numbers)
}

/// The axis of a key, its values in increasing order, and their divisor.
fn key_axis(series: &StudySeries, key: &KeyColumn) -> (SampledAxis, Vec<f64>, f64) {
    let values = distinct(series.numbers(key).unwrap_or_default());
    let Scaled { divisor, title } =
        Scaled::of(&key.name, key.unit.as_deref(), values.iter().copied());
    let values: Vec<_> = values.into_iter().map(|value| value / divisor).collect();
    let is_logarithmic = is_logarithmic(&values);
    (
        SampledAxis {
            title,
            is_logarithmic,
        },
        values,
        divisor,
    )
}

fn heading(series: &StudySeries, results: &[ResultColumn]) -> [String; 2] {
    let names: Vec<_> = results.iter().map(|result| result.name.as_str()).collect();
    let words = format!("{}; {}", names.join(", "), count(series.cases(), "case"));
    [series.study.clone(), words]
}

fn curves(
    series: &StudySeries,
    results: &[ResultColumn],
    key: &KeyColumn,
    second: Option<&KeyColumn>,
) -> StudyPicture {
    let (axis, _, divisor) = key_axis(series, key);
    let values = series.numbers(key).unwrap_or_default();
    let mut words: Vec<String> = Vec::new();
    let curve_of: Vec<_> = (0..series.cases())
        .map(|case| {
            let word = second.map_or("", |second| series.word(case, second));
            let known = words.iter().position(|known| known == word);
            known.unwrap_or_else(|| {
                words.push(word.to_owned());
                words.len() - 1
            })
        })
        .collect();
    let panel = |result: &ResultColumn| {
        let scaled = scaled(series, result);
        let mut curves = vec![Vec::new(); words.len()];
        for (case, curve) in curve_of.iter().enumerate() {
            let sample = sample(series, case, result, scaled.divisor);
            curves[*curve].push((values[case] / divisor, sample));
        }
        for curve in &mut curves {
            curve.sort_by(|one, other| one.0.total_cmp(&other.0));
        }
        let numbers = curves
            .iter()
            .flatten()
            .filter_map(|(_, sample)| sample.value);
        let ends = pellicle_plot::study::sample::ends(numbers);
        let is_wide = ends.is_some_and(|[least, most]| least > 0.0 && most / least >= WIDE);
        CurvesPanel {
            axis: SampledAxis {
                title: scaled.title,
                is_logarithmic: axis.is_logarithmic && is_wide,
            },
            curves,
            limit: None,
        }
    };
    StudyPicture::Curves(CurvesPicture {
        heading: heading(series, results),
        panels: results.iter().map(panel).collect(),
        key: axis,
        names: second.map_or_else(Vec::new, |second| curve_names(series, second, &words)),
        answer: None,
    })
}

/// Names of curves: `surface.area_fraction = 0.1`.
fn curve_names(series: &StudySeries, key: &KeyColumn, words: &[String]) -> Vec<String> {
    let numbers = series.numbers(key);
    let word = |word: &String| match (numbers.is_some(), &key.unit, word.parse::<f64>()) {
        (true, None, Ok(value)) => short(value),
        (true, Some(unit), Ok(value)) => {
            let scale = scale(value, unit);
            let number = short(value / scale.divisor);
            format!("{number} {}", scale.label).trim_end().to_owned()
        }
        _ => word.clone(),
    };
    words
        .iter()
        .map(|of| format!("{} = {}", key.name, word(of)))
        .collect()
}

fn map(
    series: &StudySeries,
    results: &[ResultColumn],
    keys: [&KeyColumn; 2],
) -> Result<StudyPicture, Failure> {
    let [result] = results else {
        let found = format!("{} results", results.len());
        return Err(wrong(found, "one for a map: give --result, or --as curves"));
    };
    if series.numbers(keys[1]).is_none() {
        let found = format!("words as values of {}", keys[1].name);
        return Err(wrong(found, "numbers for a map: give --as curves"));
    }
    let scaled = scaled(series, result);
    let axes = keys.map(|key| key_axis(series, key));
    let [across, upwards] = axes.each_ref().map(|(_, values, _)| values.len());
    let mut samples = vec![None; across * upwards];
    for case in 0..series.cases() {
        let place = |i: usize| {
            let (_, values, divisor) = &axes[i];
            let value = series.word(case, keys[i]).parse::<f64>().ok()? / divisor;
            values
                .iter()
                .position(|other| other.to_bits() == value.to_bits())
        };
        if let (Some(i), Some(j)) = (place(0), place(1)) {
            samples[i * upwards + j] = Some(sample(series, case, result, scaled.divisor));
        }
    }
    let [(first, across, _), (second, upwards, _)] = axes;
    Ok(StudyPicture::Map(MapPicture {
        heading: heading(series, results),
        keys: [first, second],
        values: [across, upwards],
        title: scaled.title,
        samples,
    }))
}
