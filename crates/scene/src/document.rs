//! A document as it was read: its tables with their places, and the files that it names. It is read once, whatever
//! happens to the file later: a pipe cannot be read twice, and all cases of a plan belong to one document.

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

/// The parsed text of a file: a pair's scene, a gearbox file, a plan, a study or an optimisation. Clones share the same
/// document; a scene made from it by settings holds no text.
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
    /// [`SceneError::Read`] if it cannot be read.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::read_beside(file, Arc::default())
    }

    /// Reads a file that another document names: files that both name are read once.
    pub(crate) fn read_beside(file: &Path, files: Arc<DataFiles>) -> Result<Self, SceneError> {
        let text = read_text(file).map_err(|source| SceneError::Read { file: file.to_owned(), source })?;
        Ok(Self::made(text, file, Origin::Disk, files))
    }

    /// A document from a text. `file` is used in messages, and paths are relative to its folder. Errors in the text are
    /// reported when its content is requested.
    pub fn new(text: String, file: &Path) -> Self {
        Self::made(text, file, Origin::Disk, Arc::default())
    }

    /// The document with another text, as in an editor. Of the files named by both texts, those that have been modified
    /// are read again.
    pub fn edited(&self, text: String) -> Self {
        Self::made(text, self.file(), self.origin(), Arc::new(self.files().unchanged()))
    }

    pub(crate) fn made(text: String, file: &Path, origin: Origin, files: Arc<DataFiles>) -> Self {
        let root = Node::of_text(&text);
        Self(Arc::new(Read { file: file.to_owned(), text, root, origin, files, places: OnceLock::new() }))
    }

    /// Path of the document.
    pub fn file(&self) -> &Path {
        &self.0.file
    }

    /// The name of its file without the ending: what it is called where it has no `name`. A text without a file is
    /// untitled.
    pub(crate) fn stem(&self) -> String {
        self.file().file_stem().map_or_else(|| "untitled".into(), |stem| stem.to_string_lossy().into_owned())
    }

    /// Kind of the document, determined by its tables; `None` if it has no table of a known kind, or is not TOML.
    pub fn kind(&self) -> Option<DocumentKind> {
        self.0.root.as_ref().ok().and_then(DocumentKind::of)
    }

    /// Kind of the machine that it describes, whatever is varied or optimised; `None` if it describes none.
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

    /// Whether it is empty.
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
