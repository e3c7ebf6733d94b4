//! What earlier versions read and this one does not, with what to use instead.

/// A key of a file, an option of a command, or a value of an option, and what to use instead.
pub const WITHDRAWN: [(&str, &str); 6] = [
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
