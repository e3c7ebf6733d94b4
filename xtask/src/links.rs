//! Links of documents: what they lead to, seen from the root of the workspace.

/// The relative targets of the links, pictures and reference definitions of a document, with their lines. Links to
/// other sites are left out.
pub fn targets(text: &str) -> impl Iterator<Item = (usize, String)> {
    prose(text).flat_map(|(number, line)| {
        let targets = targets_in(&without_code(line));
        let is_here = |target: &String| !target.contains("://") && !target.starts_with("mailto:");
        targets
            .into_iter()
            .filter(is_here)
            .map(move |target| (number, target))
    })
}

/// The path from the root for a link in the document `from`; `None` if it leaves the tree.
pub fn resolved(from: &str, target: &str) -> Option<String> {
    if target.is_empty() {
        return Some(from.to_owned());
    }
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in target.split('/').filter(|part| !matches!(*part, "" | ".")) {
        if part == ".." {
            parts.pop()?;
        } else {
            parts.push(part);
        }
    }
    Some(parts.join("/"))
}

/// The lines outside fenced code, numbered from 1; fences may be in comments.
pub fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut in_code = false;
    text.lines().enumerate().filter_map(move |(index, line)| {
        let is_fence = unmarked(line).starts_with("```");
        in_code ^= is_fence;
        (!in_code && !is_fence).then_some((index + 1, line))
    })
}

/// The line without its indentation and comment marker.
pub fn unmarked(line: &str) -> &str {
    line.trim_start_matches(|c: char| c.is_whitespace() || "/!".contains(c))
}

/// The line without its code spans.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect::<Vec<_>>().join("`")
}

/// The targets of the links, pictures and reference definitions of a line.
fn targets_in(line: &str) -> Vec<String> {
    let inline = line
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')'));
    let definition = line
        .starts_with('[')
        .then(|| line.split_once("]: "))
        .flatten();
    let written = inline
        .map(|(target, _)| target)
        .chain(definition.map(|(_, target)| target));
    written
        .filter_map(|target| target.split_whitespace().next())
        .map(|target| target.trim_matches(['<', '>']).to_owned())
        .collect()
}
