//! Warnings about the size of a domain and the distance of a contact from its edge.

use super::*;

#[test]
fn a_domain_is_much_larger_than_a_contact_of_few_elements_or_a_small_fraction_of_it() {
    let model = Model::on_half_space([1.0, 0.0], Relief::Bare, Paraboloid::new(2.0).unwrap());
    // `size` elements per side, of which `across` are in contact.
    let warning = |size: usize, across: usize| {
        let grid = Grid::new(1.0, size).unwrap();
        let radius = (across - 1) as f64 / (2 * size) as f64;
        domain_much_larger(&model, &grid, &[Load::Penetration(1e-6)], radius)
    };
    for (size, across, is_warned) in [
        (1000, 19, true),
        (1000, 20, false),
        (64, 7, true),
        (64, 8, false),
        (28, 7, false),
        (64, 1, false),
    ] {
        assert_eq!(
            warning(size, across).is_some(),
            is_warned,
            "{size} {across}"
        );
    }
    let Some(Warning::DomainMuchLarger {
        elements,
        radius,
        side,
        wanted,
    }) = warning(1000, 19)
    else {
        panic!("a warning")
    };
    assert_eq!(
        (elements, radius, side, wanted),
        (19, 0.009, 1.0, SIDE_PER_RADIUS * 0.009)
    );
    // Below eight elements the radius is estimated: a² = 2 R D.
    let Some(Warning::DomainMuchLarger { radius, wanted, .. }) = warning(64, 7) else {
        panic!("a warning")
    };
    assert!((radius / 2e-3 - 1.0).abs() < 0.02 && (wanted / 6e-3 - 1.0).abs() < 0.02);
}

#[test]
fn a_contact_may_come_closer_to_the_edge_of_a_chosen_domain_without_a_warning() {
    let (_, mut step) = on_film();
    let mut codes = |to_edge: Option<usize>, domain: Domain| {
        step.summary.elements_to_edge = to_edge;
        edge(domain, 4, &step)
    };
    let chosen = [Domain::Chosen(1.0), Domain::Automatic];
    for (to_edge, by_side, by_choice) in [
        (0, true, true),
        (1, true, false),
        (2, true, false),
        (3, false, false),
    ] {
        let wanted = Warning::DomainEdge {
            step: 4,
            elements: to_edge,
        };
        let found = codes(Some(to_edge), Domain::Side(1.0));
        assert_eq!(found, by_side.then_some(wanted), "{to_edge}");
        for domain in chosen {
            let found = codes(Some(to_edge), domain);
            assert_eq!(found, by_choice.then_some(wanted), "{to_edge}");
        }
        assert_eq!(codes(Some(to_edge), Domain::Periodic(1.0)), None);
    }
    assert_eq!(codes(None, Domain::Side(1.0)), None);
    step.cut_off = Some(crate::CutOff::Domain);
    let cut_off = edge(Domain::Side(1.0), 4, &step);
    let by = crate::CutOff::Domain;
    assert_eq!(cut_off, Some(Warning::CutOff { step: 4, by }));
}

#[test]
fn a_contact_that_the_grid_barely_resolves_has_the_edge_of_the_estimated_one() {
    let (model, mut step) = on_film();
    let loads = [Load::Force(1e-2)];
    step.grid_error.max_pressure.as_mut().unwrap().resolved = false;
    let codes = |side: f64, domain: Domain, step: &Step| {
        let grid = Grid::new(side, 64).unwrap();
        let found = warnings(&model, &grid, domain, &loads, std::slice::from_ref(step));
        found.iter().map(Warning::code).collect::<Vec<_>>()
    };
    assert_eq!(codes(1.0, Domain::Side(1.0), &step), ["peak-not-resolved"]);
    // On a domain twenty times as large few elements are in contact.
    let large = Domain::Side(20.0);
    let both = ["domain-much-larger", "peak-not-resolved"];
    assert_eq!(codes(20.0, large, &step), both);
    // A steep edge on few elements gives no warning if the estimated contact is much smaller.
    let slope = step.slope.replace(ContactSlope::AtEdge(0.35));
    let found = codes(20.0, large, &step);
    assert_eq!(found, both);
    let steep = Model {
        indenter: crate::Cone::new(1.1, 0.0).unwrap().into(),
        ..model.clone()
    };
    let grid = Grid::new(20.0, 64).unwrap();
    let found = warnings(&steep, &grid, large, &loads, std::slice::from_ref(&step));
    let found: Vec<_> = found.iter().map(Warning::code).collect();
    assert_eq!(found, [both[0], both[1], "steep-indenter"]);
    step.slope = slope;
    assert_eq!(
        codes(20.0, Domain::Periodic(20.0), &step),
        ["peak-not-resolved"]
    );
    let widest = much_larger(
        &model,
        &Grid::new(20.0, 64).unwrap(),
        &loads,
        &[step.clone()],
    );
    assert!(matches!(widest, Some(Warning::DomainMuchLarger { .. })));
}
