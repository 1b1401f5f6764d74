//! The text of a document: lines, keys, and errors that name them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::de::DeserializeOwned;
use toml::Spanned;

use super::DocumentKind;
use super::data_file::DataFiles;
use super::document::Document;
use super::document_kind::TASKS;
use super::keys::{self, Neighbour, Tables};
use super::origin::Origin;
use super::places::Written;
use super::setting::Setting;
use super::spanned::{NAMED, Named, Word};
use super::tree::Node;
use super::{Place, error::SceneError};
use super::{hints, wrong_line};

/// A document with its additional settings, and the meaning of its keys.
pub struct Source<'a> {
    /// Path as the user wrote it.
    pub file: &'a Path,
    document: &'a Document,
    /// What was set beside the file.
    pub(crate) settings: &'a [Setting],
    tables: Tables,
    /// The other kind of machine, with its tables: who writes a key of that is told.
    neighbour: Option<Neighbour>,
    /// Whether this is the scene of a mesh of a gearbox, which says itself what holds, drives and moves its gears.
    pub(crate) is_of_mesh: bool,
    /// What a key means.
    pub(super) meaning: fn(&str) -> Option<&'static str>,
    /// Names and texts of files beside it that are not written yet.
    beside: &'a [(String, String)],
    /// Documents that it names, as far as they were read.
    named: RefCell<BTreeMap<PathBuf, Document>>,
}

impl<'a> Source<'a> {
    /// A file of these tables. Hints tell no meanings: a key of a scene that has its name means something else.
    pub(crate) fn of(document: &'a Document, tables: Tables) -> Self {
        let (settings, beside): (&[Setting], &[_]) = (&[], &[]);
        let (named, neighbour, is_of_mesh) = (RefCell::default(), None, false);
        let file = document.file();
        Self { file, document, settings, tables, neighbour, is_of_mesh, meaning: |_| None, beside, named }
    }

    /// This file with the other kind of machine that keys may be meant for.
    pub(crate) fn with_neighbour(self, neighbour: Neighbour) -> Self {
        Self { neighbour: Some(neighbour), ..self }
    }

    /// This file as the scene of a mesh of a gearbox.
    pub(crate) fn of_mesh(self) -> Self {
        Self { is_of_mesh: true, ..self }
    }

    /// This file with what its keys mean.
    pub(crate) fn with_meanings(self, meaning: fn(&str) -> Option<&'static str>) -> Self {
        Self { meaning, ..self }
    }

    /// This file with what was set beside it.
    pub(crate) fn with_settings(self, settings: &'a [Setting]) -> Self {
        Self { settings, ..self }
    }

    /// This file with names and texts of files beside it that are not written yet.
    pub(crate) fn with_beside(self, beside: &'a [(String, String)]) -> Self {
        Self { beside, ..self }
    }
}

impl Source<'_> {
    /// The words of the document with what was set beside it, each with its place: settings stand behind the text, a line
    /// each.
    ///
    /// # Errors
    /// Syntax, unknown keys and wrong types, each with its line, as far as this is not a document of another kind than
    /// the `wanted` one.
    pub(crate) fn words<T: DeserializeOwned>(&self, wanted: DocumentKind) -> Result<T, SceneError> {
        // What is varied or optimised of a pair or a gearbox is not a part of it.
        let is_machine = matches!(wanted, DocumentKind::Scene | DocumentKind::Gearbox);
        let is_task = |name: &str| TASKS.iter().any(|(_, task)| *task == name);
        let has_task = |root: &Node| is_machine && root.entries().any(|(key, _)| is_task(key));
        let read = match self.document.root() {
            Err(fault) => Err(fault.clone()),
            Ok(root) if self.settings.is_empty() && !has_task(root) => T::deserialize(root),
            Ok(root) => {
                let mut all = root.clone().only(|name| !(is_machine && is_task(name)));
                for (setting, line) in self.settings.iter().zip(self.lines()) {
                    if let Some(what) = all.nobody_called(setting.path()) {
                        return Err(SceneError::Setting { label: setting.label().to_owned(), what });
                    }
                    all.put(setting.path(), setting.value().moved(line.end - setting.written().len()));
                }
                T::deserialize(&all)
            }
        };
        read.map_err(|fault| self.of_kind(self.explain(&fault.message, fault.span), wanted))
    }

    /// A complaint about a document that was to be a `wanted` one: that it is of another kind, where it is.
    pub(crate) fn of_kind(&self, complaint: SceneError, wanted: DocumentKind) -> SceneError {
        // A typo in a pair with a plan in it is one in the pair.
        let found = match wanted {
            DocumentKind::Scene | DocumentKind::Gearbox => self.document.base_kind().or(self.document.kind()),
            _ => self.document.kind(),
        };
        complaint.unless_another_kind(found, self.file, wanted)
    }

    /// Ranges of the lines of the settings, behind the text of the document.
    fn lines(&self) -> impl Iterator<Item = Range<usize>> {
        let mut at = self.document.text().len();
        self.settings.iter().map(move |setting| {
            let start = at + 1;
            at = start + setting.line().len();
            start..at
        })
    }

    /// The setting that a byte range lies in, with the range of its line; `None` within the text.
    fn setting(&self, span: &Range<usize>) -> Option<(&Setting, Range<usize>)> {
        // Its end too, where something is missing.
        self.settings.iter().zip(self.lines()).find(|(_, line)| (line.start..=line.end).contains(&span.start))
    }

    /// File and line of a byte range, or the setting that contains it.
    pub fn place(&self, span: &Range<usize>) -> Place {
        match self.setting(span) {
            Some((setting, _)) => Place::Setting { label: setting.label().into() },
            None => self.document.line(span),
        }
    }

    /// What it calls itself, else the name of the file.
    ///
    /// # Errors
    /// As of [`Source::called`].
    pub(crate) fn title(&self, name: &Word) -> Result<String, SceneError> {
        Ok(self.called(name)?.unwrap_or_else(|| self.document.stem()))
    }

    /// A name, where one is written.
    ///
    /// # Errors
    /// [`SceneError::Conflict`] for one without a letter.
    pub(crate) fn called(&self, name: &Word) -> Result<Option<String>, SceneError> {
        let Some(word) = name else { return Ok(None) };
        if word.get_ref().trim().is_empty() {
            let advice = "give it a name, or leave the key out where it has a default";
            return Err(self.conflict(&word.span(), "the name is empty", advice));
        }
        Ok(Some(word.get_ref().clone()))
    }

    /// Where the scene that is read came from.
    pub(crate) fn written(&self) -> Written {
        let of_file = self.document.places();
        let places = if self.settings.is_empty() { of_file.clone() } else { of_file.with(self.settings) };
        Written::new(places, self.origin(), Arc::clone(self.document.files()))
    }

    /// Where files that it names are looked for.
    pub(crate) fn origin(&self) -> Origin {
        self.document.origin()
    }

    /// Data files that it names, as far as they were read.
    pub(crate) fn data_files(&self) -> &DataFiles {
        self.document.files()
    }

    /// The document that a word names, read once for all who name it; `whose` is what this file is called.
    ///
    /// # Errors
    /// [`SceneError::Conflict`] at the word.
    pub(crate) fn named(&self, word: &Spanned<String>, whose: &str) -> Result<Document, SceneError> {
        let name = word.get_ref();
        let path = self.file.parent().unwrap_or(Path::new("")).join(name);
        let mut known = self.named.borrow_mut();
        if let Some(document) = known.get(&path) {
            return Ok(document.clone());
        }
        let files = Arc::clone(self.document.files());
        let document = match self.beside.iter().find(|(own, _)| own == name) {
            Some((_, text)) => Document::made(text.clone(), &path, Origin::Disk, files),
            None => Document::read_beside(&path, files).map_err(|e| match e {
                SceneError::Read { file, source } => {
                    let said = format!("\"{}\" cannot be read: {source}", file.display());
                    self.conflict(&word.span(), said, format!("paths are relative to the {whose}"))
                }
                other => other,
            })?,
        };
        known.insert(path, document.clone());
        Ok(document)
    }

    /// The document that a word names, or whose tables stand in its place.
    ///
    /// # Errors
    /// As [`Source::named`].
    pub(crate) fn document(&self, word: &Spanned<Named>, whose: &str) -> Result<Document, SceneError> {
        match word.get_ref() {
            Named::Path(path) => self.named(&Spanned::new(word.span(), path.clone()), whose),
            Named::Here => self.document.part(&word.span()).ok_or_else(|| {
                self.conflict(&word.span(), "tables that are set beside the file", "write them into the file")
            }),
        }
    }

    /// An error about values that are valid separately but exclude each other.
    pub fn conflict(&self, span: &Range<usize>, what: impl Into<String>, advice: impl Into<String>) -> SceneError {
        SceneError::Conflict { place: self.place(span), what: what.into(), advice: advice.into() }
    }

    /// A message of the TOML reader in this program's words.
    fn explain(&self, message: &str, span: Option<Range<usize>>) -> SceneError {
        let span = span.unwrap_or(0..0);
        let place = self.place(&span);
        if let Some(rest) = message.strip_prefix("unknown field ") {
            let mut words = rest.split('`').skip(1).step_by(2);
            let key = words.next().unwrap_or_default().to_owned();
            let here: Vec<&str> = words.collect();
            let is_heading = self.document.text().get(..span.start).is_some_and(|before| {
                let line = before.rsplit('\n').next().unwrap_or_default();
                line.trim_start().starts_with('[') && !line.contains('=')
            });
            let advice = keys::advice((self.tables, self.neighbour), (&key, is_heading), &here);
            return SceneError::UnknownKey { place, key, advice };
        }
        let typed = message.strip_prefix("invalid type: ").or(message.strip_prefix("invalid value: "));
        if let Some((found, expected)) = typed.and_then(|rest| rest.rsplit_once(", expected ")) {
            let expected = match expected {
                "f64" => "a number".into(),
                "i64" => "a whole number".into(),
                "a boolean" => "true or false".into(),
                NAMED => NAMED.into(),
                e if e.contains("string") => "a text in quotes".into(),
                e if e.starts_with("struct") || e.contains("map") => "a table".into(),
                e if e.contains("sequence") => "a list".into(),
                e => e.to_owned(),
            };
            let key = self.key_before(span.start);
            let found = hints::found(found);
            let advice = hints::of_type(&key, &expected, &found);
            return SceneError::WrongType { place, key, expected: expected.into(), found, advice };
        }
        // Only the first line: the reader's own excerpts are for its own layout.
        let mut message = message.lines().next().unwrap_or("not readable").to_owned();
        let text = self.document.text();
        let advice = hints::of_syntax(text, &span, &message);
        if let Some(own) = wrong_line::message(text, &span, &message) {
            message = own;
        }
        if hints::is_nesting(&message) {
            message = "tables, lists or the parts of a key are nested too deep".into();
        }
        SceneError::Syntax { place, message, advice }
    }

    /// The key whose value begins at `at`; for a list or a table the one it belongs to.
    fn key_before(&self, at: usize) -> String {
        let of_setting = self.setting(&(at..at)).map(|(setting, line)| (setting.line(), at - line.start));
        let (text, at) = of_setting.as_ref().map_or((self.document.text(), at), |(line, at)| (line.as_str(), *at));
        let before = text.get(..at).unwrap_or(text);
        let line = before.rsplit('\n').next().unwrap_or_default();
        let Some((left, _)) = line.rsplit_once('=') else {
            // The value is a table of its own: `[pinion]` where a number was wanted.
            let whole = text.get(at..).unwrap_or_default().lines().next().unwrap_or_default();
            let name = format!("{line}{whole}");
            let name = name.split('=').next().unwrap_or_default();
            return name.trim().trim_matches(['[', ']']).to_owned();
        };
        let is_key = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.');
        left.trim_end().rsplit(|c| !is_key(c)).next().unwrap_or_default().to_owned()
    }
}
