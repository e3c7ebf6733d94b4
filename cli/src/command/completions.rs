//! `pellicle completions` and `pellicle man`: shell completions and the manual page, generated from the command line.

use clap::CommandFactory;

use crate::arguments::{Arguments, CompletionsArguments};
use crate::command::Outcome;
use crate::failure::Failure;
use crate::terminal::{self, NoOutput};

/// Prints the completions for a shell.
///
/// # Errors
///
/// [`Failure::Output`] if standard output cannot be written to.
pub fn completions(arguments: &CompletionsArguments) -> Result<Outcome, Failure> {
    let mut text = Vec::new();
    let mut command = Arguments::command();
    clap_complete::generate(arguments.shell, &mut command, "pellicle", &mut text);
    print(&text)
}

/// Prints the manual page: the program, then every command.
///
/// # Errors
///
/// [`Failure::Output`] if standard output cannot be written to.
pub fn man() -> Result<Outcome, Failure> {
    let command = Arguments::command().disable_help_subcommand(true);
    let mut text = Vec::new();
    page(&command, &mut text).map_err(NoOutput)?;
    print(&text)
}

/// Writes one page for everything: the sections of the program, then those of each command under its own name.
fn page(command: &clap::Command, text: &mut Vec<u8>) -> std::io::Result<()> {
    let man = clap_mangen::Man::new(command.clone());
    man.render(text)?;
    for subcommand in command.get_subcommands() {
        let name = format!("pellicle {}", subcommand.get_name());
        let subcommand = subcommand.clone().bin_name(&name).display_name(&name);
        text.extend(format!(".SH \"{}\"\n", name.to_uppercase()).bytes());
        text.extend(part(&clap_mangen::Man::new(subcommand))?.bytes());
    }
    Ok(())
}

/// The sections of a command, as subsections of the page.
fn part(man: &clap_mangen::Man) -> std::io::Result<String> {
    let mut text = Vec::new();
    man.render_description_section(&mut text)?;
    man.render_synopsis_section(&mut text)?;
    man.render_options_section(&mut text)?;
    Ok(String::from_utf8_lossy(&text).replace(".SH ", ".SS "))
}

fn print(text: &[u8]) -> Result<Outcome, Failure> {
    terminal::print(&String::from_utf8_lossy(text))?;
    Ok(Outcome::Done)
}

#[cfg(test)]
mod tests {
    use clap::ValueEnum;

    use super::*;

    #[test]
    fn completions_of_every_shell_list_every_command() {
        for shell in clap_complete::Shell::value_variants() {
            let mut text = Vec::new();
            clap_complete::generate(*shell, &mut Arguments::command(), "pellicle", &mut text);
            let text = String::from_utf8(text).unwrap();
            for command in Arguments::command().get_subcommands() {
                assert!(
                    text.contains(command.get_name()),
                    "{shell}: {}",
                    command.get_name()
                );
            }
        }
    }

    #[test]
    fn the_manual_page_has_a_section_for_every_command() {
        let command = Arguments::command().disable_help_subcommand(true);
        let mut text = Vec::new();
        page(&command, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        for command in command.get_subcommands() {
            let heading = format!(".SH \"PELLICLE {}\"", command.get_name().to_uppercase());
            assert!(text.contains(&heading), "{heading}");
        }
        assert!(text.contains("\\-\\-shard"));
    }
}
