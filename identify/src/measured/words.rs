//! The words of a name in a file: of a column, or of a setting above the table.

/// The words of a name, split at signs and before a capital that begins a word: `vDeflection` has two, `InvOLS` and
/// `pN` have one.
pub(crate) fn words(name: &str) -> Vec<String> {
    let mut split = String::new();
    let mut was_lower = false;
    let mut rest = name.chars().peekable();
    while let Some(c) = rest.next() {
        let begins_word = c.is_uppercase() && rest.peek().is_some_and(|next| next.is_lowercase());
        if was_lower && begins_word {
            split.push(' ');
        }
        was_lower = c.is_lowercase();
        split.push(if c.is_alphanumeric() { c } else { ' ' });
    }
    split.split_whitespace().map(str::to_owned).collect()
}

/// The words of a name in lower case.
pub(crate) fn lower_words(name: &str) -> Vec<String> {
    words(name).iter().map(|word| word.to_lowercase()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_split_at_signs_and_before_capitals_that_begin_words() {
        for (name, wanted) in [
            ("vDeflection", &["v", "Deflection"][..]),
            ("InvOLS", &["InvOLS"]),
            ("springConstant", &["spring", "Constant"]),
            ("Sens. DeflSens", &["Sens", "Defl", "Sens"]),
            ("Defl_pN_Ex", &["Defl", "pN", "Ex"]),
            ("Z-Sense", &["Z", "Sense"]),
        ] {
            assert_eq!(words(name), wanted);
        }
    }
}
