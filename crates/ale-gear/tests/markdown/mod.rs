//! What the tests of documents and tutorials read out of Markdown.

#![allow(dead_code)] // each test file uses its own part

use std::ops::Range;
use std::path::{Path, PathBuf};

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

/// One Markdown file.
pub struct Page {
    pub path: PathBuf,
    pub text: String,
}

/// A name in the first cell of a row of a table.
pub struct TableKey {
    /// Heading above the table.
    pub section: String,
    /// What stands above the first column.
    pub title: String,
    pub name: String,
    /// Where it begins.
    pub byte: usize,
}

impl Page {
    pub fn read(path: PathBuf) -> Self {
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Self { path, text }
    }

    /// All `.md` files in a folder, and below it when asked for, ascending by path.
    pub fn all_in(folder: &Path, below: bool) -> Vec<Self> {
        let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
        paths.sort();
        let (folders, files): (Vec<_>, Vec<_>) = paths.into_iter().partition(|p| p.is_dir());
        let mut pages: Vec<Self> =
            files.into_iter().filter(|p| p.extension().is_some_and(|e| e == "md")).map(Self::read).collect();
        if below {
            pages.extend(folders.iter().flat_map(|folder| Self::all_in(folder, true)));
        }
        pages
    }

    pub fn events(&self) -> impl Iterator<Item = (Event<'_>, Range<usize>)> {
        Parser::new_ext(&self.text, Options::ENABLE_TABLES).into_offset_iter()
    }

    /// `file:line` of a byte of the text.
    pub fn place(&self, byte: usize) -> String {
        format!("{}:{}", self.path.display(), 1 + self.text[..byte].matches('\n').count())
    }

    /// Targets of links and pictures, each with the byte where it begins.
    pub fn links(&self) -> Vec<(String, usize)> {
        self.events()
            .filter_map(|(event, range)| match event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    Some((dest_url.into_string(), range.start))
                }
                _ => None,
            })
            .collect()
    }

    /// Inline code, each with the byte where it begins.
    pub fn code(&self) -> Vec<(String, usize)> {
        self.events()
            .filter_map(|(event, range)| match event {
                Event::Code(text) => Some((text.into_string(), range.start)),
                _ => None,
            })
            .collect()
    }

    /// Names in code font in the first cells of the rows of all tables.
    pub fn table_keys(&self) -> Vec<TableKey> {
        let (mut keys, mut section, mut in_heading, mut cell) = (Vec::new(), String::new(), false, 0);
        let (mut title, mut in_head) = (String::new(), false);
        for (event, range) in self.events() {
            match event {
                Event::Start(Tag::Heading { .. }) => (in_heading, section) = (true, String::new()),
                Event::End(TagEnd::Heading(_)) => in_heading = false,
                Event::Text(text) | Event::Code(text) if in_heading => section.push_str(&text),
                Event::Start(Tag::TableHead) => (in_head, cell, title) = (true, 0, String::new()),
                Event::End(TagEnd::TableHead) => in_head = false,
                Event::Start(Tag::TableRow) => cell = 0,
                Event::Start(Tag::TableCell) => cell += 1,
                Event::End(TagEnd::Table) => cell = 0,
                Event::Text(text) | Event::Code(text) if in_head && cell == 1 => title.push_str(&text),
                Event::Code(name) if cell == 1 => {
                    keys.push(TableKey {
                        section: section.clone(),
                        title: title.clone(),
                        name: name.into_string(),
                        byte: range.start,
                    });
                }
                _ => {}
            }
        }
        keys
    }

    /// What may stand behind `#` in a link to this page: its headings, in the spelling that repository hosts and mdBook
    /// share.
    pub fn anchors(&self) -> Vec<String> {
        let (mut anchors, mut heading): (Vec<String>, Option<String>) = (Vec::new(), None);
        for (event, _) in self.events() {
            match event {
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::Text(text) | Event::Code(text) => heading.iter_mut().for_each(|h| h.push_str(&text)),
                Event::End(TagEnd::Heading(_)) => anchors.extend(heading.take().map(|h| anchor(&h))),
                _ => {}
            }
        }
        anchors
    }
}

/// Lower case, blanks as hyphens, other signs left out.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
}
