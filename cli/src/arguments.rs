//! The command line.

mod values;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use self::values::{offset, perturbation, positive, range, section};
use crate::case::output::{Format, OutputCase, Steps};
use crate::picture::colour_map::ColourMap;
use crate::picture::style::Cut;
use crate::study::shard::Shard;
use crate::templates::Template;

/// Contact of a rigid indenter with a layered, textured elastic body: a case file in, a certified solution out.
#[derive(Debug, Parser)]
#[command(name = "pellicle", version, arg_required_else_help = true)]
#[command(
    after_help = "Exit codes: 0 solved and certified, 1 not converged or cut off by the domain or a map (result written and marked), \
                        2 the case or the command line is wrong, 130 stopped by Ctrl-C."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Solve a case and write a results folder
    Run(RunArguments),
    /// Solve a case for many values of its keys, in parallel; killed at any moment, the same command goes on where it
    /// stopped
    #[command(
        after_help = "A study file is a table [study] with the keys that vary, and the base case: `pellicle init study` prints one.\n\
                            Exit codes: 0 every case is certified, 1 some case is not (the others are there), \
                            2 the study or the command line is wrong, 130 stopped by Ctrl-C."
    )]
    Study(StudyArguments),
    /// Put the tables of a study's parts (--shard) together
    Gather(GatherArguments),
    /// Resolve a case and say what solving it would take, without solving it
    Check(CaseArguments),
    /// Print a commented case that runs as it is
    Init(InitArguments),
    /// Print the compliance C(k) and the response Φ of the case's foundation
    Kernel(KernelArguments),
    /// Print influence coefficients of the case's foundation and grid
    Influence(InfluenceArguments),
    /// Draw the pictures of a results folder again, or to order; of several, their curves in one picture
    Plot(PlotArguments),
    /// Show where coefficients are kept between runs and how much there is, or remove them
    #[command(
        after_help = "PELLICLE_CACHE names the folder; set but empty, it turns the cache on disk off."
    )]
    Cache(CacheArguments),
    /// Compare the program with what is known: closed forms, data of many digits, limits, and pressures that its
    /// certificate must refuse
    #[command(
        after_help = "Takes some seconds, reads and writes no files. The error of each row is as the line below its section says; \
                            in the certificate's negative controls it is the worst line of a wrong pressure's certificate and must exceed \
                            the tolerance.\n\
                            Exit codes: 0 every row passes, 1 some row fails, 2 the command line is wrong."
    )]
    Validate(ValidateArguments),
    /// Print completions for a shell
    Completions(CompletionsArguments),
    /// Print the manual page: pellicle man | man -l -
    Man,
}

/// A case and what replaces its values.
#[derive(Debug, Args)]
pub struct CaseArguments {
    /// The case file
    #[arg(value_name = "CASE")]
    pub path: PathBuf,
    /// Replace one value of the case: --set load.force="3 mN" (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub sets: Vec<String>,
}

/// How to run a case.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// The case, and what replaces its values.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Results folder [default: results/NAME after the case, numbered if that exists; none with --json]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace the results in an existing results folder, and no other files in it, when the new ones are complete
    #[arg(long)]
    pub force: bool,
    /// What is written of the case.
    #[command(flatten)]
    pub output: OutputArguments,
    /// Print the summary as JSON to standard output, and nothing else; a folder is written only with --out
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// What a run writes, where the case is not to decide.
#[derive(Debug, Args)]
pub struct OutputArguments {
    /// Loading steps whose fields are written [default: what the case says, or last]
    #[arg(long, value_enum, value_name = "STEPS")]
    pub fields: Option<Steps>,
    /// Loading steps whose pictures are drawn [default: what the case says, or last]
    #[arg(long, value_enum, value_name = "STEPS")]
    pub pictures: Option<Steps>,
    /// Formats of the fields, by commas [default: what the case says, or all]
    #[arg(long, value_enum, value_name = "FORMATS", value_delimiter = ',')]
    pub formats: Vec<Format>,
}

impl OutputArguments {
    /// Puts what is given in the place of what the case says.
    pub fn replace(&self, output: &mut OutputCase) {
        output.fields = self.fields.unwrap_or(output.fields);
        output.pictures = self.pictures.unwrap_or(output.pictures);
        if !self.formats.is_empty() {
            output.set_formats(&self.formats);
        }
    }
}

/// How to run a study.
#[derive(Debug, Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a switch of the command line"
)]
pub struct StudyArguments {
    /// The study file
    #[arg(value_name = "STUDY")]
    pub path: PathBuf,
    /// Replace one value of the base case: --set grid.elements=64 (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub sets: Vec<String>,
    /// Folder of the results [default: results/NAME after the study]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Go on where it stopped (the default)
    #[arg(long, conflicts_with = "fresh")]
    pub resume: bool,
    /// Begin again and forget the results that are there, of this study or another
    #[arg(long)]
    pub fresh: bool,
    /// Only part I of N, from 1; `pellicle gather` puts the parts together
    #[arg(
        long,
        value_name = "I/N",
        default_value = "1/1",
        hide_default_value = true
    )]
    pub shard: Shard,
    /// Print the cases and solve none
    #[arg(long)]
    pub list: bool,
    /// Write a whole results folder for every case too, in cases/
    #[arg(long)]
    pub folders: bool,
    /// Print how the cases ended as JSON to standard output
    #[arg(long)]
    pub json: bool,
    /// Number of threads, and of cases at a time [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Which parts to put together.
#[derive(Debug, Args)]
pub struct GatherArguments {
    /// The folder of the study
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Replace the whole table of another study
    #[arg(long)]
    pub force: bool,
}

/// How to validate.
#[derive(Debug, Args)]
pub struct ValidateArguments {
    /// Print JSON to standard output
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Multiply every influence coefficient by 1 + EPS, to see that the validation fails: 1e-3, 1e-6, 1e-12
    #[arg(
        long,
        value_name = "EPS",
        default_value_t = 0.0,
        hide_default_value = true
    )]
    #[arg(help_heading = "Test hook", allow_hyphen_values = true, value_parser = perturbation)]
    pub perturb_coefficients: f64,
}

/// Which shell.
#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_enum)]
    pub shell: clap_complete::Shell,
}

/// Which case to begin with.
#[derive(Debug, Args)]
pub struct InitArguments {
    /// What the case is about
    #[arg(value_enum, default_value_t)]
    pub kind: Template,
    /// Write it to a new file instead of standard output
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    pub force: bool,
}

/// At which wavenumbers.
#[derive(Debug, Args)]
pub struct KernelArguments {
    /// The case, and what replaces its values.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Wavenumbers k, in 1/m or the case's own units; several by spaces, commas or repetition
    #[arg(long = "wavenumber", value_name = "K", required = true, num_args = 1.., value_delimiter = ',')]
    #[arg(allow_negative_numbers = true, value_parser = positive)]
    pub wavenumbers: Vec<f64>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// At which offsets.
#[derive(Debug, Args)]
pub struct InfluenceArguments {
    /// The case, and what replaces its values.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Offsets in elements along x and y; several by spaces or repetition
    #[arg(long = "offset", value_name = "M,N", required = true, num_args = 1.., value_parser = offset)]
    pub offsets: Vec<[usize; 2]>,
    /// Take the slow path: adaptive quadrature of the defining integral
    #[arg(long)]
    pub direct: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Which results to draw.
#[derive(Debug, Args)]
pub struct PlotArguments {
    /// The results folder; of several, the curves are drawn in one picture, curves.svg and curves.png
    #[arg(value_name = "DIR", required = true)]
    pub folders: Vec<PathBuf>,
    /// Folder for the pictures [default: that of the results, whose pictures and report are replaced; of several the
    /// current one]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace pictures that are there, in a folder that is not that of the results
    #[arg(long)]
    pub force: bool,
    /// Only the pictures of this loading step, counted from 0
    #[arg(long, value_name = "N")]
    pub step: Option<usize>,
    /// Width of every picture in pixels [default: about 1000]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u16).range(100..=10000))]
    pub size: Option<u16>,
    /// Leave out the lines above the pictures
    #[arg(long)]
    pub no_title: bool,
    /// Colours of the maps [default: viridis]
    #[arg(long, value_enum, value_name = "COLOURS")]
    pub colour_map: Option<ColourMap>,
    /// Ends of the scale of pressures: "2 GPa", or "0.5 GPa:2 GPa"; a bare number is in Pa or the case's own unit
    /// [default: the largest]
    #[arg(long, value_name = "[FROM:]TO", value_parser = range)]
    pub range: Option<[f64; 2]>,
    /// Where the section is: axis, peak (through the largest pressure), y="5 um" (along x there), x="5 um" (along y)
    /// [default: axis]
    #[arg(long, value_name = "PLACE", value_parser = section)]
    pub section: Option<Cut>,
}

/// What to do with the cache.
#[derive(Debug, Args)]
pub struct CacheArguments {
    /// Remove the cache's files, and no others
    #[arg(long)]
    pub clear: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_well_formed() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn wavenumbers_and_offsets_come_in_every_form() {
        let line = "pellicle kernel case.toml --wavenumber 1 2e3,3 --wavenumber 4";
        let Command::Kernel(kernel) = Arguments::parse_from(line.split(' ')).command else {
            panic!("not kernel")
        };
        assert_eq!(kernel.wavenumbers, [1.0, 2e3, 3.0, 4.0]);
        let line = "pellicle influence case.toml --offset 0,0 3,4 --offset 1,2";
        let Command::Influence(influence) = Arguments::parse_from(line.split(' ')).command else {
            panic!("not influence")
        };
        assert_eq!(influence.offsets, [[0, 0], [3, 4], [1, 2]]);
    }
}
