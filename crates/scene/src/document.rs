//! A document as it was read: its tables and where they stand, and the files that it names. Read once, whatever becomes
//! of the file: a pipe can be read no second time, and all cases of a plan are of one document.

use std::{
    ops::Range,
    path::Path,
    path::PathBuf,
    sync::{Arc, OnceLock},
};

use crate::{
    DocumentKind, Line, Place, SceneError,
    data_file::DataFiles,
    document_kind::TASKS,
    excerpt::excerpt,
    input_text::read_text,
    origin::Origin,
    places::Places,
    setting::Setting,
    tree::{Fault, Node},
};

/// The text of a file in tables: a pair's scene, a gearbox file, a plan, a study, an optimisation. Clones are the same
/// one; what a scene is made of it by settings holds no text.
#[derive(Debug, Clone)]
pub struct Document(Arc<Read>);

#[derive(Debug)]
struct Read {
    file: PathBuf,
    text: String,
    root: Result<Node, Fault>,
    origin: Origin,
    files: Arc<DataFiles>,
    places: OnceLock<Places>,
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    /// [`SceneError::Read`].
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::read_beside(file, Arc::default())
    }

    /// Reads a file that another document names: files that both name are read once.
    pub(crate) fn read_beside(file: &Path, files: Arc<DataFiles>) -> Result<Self, SceneError> {
        let text = read_text(file).map_err(|source| SceneError::Read { file: file.to_owned(), source })?;
        Ok(Self::made(text, file, Origin::Disk, files))
    }

    /// A text; `file` is what messages name and what paths are relative to. What is wrong with it is told when it is
    /// asked what it says.
    pub fn new(text: String, file: &Path) -> Self {
        Self::made(text, file, Origin::Disk, Arc::default())
    }

    /// The document with another text, as an editor has it. Of the files that both name those are read again that somebody
    /// has written to.
    pub fn edited(&self, text: String) -> Self {
        Self::made(text, self.file(), self.origin(), Arc::new(self.files().unchanged()))
    }

    pub(crate) fn made(text: String, file: &Path, origin: Origin, files: Arc<DataFiles>) -> Self {
        let root = Node::of_text(&text);
        Self(Arc::new(Read { file: file.to_owned(), text, root, origin, files, places: OnceLock::new() }))
    }

    /// Where it stands.
    pub fn file(&self) -> &Path {
        &self.0.file
    }

    /// The name of its file without the ending: what it is called where it has no `name`. A text without a file is
    /// untitled.
    pub(crate) fn stem(&self) -> String {
        self.file().file_stem().map_or_else(|| "untitled".into(), |stem| stem.to_string_lossy().into_owned())
    }

    /// Kind of the document by its tables; `None` where it has none of a known kind, or is no TOML.
    pub fn kind(&self) -> Option<DocumentKind> {
        self.0.root.as_ref().ok().and_then(DocumentKind::of)
    }

    /// Kind of what it describes, whatever is varied or optimised of it; `None` where it describes nothing.
    pub fn base_kind(&self) -> Option<DocumentKind> {
        self.0.root.as_ref().ok().and_then(DocumentKind::of_machine)
    }

    /// This document with these names at its top alone.
    pub(crate) fn only(&self, names: &[&str]) -> Self {
        let Read { file, text, root, origin, files, .. } = &*self.0;
        let (file, text, files) = (file.clone(), text.clone(), Arc::clone(files));
        let root = root.clone().map(|root| root.only(|name| names.contains(&name)));
        Self(Arc::new(Read { file, text, root, origin: *origin, files, places: OnceLock::new() }))
    }

    /// The document whose tables stand at a place of this one; paths in it are relative to the same folder.
    pub(crate) fn part(&self, span: &Range<usize>) -> Option<Self> {
        let Read { file, text, root, origin, files, .. } = &*self.0;
        let (root, file, text) = (root.as_ref().ok()?.part(span)?.clone(), file.clone(), text.clone());
        let files = Arc::clone(files);
        Some(Self(Arc::new(Read { file, text, root: Ok(root), origin: *origin, files, places: OnceLock::new() })))
    }

    /// Checks that not both of a plan and an optimisation stand in it.
    ///
    /// # Errors
    /// [`SceneError::Conflict`].
    pub(crate) fn one_task(&self) -> Result<(), SceneError> {
        if !TASKS.iter().all(|(_, name)| self.has(name)) {
            return Ok(());
        }
        let what = "[vary] and [optimise] stand in one document".to_owned();
        let advice = "write one of them into a file of its own, with `scene` the path of this one".to_owned();
        Err(SceneError::Conflict { place: self.line(&(0..0)), what, advice })
    }

    /// Whether a name stands at its top.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.0.root.as_ref().is_ok_and(|root| root.entries().any(|(key, _)| key == name))
    }

    /// The number that it says at the parts of a key, with some of its keys set otherwise.
    pub(crate) fn number_at(&self, key: &[String], settings: &[Setting]) -> Option<f64> {
        let mut root = self.0.root.as_ref().ok()?.clone();
        settings.iter().for_each(|setting| root.put(setting.path(), setting.value().clone()));
        root.number_at(key)
    }

    /// BLAKE3 of its text, hexadecimal.
    pub fn blake3(&self) -> String {
        blake3::hash(self.0.text.as_bytes()).to_hex().to_string()
    }

    /// Whether nothing is in it.
    pub fn is_empty(&self) -> bool {
        self.0.text.is_empty()
    }

    pub(crate) fn root(&self) -> Result<&Node, &Fault> {
        self.0.root.as_ref()
    }

    /// Text of the document, for complaints about what stands in it.
    pub(crate) fn text(&self) -> &str {
        &self.0.text
    }

    pub(crate) fn origin(&self) -> Origin {
        self.0.origin
    }

    pub(crate) fn files(&self) -> &Arc<DataFiles> {
        &self.0.files
    }

    /// File and line of a byte range.
    pub(crate) fn line(&self, span: &Range<usize>) -> Place {
        let text = self.text();
        let end = span.start.min(text.len());
        let number = 1 + text.as_bytes()[..end].iter().filter(|&&b| b == b'\n').count();
        let excerpt = excerpt(text, span, number);
        Place::Line(Arc::new(Line { file: self.file().to_owned(), number, excerpt }))
    }

    /// Where each of its keys stands; made once for all cases.
    pub(crate) fn places(&self) -> &Places {
        self.0.places.get_or_init(|| {
            let root = self.root().ok();
            root.map_or_else(Places::default, |root| Places::of(root, &|span| self.line(span)))
        })
    }
}
