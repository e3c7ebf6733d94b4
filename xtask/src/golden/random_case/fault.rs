//! One fault in a text, of the kinds that people make.

use super::draw::Draw;

/// Values in place of that of a key.
const VALUES: [&str; 9] = [
    "true",
    "\"5 parsec\"",
    "nan",
    "\"3 mN\"",
    "\"3 nm\"",
    "[1, 2]",
    "0",
    "1e300",
    "\"none\"",
];

/// Spoils one line of the text.
pub fn draw(draw: &mut Draw) {
    let text = draw.text.clone();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let is_key = |line: &&(usize, &str)| line.1.contains(" = ");
    let keys: Vec<usize> = text
        .lines()
        .enumerate()
        .filter(|line| is_key(&line))
        .map(|(index, _)| index)
        .collect();
    let at = draw.pick(&keys);
    let (key, value) = lines[at].split_once(" = ").unwrap_or_default();
    let spoiled = match draw.below(8) {
        0 => Some(format!("{} = {value}", swapped(key))),
        1 => None,
        2 => Some(format!("{key} = {value}\n{key} = {value}")),
        3 if value.starts_with('"') => Some(format!("{key} = \"-{}", &value[1..])),
        3 => Some(format!("{key} = -{value}")),
        4 => Some(format!("{key} = {value}\ncolour = 3")),
        5 => Some(format!("{key} = {}", &value[..value.len() - 1])),
        _ => Some(format!("{key} = {}", draw.pick(&VALUES))),
    };
    match spoiled {
        Some(line) => lines[at] = line,
        None => {
            lines.remove(at);
        }
    }
    draw.text = lines.join("\n") + "\n";
}

/// The key with its second and third letters exchanged.
fn swapped(key: &str) -> String {
    let mut letters: Vec<char> = key.chars().collect();
    if letters.len() > 2 {
        letters.swap(1, 2);
    }
    letters.into_iter().collect()
}
