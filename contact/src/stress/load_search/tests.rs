//! Load searches with known results.

use pellicle_texture::Relief;

use super::*;
use crate::{Model, Observer, Paraboloid, SolverOptions, stress::quantity::StressQuantity};

static NO_RESIDUAL: std::sync::LazyLock<ResidualStress> =
    std::sync::LazyLock::new(ResidualStress::default);

fn solved(force: f64, value: f64) -> Solved {
    Solved {
        force,
        penetration: 0.0,
        radius: 0.0,
        is_beyond: false,
        extreme: Extreme {
            value,
            at: [0.0; 3],
            resolved: true,
            estimate: None,
        },
        followed_on: None,
    }
}

fn model() -> Model {
    Model::on_half_space([1.0, 0.3], Relief::Bare, Paraboloid::new(1.0).unwrap())
}

/// What several searches share.
fn shared<'a>(model: &'a Model, observer: &'a mut dyn Observer) -> (SolvedLoads<'a>, RoughDepths) {
    let loads = SolvedLoads::new(model, 32, SolverOptions::default(), observer);
    let foundation = model.tables.foundation();
    (loads, RoughDepths::new(foundation, 0.01, [0.0; 2]).unwrap())
}

fn search<'a, 'b>(
    (loads, rough): &'a mut (SolvedLoads<'b>, RoughDepths),
    target: &'a Target,
    strength: f64,
    solved: Vec<Solved>,
) -> LoadSearch<'a, 'b> {
    LoadSearch {
        loads,
        domain: Domain::Automatic,
        sliding: Sliding::default(),
        target,
        strength,
        residual: &NO_RESIDUAL,
        at_rest: 0.0,
        solved,
        follows: true,
        rough,
    }
}

fn target() -> Target {
    Target {
        top: 0.0,
        bottom: 1.0,
        quantities: vec![StressQuantity::VonMises],
    }
}

#[test]
fn secants_from_either_side_find_the_yield_force_under_a_ball_in_a_few_loads() {
    let (model, target) = (model(), target());
    // 0.62 p0 under a ball, p0³ = 6 Q E*²/(π³ R²)
    let strength = 0.03;
    let exact = (std::f64::consts::PI * strength / 0.6205).powi(3) * 0.91_f64.powi(2) / 6.0;
    let at = |part: f64| solved(part * exact, strength * part.cbrt());
    for (known, most) in [
        (vec![at(0.6), at(1.7)], 3),
        (vec![at(1.7)], 4),
        (vec![at(60.0)], 7),
    ] {
        let before = known.len();
        let observer = &mut ();
        let mut shared = shared(&model, observer);
        let mut search = search(&mut shared, &target, strength, known);
        let LoadSearchResult::Met { solved, exponent } = search.search().unwrap() else {
            panic!("the strength is reached")
        };
        // The discretisation error of the stress, tripled in the force.
        assert!(
            (solved.force / exact - 1.0).abs() < 0.01,
            "{} {exact}",
            solved.force
        );
        assert!((exponent - 1.0 / 3.0).abs() < 0.05, "{exponent}");
        assert!((solved.extreme.value / strength - 1.0).abs() < 1e-4);
        assert!(
            search.solved.len() - before <= most,
            "{}",
            search.solved.len()
        );
        assert!(
            search
                .solved
                .is_sorted_by(|one, other| one.force < other.force)
        );
    }
}

#[test]
fn solved_loads_bracket_the_strength_and_give_the_growth_exponent() {
    let (model, target) = (model(), target());
    // σ = 2 √Q, and no utilisation below 0
    let loads = [(0.0, -1.0), (1.0, 2.0), (4.0, 4.0), (9.0, 6.0)];
    let known = loads.map(|(force, value)| solved(force, value)).to_vec();
    let observer = &mut ();
    let mut shared = shared(&model, observer);
    let mut search = search(&mut shared, &target, 4.0, known);
    let [none, one, four, nine] = [0, 1, 2, 3].map(|i: usize| search.solved[i]);
    assert_eq!(
        [none, one, nine].map(|at| search.utilisation(&at)),
        [0.0, 0.5, 1.5]
    );
    assert_eq!(search.first_reached().map(|at| at.force), Some(4.0));
    assert_eq!(search.largest().map(|at| at.force), Some(9.0));
    assert_eq!(
        [0.5, 1.0, 9.0].map(|force| search.first_after(force)),
        [1.0, 4.0, 9.0]
    );
    let before = |force| search.last_before(force).map(|at| at.force);
    assert_eq!(
        [before(9.0), before(4.5), before(1.0)],
        [Some(4.0), Some(4.0), None]
    );
    let exponent = search.exponent(&one, &nine).unwrap();
    assert!((exponent - 0.5).abs() < 1e-15);
    assert_eq!(search.exponent(&nine, &solved(16.0, 5.0)), None);
    assert_eq!(search.exponent(&none, &one), None);
    assert_eq!(search.exponent(&one, &solved(4.0, 2.0)), None);
    assert_eq!(search.nearer(one, nine).force, 9.0);
    assert_eq!(search.nearer(four, nine).force, 4.0);
    // A given side stays; a chosen one holds the contact of the load.
    search.domain = Domain::Side(3.0);
    assert_eq!(search.domain_for(1e-3).unwrap(), Domain::Side(3.0));
    search.domain = Domain::Automatic;
    let Domain::Side(side) = search.domain_for(1e-3).unwrap() else {
        panic!("a side")
    };
    // a³ = 3 Q R/(4 E*), a side of three radii
    let radius = (0.75e-3 * 0.91_f64).cbrt();
    assert!((side / radius - 3.0).abs() < 0.05, "{side}");
}

#[test]
fn a_strength_narrowly_missed_is_searched_for_between_the_adjacent_loads() {
    let (model, target) = (model(), target());
    let strength = 0.03;
    let exact = (std::f64::consts::PI * strength / 0.6205).powi(3) * 0.91_f64.powi(2) / 6.0;
    // The given stresses are too low, but between the second and the third load the strength is reached.
    let loads = [(0.3, 0.2), (0.9, 0.95), (2.0, 0.3)];
    let known = |factor: f64| {
        let of = |(part, value): (f64, f64)| solved(part * exact, factor * value * strength);
        loads.map(of).to_vec()
    };
    let observer = &mut ();
    let mut of_one = shared(&model, observer);
    let mut one = search(&mut of_one, &target, strength, known(1.0));
    let found = one.reached_between().unwrap().unwrap();
    // First halfway to the previous load, √(0.3 · 0.9), where it is not reached; then halfway to the next.
    let places: Vec<f64> = one.solved.iter().map(|at| at.force / exact).collect();
    let wanted = [0.3, 0.27_f64.sqrt(), 0.9, 2.0];
    assert_eq!(places.len(), 5, "{places:?}");
    assert!(
        wanted
            .iter()
            .all(|wanted| places.iter().any(|found| (found - wanted).abs() < 1e-9))
    );
    assert!(found.force > 0.9 * exact && found.force < 2.0 * exact);
    assert!(found.extreme.value >= strength);
    // With less than seven tenths of the strength there is no search.
    let mut far = search(&mut of_one, &target, strength, known(0.7));
    assert!(far.reached_between().unwrap().is_none() && far.solved.len() == 3);
}
