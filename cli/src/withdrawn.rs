//! Options and files of earlier versions.

use clap::error::{ContextKind, ContextValue};
use pellicle::input::withdrawn::instead_of;

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
    use pellicle::input::withdrawn::WITHDRAWN;

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
