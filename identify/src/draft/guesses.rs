//! What a drafted fit file still guesses, by the words beside its defaults: no interval knows of it.

use pellicle::input::document::Document;

use super::NOT_IN_THE_FILE;

/// The keys beside which a fit file still says [`NOT_IN_THE_FILE`], each in backquotes, with the words of its
/// comment in brackets.
#[must_use]
pub fn guesses(document: &Document) -> Vec<String> {
    in_text(document.root().span.source.inner())
}

fn in_text(text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let guess = |(number, line): (usize, &&str)| {
        let (before, _) = line.split_once(NOT_IN_THE_FILE)?;
        let (_, words) = before.rsplit_once('#')?;
        // The head of a draft quotes the words.
        if words.ends_with('"') {
            return None;
        }
        // A line of comment belongs to the key below it.
        let is_key = |line: &&&str| !line.is_empty() && !line.starts_with('#');
        let with_key = if line.starts_with('#') {
            lines[number..].iter().find(is_key)?
        } else {
            line
        };
        let key = with_key.split('=').next().unwrap_or_default().trim();
        let words = words.trim().trim_end_matches([',', ';']);
        Some(if words.is_empty() {
            format!("`{key}`")
        } else {
            format!("`{key}` ({words})")
        })
    };
    lines.iter().enumerate().filter_map(guess).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_mark_belongs_to_its_key_and_the_head_to_none() {
        let text = "# A default has the words \"not in the file: put yours\".\n\
                    substrate = { poisson_ratio = 0.5 }  # Poisson's ratio, not in the file: put yours\n\
                    radius = \"5 um\"  # not in the file: put yours\n\
                    # An ideal pyramid, not in the file: put yours: coefficients,\n\
                    # such as [24.5].\n\
                    area_function = [24.5]\n\
                    # line 2: # InvOLS: 55; its unit, not in the file: put yours\n\
                    units = { deflection = \"55 nm/V\" }\n\
                    force = \"1 N\"  # line 1\n";
        let wanted = [
            "`substrate` (Poisson's ratio)",
            "`radius`",
            "`area_function` (An ideal pyramid)",
            "`units` (InvOLS: 55; its unit)",
        ];
        assert_eq!(in_text(text), wanted);
    }
}
