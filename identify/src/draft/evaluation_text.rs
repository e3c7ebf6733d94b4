//! The text of a drafted file whose unloadings are evaluated by Oliver and Pharr.

use super::NOT_IN_THE_FILE;
use super::group::Group;

/// The text of a fit file with these tables.
pub(super) fn fit_file(groups: &[Group]) -> String {
    let tables: String = groups.iter().map(Group::text).collect();
    format!(
        "# Modulus and hardness from unloadings, by Oliver and Pharr (ISO 14577). What no file tells has a default\n\
         # and the words \"{NOT_IN_THE_FILE}\".\n\n\
         [evaluation]\n\
         # An ideal Berkovich pyramid, {NOT_IN_THE_FILE}: coefficients, such as [24.5, \"120 nm\"]; or in place of\n\
         # them tip = \"berkovich\" with tip_radius = \"50 nm\"; or the file of a calibration.\n\
         area_function = [24.5]\n\
         frame_compliance = \"0 nm/mN\"  # {NOT_IN_THE_FILE}\n\
         poisson_ratio = 0.25  # {NOT_IN_THE_FILE}\n\
         indenter = {{ young_modulus = \"1141 GPa\", poisson_ratio = 0.07 }}  # diamond, {NOT_IN_THE_FILE}\n\
         unloading = [0.95, 0.40]  # the part of the largest force that is fitted\n\
         epsilon = 0.75  # or \"exponent\"\n\
         beta = 1.0\n\
         # The drift of a hold below half of the largest force is taken out if there is one; drift = \"off\" keeps it.\n\n\
         {tables}"
    )
}
