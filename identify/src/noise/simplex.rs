//! The downhill simplex method, for the few numbers of a noise model, whose likelihood costs no prediction.
//!
//! J. A. Nelder and R. Mead, Comput. J. 7, 308 (1965), with the usual coefficients 1, 2, ½, ½.

/// A simplex smaller than this in every coordinate (logarithms and logits) has converged.
const TOLERANCE: f64 = 1e-4;

/// Minimises `function` from `start`, with an initial simplex of edge `edge`.
pub(crate) fn least(start: &[f64], edge: f64, mut function: impl FnMut(&[f64]) -> f64) -> Vec<f64> {
    let mut corners = vec![(function(start), start.to_vec())];
    for axis in 0..start.len() {
        let mut corner = start.to_vec();
        corner[axis] += edge;
        corners.push((function(&corner), corner));
    }
    for _ in 0..200 * start.len() {
        corners.sort_by(|a, b| a.0.total_cmp(&b.0));
        if size(&corners) < TOLERANCE {
            break;
        }
        advance(&mut corners, &mut function);
    }
    corners.sort_by(|a, b| a.0.total_cmp(&b.0));
    corners.swap_remove(0).1
}

type Corner = (f64, Vec<f64>);

/// Replaces the worst of the sorted corners, or contracts all towards the best.
fn advance(corners: &mut [Corner], function: &mut impl FnMut(&[f64]) -> f64) {
    let last = corners.len() - 1;
    let centre = centroid(&corners[..last]);
    let worst = corners[last].clone();
    let mut at = |factor: f64| {
        let point: Vec<f64> = centre
            .iter()
            .zip(&worst.1)
            .map(|(c, w)| c + factor * (c - w))
            .collect();
        (function(&point), point)
    };
    let reflected = at(1.0);
    let replacement = if reflected.0 < corners[0].0 {
        let expanded = at(2.0);
        if expanded.0 < reflected.0 {
            expanded
        } else {
            reflected
        }
    } else if reflected.0 < corners[last.saturating_sub(1)].0 {
        reflected
    } else {
        at(if reflected.0 < worst.0 { 0.5 } else { -0.5 })
    };
    if replacement.0 < worst.0 {
        corners[last] = replacement;
    } else {
        shrink(corners, function);
    }
}

/// Moves all corners halfway to the first.
fn shrink(corners: &mut [Corner], function: &mut impl FnMut(&[f64]) -> f64) {
    let best = corners[0].1.clone();
    for (value, corner) in &mut corners[1..] {
        for (x, b) in corner.iter_mut().zip(&best) {
            *x = f64::midpoint(*x, *b);
        }
        *value = function(corner);
    }
}

fn centroid(corners: &[Corner]) -> Vec<f64> {
    let mut centre = vec![0.0; corners[0].1.len()];
    for (_, corner) in corners {
        for (c, x) in centre.iter_mut().zip(corner) {
            *c += x / corners.len() as f64;
        }
    }
    centre
}

fn size(corners: &[Corner]) -> f64 {
    corners[1..]
        .iter()
        .flat_map(|corner| corner.1.iter().zip(&corners[0].1))
        .map(|(x, b)| (x - b).abs())
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_minimum_of_a_curved_valley_is_found() {
        let valley = |x: &[f64]| (1.0 - x[0]).powi(2) + 10.0 * (x[1] - x[0] * x[0]).powi(2);
        let found = least(&[-1.0, 2.0], 0.5, valley);
        // The search ends when the simplex is smaller than 1e-4; the valley is flatter along its floor than across.
        assert!(
            (found[0] - 1.0).abs() < 1e-3 && (found[1] - 1.0).abs() < 2e-3,
            "{found:?}"
        );
    }

    #[test]
    fn a_minimum_in_one_dimension_is_found() {
        let found = least(&[3.0], 0.5, |x| (x[0] - 0.25).powi(2));
        // The size at which the search ends.
        assert!((found[0] - 0.25).abs() < 1e-4);
    }
}
