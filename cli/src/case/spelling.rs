//! What a misspelt word was meant to be.

/// The one of `known` that `word` is most likely a misspelling of.
#[must_use]
pub fn closest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase().replace('-', "_");
    let distance = |key: &str| strsim::damerau_levenshtein(&word, &key.replace('-', "_"));
    let near = |key: &&&str| distance(key) <= 1 + key.len() / 4;
    let near = known.iter().filter(near);
    near.min_by_key(|key| distance(key)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_suggested_for_a_key_unlike_any() {
        assert_eq!(closest("colour", &["thickness", "young_modulus"]), None);
        assert_eq!(
            closest("Flat_Punch", &["flat-punch", "cone"]),
            Some("flat-punch")
        );
    }
}
