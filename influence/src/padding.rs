//! The length to which a transform is padded.

/// Half the padded length, M: the smallest M ≥ `size` of the form 2^i · 3^j · 5^k with j + k ≤ 3, for which the transform is fast.
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

/// Whether only few of the factors of `length` are odd, and these 3 or 5.
fn is_fast(length: usize) -> bool {
    let mut odd = length >> length.trailing_zeros();
    let mut factors = 0;
    for prime in [3, 5] {
        while odd.is_multiple_of(prime) {
            odd /= prime;
            factors += 1;
        }
    }
    odd == 1 && factors <= 3
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
        assert_eq!(half_length(100), 100);
    }
}
