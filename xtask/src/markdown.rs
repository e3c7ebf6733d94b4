//! The little of Markdown that the house rules read: lines outside code, links, anchors of headings, commands.

/// A line of a document, with what it is part of.
struct Line<'a> {
    number: usize,
    text: &'a str,
    in_code: bool,
}

/// A link or picture: line (from 1) and target as written.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Link {
    pub line: usize,
    pub target: String,
}

/// Every inline link, picture and reference definition outside code.
pub(crate) fn links(text: &str) -> Vec<Link> {
    let prose = lines(text).filter(|line| !line.in_code);
    prose
        .flat_map(|line| {
            targets(&without_code_spans(line.text))
                .into_iter()
                .map(move |target| Link {
                    line: line.number,
                    target,
                })
        })
        .collect()
}

/// The anchors that GitHub gives the headings: lower case, punctuation dropped, spaces as hyphens, repeats numbered.
pub(crate) fn anchors(text: &str) -> Vec<String> {
    let mut anchors: Vec<String> = Vec::new();
    let mut seen: Vec<String> = Vec::new();
    for line in lines(text).filter(|line| !line.in_code && line.text.starts_with('#')) {
        let anchor = anchor(line.text.trim_start_matches('#'));
        let repeats = seen.iter().filter(|s| **s == anchor).count();
        anchors.push(if repeats == 0 {
            anchor.clone()
        } else {
            format!("{anchor}-{repeats}")
        });
        seen.push(anchor);
    }
    anchors
}

/// The lines of all fenced code, trimmed.
pub(crate) fn code_lines(text: &str) -> Vec<&str> {
    let code = lines(text).filter(|line| line.in_code);
    code.map(|line| line.text.trim()).collect()
}

fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
    let lower = heading.trim().to_lowercase();
    lower
        .chars()
        .filter(kept)
        .collect::<String>()
        .replace(' ', "-")
}

fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let mut in_code = false;
    text.lines().enumerate().map(move |(index, text)| {
        let is_fence = text.trim_start().starts_with("```");
        in_code ^= is_fence;
        Line {
            number: index + 1,
            text,
            in_code: in_code && !is_fence,
        }
    })
}

/// The line without what stands between pairs of backquotes; what follows an unpaired one is prose.
fn without_code_spans(line: &str) -> String {
    let parts: Vec<&str> = line.split('`').collect();
    let unpaired = parts.len() - 1;
    let prose = |&(i, _): &(usize, &&str)| i % 2 == 0 || i == unpaired;
    let kept = parts.iter().enumerate().filter(prose);
    kept.map(|(_, part)| *part).collect::<Vec<_>>().join("`")
}

fn targets(line: &str) -> Vec<String> {
    let inline = line
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')'));
    let definition = line
        .starts_with('[')
        .then(|| line.split_once("]: "))
        .flatten();
    inline
        .map(|(target, _)| target)
        .chain(definition.map(|(_, target)| target))
        .filter_map(|target| target.split_whitespace().next())
        .map(|target| target.trim_matches(['<', '>']).to_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_in_code_are_not_links() {
        let text =
            "a [b](c.md) `[d](e.md)` ![f](g.png \"title\")\n```text\n[h](i.md)\n```\n[j]: k.md\n";
        let expected = [(1, "c.md"), (1, "g.png"), (5, "k.md")];
        let expected = expected.map(|(line, target)| Link {
            line,
            target: target.to_owned(),
        });
        assert_eq!(links(text), expected);
    }

    #[test]
    fn anchors_are_those_of_github() {
        let text = "# What it is\n## How to add an indenter, a relief\n# What it is\n```sh\n# comment\n```\n";
        let expected = [
            "what-it-is",
            "how-to-add-an-indenter-a-relief",
            "what-it-is-1",
        ];
        assert_eq!(anchors(text), expected);
    }

    #[test]
    fn code_lines_are_those_between_fences() {
        assert_eq!(code_lines("a\n```sh\n  cargo test\n```\nb"), ["cargo test"]);
    }
}
