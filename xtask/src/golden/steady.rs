//! Texts without what differs from run to run: times, numbers of threads and the version of the program.

/// What stands after a number that differs: units of a time, and threads.
const UNSTEADY: [&str; 6] = ["s", "ms", "min", "seconds", "thread", "threads"];
/// Marks around a word.
const MARKS: [char; 8] = [',', '.', ';', ':', '(', ')', '>', '<'];

/// The text with `…` in place of every number of such a unit, and of every version.
pub fn steady(text: &str) -> String {
    let lines: Vec<String> = text.split('\n').map(steady_line).collect();
    lines.join("\n")
}

fn steady_line(line: &str) -> String {
    let words: Vec<&str> = line.split(' ').collect();
    let next = words.iter().skip(1).map(|word| bare(word)).chain([""]);
    let kept = words.iter().zip(next).map(|(&word, next)| {
        let is_unsteady = UNSTEADY.contains(&next) && bare(word).parse::<f64>().is_ok();
        if is_unsteady || is_version(bare(word)) {
            word.replacen(bare(word), "…", 1)
        } else {
            word.to_owned()
        }
    });
    kept.collect::<Vec<_>>().join(" ")
}

fn bare(word: &str) -> &str {
    let end = word.find('<').unwrap_or(word.len());
    word[..end].trim_matches(MARKS)
}

/// Three whole numbers, with points between them.
fn is_version(word: &str) -> bool {
    let parts: Vec<&str> = word.split('.').collect();
    parts.len() == 3 && parts.iter().all(|part| part.parse::<u32>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_versions_are_replaced_and_other_numbers_kept() {
        for (text, wanted) in [
            (
                "7 products with K, 0.0258 s\nnext 1",
                "7 products with K, … s\nnext 1",
            ),
            (
                "Coefficients 0.00447 s (read), 2 threads.</p>",
                "Coefficients … s (read), … threads.</p>",
            ),
            ("solved, 0.992 s</p>", "solved, … s</p>"),
            ("Pellicle 0.1.0, 256 × 256", "Pellicle …, 256 × 256"),
            ("found 5 m, wanted 3 sides", "found 5 m, wanted 3 sides"),
        ] {
            assert_eq!(steady(text), wanted);
        }
    }
}
