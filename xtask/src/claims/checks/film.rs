//! What the film does under the pyramid (Figs. 5 and 6): the first argument is with the film, the second without.

use super::super::finding::{percent, significant};
use super::super::{ContactFields, Curve, Finding};

/// Holds if the contact area with the film is larger by more than `threshold` at the last load.
pub(in super::super) fn area_is_larger(film: &Curve, bare: &Curve, threshold: f64) -> Finding {
    let excess = last(&film.contact_area) / last(&bare.contact_area) - 1.0;
    Finding::new(excess > threshold, format!("larger by {}", percent(excess)))
}

/// Holds if the largest pressure with the film is lower by more than `threshold` at every load.
pub(in super::super) fn peak_is_lower(film: &Curve, bare: &Curve, threshold: f64) -> Finding {
    let effects = effects(film, bare, |curve| &curve.max_pressure);
    let lower: Vec<f64> = effects.iter().map(|effect| -effect).collect();
    let [smallest, largest] = range(&lower);
    Finding::new(
        smallest > threshold,
        format!("lower by {} to {}", percent(smallest), percent(largest)),
    )
}

/// Holds if `∂D/∂Q` at the smallest load differs with and without the film by more than `threshold`.
pub(in super::super) fn gradients_differ_at_first(
    film: &Curve,
    bare: &Curve,
    threshold: f64,
) -> Finding {
    let effect = effects(film, bare, |curve| &curve.gradient)[0];
    Finding::new(
        effect.abs() > threshold,
        format!("∂D/∂Q {} with the film", changed(effect)),
    )
}

/// Holds if the film's effect on `∂D/∂Q` at the largest load is below `threshold` of that at the smallest.
pub(in super::super) fn effect_on_gradient_fades(
    film: &Curve,
    bare: &Curve,
    threshold: f64,
) -> Finding {
    fades(&effects(film, bare, |curve| &curve.gradient), threshold)
}

/// Holds if the film's effect on the largest pressure at the largest load is below `threshold` of that at the smallest.
pub(in super::super) fn effect_on_peak_fades(
    film: &Curve,
    bare: &Curve,
    threshold: f64,
) -> Finding {
    fades(&effects(film, bare, |curve| &curve.max_pressure), threshold)
}

/// Holds if the film's effect on penetration at the largest load is below `threshold` of that at the smallest.
pub(in super::super) fn effect_on_penetration_fades(
    film: &Curve,
    bare: &Curve,
    threshold: f64,
) -> Finding {
    fades(&effects(film, bare, |curve| &curve.penetration), threshold)
}

/// Holds if the pressure is nearer to the pyramid's own shape with the film by more than `threshold`.
///
/// How near: the squared correlation of the pressure with the height of the indenter over the contact. On springs alone
/// `p = (D − f)/η`, a pyramid turned over, and it is 1.
pub(in super::super) fn is_more_pyramidal(
    film: &ContactFields,
    bare: &ContactFields,
    threshold: f64,
) -> Finding {
    let (Some(with), Some(without)) = (likeness(film), likeness(bare)) else {
        return Finding::nothing("pressure to compare");
    };
    Finding::new(
        with - without > threshold,
        format!(
            "r² {} with, {} without",
            significant(with, 3),
            significant(without, 3)
        ),
    )
}

/// Squared correlation of pressure and height over the contact; none where one of them is constant.
fn likeness(fields: &ContactFields) -> Option<f64> {
    let contact: Vec<[f64; 2]> = fields
        .contact()
        .map(|i| [fields.pressure[i], fields.indenter[i]])
        .collect();
    let count = contact.len() as f64;
    let mean = [0, 1].map(|k| contact.iter().map(|pair| pair[k]).sum::<f64>() / count);
    let product = |j: usize, k: usize| {
        let products = contact
            .iter()
            .map(|pair| (pair[j] - mean[j]) * (pair[k] - mean[k]));
        products.sum::<f64>()
    };
    let squares = product(0, 0) * product(1, 1);
    (squares > 0.0).then(|| product(0, 1).powi(2) / squares)
}

/// By how much a quantity is larger with the film than without, at each load of the film's curve.
fn effects(film: &Curve, bare: &Curve, list: impl Fn(&Curve) -> &[f64]) -> Vec<f64> {
    let pairs = film.force.iter().zip(list(film));
    pairs
        .map(|(&force, with)| with / bare.at(force, list(bare)) - 1.0)
        .collect()
}

fn fades(effects: &[f64], threshold: f64) -> Finding {
    let [first, last] = [effects[0], last(effects)];
    Finding::new(
        last.abs() < threshold * first.abs(),
        format!(
            "{} at the smallest load, {} at the largest",
            changed(first),
            changed(last)
        ),
    )
}

fn changed(effect: f64) -> String {
    let way = if effect < 0.0 { "lower" } else { "higher" };
    format!("{} {way}", percent(effect.abs()))
}

fn last(list: &[f64]) -> f64 {
    list[list.len() - 1]
}

fn range(list: &[f64]) -> [f64; 2] {
    [
        list.iter().copied().fold(f64::INFINITY, f64::min),
        list.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::super::made_up::{power_law, pressed, with_fading_film};
    use super::*;

    fn pair() -> [Curve; 2] {
        [with_fading_film(), power_law(1.0, 2.0 / 3.0)]
    }

    #[test]
    fn a_film_that_matters_less_and_less_is_seen_to_do_so() {
        let [film, bare] = pair();
        assert!(area_is_larger(&film, &bare, 0.01).holds);
        assert!(peak_is_lower(&film, &bare, 0.01).holds);
        assert!(gradients_differ_at_first(&film, &bare, 0.1).holds);
        for fades in [
            effect_on_gradient_fades,
            effect_on_peak_fades,
            effect_on_penetration_fades,
        ] {
            assert!(fades(&film, &bare, 0.5).holds);
        }
    }

    #[test]
    fn a_film_that_does_nothing_bears_nothing_out() {
        let [_, bare] = pair();
        assert!(!area_is_larger(&bare, &bare, 0.01).holds);
        assert!(!peak_is_lower(&bare, &bare, 0.01).holds);
        assert!(!gradients_differ_at_first(&bare, &bare, 0.1).holds);
        assert!(!effect_on_gradient_fades(&bare, &bare, 0.5).holds);
    }

    #[test]
    fn a_film_that_matters_the_same_at_every_load_does_not_fade() {
        let [_, bare] = pair();
        let mut film = bare.clone();
        for list in [
            &mut film.gradient,
            &mut film.penetration,
            &mut film.max_pressure,
        ] {
            list.iter_mut().for_each(|value| *value *= 1.3);
        }
        for fades in [
            effect_on_gradient_fades,
            effect_on_peak_fades,
            effect_on_penetration_fades,
        ] {
            assert!(!fades(&film, &bare, 0.5).holds);
        }
        assert!(!peak_is_lower(&film, &bare, 0.01).holds);
    }

    #[test]
    fn springs_press_in_the_indenters_shape_and_a_flat_pressure_does_not() {
        // The made-up indenter is the cone f = r.
        let springs = pressed(|radius, _| (2.0 - radius).max(0.0));
        let dome = pressed(|radius, _| (4.0 - radius * radius).max(0.0).sqrt());
        assert!(is_more_pyramidal(&springs, &dome, 0.01).holds);
        assert!(!is_more_pyramidal(&dome, &springs, 0.01).holds);
        assert!(!is_more_pyramidal(&springs, &springs, 0.01).holds);
        let flat = pressed(|_, _| 1.0);
        assert!(!is_more_pyramidal(&flat, &dome, 0.01).holds);
    }
}
