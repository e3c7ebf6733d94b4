//! The length to which a transform is padded.

/// Half the padded length, M: the smallest M ≥ `size` for which the transform is fast.
///
/// M is a multiple of four with at most three odd factors, all of them 3 except for one 5 or 7. Measured: a second
/// factor 5 makes a transform of 100 numbers slower than one of 128, and half as fast as one of 96.
///
/// Any L = 2M ≥ 2N − 1 makes the circulant embedding exact.
pub(crate) fn half_length(size: usize) -> usize {
    let mut half = size.max(1);
    // A power of two is never far.
    while !is_fast(half) {
        half += 1;
    }
    half
}

/// Length below which all transforms are equally good.
const SHORT: usize = 16;

/// Whether a transform of this length is fast.
fn is_fast(length: usize) -> bool {
    let mut odd = length >> length.trailing_zeros();
    let mut count = |prime: usize| {
        let mut factors = 0;
        while odd.is_multiple_of(prime) {
            odd /= prime;
            factors += 1;
        }
        factors
    };
    let (threes, others) = (count(3), count(5) + count(7));
    let few = threes + others <= 3 && others <= 1 && odd == 1;
    length < SHORT || (length.is_multiple_of(4) && few)
}

#[cfg(test)]
mod tests {
    use super::half_length;

    #[test]
    fn powers_of_two_are_kept_and_primes_are_rounded_up() {
        assert_eq!(half_length(1), 1);
        assert_eq!(half_length(512), 512);
        assert_eq!(half_length(513), 576);
        assert_eq!(half_length(127), 128);
        assert_eq!(half_length(100), 108);
        assert_eq!(half_length(109), 112);
        assert_eq!(half_length(11), 11);
    }
}
