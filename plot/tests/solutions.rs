//! The pictures of a solution can be drawn for any finite numbers.

use pellicle::input::units::Units;
use pellicle::result::fields::Fields;
use pellicle_plot::run::curve::{self, CurveStep, NamedCurve};
use pellicle_plot::sheet::render;
use pellicle_plot::sheet::style::{Cut, Heading, Style};
use pellicle_plot::step::field_map::FieldMap;
use pellicle_plot::step::histograms::{self, Distribution, RoughContact};
use pellicle_plot::step::subject::Subject;
use pellicle_plot::step::{pressure_map, pressure_view, section};
use pellicle_plot::stress;
use pellicle_plot::stress::extremes::{BodyExtremes, Extreme, Extremes, InterfaceExtremes};
use pellicle_plot::stress::view::{InterfaceTractions, StressSection, StressView, SurfaceLine};
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, TestRunner};

const SIZE: usize = 9;

/// Returns a view whose planes and interface have these values.
fn view(side: f64, values: &[f64]) -> StressView {
    let coordinates: Vec<f64> = (0..SIZE)
        .map(|i| side * (i as f64 / SIZE as f64 - 0.4))
        .collect();
    let depth = |i: usize| side * [0.0, 0.1, 0.2, 1.0, 1.0, 1.5, 2.0, 4.0, 5.0][i];
    StressView {
        section: StressSection {
            line: SurfaceLine {
                through: [0.1 * side, 0.2 * side],
                direction: values[0].clamp(-3.0, 3.0),
            },
            along: coordinates.clone(),
            depths: (0..SIZE).map(depth).collect(),
            bodies: (0..SIZE).map(|i| usize::from(i > 3)).collect(),
            von_mises: values.iter().map(|value| value.abs()).collect(),
            max_principal: values.to_vec(),
        },
        centres: coordinates,
        interfaces: vec![InterfaceTractions {
            index: 0,
            depth: side,
            shear: values.iter().map(|value| value.abs()).collect(),
            normal: values.to_vec(),
        }],
    }
}

/// Extremes of this value in both bodies and on the interface.
fn extremes(side: f64, value: f64) -> Extremes {
    let body = |name: &str| BodyExtremes {
        name: name.into(),
        von_mises: Some(Extreme {
            value: value.abs(),
            at: [0.1 * side, 0.2 * side, 0.1 * side],
        }),
        max_principal: Some(Extreme {
            value,
            at: [side, side, 2.0 * side],
        }),
    };
    let extreme = Extreme {
        value,
        at: [0.0, 0.1 * side],
    };
    Extremes {
        bodies: vec![body("layer 0"), body("substrate")],
        interfaces: vec![InterfaceExtremes {
            index: 0,
            shear: Some(extreme),
            tension: Some(extreme),
            compression: Some(extreme),
        }],
    }
}

/// Fields with incompatible magnitudes.
fn field() -> impl Strategy<Value = Vec<f64>> {
    let sizes = vec![0.0, 1e-308, 1e-9, 1.0, 1e7, 1e16, 1e150, 1e308];
    let value = (select(sizes), -1.0..1.0).prop_map(|(size, part)| size * part);
    prop::collection::vec(value, SIZE * SIZE)
}

fn style() -> impl Strategy<Value = Style> {
    let cuts = vec![Cut::Axis, Cut::Peak, Cut::AlongX(1e300), Cut::AlongY(-0.2)];
    let ranges = vec![None, Some([1e-300, 2e-300]), Some([-1.0, 1e7])];
    (select(cuts), select(ranges)).prop_map(|(cut, pressures)| Style {
        heading: Heading::Hidden,
        pressures,
        cut: Some(cut),
        ..Style::default()
    })
}

#[test]
fn every_finite_solution_can_be_drawn() {
    let mut runner = TestRunner::new(Config {
        cases: 4,
        failure_persistence: None,
        ..Config::default()
    });
    let sides = select(vec![1e-300, 1e-9, 1.0, 1e300]);
    let solutions = (field(), field(), field(), field(), sides, style());
    let ran = runner.run(&solutions, |(pressure, u, gap, profile, side, style)| {
        let pressure: Vec<_> = pressure.iter().map(|p| p.max(0.0)).collect();
        let subject = Subject {
            title: "a needle",
            units: Units::Si,
            relief_height: Some(side),
            numbers: "largest p".into(),
            accuracy: String::new(),
            fields: Fields {
                side,
                size: SIZE,
                pressure: &pressure,
                displacement: &u,
                gap: &gap,
                shortening: &profile,
                plastic_depth: &[],
                profile: &profile,
                mask: &[true; SIZE * SIZE],
            },
            style,
        };
        let step = |value: &f64| CurveStep {
            force: value.abs(),
            penetration: value.abs(),
            max_pressure: value.abs(),
            mark: None,
        };
        let curve = NamedCurve {
            name: "a needle".into(),
            steps: u.iter().map(step).collect(),
        };
        let of = Distribution {
            mean: u[0].abs(),
            largest: u[0].abs(),
            counts: &[3, 2, 0, 1],
        };
        let rough = RoughContact {
            pressures: of,
            gaps: of,
        };
        let extremes = extremes(side, u[1]);
        let view = view(side, &u);
        for svg in [
            stress::section::draw(&subject, &view, &extremes),
            stress::interfaces::draw(&subject, &view, &extremes),
            pressure_map::draw(&subject),
            section::draw(&subject),
            pressure_view::draw(&subject),
            histograms::draw(&subject, Some(&rough)),
            FieldMap::Gap.draw(&subject),
            FieldMap::Heights.draw(&subject),
            curve::draw_several(vec![curve], None, Units::Si, &style),
        ] {
            prop_assert!(render::png(&svg).is_ok());
            prop_assert!(render::pdf(&svg).is_ok());
        }
        Ok(())
    });
    ran.unwrap();
}

#[test]
fn a_yielding_surface_is_drawn_deeper_by_its_plastic_depth() {
    let pressure: Vec<f64> = (0..SIZE * SIZE)
        .map(|e| f64::from(u8::from(e % SIZE > 2)))
        .collect();
    let elastic: Vec<f64> = (0..SIZE * SIZE)
        .map(|e| 0.1 + 0.01 * (e / SIZE) as f64)
        .collect();
    let plastic_depth: Vec<f64> = pressure.iter().map(|p| 0.5 * p).collect();
    let lacking: Vec<f64> = plastic_depth.iter().map(|depth| -depth).collect();
    let (pairs, zeros) = (elastic.iter().zip(&plastic_depth), [0.0; SIZE * SIZE]);
    let sum: Vec<f64> = pairs.map(|(u, depth)| u + depth).collect();
    let section = |displacement, gap, plastic_depth| {
        section::draw(&Subject {
            title: "a ball",
            units: Units::Si,
            relief_height: Some(0.0),
            numbers: String::new(),
            accuracy: String::new(),
            fields: Fields {
                side: 1.0,
                size: SIZE,
                pressure: &pressure,
                displacement,
                gap,
                shortening: &zeros,
                plastic_depth,
                profile: &zeros,
                mask: &[false; SIZE * SIZE],
            },
            style: Style::default(),
        })
    };
    let drawn = section(&elastic, &lacking, &plastic_depth);
    assert_eq!(drawn, section(&sum, &zeros, &[]));
    assert_ne!(drawn, section(&elastic, &zeros, &[]));
}
