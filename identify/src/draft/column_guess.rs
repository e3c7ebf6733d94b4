//! Which column holds which quantity, by its name and unit, or by its numbers where the table has no header.

use pellicle::input::dimension::Dimension;

use crate::measured::channel::Channel;
use crate::measured::header::{HeaderField, HeaderUnit};
use crate::measured::words::{lower_words, words};

/// Words of columns that hold no quantity of the contact.
const FOREIGN: [&str; 15] = [
    "rate",
    "speed",
    "velocity",
    "lateral",
    "horizontal",
    "friction",
    "torsion",
    "target",
    "setpoint",
    "auxiliary",
    "raw",
    "area",
    "error",
    "temperature",
    "frame",
];
/// Words of the oscillation on which a continuous stiffness rests: only the stiffness is one of the contact.
const OSCILLATION: [&str; 6] = [
    "harmonic",
    "dynamic",
    "amplitude",
    "phase",
    "oscillation",
    "ac",
];
/// Words of what was asked for or is not yet corrected, where another column has what was measured.
const LESSER: [&str; 6] = [
    "uncorrected",
    "nominal",
    "set",
    "command",
    "programmed",
    "demand",
];
/// Words of columns of the way back.
const WAY_BACK: [&str; 8] = [
    "retract",
    "retraction",
    "return",
    "withdraw",
    "unload",
    "unloading",
    "backward",
    "rt",
];
/// Words and symbols that are too short to prove another quantity, but suggest this one.
const SYMBOLS: [(Channel, &[&str]); 6] = [
    (Channel::Time, &["t"]),
    (Channel::Stiffness, &["S", "s"]),
    (
        Channel::Force,
        &["F", "P", "N", "Fz", "fz", "Fn", "Prüfkraft"],
    ),
    (Channel::Deflection, &["defl", "Defl"]),
    (
        Channel::Height,
        &[
            "Z", "ramp", "Ramp", "zsnsr", "ZSnsr", "zsensor", "Zsensor", "zpos", "Zpos",
        ],
    ),
    (Channel::Depth, &["h", "d", "D", "δ", "disp", "Disp"]),
];
/// What a word such as "measured" adds to the likeness.
const MEASURED: i32 = 1;
/// Differences of neighbouring times are equal to this part of their mean.
const EVEN: f64 = 0.05;

/// A column taken for a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ColumnGuess {
    /// The quantity.
    pub(super) channel: Channel,
    /// Its place in the table, from 0.
    pub(super) place: usize,
}

/// The columns of a header that are named or measured as these quantities, each used once.
pub(super) fn of_header(header: &[HeaderField]) -> Vec<ColumnGuess> {
    // A length is the depth only if it is nothing else.
    const ORDER: [Channel; 6] = [
        Channel::Time,
        Channel::Stiffness,
        Channel::Force,
        Channel::Deflection,
        Channel::Height,
        Channel::Depth,
    ];
    let mut found: Vec<ColumnGuess> = Vec::new();
    for channel in ORDER {
        let is_free = |place: &usize| found.iter().all(|taken| taken.place != *place);
        let ranked = header.iter().enumerate().filter_map(|(place, head)| {
            let likeness = likeness(channel, head)?;
            is_free(&place).then_some((likeness, place))
        });
        // The first of the most alike.
        let best = ranked.max_by_key(|(likeness, place)| (*likeness, usize::MAX - place));
        found.extend(best.map(|(_, place)| ColumnGuess { channel, place }));
    }
    found.extend(only_length(header, &found));
    found
}

/// The places of other columns that may as well be this quantity, but for how one is named before the other.
pub(super) fn rivals(
    header: &[HeaderField],
    guesses: &[ColumnGuess],
    of: ColumnGuess,
) -> Vec<usize> {
    let likeness = |place: usize| likeness(of.channel, header.get(place)?);
    let least = likeness(of.place).unwrap_or(i32::MAX) - MEASURED;
    let is_taken = |place: &usize| guesses.iter().any(|guess| guess.place == *place);
    let others = (0..header.len()).filter(|place| !is_taken(place));
    others
        .filter(|place| likeness(*place).is_some_and(|found| found >= least))
        .collect()
}

/// The only other length beside a force, if it has a name that says nothing: the depth.
fn only_length(header: &[HeaderField], found: &[ColumnGuess]) -> Option<ColumnGuess> {
    let has = |channel| found.iter().any(|guess| guess.channel == channel);
    if !has(Channel::Force) || has(Channel::Depth) || has(Channel::Height) {
        return None;
    }
    let is_length = |head: &HeaderField| head.unit == HeaderUnit::Of(Dimension::Length);
    let places = (0..header.len()).filter(|place| {
        let is_free = found.iter().all(|taken| taken.place != *place);
        let head = &header[*place];
        let is_contact = words(&head.name)
            .iter()
            .any(|word| word.eq_ignore_ascii_case("contact"));
        is_free && is_length(head) && !is_foreign(head) && !is_contact
    });
    let [place] = places.collect::<Vec<_>>()[..] else {
        return None;
    };
    let channel = Channel::Depth;
    Some(ColumnGuess { channel, place })
}

/// Whether a column holds no quantity of the contact. The `hDeflection` of JPK is the lateral one.
fn is_foreign(head: &HeaderField) -> bool {
    let words = lower_words(&head.name);
    words.iter().any(|word| FOREIGN.contains(&word.as_str())) || words == ["h", "deflection"]
}

/// How much a header is like that of a quantity; none if it is not.
fn likeness(channel: Channel, head: &HeaderField) -> Option<i32> {
    let words = words(&head.name);
    let has = |wanted: &[&str]| {
        words
            .iter()
            .any(|word| wanted.contains(&word.to_lowercase().as_str()))
    };
    if is_foreign(head) {
        return None;
    }
    // A depth of contact is less than the depth.
    if channel == Channel::Depth && has(&["contact"]) {
        return None;
    }
    if channel != Channel::Stiffness && has(&OSCILLATION) {
        return None;
    }
    let symbols = SYMBOLS.iter().find(|(of, _)| *of == channel);
    let is_symbol =
        symbols.is_some_and(|(_, symbols)| words.iter().any(|w| symbols.contains(&w.as_str())));
    let is_named = channel.is_indicated_by(&head.name);
    let has_unit = match head.unit {
        HeaderUnit::Of(dimension) if dimension == channel.dimension() => true,
        HeaderUnit::Electrical if channel == Channel::Deflection => false,
        HeaderUnit::None => false,
        HeaderUnit::Of(_) | HeaderUnit::Electrical => return None,
    };
    // A length alone may be any of four, a force is a force.
    let tells_alone = channel.dimension() != Dimension::Length;
    let likeness = match (is_named, is_symbol, has_unit) {
        (true, _, true) => 40,
        (true, _, false) => 30,
        (false, true, true) => 25,
        (false, true, false) => 15,
        (false, false, true) if tells_alone => 20,
        _ => return None,
    };
    let worse = 6 * i32::from(has(&WAY_BACK) || has(&LESSER));
    let measured = MEASURED * i32::from(has(&["measured", "sensor", "corrected"]));
    Some(likeness - worse + measured)
}

/// The columns of a table without header: two, the steeper of which is the force, and perhaps a time that goes in even
/// steps. None if there are more.
pub(super) fn of_numbers(columns: &[Vec<f64>]) -> Option<Vec<ColumnGuess>> {
    let at = |channel, place| ColumnGuess { channel, place };
    let all: Vec<usize> = (0..columns.len()).collect();
    let time = (all.len() == 3).then(|| all.iter().copied().find(|c| is_even(&columns[*c])));
    let time = time.flatten();
    let rest: Vec<usize> = all.into_iter().filter(|c| Some(*c) != time).collect();
    let [one, other] = rest[..] else {
        return None;
    };
    let [depth, force] = if is_convex(&columns[one], &columns[other]) {
        [one, other]
    } else {
        [other, one]
    };
    let mut found = vec![at(Channel::Force, force), at(Channel::Depth, depth)];
    found.extend(time.map(|time| at(Channel::Time, time)));
    Some(found)
}

/// Whether numbers rise in even steps.
fn is_even(values: &[f64]) -> bool {
    let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mean = steps.iter().sum::<f64>() / steps.len() as f64;
    mean > 0.0 && steps.iter().all(|step| (step - mean).abs() < EVEN * mean)
}

/// Whether `y` rises ever faster with `x` up to its largest: the middle of its rise lies beyond that of `x`. The force
/// of a contact does.
fn is_convex(x: &[f64], y: &[f64]) -> bool {
    let valid = || {
        x.iter()
            .zip(y)
            .filter(|(x, y)| x.is_finite() && y.is_finite())
    };
    let Some((_, peak)) = valid().max_by(|one, other| one.1.total_cmp(other.1)) else {
        return true;
    };
    let Some((x0, y0)) = valid().next() else {
        return true;
    };
    let half = valid().find(|(_, value)| **value >= 0.5 * (y0 + peak));
    let end = valid().find(|(_, value)| *value >= peak);
    match (half, end) {
        (Some((middle, _)), Some((end, _))) => (middle - x0) >= 0.5 * (end - x0),
        _ => true,
    }
}

#[cfg(test)]
mod tests;
