//! Dotted paths of keys: `foundation.layer[0].thickness`.

/// The dotted path of a key in the table at `path`; empty for the root.
#[must_use]
pub fn dotted(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    }
}

/// Splits `foundation.layer[0].thickness` or `foundation.layer.0.thickness` into its four parts.
#[must_use]
pub fn parts(key: &str) -> Option<Vec<String>> {
    let dotted = key.trim().replace('[', ".").replace(']', "");
    let parts: Vec<_> = dotted.split('.').map(|s| s.trim().to_owned()).collect();
    (parts.iter().all(|part| !part.is_empty())).then_some(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn list_items_are_numbered_in_brackets_or_between_dots() {
        let thickness = ["foundation", "layer", "0", "thickness"].map(str::to_owned);
        for key in [
            "foundation.layer[0].thickness",
            " foundation.layer.0.thickness",
            dotted("foundation.layer[0]", "thickness").as_str(),
        ] {
            assert_eq!(parts(key).as_deref(), Some(&thickness[..]), "{key}");
        }
        assert_eq!(dotted("", "title"), "title");
        assert_eq!(parts("load..force"), None);
    }
}
