//! Determines the kind of a file, for messages when a command needs another kind.

use std::fmt;

use crate::tree::Node;

/// A kind of TOML file that the program reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DocumentKind {
    /// A scene: a pair of gears.
    Scene,
    /// A gearbox: shafts, bearings and meshes.
    Gearbox,
    /// A plan: varied keys of a scene.
    Plan,
    /// A study: several scenes for comparison.
    Study,
    /// An optimisation: keys of a scene whose best values are searched.
    Optimisation,
}

/// Each kind with names that stand at the top of no other.
const NAMES: [(DocumentKind, &[&str]); 3] = [
    (DocumentKind::Scene, &["pinion", "wheel", "pair", "material", "operation", "contact", "drive", "load"]),
    (DocumentKind::Gearbox, &["shaft", "bearing", "gear", "torque", "input", "housing", "vibration"]),
    (DocumentKind::Study, &["case", "quantity", "over_time", "follow", "full"]),
];

/// Tables of what is asked of a pair or a gearbox beside a run; one that is run by itself does without them.
pub(crate) const TASKS: [(DocumentKind, &str); 2] =
    [(DocumentKind::Plan, "vary"), (DocumentKind::Optimisation, "optimise")];

impl fmt::Display for DocumentKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scene => "a scene",
            Self::Gearbox => "a gearbox file",
            Self::Plan => "a plan",
            Self::Study => "a study",
            Self::Optimisation => "an optimisation",
        })
    }
}

impl DocumentKind {
    /// The subcommand for such a file.
    pub fn command(self) -> &'static str {
        match self {
            Self::Optimisation => "optimise",
            _ => "run",
        }
    }

    /// What is asked of a document: a plan or an optimisation where it has such a table, else what it describes.
    pub(crate) fn of(root: &Node) -> Option<Self> {
        let asked = TASKS.iter().find(|(_, name)| root.entries().any(|(key, _)| key == name));
        asked.map(|(kind, _)| *kind).or_else(|| Self::of_machine(root))
    }

    /// What a document describes: the kind with most names of its own at its top; `None` where there is none.
    pub(crate) fn of_machine(root: &Node) -> Option<Self> {
        let count = |names: &[&str]| root.entries().filter(|(key, _)| names.contains(&key.as_str())).count();
        let counts = NAMES.iter().map(|(kind, names)| (count(names), *kind));
        counts.filter(|(n, _)| *n > 0).reduce(|best, own| if own.0 > best.0 { own } else { best }).map(|(_, kind)| kind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_told_by_their_tables() {
        let of = |text: &str| Node::of_text(text).ok().and_then(|root| DocumentKind::of(&root));
        assert_eq!(of("[pinion]\n[wheel]\n[pair]\n[mesh]\n[analysis]\n"), Some(DocumentKind::Scene));
        assert_eq!(of("name = \"x\"\n[[shaft]]\n[[mesh]]\n[input]\n[motion]\n"), Some(DocumentKind::Gearbox));
        assert_eq!(of("scene = \"x\"\n[vary]\n"), Some(DocumentKind::Plan));
        assert_eq!(of("[pinion]\n[wheel]\n[optimise]\n"), Some(DocumentKind::Optimisation));
        assert_eq!(of("name = \"x\"\n"), None);
        assert_eq!(of("[pinion"), None);
    }
}
