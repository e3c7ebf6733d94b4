//! Dotted paths of keys: `foundation.layer[0].thickness`.

/// The dotted path of a key in the table at `path`; empty for the root.
#[must_use]
pub fn dotted(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    }
}

/// Splits `foundation.layer[0].thickness` or `foundation.layer.0.thickness` into its four parts; dots and brackets
/// within quotes do not split, as in `unknown."load.work_of_adhesion"`.
#[must_use]
pub fn parts(key: &str) -> Option<Vec<String>> {
    let mut is_quoted = false;
    let is_end = |sign: char| {
        is_quoted ^= sign == '"';
        !is_quoted && matches!(sign, '.' | '[')
    };
    let parts = key.split(is_end);
    let bare = |part: &str| part.replace(['"', ']'], "").trim().to_owned();
    let quoted = |part: &str| {
        part.trim()
            .strip_prefix('"')?
            .strip_suffix('"')
            .map(str::to_owned)
    };
    let parts: Vec<_> = parts
        .map(|part| quoted(part).unwrap_or_else(|| bare(part)))
        .collect();
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
        let quoted = ["unknown", "foundation.layer[0].thickness", "from"].map(str::to_owned);
        let key = "unknown.\"foundation.layer[0].thickness\".from";
        assert_eq!(parts(key).as_deref(), Some(&quoted[..]));
    }
}
