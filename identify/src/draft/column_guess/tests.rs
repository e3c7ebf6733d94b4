//! Names of columns of instruments, and the quantities that they are taken for.

use super::*;

fn guessed(names: &[&str]) -> Vec<(&'static str, usize)> {
    let header: Vec<_> = names.iter().map(|name| HeaderField::new(name)).collect();
    let mut found: Vec<_> = of_header(&header)
        .into_iter()
        .map(|guess| (guess.channel.key(), guess.place + 1))
        .collect();
    found.sort_by_key(|(_, place)| *place);
    found
}

#[test]
fn columns_of_instruments_are_found_by_name_and_unit() {
    for (names, wanted) in [
        (
            &[
                "Depth (nm)",
                "Load (µN)",
                "Time (s)",
                "Depth (V)",
                "Load (V)",
            ][..],
            &[("depth", 1), ("force", 2), ("time", 3)][..],
        ),
        (
            &[
                "Displacement Into Surface [nm]",
                "Load On Sample [mN]",
                "Time On Sample [s]",
                "Harmonic Contact Stiffness [N/m]",
            ],
            &[("depth", 1), ("force", 2), ("time", 3), ("stiffness", 4)],
        ),
        (
            &[
                "Time (s)",
                "Load (uN)",
                "Indentation (nm)",
                "Cantilever (nm)",
                "Piezo (nm)",
                "Auxiliary",
            ],
            &[
                ("time", 1),
                ("force", 2),
                ("depth", 3),
                ("deflection", 4),
                ("height", 5),
            ],
        ),
        (
            &[
                "Retract Z-Sense(nm)",
                "Retract Force(nN)",
                "Extend Z-Sense(nm)",
                "Extend Force(nN)",
            ],
            &[("height", 3), ("force", 4)],
        ),
        (
            &[
                "force [N]",
                "height piezo [m]",
                "height measured [m]",
                "segment",
                "time [s]",
            ],
            &[("force", 1), ("height", 3), ("time", 5)],
        ),
        (
            &["Z (nm)", "Deflection (V)"],
            &[("height", 1), ("deflection", 2)],
        ),
        (&["Pd [nm]", "Fn [mN]"], &[("depth", 1), ("force", 2)]),
        (
            &["Tip-Sample Separation (nm)", "Force (nN)"],
            &[("depth", 1), ("force", 2)],
        ),
        (
            &[
                "Contact Depth (nm)",
                "Depth (nm)",
                "Load rate (mN/s)",
                "Load (mN)",
            ],
            &[("depth", 2), ("force", 4)],
        ),
        (&["F", "h", "t"], &[("force", 1), ("depth", 2), ("time", 3)]),
        (
            &["Calc_Ramp_Ex_nm", "Defl_pN_Ex"],
            &[("height", 1), ("force", 2)],
        ),
        (&["Lateral Force (nN)", "voltage"], &[]),
        (
            &[
                "Set Load (mN)",
                "Dynamic Force (uN)",
                "Uncorrected Depth (nm)",
                "Load (mN)",
                "Depth (nm)",
                "Frame Stiffness (N/m)",
                "Dynamic Stiffness (N/m)",
            ],
            &[("force", 4), ("depth", 5), ("stiffness", 7)],
        ),
    ] {
        assert_eq!(guessed(names), wanted, "{names:?}");
    }
}

#[test]
fn columns_that_may_as_well_be_meant_are_told() {
    let names = [
        "Load A (mN)",
        "Load B (mN)",
        "Depth (nm)",
        "Unload Load (mN)",
        "Depth rate (nm/s)",
    ];
    let header = names.map(HeaderField::new);
    let guesses = of_header(&header);
    let of = |channel| {
        *guesses
            .iter()
            .find(|guess| guess.channel == channel)
            .unwrap()
    };
    assert_eq!(rivals(&header, &guesses, of(Channel::Force)), [1]);
    assert!(rivals(&header, &guesses, of(Channel::Depth)).is_empty());
}

#[test]
fn deflections_of_force_microscopes_are_not_the_lateral_ones() {
    for (names, wanted) in [
        (
            &[
                "Calc_Ramp_Ex_nm",
                "Calc_Ramp_Rt_nm",
                "Defl_V_Ex",
                "Defl_V_Rt",
            ][..],
            &[("height", 1), ("deflection", 3)][..],
        ),
        (
            &[
                "measuredHeight [m]",
                "hDeflection [V]",
                "vDeflection [V]",
                "seriesTime [s]",
            ],
            &[("height", 1), ("deflection", 3), ("time", 4)],
        ),
        (
            &["height [m]", "vDeflection [N]"],
            &[("height", 1), ("force", 2)],
        ),
    ] {
        assert_eq!(guessed(names), wanted, "{names:?}");
    }
}

#[test]
fn without_header_the_steeper_of_two_columns_is_the_force() {
    let depth: Vec<f64> = (0..50)
        .map(f64::from)
        .map(|i| i + 0.1 * (3.0 * i).sin())
        .collect();
    let force: Vec<f64> = depth.iter().map(|d| d.max(0.0).powf(1.5)).collect();
    let time: Vec<f64> = (0..50).map(f64::from).collect();
    let of = |columns: &[&Vec<f64>]| {
        let columns: Vec<_> = columns.iter().map(|values| (*values).clone()).collect();
        let mut found = of_numbers(&columns)?;
        found.sort_by_key(|guess| guess.place);
        Some(
            found
                .iter()
                .map(|guess| guess.channel.key())
                .collect::<Vec<_>>(),
        )
    };
    assert_eq!(of(&[&depth, &force]), Some(vec!["depth", "force"]));
    assert_eq!(of(&[&force, &depth]), Some(vec!["force", "depth"]));
    assert_eq!(
        of(&[&time, &depth, &force]),
        Some(vec!["time", "depth", "force"])
    );
    assert_eq!(of(&[&depth, &force, &force, &depth]), None);
}
