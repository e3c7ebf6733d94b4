//! The links of a site as built: each leads to a file of it, and an anchor to an element of that page.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Display, Formatter};
use std::fs;
use std::path::Path;

use crate::XtaskError;
use crate::links::resolved;

/// A link of a page that leads nowhere.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BrokenLink {
    /// The page, from the folder of the site.
    pub page: String,
    /// The address in it.
    pub target: String,
}

impl Display for BrokenLink {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: the link to `{}` leads nowhere",
            self.page, self.target
        )
    }
}

/// The links of these pages that lead nowhere in the site in a folder.
///
/// # Errors
/// [`XtaskError::Read`] if a page is not there.
pub(super) fn broken_links(book: &Path, pages: &[String]) -> Result<Vec<BrokenLink>, XtaskError> {
    let mut texts = BTreeMap::new();
    for page in pages {
        let name = format!("{}.html", page.trim_end_matches(".md"));
        let path = book.join(&name);
        let text = fs::read_to_string(&path).map_err(|cause| XtaskError::read(&path, cause))?;
        texts.insert(name, text);
    }
    let names: BTreeMap<_, _> = texts
        .iter()
        .map(|(page, text)| (page.as_str(), names(text)))
        .collect();
    let mut broken = Vec::new();
    for (page, text) in &texts {
        let leads_nowhere = |target: &&str| {
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let Some(path) = resolved(page, file) else {
                return true;
            };
            let has_anchor = || {
                let names = names.get(path.as_str());
                anchor.is_empty() || names.is_some_and(|names| names.contains(anchor))
            };
            let place = book.join(&path);
            !(place.is_file() && has_anchor() || place.join("index.html").is_file())
        };
        let links = values(text, " href=\"").chain(values(text, " src=\""));
        let local = links.filter(|target| !target.contains(':'));
        let found = local.filter(leads_nowhere).collect::<BTreeSet<_>>();
        broken.extend(found.into_iter().map(|target| BrokenLink {
            page: page.clone(),
            target: target.to_owned(),
        }));
    }
    Ok(broken)
}

/// The names of a page's elements, to which anchors lead.
fn names(text: &str) -> BTreeSet<&str> {
    values(text, " id=\"").collect()
}

/// The values of an attribute.
fn values<'a>(text: &'a str, attribute: &str) -> impl Iterator<Item = &'a str> {
    let parts = text.split(attribute).skip(1);
    parts.filter_map(|part| part.split('"').next())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_without_a_file_or_an_element_are_found() {
        let book = tempfile::tempdir().unwrap();
        fs::create_dir(book.path().join("cases")).unwrap();
        fs::write(book.path().join("cases/index.html"), "").unwrap();
        let text = "<h1 id=\"top\"> <a href=\"#top\"> <a href=\"#end\"> <a href=\"b.html#top\"> <a href=\"cases\"> \
                    <img src=\"none.png\"> <a href=\"https://a.b\">";
        fs::write(book.path().join("a.html"), text).unwrap();
        fs::write(book.path().join("b.html"), "<p id=\"top\">").unwrap();
        let broken = broken_links(book.path(), &["a.md".into(), "b.md".into()]).unwrap();
        let targets: Vec<_> = broken.iter().map(|link| link.target.as_str()).collect();
        assert_eq!(targets, ["#end", "none.png"]);
        let told = broken[0].to_string();
        assert_eq!(told, "a.html: the link to `#end` leads nowhere");
    }
}
