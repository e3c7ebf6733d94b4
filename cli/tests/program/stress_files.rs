//! `stress-NNN.nc` and `stress-NNN.vtr`, read back by readers independent of the program.

use std::collections::BTreeMap;
use std::fs;

use ndarray::Array2;
use ndarray_npy::NpzReader;

use super::netcdf_reader;
use super::runner::{CASE, TestFolder, names};

/// Returns the arrays of a VTK file by name, all as numbers.
fn vtk_arrays(bytes: &[u8]) -> BTreeMap<String, Vec<f64>> {
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start = bytes
        .windows(marker.len())
        .position(|part| part == marker)
        .unwrap()
        + marker.len();
    let head = std::str::from_utf8(&bytes[..start]).unwrap();
    let attribute = |line: &str, name: &str| {
        let rest = line.split_once(&format!(" {name}=\"")).unwrap().1;
        rest.split_once('"').unwrap().0.to_owned()
    };
    let mut end = start;
    let lines = head.lines().filter(|line| line.contains("<DataArray "));
    let arrays = lines.map(|line| {
        let at = start + attribute(line, "offset").parse::<usize>().unwrap();
        let length = u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
        let values = &bytes[at + 8..][..usize::try_from(length).unwrap()];
        end = end.max(at + 8 + values.len());
        let values = match &attribute(line, "type")[..] {
            "Float32" => values
                .chunks(4)
                .map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap())))
                .collect(),
            "Float64" => values
                .chunks(8)
                .map(|b| f64::from_le_bytes(b.try_into().unwrap()))
                .collect(),
            "UInt8" => values.iter().map(|byte| f64::from(*byte)).collect(),
            other => panic!("{other}"),
        };
        (attribute(line, "Name"), values)
    });
    let arrays = arrays.collect();
    assert_eq!(&bytes[end..], b"\n  </AppendedData>\n</VTKFile>\n");
    arrays
}

/// The command line of a run that writes its planes in both formats.
const RUN: [&str; 8] = [
    "run",
    "case.toml",
    "--out",
    "a",
    "--pictures",
    "none",
    "--formats",
    "npz,nc,vti",
];

/// The case with stresses on three planes and the interface.
fn with_stress(more: &str) -> String {
    format!("{CASE}\n[stress]\ndepths = [0, \"4 nm\", \"10 nm\", \"40 nm\"]\n{more}\n")
}

const FIELDS: [&str; 11] = [
    "ux",
    "uy",
    "uz",
    "sxx",
    "syy",
    "szz",
    "sxy",
    "sxz",
    "syz",
    "von_mises",
    "max_principal",
];

#[test]
fn both_files_hold_the_same_fields_and_the_surface_stress_is_the_pressure() {
    let folder = TestFolder::with_case(with_stress("extent = \"300 nm\"\nfriction = 0.25"));
    let ran = folder.run(&RUN);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let bytes = fs::read(folder.path("a/stress-000.nc")).unwrap();
    let netcdf = netcdf_reader::variables(bytes);
    let vtk = vtk_arrays(&fs::read(folder.path("a/stress-000.vtr")).unwrap());
    // The centres within 300 nm on a grid of 32 elements of 12.5 nm.
    let x: Vec<f64> = (0..24).map(|i| 12.5e-9 * (f64::from(i) - 11.5)).collect();
    for axis in ["x", "y"] {
        let found = &netcdf[axis][0];
        assert!(
            found
                .iter()
                .zip(&x)
                .all(|(found, x)| (found - x).abs() < 1e-22),
            "{found:?}"
        );
        assert_eq!(found, &vtk[axis]);
    }
    let depths: Vec<_> = netcdf["z"].concat();
    assert_eq!(depths, [0.0, 4e-9, 1e-8, 1e-8, 4e-8]);
    assert_eq!(depths, vtk["z"]);
    assert_eq!(netcdf["body"].concat(), [0.0, 0.0, 0.0, 1.0, 1.0]);
    assert!(netcdf.keys().len() == FIELDS.len() + 4 && vtk.keys().len() == FIELDS.len() + 4);
    for name in FIELDS {
        let planes = &netcdf[name];
        assert_eq!((planes.len(), vtk[name].len()), (5, 5 * 24 * 24));
        for (i, value) in vtk[name].iter().enumerate() {
            let (plane, j, i) = (i / 576, i / 24 % 24, i % 24);
            #[expect(clippy::cast_possible_truncation, reason = "single precision is meant")]
            let single = f64::from(planes[plane][i * 24 + j] as f32);
            let is_same = value.to_bits() == single.to_bits();
            assert!(is_same, "{name} on plane {plane} at {i}, {j}");
        }
    }
    let mut npz = NpzReader::new(fs::File::open(folder.path("a/fields-000.npz")).unwrap()).unwrap();
    let pressure: Array2<f64> = npz.by_name("pressure").unwrap();
    let largest = pressure.iter().copied().fold(0.0, f64::max);
    for (at, normal) in netcdf["szz"][0].iter().enumerate() {
        let pressure = pressure[[4 + at / 24, 4 + at % 24]];
        assert!((normal + pressure).abs() < 1e-10 * largest);
        assert!((netcdf["sxz"][0][at] + 0.25 * pressure).abs() < 1e-10 * largest);
        assert!(netcdf["syz"][0][at].abs() < 1e-10 * largest);
    }
}

#[test]
fn stresses_are_written_for_the_steps_with_fields_in_the_requested_formats() {
    let folder = TestFolder::with_case(with_stress(""));
    let curve = "load={forces=[\"1 uN\", \"2 uN\"]}";
    for (out, more, wanted) in [
        ("last", &[][..], &["stress-001.npz"][..]),
        ("none", &["--fields", "none"], &[]),
        ("gsf", &["--formats", "npz,gsf"], &["stress-001.npz"]),
        (
            "all",
            &["--formats", "npz,vti,nc"],
            &["stress-001.nc", "stress-001.npz", "stress-001.vtr"],
        ),
        (
            "nc",
            &["--formats", "npz,nc", "--fields", "all"],
            &[
                "stress-000.nc",
                "stress-000.npz",
                "stress-001.nc",
                "stress-001.npz",
            ],
        ),
    ] {
        let line = [
            "run",
            "case.toml",
            "--pictures",
            "none",
            "--set",
            curve,
            "--out",
            out,
        ];
        let ran = folder.run(&[&line, more].concat());
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let mut written = names(&folder.path(out));
        written.retain(|name| name.starts_with("stress"));
        assert_eq!(written, wanted, "{out}");
    }
    // They count as files of a run: --force replaces them.
    let again = folder.run(&[
        "run",
        "case.toml",
        "--out",
        "last",
        "--force",
        "--fields",
        "none",
        "--pictures",
        "none",
    ]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    assert!(
        !names(&folder.path("last"))
            .iter()
            .any(|name| name.starts_with("stress"))
    );
}

#[test]
fn displacements_unbounded_under_friction_are_nan_and_stresses_are_finite() {
    let slides = "poisson_ratio = 0.3\ninterface = \"frictionless\"";
    let text = with_stress("friction = 0.25").replace("poisson_ratio = 0.3", slides);
    let folder = TestFolder::with_case(text);
    let ran = folder.run(&RUN);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("u_x and u_y above it are unbounded"),
        "{}",
        ran.stderr
    );
    let bytes = fs::read(folder.path("a/stress-000.nc")).unwrap();
    let netcdf = netcdf_reader::variables(bytes);
    for name in FIELDS {
        for (plane, values) in netcdf[name].iter().enumerate() {
            let is_unbounded = ["ux", "uy"].contains(&name) && plane < 3;
            assert!(
                values.iter().all(|value| value.is_nan() == is_unbounded),
                "{name}, {plane}"
            );
        }
    }
}

#[test]
fn a_step_without_contact_has_zero_stresses() {
    let folder = TestFolder::with_case(with_stress(""));
    let apart = "load={penetration=\"-1 nm\"}";
    let line = [
        "run",
        "case.toml",
        "--out",
        "a",
        "--pictures",
        "none",
        "--formats",
        "nc",
        "--set",
        apart,
    ];
    let ran = folder.run(&line);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let bytes = fs::read(folder.path("a/stress-000.nc")).unwrap();
    let netcdf = netcdf_reader::variables(bytes);
    assert!(
        FIELDS
            .iter()
            .all(|name| netcdf[*name].concat().iter().all(|value| *value == 0.0))
    );
}
