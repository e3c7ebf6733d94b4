//! Text of the user or of a file, made harmless to a terminal.

/// The text with every control character except line breaks and tabs escaped (`\\u001b`), so that a terminal shows them
/// instead of obeying them. Inside a JSON or TOML string the escaped text means the same.
#[must_use]
pub fn clean(text: &str) -> String {
    let is_escaped = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    if !text.contains(is_escaped) {
        return text.to_owned();
    }
    let shown = |c: char| {
        if is_escaped(c) {
            format!("\\u{:04x}", u32::from(c))
        } else {
            c.to_string()
        }
    };
    text.chars().map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped_and_all_others_kept() {
        assert_eq!(
            clean("µ \u{1b}[31m\u{9b}\u{7}\r\n\tä"),
            "µ \\u001b[31m\\u009b\\u0007\\u000d\n\tä"
        );
    }
}
