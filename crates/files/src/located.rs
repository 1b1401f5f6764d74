//! Where something was said or happened, beside an error that says what.

use std::{
    error::Error,
    fmt,
    path::{Path, PathBuf},
    sync::Arc,
};

/// Where something was said, or where it happened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// A line of a file; shared by all who name it.
    Line(Arc<Line>),
    /// Beside the file.
    Setting {
        /// As `--set operation.torque_nm`, or `operation.torque_nm = 150` of a value that a sweep gives.
        label: Box<str>,
    },
    /// A file as a whole.
    File(Box<Path>),
    /// A part of what was asked about: a gear, a mesh, a table of the file.
    Part(Box<str>),
}

/// A line of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// The file as the user named it.
    pub file: PathBuf,
    /// Counted from 1.
    pub number: usize,
    /// The line itself with a mark below what is meant: two lines of text.
    pub excerpt: String,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "{}:{}", line.file.display(), line.number),
            Self::Setting { label } => f.write_str(label),
            Self::File(file) => write!(f, "{}", file.display()),
            Self::Part(name) => f.write_str(name),
        }
    }
}

impl Place {
    /// A part by its name.
    pub fn part(name: impl Into<Box<str>>) -> Self {
        Self::Part(name.into())
    }

    /// The line with a mark below what is meant; none beside a file.
    pub fn excerpt(&self) -> Option<&str> {
        match self {
            Self::Line(line) => Some(&line.excerpt),
            Self::Setting { .. } | Self::File(_) | Self::Part(_) => None,
        }
    }

    /// The file that is named.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::Line(line) => Some(&line.file),
            Self::File(file) => Some(file),
            Self::Setting { .. } | Self::Part(_) => None,
        }
    }

    /// The line of that file, from 1.
    pub fn line(&self) -> Option<usize> {
        match self {
            Self::Line(line) => Some(line.number),
            Self::Setting { .. } | Self::File(_) | Self::Part(_) => None,
        }
    }
}

/// An error that says what happened, with where it did. Its text is `place: what`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Located<E> {
    /// Where.
    pub place: Place,
    /// What happened.
    pub source: E,
}

impl<E: fmt::Display> fmt::Display for Located<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.source)
    }
}

impl<E: Error> Error for Located<E> {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.source.source()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places say themselves in the order in which they were put around an error, the widest first.
    #[test]
    fn places_stand_before_what_happened() {
        let line = Line { file: "a.toml".into(), number: 3, excerpt: "torque_nm = 1\n^".into() };
        let places = [
            (Place::Line(Arc::new(line)), "a.toml:3", Some("a.toml"), Some(3)),
            (Place::File(Path::new("b.toml").into()), "b.toml", Some("b.toml"), None),
            (Place::part("pinion"), "pinion", None, None),
            (Place::Setting { label: "--set x".into() }, "--set x", None, None),
        ];
        for (place, said, file, number) in places {
            assert_eq!(place.file(), file.map(Path::new), "{said}");
            assert_eq!((place.line(), place.excerpt().is_some()), (number, number.is_some()), "{said}");
            let inner = Located { place, source: fmt::Error };
            let outer = Located { place: Place::part("wheel"), source: inner };
            assert_eq!(outer.to_string(), format!("wheel: {said}: {}", fmt::Error));
        }
    }
}
