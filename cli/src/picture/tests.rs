//! The pictures of a solution can be drawn for any finite numbers.

use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, TestRunner};
use serde_json::json;

use super::field_map::FieldMap;
use super::style::{Cut, Heading, Style};
use super::subject::Subject;
use super::{
    curve, histograms, pressure_map, pressure_view, render, section, stress_interfaces,
    stress_section,
};
use crate::input::units::Units;
use crate::output::fields::Fields;
use crate::output::stress::view::{InterfaceTractions, StressSection, StressView, SurfaceLine};
use crate::output::summary::StepSummary;

const SIZE: usize = 9;

fn step(value: f64) -> StepSummary {
    let number = |value: f64| value.is_finite().then_some(value);
    let histogram = json!({"largest": number(value.abs()), "counts": [3, 2, 0, 1]});
    let rough = json!({
        "nominal_area": 1.0, "contact_fraction": 1.0, "counted_area": 1.0, "corrected_area": 1.0, "perimeter": 1.0,
        "mean_gap": number(value),
        "islands": {"count": 1, "largest_area": 1.0, "mean_area": 1.0, "counts_by_octave": [1]},
        "pressures": histogram, "gaps": histogram,
    });
    let step = json!({
        "force": number(value), "penetration": number(value), "max_pressure": number(value),
        "max_pressure_at": [0.0, 0.0], "mean_pressure": 1.0, "contact_area": 1.0, "contact_elements": 1,
        "contact_area_on_relief": 0.0, "contact_area_between": 1.0, "contact_radius": 1.0,
        "rough_contact": rough,
        "certificate": {"complementarity": 0.0, "gap_in_contact": 0.0, "overlap": 0.0, "load": 0.0, "min_pressure": 0.0,
                        "worst": 0.0, "satisfied": true},
        "work": {"iterations": 1, "operator_applications": 1, "seconds": 0.0, "levels": []},
        "grid_error": {"penetration": null, "contact_area": null, "max_pressure": null, "levels": []},
    });
    serde_json::from_value(step).unwrap()
}

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
        cut,
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
            step: &step(u[0]),
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
        let steps: Vec<_> = u.iter().map(|value| step(value.abs())).collect();
        let curve = curve::NamedCurve {
            name: "a needle".into(),
            steps: &steps,
        };
        let view = view(side, &u);
        for svg in [
            stress_section::draw(&subject, &view),
            stress_interfaces::draw(&subject, &view),
            pressure_map::draw(&subject),
            section::draw(&subject),
            pressure_view::draw(&subject),
            histograms::draw(&subject),
            FieldMap::Gap.draw(&subject),
            FieldMap::Heights.draw(&subject),
            curve::draw_several(vec![curve], Units::Si, &style),
        ] {
            prop_assert!(render::png(&svg).is_ok());
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
            step: &step(1.0),
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
