//! Parallel sums and updates of fields, in parts of fixed length so that every number of threads gives the same bits.

pub mod stretches;

use std::ops::Range;

use rayon::prelude::*;

/// Elements per part: enough to justify a thread, few enough to stay in its cache.
const PART: usize = 1 << 12;
/// Fields up to this length are processed by one thread: waking another takes as long.
const SHORT: usize = 1 << 13;
/// Partial sums, which let the processor do independent additions at once.
const LANES: usize = 8;

/// The results of `of_part` for each part of a field, by its number, in order.
///
/// The work on a part is a trait object: the loop over threads, which is far longer, is compiled once for each type of
/// result and not for each use.
fn for_parts<T: Send>(length: usize, of_part: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let parts = 0..length.div_ceil(PART);
    if length <= SHORT {
        parts.map(of_part).collect()
    } else {
        parts.into_par_iter().map(of_part).collect()
    }
}

/// Hands each part of a field to `on_part`, with its number.
fn on_parts(field: &mut [f64], on_part: &(dyn Fn(usize, &mut [f64]) + Sync)) {
    let on_part = |(part, field): (usize, &mut [f64])| on_part(part, field);
    if field.len() <= SHORT {
        field.chunks_mut(PART).enumerate().for_each(on_part);
    } else {
        field.par_chunks_mut(PART).enumerate().for_each(on_part);
    }
}

/// Returns the results of `of_part` for each part of `0 … length`, in order.
pub fn by_parts<T: Send>(length: usize, of_part: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    for_parts(length, &|part| {
        of_part(part * PART..((part + 1) * PART).min(length))
    })
}

/// The number in single precision, for preconditioners.
#[expect(
    clippy::cast_possible_truncation,
    reason = "a preconditioner needs no more"
)]
pub fn single(value: f64) -> f32 {
    value as f32
}

/// `Σ aᵢ bᵢ`.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    by_parts(a.len(), |part| dot_of_part(&a[part.clone()], &b[part]))
        .iter()
        .sum()
}

fn dot_of_part(a: &[f64], b: &[f64]) -> f64 {
    let (a_lanes, a_rest) = a.as_chunks::<LANES>();
    let (b_lanes, b_rest) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (x, y) in a_lanes.iter().zip(b_lanes) {
        for lane in 0..LANES {
            sums[lane] += x[lane] * y[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f64>() + rest
}

/// `Σ aᵢ`.
pub fn sum(a: &[f64]) -> f64 {
    by_parts(a.len(), |part| sum_of_part(&a[part])).iter().sum()
}

/// The same for one part.
pub fn sum_of_part(a: &[f64]) -> f64 {
    let (lanes, rest) = a.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for x in lanes {
        for lane in 0..LANES {
            sums[lane] += x[lane];
        }
    }
    sums.iter().sum::<f64>() + rest.iter().sum::<f64>()
}

/// The smallest value; NaN if there is one, +∞ for an empty field.
pub fn smallest(a: &[f64]) -> f64 {
    let parts = by_parts(a.len(), |part| smallest_of_part(&a[part]));
    smallest_of_part(&parts)
}

fn smallest_of_part(a: &[f64]) -> f64 {
    let (lanes, rest) = a.as_chunks::<LANES>();
    let (mut least, mut nan) = ([f64::INFINITY; LANES], [false; LANES]);
    for x in lanes {
        for lane in 0..LANES {
            least[lane] = if x[lane] < least[lane] {
                x[lane]
            } else {
                least[lane]
            };
            nan[lane] |= x[lane].is_nan();
        }
    }
    if nan.contains(&true) || rest.iter().any(|x| x.is_nan()) {
        return f64::NAN;
    }
    least
        .iter()
        .chain(rest)
        .copied()
        .fold(f64::INFINITY, f64::min)
}

/// The largest `of(aᵢ, bᵢ)` where `mask` holds, at least 0, for one part; NaN is left out.
pub fn largest_of_part([a, b]: [&[f64]; 2], mask: &[bool], of: impl Fn(f64, f64) -> f64) -> f64 {
    let larger = |most: f64, a: f64, b: f64, holds: bool| {
        let value = if holds { of(a, b) } else { 0.0 };
        if value > most { value } else { most }
    };
    let (a_lanes, a_rest) = a.as_chunks::<LANES>();
    let (b_lanes, b_rest) = b.as_chunks::<LANES>();
    let (mask_lanes, mask_rest) = mask.as_chunks::<LANES>();
    let mut most = [0.0; LANES];
    for ((a, b), holds) in a_lanes.iter().zip(b_lanes).zip(mask_lanes) {
        for lane in 0..LANES {
            most[lane] = larger(most[lane], a[lane], b[lane], holds[lane]);
        }
    }
    let rest = a_rest.iter().zip(b_rest).zip(mask_rest);
    let rest = rest.fold(0.0, |most, ((a, b), holds)| larger(most, *a, *b, *holds));
    most.into_iter().fold(rest, f64::max)
}

/// Applies `rule` to every element.
pub fn each(y: &mut [f64], rule: impl Fn(&mut f64) + Sync) {
    on_parts(y, &|_, y| y.iter_mut().for_each(&rule));
}

/// `y ← y + α x`.
pub fn add_scaled(y: &mut [f64], alpha: f64, x: &[f64]) {
    update(y, x, |y, x| *y += alpha * x);
}

/// Applies `rule` to every pair of elements.
pub fn update<T: Sync>(y: &mut [f64], x: &[T], rule: impl Fn(&mut f64, &T) + Sync) {
    on_parts(y, &|part, y| {
        let x = &x[part * PART..];
        y.iter_mut().zip(x).for_each(|(y, x)| rule(y, x));
    });
}

/// Applies `rule` to every triple of elements.
pub fn update_with<S: Sync, T: Sync>(
    z: &mut [f64],
    x: &[S],
    y: &[T],
    rule: impl Fn(&mut f64, &S, &T) + Sync,
) {
    on_parts(z, &|part, z| {
        let others = x[part * PART..].iter().zip(&y[part * PART..]);
        z.iter_mut()
            .zip(others)
            .for_each(|(z, (x, y))| rule(z, x, y));
    });
}

#[cfg(test)]
mod tests {
    use rayon::ThreadPoolBuilder;

    use super::{
        add_scaled, by_parts, dot, each, largest_of_part, smallest, sum, update, update_with,
    };

    /// Fields of one part and of several, some not full.
    const LENGTHS: [usize; 5] = [0, 7, 8192, 32_769, 50_001];

    fn field(length: usize, rate: f64) -> Vec<f64> {
        (0..length).map(|i| (rate * i as f64).sin()).collect()
    }

    #[test]
    fn sums_have_the_same_bits_for_every_number_of_threads() {
        let a: Vec<f64> = (0..100_000).map(|i| f64::from(i).sin()).collect();
        let b: Vec<f64> = (0..100_000).map(|i| (1.7 * f64::from(i)).cos()).collect();
        let with = |threads| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap()
                .install(|| (sum(&a).to_bits(), dot(&a, &b).to_bits()))
        };
        assert_eq!(with(1), with(2));
        assert_eq!(with(1), with(5));
    }

    #[test]
    fn parts_in_order_make_up_the_whole() {
        for length in LENGTHS {
            let parts = by_parts(length, |part| part);
            let all: Vec<usize> = parts.iter().cloned().flatten().collect();
            assert_eq!(all, (0..length).collect::<Vec<_>>());
            assert!(parts.iter().all(|part| part.len() <= 4096));
        }
    }

    #[test]
    fn sums_include_all_elements() {
        for length in LENGTHS {
            let (a, b) = (field(length, 0.3), field(length, 0.7));
            let plain: f64 = a.iter().sum();
            let product: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
            // 50 000 terms of order 1, added in another order.
            assert!((sum(&a) - plain).abs() < 1e-11);
            assert!((dot(&a, &b) - product).abs() < 1e-11);
        }
    }

    #[test]
    fn the_minimum_is_over_all_elements_and_nan_if_any_is_nan() {
        assert_eq!(smallest(&[]), f64::INFINITY);
        for length in LENGTHS.into_iter().filter(|length| *length > 0) {
            for place in [0, length / 2, length - 1] {
                let mut a = field(length, 0.3);
                a[place] = -2.0;
                assert_eq!(smallest(&a), -2.0);
                a[place] = f64::NAN;
                assert!(smallest(&a).is_nan());
            }
        }
    }

    #[test]
    fn the_maximum_is_over_the_elements_of_the_mask() {
        let (a, b) = (field(4093, 0.3), field(4093, 0.7));
        for place in [0, 2046, 4092] {
            let mut mask = vec![false; 4093];
            (mask[place], mask[17]) = (true, true);
            let of = |a: f64, b: f64| (a - b).abs();
            let found = largest_of_part([&a, &b], &mask, of);
            assert_eq!(found, of(a[place], b[place]).max(of(a[17], b[17])));
            let without = largest_of_part([&a, &b], &mask, |a, _| if a > 9.0 { a } else { -1.0 });
            assert_eq!(without, 0.0);
        }
        assert_eq!(
            largest_of_part([&[f64::NAN, 2.0]; 2], &[true; 2], |a, _| a),
            2.0
        );
    }

    #[test]
    fn updates_pair_elements_with_the_same_index() {
        for length in LENGTHS {
            let (a, b) = (field(length, 0.3), field(length, 0.7));
            let mut c = a.clone();
            each(&mut c, |c| *c += 2.0);
            assert!(c.iter().zip(&a).all(|(c, a)| *c == a + 2.0));
            add_scaled(&mut c, 3.0, &b);
            assert!((0..length).all(|i| c[i] == a[i] + 2.0 + 3.0 * b[i]));
            update(&mut c, &b, |c, b| *c = -b);
            assert!((0..length).all(|i| c[i] == -b[i]));
            update_with(&mut c, &a, &b, |c, a, b| *c = a - b);
            assert!((0..length).all(|i| c[i] == a[i] - b[i]));
        }
    }
}
