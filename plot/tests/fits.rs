//! The pictures of a fit can be drawn for any numbers.

use pellicle::display::DisplayUnit;
use pellicle_plot::fit::curve::{AxisQuantity, CurveUse, Curves, FittedCurve, FittedPoint};
use pellicle_plot::fit::heading::FitHeading;
use pellicle_plot::fit::profiles::Profiles;
use pellicle_plot::fit::repeats::{Repeated, RepeatsPlot};
use pellicle_plot::fit::unknown::FittedUnknown;
use pellicle_plot::sheet::render;
use pellicle_plot::sheet::style::Style;

fn scale(divisor: f64) -> DisplayUnit {
    DisplayUnit {
        divisor,
        label: "m".into(),
    }
}

fn head() -> FitHeading {
    FitHeading {
        title: "a fit".into(),
        numbers: "NOT CONVERGED".into(),
    }
}

fn unknown(value: f64, other: f64) -> FittedUnknown {
    FittedUnknown {
        name: "E".into(),
        symbol: "E".into(),
        scale: scale(value),
        value,
        interval: [None, Some(other)],
        bounds: [1e-30, 1e30],
        verdict: "weak".into(),
        wald: Some(other),
        threshold: 3.84,
        profile: vec![[value, 0.0], [value, 0.0], [other, other], [1e30, f64::NAN]],
        combination: None,
    }
}

/// Draws all pictures of a fit with these numbers.
fn pictures(value: f64, other: f64) -> [Option<String>; 3] {
    let point = |abscissa, observed| FittedPoint {
        abscissa,
        observed,
        model: other,
        whitened: observed,
    };
    let quantity = |divisor| AxisQuantity {
        name: "force Q",
        scale: scale(divisor),
    };
    let curve = FittedCurve {
        name: "one".into(),
        points: vec![
            point(value, other),
            point(other, value),
            point(1.0, f64::NAN),
        ],
        usage: CurveUse::Used,
    };
    let curves = Curves {
        head: head(),
        x: quantity(value),
        y: quantity(other),
        all: vec![curve],
    };
    let unknowns = vec![unknown(value, other), unknown(other, value)];
    let repeats = RepeatsPlot {
        head: head(),
        names: vec!["one".into(); 3],
        unknowns: vec![Repeated {
            unknown: unknown(value, other),
            scatter: other,
            values: vec![(0, value), (2, f64::NAN)],
        }],
    };
    let profiles = Profiles {
        head: head(),
        level: 0.95,
        unknowns,
    };
    let style = Style::default();
    [
        curves.draw(&style),
        profiles.draw(&style),
        repeats.draw(&style),
    ]
}

#[test]
fn every_fit_can_be_drawn() {
    let numbers = [1e-300, 1e-9, 1.0, 1e12, 1e300, 0.0, f64::NAN, f64::INFINITY];
    let mut drawn = 0;
    for value in numbers {
        for other in numbers {
            for svg in pictures(value, other).into_iter().flatten() {
                assert!(render::png(&svg).is_ok(), "{value} {other}: {svg}");
                assert!(render::pdf(&svg).is_ok(), "{value} {other}: {svg}");
                drawn += 1;
            }
        }
    }
    // At least half of them have something to show.
    assert!(drawn > 2 * numbers.len().pow(2), "{drawn}");
}
