//! Text in tables: one line per row, and nothing that a spreadsheet takes for a formula.

/// The characters with which a formula begins when a spreadsheet opens a table, also in full width.
///
/// Source: OWASP, *CSV Injection*.
const FORMULA_STARTS: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];

/// The texts allowed as values that become cells.
pub const WANTED: &str =
    "text without control characters that does not begin with =, +, - or @, as a formula does";

/// Whether a spreadsheet shows the text as it is. A number with a sign is no formula.
#[must_use]
pub fn is_plain(text: &str) -> bool {
    let is_formula = text.trim_start().starts_with(FORMULA_STARTS);
    let is_number = || text.trim().parse::<f64>().is_ok();
    !text.contains(char::is_control) && (!is_formula || is_number())
}

/// The text on one line, after an apostrophe if it would be a formula.
#[must_use]
pub fn made_plain(text: &str) -> String {
    let text = on_one_line(text);
    if is_plain(&text) {
        text
    } else {
        format!("'{text}")
    }
}

/// The text as a cell: [made plain](made_plain), and quoted if necessary.
#[must_use]
pub fn text_cell(text: &str) -> String {
    let text = made_plain(text);
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text
    }
}

/// Escapes line ends and other control characters.
#[must_use]
pub fn on_one_line(text: &str) -> String {
    let spelt = |character: char| {
        let is_control = character.is_control();
        let spelt = is_control.then(|| character.escape_debug().to_string());
        spelt.unwrap_or_else(|| character.into())
    };
    text.chars().map(spelt).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_told_from_a_number_with_a_sign() {
        let formulas = ["=cmd|'/C calc'!A0", "+1+1", "@SUM(1)", " =1", "-x", "＝1"];
        assert!(formulas.iter().all(|text| !is_plain(text)));
        assert!(
            ["\tx", "a\nb", "a\rb", "\u{1b}[31m"]
                .iter()
                .all(|text| !is_plain(text))
        );
        let plain = ["-2", "-1.5e-3", "+7", "-inf", "bare", "a = b", "1 - 2", ""];
        assert!(plain.iter().all(|text| is_plain(text)));
    }

    #[test]
    fn a_cell_is_one_line_and_no_formula() {
        let cells = ["=1.csv", "a\nb", "a\"b,c", "-2", "a.csv"].map(text_cell);
        assert_eq!(cells, ["'=1.csv", "a\\nb", "\"a\"\"b,c\"", "-2", "a.csv"]);
    }
}
