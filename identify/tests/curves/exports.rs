//! Texts in the forms in which instruments and programs export curves, each reconstructed from the facts of its format
//! with numbers of a Hertz contact: every one must read to its modulus at every point, or be refused with a remedy.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

use pellicle::input::span::Source;
use pellicle_identify::measured::curve::MeasuredCurve;
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::measured::sources::MeasurementSources;

/// A ball on a half-space: the plane-strain modulus, the radius and the largest depth, SI.
#[derive(Clone, Copy)]
struct Ball {
    modulus: f64,
    radius: f64,
    depth: f64,
}

/// As a nanoindenter and as a force microscope measure it.
const HARD: Ball = Ball {
    modulus: 100e9,
    radius: 10e-6,
    depth: 100e-9,
};
const SOFT: Ball = Ball {
    modulus: 10e3,
    radius: 5e-6,
    depth: 1e-6,
};
/// The spring constant of the cantilever, N/m.
const SPRING: f64 = 0.1;

impl Ball {
    /// Depths and forces from the first contact on.
    fn points(self) -> Vec<[f64; 2]> {
        let depth = |i: u32| self.depth * f64::from(i) / 40.0;
        (0..=40).map(|i| [depth(i), self.force(depth(i))]).collect()
    }

    /// `F = 4/3 E* √R D^1.5`
    fn force(self, depth: f64) -> f64 {
        4.0 / 3.0 * self.modulus * self.radius.sqrt() * depth.powf(1.5)
    }
}

/// A column of a text.
#[derive(Clone, Copy)]
enum Column {
    /// The depth, in a unit.
    Depth(f64),
    /// The force, in a unit.
    Force(f64),
    /// The time, in a unit, ten points in a second.
    Time(f64),
    /// The height of the piezo, larger towards the body or away from it.
    Height(f64),
    /// The deflection of the cantilever.
    Deflection(f64),
    /// The number of the row.
    Index,
    /// A time of day.
    Clock,
    /// The same text in every row.
    Same(&'static str),
}
use Column::{Clock, Deflection, Depth, Force, Height, Index, Same, Time};

const NM: f64 = 1e-9;
const UM: f64 = 1e-6;
const MN: f64 = 1e-3;
const UN: f64 = 1e-6;
const NN: f64 = 1e-9;
const PN: f64 = 1e-12;

/// The rows of a text.
fn rows(ball: Ball, columns: &[Column], separator: &str, decimal: &str) -> String {
    let mut text = String::new();
    for (index, [depth, force]) in ball.points().into_iter().enumerate() {
        let number = |value: f64| format!("{value:.7e}").replace('.', decimal);
        let time = index as f64 / 10.0;
        let cells = columns.iter().map(|column| match column {
            Depth(unit) => number(depth / unit),
            Force(unit) => number(force / unit),
            Time(unit) => number(time / unit),
            Height(unit) => number((3e-6 * unit.signum() + depth + force / SPRING) / unit),
            Deflection(unit) => number(force / SPRING / unit),
            Index => index.to_string(),
            Clock => format!("10:41:{:05.2}", 6.0 + time),
            Same(text) => (*text).to_owned(),
        });
        text += &cells.collect::<Vec<_>>().join(separator);
        text.push('\n');
    }
    text
}

/// An export: its name, the body, the lines above the rows, the columns with their separator and decimal mark, and the
/// keys of the table that reads it.
type Export = (
    &'static str,
    Ball,
    &'static str,
    (&'static [Column], &'static str, &'static str),
    &'static str,
);

fn text(export: &Export) -> String {
    let (_, ball, head, (columns, separator, decimal), _) = export;
    format!("{head}{}", rows(*ball, columns, separator, decimal))
}

fn read(keys: &str, text: &str) -> Result<MeasuredCurve, String> {
    let source = Arc::new(Source::new(
        "fit.toml",
        format!("[[data]]\nfile = \"a.txt\"\n{keys}\n"),
    ));
    let sources = MeasurementSources::in_folder(Path::new("nowhere")).with_text("a.txt", text);
    let root = pellicle::input::toml_tree::parse(&source).expect("the keys are TOML");
    let tables = DataTable::read_all(&root, &sources).map_err(|fault| fault.to_string())?;
    let curves = MeasuredCurve::read_all(&tables[0]).map_err(|fault| fault.to_string())?;
    Ok(curves[0].clone())
}

/// The largest relative difference of the force at each depth from that of the ball.
fn error(ball: Ball, curve: &MeasuredCurve) -> f64 {
    let channel = |of: Option<&[f64]>| of.expect("the column was read").to_vec();
    let pairs = channel(curve.depth())
        .into_iter()
        .zip(channel(curve.force()));
    let largest = ball.force(ball.depth);
    pairs.fold(0.0, |most: f64, (depth, force)| {
        most.max((ball.force(depth.max(0.0)) - force).abs() / largest)
    })
}

#[rustfmt::skip]
const EXPORTS: [Export; 35] = [
    ("Hysitron, names above a word", HARD, "Mon Jan 5 10:00:00 2026\n\nNumber of Points = 41\nDepth (nm)\tLoad (uN)\tTime (s)\neoh\n",
        (&[Depth(NM), Force(UN), Time(1.0)], "\t", "."), "columns = { depth = \"Depth\", force = \"Load\" }"),
    ("Hysitron, columns in volts beside", HARD, "Number of Points = 41\nDepth (nm)\tLoad (\u{b5}N)\tTime (s)\tDepth (V)\tLoad (V)\n",
        (&[Depth(NM), Force(UN), Time(1.0), Same("0.1"), Same("0.2")], "\t", "."), "columns = { depth = \"Depth (nm)\", force = \"Load (µN)\" }"),
    ("Agilent, units in a row of their own", HARD, "Displacement Into Surface,Load On Sample,Time On Sample\nnm,mN,s\n",
        (&[Depth(NM), Force(MN), Time(1.0)], ",", "."), "columns = { depth = \"Displacement Into Surface\", force = \"Load On Sample\" }"),
    ("KLA, title and brackets", HARD, "Test 1\n\nDEPTH [nm],LOAD [mN],TIME [s],STIFFNESS [N/m]\n",
        (&[Depth(NM), Force(MN), Time(1.0), Same("1000")], ",", "."), "columns = { depth = \"Depth\", force = \"Load\" }"),
    ("FischerScope, decimal comma and no units", HARD, "Name of the application\n1\tNumber of block\nF\th\tt\n",
        (&[Force(MN), Depth(UM), Time(1.0)], "\t", ","), "columns = { depth = \"h\", force = \"F\" }\nunits = { depth = \"um\", force = \"mN\" }\ntext = { decimal = \",\", skip_until = \"F h t\" }"),
    ("Anton Paar, names and units in brackets", HARD, "Indentation\nMax depth : 100 nm\n\nTime\tPd\tFn\n[s]\t[nm]\t[mN]\n\n",
        (&[Time(1.0), Depth(NM), Force(MN)], "\t", "."), "columns = { depth = \"Pd\", force = \"Fn\" }"),
    ("Anton Paar, semicolons and decimal comma", HARD, "Time [s];Pd [nm];Fn [mN]\n",
        (&[Time(1.0), Depth(NM), Force(MN)], ";", ","), "columns = { depth = \"Pd\", force = \"Fn\" }\ntext = { decimal = \",\" }"),
    ("ZHN, German", HARD, "Zeit [s]\tEindringtiefe [µm]\tNormalkraft [mN]\n",
        (&[Time(1.0), Depth(UM), Force(MN)], "\t", ","), "columns = { depth = \"Eindringtiefe\", force = \"Normalkraft\" }\ntext = { decimal = \",\" }"),
    ("Micro Materials, bare numbers", HARD, "",
        (&[Depth(NM), Force(MN)], "  ", "."), "columns = { depth = 1, force = 2 }\nunits = { depth = \"nm\", force = \"mN\" }"),
    ("FemtoTools, many columns", HARD, "Index,Phase,Displacement [um],Time [s],Pos X [um],Force A [uN]\n",
        (&[Index, Same("1"), Depth(UM), Time(1.0), Same("12.5"), Force(UN)], ",", "."), "columns = { depth = \"Displacement\", force = \"Force A\" }"),
    ("Alemnis", HARD, "Date: 2026\nTime [s]\tDisplacement [um]\tForce [mN]\n",
        (&[Time(1.0), Depth(UM), Force(MN)], "\t", "."), "columns = { depth = \"Displacement\", force = \"Force\" }"),
    ("Nanovea", HARD, "Depth (\u{3bc}m),Load (mN),Time (s)\n",
        (&[Depth(UM), Force(MN), Time(1.0)], ",", "."), "columns = { depth = \"Depth\", force = \"Load\" }"),
    ("Zwick, quoted, semicolons", HARD, "\"Prüfzeit\";\"Standardweg\";\"Standardkraft\"\n\"s\";\"mm\";\"N\"\n",
        (&[Time(1.0), Depth(1e-3), Force(1.0)], ";", ","), "columns = { depth = \"Standardweg\", force = \"Standardkraft\" }\ntext = { decimal = \",\" }"),
    ("Instron, units in brackets below", HARD, "Results Table 1\n\n\"Time\",\"Extension\",\"Load\"\n\"(sec)\",\"(mm)\",\"(N)\"\n",
        (&[Time(1.0), Depth(1e-3), Force(1.0)], ",", "."), "columns = { depth = \"Extension\", force = \"Load\" }"),
    ("MTS, sec", HARD, "MTS793\nLoad\tDisplacement\tTime\nN\tmm\tsec\n",
        (&[Force(1.0), Depth(1e-3), Time(1.0)], "\t", "."), "columns = { depth = \"Displacement\", force = \"Load\" }"),
    ("Mark-10, time of day", HARD, "Reading,Load [N],Travel [mm],Time\n",
        (&[Index, Force(1.0), Depth(1e-3), Clock], ",", "."), "columns = { depth = \"Travel\", force = \"Load\" }"),
    ("LabVIEW, end of header", HARD, "LabVIEW Measurement\t\nWriter_Version\t2\n***End_of_Header***\t\n\nChannels\t2\t\nX_Dimension\tTime\tTime\n***End_of_Header***\t\t\nX_Value\tForce (N)\tDepth (m)\tComment\n",
        (&[Time(1.0), Force(1.0), Depth(1.0), Same("")], "\t", "."), "columns = { depth = \"Depth\", force = \"Force\" }"),
    ("Origin, long names, units, comments", HARD, "Depth\tLoad\nnm\tmN\nSample A\tSample A\n",
        (&[Depth(NM), Force(MN)], "\t", "."), "columns = { depth = \"Depth\", force = \"Load\" }"),
    ("pandas, index without a name", HARD, ",depth (nm),force (uN)\n",
        (&[Index, Depth(NM), Force(UN)], ",", "."), "columns = { depth = \"depth\", force = \"force\" }"),
    ("MATLAB, units in underscores", HARD, "depth_nm,force_uN\n",
        (&[Depth(NM), Force(UN)], ",", "."), "columns = { depth = \"depth_nm\", force = \"force_uN\" }"),
    ("numpy, commented header", HARD, "# depth [m] force [N]\n",
        (&[Depth(1.0), Force(1.0)], " ", "."), "columns = { depth = \"depth\", force = \"force\" }"),
    ("a MEMS indenter, decimal commas, names above a word", HARD, "Quasi static measurement routine\nTip parameters (shape,radius, material...) \n12.08.2022\n\nPiezo position[nm]\tMEMS displ.[nm]\tDepth[nm]\tForce[uN]\tTemp [°C]\tRh [%]\neoh\n",
        (&[Same("2,05"), Same("0,19"), Depth(NM), Force(UN), Same("22,34"), Same("47,36")], "\t", ","), "columns = { depth = \"Depth\", force = \"Force\" }\ntext = { decimal = \",\" }"),
    ("nanoDMA, a tab behind every row", HARD, "nanoDMA Text Export Version 1.00\n\n Test Time (s)\t Indent Disp. (nm)\t Indent Act. Load (µN)\t Storage Stiff. (µN/nm)\t\n",
        (&[Time(1.0), Depth(NM), Force(UN), Same("8.1786"), Same("")], "\t", "."), "columns = { depth = \"Indent Disp.\", force = \"Indent Act. Load\" }"),
    ("a prefix in words is no unit", HARD, "depth_nm,load_micro_N,time_s\n",
        (&[Depth(NM), Force(UN), Time(1.0)], ", ", "."), "columns = { depth = \"depth_nm\", force = \"load_micro_N\" }\nunits = { force = \"uN\" }"),
    ("a spreadsheet with a byte-order mark", HARD, "\u{feff}Depth [nm];Load [mN]\n",
        (&[Depth(NM), Force(MN)], ";", ","), "columns = { depth = \"Depth\", force = \"Load\" }\ntext = { decimal = \",\" }"),
    ("Optics11 Piuma or Chiaro, indentation", SOFT, "Date\t12/05/2025\tStatus\tOK\nk (N/m)\t0.1\nTip radius (um)\t5.000\nModel: Hertz\nComment: \n\nTime (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)\tAuxiliary\n",
        (&[Time(1.0), Force(UN), Depth(NM), Deflection(NM), Height(NM), Same("0.1")], "\t", "."), "columns = { depth = \"Indentation\", force = \"Load\" }"),
    ("Optics11, piezo and cantilever with its own spring constant", SOFT, "Date\t12/05/2025\tStatus\tOK\nk (N/m)\t0.1\nTip radius (um)\t5.000\n\nTime (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)\tAuxiliary\n",
        (&[Time(1.0), Force(UN), Depth(NM), Deflection(NM), Height(NM), Same("0.1")], "\t", "."), "columns = { height = \"Piezo\", deflection = \"Cantilever\" }"),
    ("Optics11, decimal commas", SOFT, "k (N/m)\t0,1\nTip radius (um)\t5,000\n\nTime (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)\tAuxiliary\n",
        (&[Time(1.0), Force(UN), Depth(NM), Deflection(NM), Height(NM), Same("0,1")], "\t", ","), "columns = { height = \"Piezo\", deflection = \"Cantilever\" }\ntext = { decimal = \",\" }"),
    ("JPK text export", SOFT, "# TEXT EXPORT\n# index: 0\n#\n# segmentIndex: 0\n# segment: extend\n# columns: measuredHeight vDeflection time\n# fancyNames: \"Height (measured)\" \"Vertical Deflection\" \"Segment Time\"\n# sensitivity: 6.086E-8\n# springConstant: 0.1\n# calibrationSlots: nominal force elapsed\n# units: m N s\n#\n",
        (&[Height(-1.0), Force(1.0), Time(1.0)], " ", "."), "columns = { height = \"Height (measured)\", force = \"Vertical Deflection\" }"),
    ("afmformats, metadata and no units", SOFT, "# afmformats 0.18.0\n#\n# BEGIN METADATA\n# {\n#   \"imaging mode\": \"force-distance\",\n#   \"spring constant\": 0.1\n# }\n# END METADATA\n#\n# force\theight (measured)\tsegment\ttime\n",
        (&[Force(1.0), Height(-1.0), Same("False"), Time(1.0)], "\t", "."), "columns = { height = \"height (measured)\", force = \"force\" }\nunits = { height = \"m\", force = \"N\" }"),
    ("AFM Workshop, side by side", SOFT, "Force-Distance Curve\nFile Format:\t3\n\nX, um:\t25.0\n\nExtend Z-Sense(nm),Extend Force(nN),Retract Z-Sense(nm),Retract Force(nN)\n",
        (&[Height(NM), Force(NN), Height(NM), Force(NN)], ",", "."), "columns = { height = \"Extend Z-Sense\", force = \"Extend Force\" }\nspring_constant = \"0.1 N/m\""),
    ("Bruker NanoScope, names in underscores", SOFT, "Calc_Ramp_Ex_nm\tCalc_Ramp_Rt_nm\tDefl_pN_Ex\tDefl_pN_Rt\n",
        (&[Height(NM), Height(NM), Force(PN), Force(PN)], "\t", "."), "columns = { height = \"Calc_Ramp_Ex_nm\", force = \"Defl_pN_Ex\" }\nspring_constant = \"0.1 N/m\""),
    ("Igor text", SOFT, "IGOR\nWAVES/D\tZSnsr\tForce\nBEGIN\n",
        (&[Same(""), Height(1.0), Force(1.0)], "\t", "."), "columns = { height = \"ZSnsr\", force = \"Force\" }\nunits = { height = \"m\", force = \"N\" }\nspring_constant = \"0.1 N/m\""),
    ("Asylum, table", SOFT, "ZSnsr(m),Force(N)\n",
        (&[Height(1.0), Force(1.0)], ",", "."), "columns = { height = \"ZSnsr\", force = \"Force\" }\nspring_constant = \"0.1 N/m\""),
    ("settings as long as the table is wide", SOFT, "Spring constant (N/m);0.1\nProbe radius (um);5\nHeight (um);Force (nN)\n",
        (&[Height(UM), Force(NN)], ";", "."), "columns = { height = \"Height\", force = \"Force\" }"),
];

#[test]
fn exports_of_instruments_are_read_to_their_moduli() {
    let mut failed = String::new();
    for export in &EXPORTS {
        let (name, ball, .., keys) = export;
        match read(keys, &text(export)) {
            // Eight digits of heights of 3 µm, for forces that grow by 4e-5 of the largest with each.
            Ok(curve) => match error(*ball, &curve) {
                error if error < 1e-5 && curve.rows.len() == 41 => {}
                error => writeln!(failed, "{name}: {error:e}, {} rows", curve.rows.len()).unwrap(),
            },
            Err(fault) => writeln!(failed, "{name}: {fault}").unwrap(),
        }
    }
    assert!(failed.is_empty(), "{failed}");
}

#[test]
fn exports_that_lack_something_are_refused_with_a_remedy() {
    let depths = rows(SOFT, &[Depth(1.0), Force(1.0)], ",", ".");
    let bent = rows(SOFT, &[Height(NM), Deflection(NM)], "\t", ".");
    for (name, keys, text, wanted) in [
        (
            "grams of a texture analyser",
            "columns = { depth = \"Distance\", force = \"Force\" }",
            format!("Distance (m),Force (g)\n{depths}"),
            "found no unit of force in the file, wanted one in units, such as force = \"mN\"",
        ),
        (
            "a deflection in volts",
            "columns = { height = \"Height\", deflection = \"Deflection\" }\nspring_constant = \"0.1 N/m\"",
            format!("Height (nm)\tDeflection (V)\n{bent}"),
            "such as deflection = \"80 nm/V\"",
        ),
        (
            "no spring constant",
            "columns = { height = \"Height\", deflection = \"Deflection\" }",
            format!("Height (nm)\tDeflection (nm)\n{bent}"),
            "the spring constant of the cantilever, such as \"0.04 N/m\"",
        ),
        (
            "another spring constant",
            "columns = { height = \"Height\", deflection = \"Deflection\" }\nspring_constant = \"0.04 N/m\"",
            format!("k = 0.1 N/m\nHeight (nm)\tDeflection (nm)\n{bent}"),
            "in line 1 of the file, \"k = 0.1 N/m\"",
        ),
        (
            "units that no header states",
            "columns = { depth = 1, force = 2 }",
            depths.clone(),
            "found no unit of depth in the file, wanted one in units, such as depth = \"nm\"",
        ),
        (
            "a program's own format",
            "columns = { depth = 1, force = 2 }",
            "{\"curves\": [{\"Z\": [1.0], \"F\": [2.0]}]}".to_owned(),
            "found no table, wanted lines with two numbers or more",
        ),
        (
            "decimal commas",
            "columns = { depth = \"Depth\", force = \"Force\" }",
            format!(
                "Depth (m);Force (N)\n{}",
                rows(SOFT, &[Depth(1.0), Force(1.0)], ";", ",")
            ),
            "decimal = \",\" gives one",
        ),
        (
            "swapped columns",
            "columns = { depth = \"Load\", force = \"Depth\" }",
            format!("Depth,Load\n{depths}"),
            "which is called a force",
        ),
    ] {
        let found = read(keys, &text).expect_err(name);
        assert!(found.contains(wanted), "{name}: {found}");
    }
}

/// A number with so many decimals, its digits before the decimal mark in groups of three.
fn grouped(value: f64, decimals: usize, [group, decimal]: [&str; 2]) -> String {
    let text = format!("{value:.decimals$}");
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let groups = whole.as_bytes().rchunks(3).rev();
    let groups: Vec<&str> = groups
        .map(|of| std::str::from_utf8(of).expect("digits"))
        .collect();
    let marked = groups.join(group);
    if decimals == 0 {
        marked
    } else {
        format!("{marked}{decimal}{fraction}")
    }
}

#[test]
fn separators_of_thousands_are_read_or_refused_and_no_row_is_lost() {
    // Forces up to 13,333 µN at depths up to 100 nm.
    let text = |separator: &str, quote: &str, marks: [&str; 2], decimals: usize| {
        let rows = HARD.points().into_iter().map(|[depth, force]| {
            let depth = grouped(depth / NM, 3 * decimals.min(1), marks);
            let force = grouped(force / UN, decimals, marks);
            format!("{quote}{depth}{quote}{separator}{quote}{force}{quote}\n")
        });
        format!(
            "Depth (nm){separator}Load (uN)\n{}",
            rows.collect::<String>()
        )
    };
    let keys = |decimal: &str| {
        format!(
            "columns = {{ depth = \"Depth\", force = \"Load\" }}\ntext = {{ decimal = \"{decimal}\" }}\n"
        )
    };
    for (separator, quote, marks) in [
        ("\t", "", [",", "."]),
        (";", "", ["'", "."]),
        (",", "\"", [",", "."]),
        ("\t", "", [".", ","]),
        (";", "", [" ", ","]),
        ("\t", "", ["\u{202f}", ","]),
        (",", "\"", [".", ","]),
    ] {
        for decimals in [3, 1] {
            let found = read(&keys(marks[1]), &text(separator, quote, marks, decimals)).unwrap();
            assert_eq!(found.table_rows, 41, "{separator:?} {marks:?}");
            assert_eq!(found.rows.len(), 41, "{separator:?} {marks:?}");
            assert!(
                error(HARD, &found) < 1e-4,
                "{separator:?} {marks:?} {}",
                error(HARD, &found)
            );
        }
    }
    // Whole numbers beside which no fraction shows what the comma is.
    let refused = read(&keys("."), &text("\t", "", [",", "."], 0)).unwrap_err();
    assert!(
        refused.contains("a number above a thousand or a fraction"),
        "{refused}"
    );
    // A separator between columns is none within a number.
    let refused = read(&keys("."), &text(",", "", [",", "."], 1)).unwrap_err();
    assert!(refused.contains("one number in two fields"), "{refused}");
}
