//! The text of a drafted file whose unloadings are evaluated by Oliver and Pharr.

use super::NOT_IN_THE_FILE;
use pellicle::display::significant;

use super::group::Group;
use crate::measured::stated::StatedQuantity;

/// What else the same unloadings give.
const FILM: &str = "# A film's own modulus, exactly, from the same unloadings at several depths: remove the signs and put yours.\n\
    # [model.foundation]\n\
    # substrate = { young_modulus = \"170 GPa\", poisson_ratio = 0.22 }\n\
    # layer = [{ thickness = \"500 nm\", young_modulus = \"70 GPa\", poisson_ratio = 0.17 }]\n\
    # [unknown]\n\
    # \"foundation.layer[0].young_modulus\" = { from = \"1 GPa\", to = \"1 TPa\" }\n";

/// The text of a fit file with these tables.
pub(super) fn fit_file(groups: &[Group]) -> String {
    let tables: String = groups.iter().map(Group::text).collect();
    let mut stated = groups.iter().map(|group| {
        let stated = group.survey.stated(StatedQuantity::FrameCompliance)?;
        let value = significant(stated.value * 1e6, 4);
        Some(format!(
            "frame_compliance = \"{value} nm/mN\"  # line {}: {}",
            stated.line, stated.text
        ))
    });
    let assumed = || format!("frame_compliance = \"0 nm/mN\"  # {NOT_IN_THE_FILE}");
    let frame = stated.find_map(|stated| stated).unwrap_or_else(assumed);
    format!(
        "# Modulus and hardness from unloadings, by Oliver and Pharr (ISO 14577). What no file tells has a default\n\
         # and the words \"{NOT_IN_THE_FILE}\".\n\n\
         [evaluation]\n\
         # An ideal Berkovich pyramid, {NOT_IN_THE_FILE}: coefficients, such as [24.5, \"120 nm\"]; or in place of\n\
         # them tip = \"berkovich\" with tip_radius = \"50 nm\"; or the file of a calibration.\n\
         area_function = [24.5]\n\
         {frame}\n\
         poisson_ratio = 0.25  # {NOT_IN_THE_FILE}\n\
         indenter = {{ young_modulus = \"1141 GPa\", poisson_ratio = 0.07 }}  # diamond, {NOT_IN_THE_FILE}\n\
         unloading = [0.95, 0.40]  # the part of the largest force that is fitted\n\
         epsilon = 0.75  # or \"exponent\"\n\
         beta = 1.0\n\
         # The drift of a hold in the unloading, or early in the loading, is taken out if there is one; drift = \"off\" keeps it.\n\n\
         {tables}{FILM}"
    )
}
