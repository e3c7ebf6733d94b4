//! What earlier versions read and this one does not, with what to use instead.

use clap::error::{ContextKind, ContextValue};

/// A key of a file, an option of a command, or a value of an option, and what to use instead.
const WITHDRAWN: [(&str, &str); 6] = [
    (
        "report.posterior",
        "the profiles, whose intervals need no samples; for samples, `pellicle.Likelihood` in Python with a sampler such as emcee",
    ),
    (
        "--resume",
        "no option: `pellicle study` continues where it stopped, and --fresh begins again",
    ),
    ("--colour-map magma", COLOUR_MAPS),
    ("--colour-map inferno", COLOUR_MAPS),
    ("--colour-map plasma", COLOUR_MAPS),
    ("--colour-map turbo", COLOUR_MAPS),
];

const COLOUR_MAPS: &str = "viridis, cividis or greys";

/// What to use instead of a key, given by its dotted path; none if the key was never known.
#[must_use]
pub fn instead_of(name: &str) -> Option<&'static str> {
    let known = WITHDRAWN.iter().find(|(known, _)| *known == name);
    known.map(|(_, instead)| *instead)
}

/// The sentence about an option, or a value of one, for which a command line is rejected; none if it was never known.
#[must_use]
pub fn on_the_command_line(error: &clap::Error) -> Option<String> {
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    let argument = text(ContextKind::InvalidArg)?;
    let option = argument.split([' ', '=']).next()?;
    let name = match text(ContextKind::InvalidValue) {
        Some(value) => format!("{option} {value}"),
        None => option.to_owned(),
    };
    let instead = instead_of(&name)?;
    Some(format!(
        "{name}: found an option that was withdrawn, wanted {instead}"
    ))
}

/// Whether an earlier version wrote a file of this name for a fit.
#[must_use]
pub fn is_file_of_a_fit(name: &str) -> bool {
    ["posterior.npz", "fit-corner.svg", "fit-corner.png"].contains(&name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::Arguments;
    use clap::Parser;

    #[test]
    fn every_withdrawn_option_is_answered_with_what_to_use_instead() {
        let options = WITHDRAWN.iter().filter(|(name, _)| name.starts_with("--"));
        for (name, instead) in options {
            let command = match *name {
                "--resume" => "study a.toml",
                _ => "plot results",
            };
            let line = format!("pellicle {command} {name}");
            let error = Arguments::try_parse_from(line.split(' ')).unwrap_err();
            let answer = on_the_command_line(&error).unwrap();
            assert!(
                answer.starts_with(name) && answer.ends_with(instead),
                "{answer}"
            );
        }
        let line = "pellicle study a.toml --resum";
        let error = Arguments::try_parse_from(line.split(' ')).unwrap_err();
        assert_eq!(on_the_command_line(&error), None);
    }
}
