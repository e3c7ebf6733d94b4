//! The command line.

mod explore;
mod identify;
mod plot;
mod study;
mod values;
mod wanted_shard;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use pellicle::case::output::{Format, OutputCase, Steps};

pub use self::explore::ExploreArguments;
pub use self::identify::IdentifyArguments;
pub use self::plot::PlotArguments;
pub use self::study::{GatherArguments, StudyArguments};
use self::values::{depth, hurst, length, offset, perturbation, point, positive};
use crate::templates::Template;

/// Contact of an indenter with a layered, textured elastic body: a case file in, a certified solution out.
#[derive(Debug, Parser)]
#[command(name = "pellicle", version, arg_required_else_help = true)]
#[command(
    after_help = "Exit codes: 0 solved and certified, 1 not converged, beyond the model, or cut off by the domain or a map (result written and marked), \
                        2 the case or the command line is wrong, 3 a fit that is a misfit, 130 stopped by Ctrl-C."
)]
pub struct Arguments {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
}

/// A command and its arguments.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Solve a case and write a results folder
    Run(RunArguments),
    /// Solve a case with the values that another program writes to standard input, as they come
    #[command(
        after_help = "A line of the input is a JSON object of keys and values: {\"load.force\": \"3 mN\", \"grid.elements\": 64}.\n\
                            Its answer is the summary of `run --json` on one line, or {\"line\", \"status\": \"failed\", \"error\"}.\n\
                            Exit codes: 0 every line is certified, 1 some lines are not, 2 the case file or the command line is wrong, \
                            130 stopped by Ctrl-C."
    )]
    Solve(SolveArguments),
    /// Solve a case for many values of its keys, in parallel; after a kill the same command continues where it stopped
    #[command(
        after_help = "A study file is a base case and a table [study] of the keys that vary: `pellicle init study` prints one.\n\
                            Exit codes: 0 every case is certified, 1 some cases are not (the others are kept), \
                            2 the study or the command line is wrong, 130 stopped by Ctrl-C.\n\
                            With --find, the answer is the value at which the number meets its limit, and the interval in which \
                            number ± error straddles it; only certified cases count, and the cases tried are in find.csv. \
                            Exit codes: 0 found, 1 the condition holds at both ends of the range or at neither, or a case on the \
                            way is not certified."
    )]
    Study(StudyArguments),
    /// Merge the tables of a study's parts (--shard)
    Gather(GatherArguments),
    /// Open a page in the browser on which every number of a case can be changed and its answer follows
    #[command(
        after_help = "The page is served on this machine only, at an address with a secret. The command ends with Ctrl-C, or five \
                            seconds after its last page is closed. Its numbers are those of `run`; while a slider moves they are \
                            those of a coarser grid, and say so.\n\
                            Exit codes: 0 the page was closed, 2 the case file or the command line is wrong, 130 stopped by Ctrl-C."
    )]
    Explore(ExploreArguments),
    /// Resolve a case and estimate the work of solving it, without solving it
    Check(CaseArguments),
    /// Print a commented case that runs as it is
    Init(InitArguments),
    /// Print the compliance C(k) and the response Φ of the case's foundation
    Kernel(KernelArguments),
    /// Print influence coefficients of the case's foundation and grid
    Influence(InfluenceArguments),
    /// Print displacements and stresses at points of the body under one load of the case
    #[command(
        after_help = "On an interface the values above and below it are printed. With friction above a frictionless interface \
                            u_x and u_y are unbounded: NaN, or null in JSON."
    )]
    Stress(StressArguments),
    /// Make a self-affine rough surface and write it as a height map
    Surface(SurfaceArguments),
    /// Find properties of layers and films from measured curves, each with an interval, or why it is undetermined
    #[command(
        after_help = "Exit codes: 0 fitted, 1 not converged, 2 the fit file, a measurement or the command line is wrong, \
                            3 the model does not fit the measurements (best fit written and marked), 130 stopped by Ctrl-C."
    )]
    Identify(IdentifyArguments),
    /// Redraw the pictures of a results folder, with options; for several folders, draw their curves in one picture
    Plot(PlotArguments),
    /// Show the folder and size of the cache of coefficients, or clear it
    #[command(
        after_help = "PELLICLE_CACHE names the folder; if it is set but empty, nothing is cached on disk."
    )]
    Cache(CacheArguments),
    /// Compare the program with known results: closed forms, high-precision data, limits, and wrong pressures that its
    /// certificate must reject
    #[command(
        after_help = "Takes a few seconds; reads and writes no files. The line below each section defines its error; \
                            in the certificate's negative controls it is the worst line of a wrong pressure's certificate and must exceed \
                            the tolerance.\n\
                            Exit codes: 0 every row passes, 1 some rows fail, 2 the command line is wrong."
    )]
    Validate(ValidateArguments),
    /// Print completions for a shell
    Completions(CompletionsArguments),
    /// Print the manual page: pellicle man | man -l -
    Man,
}

/// A case file and the values that replace its own.
#[derive(Debug, Args)]
pub struct CaseArguments {
    /// The case file
    #[arg(value_name = "CASE")]
    pub path: PathBuf,
    /// Replace one value of the case: --set load.force="3 mN" (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub sets: Vec<String>,
}

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// The case, and the values that replace its own.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Results folder [default: results/NAME after the case, numbered if that exists; none with --json]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace the results in an existing results folder once the new ones are complete; other files stay
    #[arg(long)]
    pub force: bool,
    /// The fields and pictures to write.
    #[command(flatten)]
    pub output: OutputArguments,
    /// Print the summary as JSON to standard output and nothing else; write a folder only with --out
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Arguments of `solve`.
#[derive(Debug, Args)]
pub struct SolveArguments {
    /// The case, and the values that replace its own.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Read JSON Lines from standard input until it ends, and print JSON Lines
    #[arg(long, required = true)]
    pub stream: bool,
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// The fields and pictures to write, in place of those that the case asks for.
#[derive(Debug, Args)]
pub struct OutputArguments {
    /// Loading steps whose fields are written [default: as in the case, or last]
    #[arg(long, value_enum, value_name = "STEPS")]
    pub fields: Option<Steps>,
    /// Loading steps whose pictures are drawn [default: as in the case, or last]
    #[arg(long, value_enum, value_name = "STEPS")]
    pub pictures: Option<Steps>,
    /// Formats of the fields, separated by commas [default: as in the case, or npz]
    #[arg(long, value_enum, value_name = "FORMATS", value_delimiter = ',')]
    pub formats: Vec<Format>,
}

impl OutputArguments {
    /// Replaces the values of `output` by those given.
    pub fn replace(&self, output: &mut OutputCase) {
        output.fields = self.fields.unwrap_or(output.fields);
        output.pictures = self.pictures.unwrap_or(output.pictures);
        if !self.formats.is_empty() {
            output.set_formats(&self.formats);
        }
    }
}

/// Arguments of `validate`.
#[derive(Debug, Args)]
pub struct ValidateArguments {
    /// Print JSON to standard output
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: one per core]
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

/// Arguments of `completions`.
#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_enum)]
    pub shell: clap_complete::Shell,
}

/// Arguments of `init`.
#[derive(Debug, Args)]
pub struct InitArguments {
    /// The template
    #[arg(value_enum, default_value_t)]
    pub kind: Template,
    /// Draft a fit from measured curves: files, a pattern in quotation marks, or a folder; with fit, fit-afm and
    /// fit-unloading
    #[arg(long, value_name = "CURVE", num_args = 1..)]
    pub from: Vec<PathBuf>,
    /// Write the template to a new file instead of standard output; with --from [default: NAME.toml beside the curves]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    pub force: bool,
}

/// Arguments of `kernel`.
#[derive(Debug, Args)]
pub struct KernelArguments {
    /// The case, and the values that replace its own.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Wavenumbers k, in 1/m or the case's own units; separate several by spaces or commas, or repeat the option
    #[arg(long = "wavenumber", value_name = "K", required = true, num_args = 1.., value_delimiter = ',')]
    #[arg(allow_negative_numbers = true, value_parser = positive)]
    pub wavenumbers: Vec<f64>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `influence`.
#[derive(Debug, Args)]
pub struct InfluenceArguments {
    /// The case, and the values that replace its own.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Offsets in elements along x and y; separate several by spaces, or repeat the option
    #[arg(long = "offset", value_name = "M,N", required = true, num_args = 1.., value_parser = offset)]
    pub offsets: Vec<[isize; 2]>,
    /// Depths at which to print displacements and stresses under a loaded element, such as "0.5 um"; on an interface
    /// those on both sides are printed
    #[arg(long = "depth", value_name = "Z", num_args = 1.., value_parser = depth, conflicts_with = "direct")]
    pub depths: Vec<f64>,
    /// Use adaptive quadrature of the defining integral, which is slow
    #[arg(long)]
    pub direct: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `stress`.
#[derive(Debug, Args)]
pub struct StressArguments {
    /// The case, and the values that replace its own.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Points x, y and z, such as "0,-1 um,0.5 um", z being the depth; separate several by spaces, or repeat the option
    #[arg(long = "at", value_name = "X,Y,Z", required = true, num_args = 1.., value_parser = point)]
    pub points: Vec<[f64; 3]>,
    /// Loading step, counted from 0 [default: the last]
    #[arg(long, value_name = "I")]
    pub step: Option<usize>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `surface`.
#[derive(Debug, Args)]
pub struct SurfaceArguments {
    /// The map's file: .npy (heights in m) or .gsf (heights and sides, single precision)
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Side of the square, such as "0.3 mm"; a bare number is in m
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub side: f64,
    /// Root mean square of the heights, such as "50 nm"
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub rms: f64,
    /// Samples along each side
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u16).range(4..=16384))]
    pub size: u16,
    /// Hurst exponent, from 0 to 1
    #[arg(long, value_name = "H", default_value_t = 0.8, value_parser = hurst)]
    pub hurst: f64,
    /// Longest and shortest wave, in any order [default: half of the side, and two samples]
    #[arg(long, value_name = "LENGTH", num_args = 2, value_delimiter = ',', value_parser = length)]
    pub wavelengths: Vec<f64>,
    /// Seed of the random phases: the same seed gives the same surface
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// Replace the file if it exists
    #[arg(long)]
    pub force: bool,
}

/// Arguments of `cache`.
#[derive(Debug, Args)]
pub struct CacheArguments {
    /// Remove the cache's files and no others
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
    fn wavenumbers_and_offsets_may_be_listed_or_repeated() {
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
