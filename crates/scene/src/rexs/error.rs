//! Errors of REXS files.

/// No pair or shaft can be made from a REXS file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RexsError {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Read(#[from] std::io::Error),
    /// A packed file (`.rexsz`).
    #[error("is packed REXS (a zip archive, `.rexsz`)")]
    Packed,
    /// REXS as JSON (`.rexsj`).
    #[error("is JSON (`.rexsj`), wanted is REXS in XML (`.rexs`)")]
    Json,
    /// The file is not valid XML.
    #[error("is no XML: {0}")]
    Xml(#[from] roxmltree::Error),
    /// An element with so many attributes that the XML reader would take hours.
    #[error("has an element of more than {most} attributes in line {line}")]
    Crowded {
        /// Largest permitted number of attributes.
        most: usize,
        /// Line at which the element begins, from 1.
        line: usize,
    },
    /// The file is another kind of XML.
    #[error("is no REXS file: its root is <{root}>, not <model>")]
    Root {
        /// Name of the root element.
        root: String,
    },
    /// The file does not have this stage.
    #[error("has {found} cylindrical stages, stage {asked} is wanted")]
    Stage {
        /// Number of stages in the file.
        found: usize,
        /// Stage requested, counted from 1.
        asked: usize,
    },
    /// A stage without its two gears.
    #[error("stage {stage} has no {role}")]
    Gear {
        /// Stage, counted from 1.
        stage: usize,
        /// Missing gear, `gear_1` or `gear_2`.
        role: &'static str,
    },
    /// The file does not have this load case.
    #[error("has {found} load cases, load case {asked} is wanted")]
    Case {
        /// Number of load cases in the file.
        found: usize,
        /// Load case requested, counted from 1.
        asked: usize,
    },
    /// Two rings in one stage.
    #[error("{part} is a ring as its mating gear is")]
    Rings {
        /// Kind and number of the component.
        part: String,
    },
    /// A part whose data cannot be used as given.
    #[error("{part} {what}")]
    Unfit {
        /// Kind and number of the component; the whole file if no part is concerned.
        part: String,
        /// Data that cannot be used.
        what: String,
        /// What to do about it.
        hint: String,
    },
    /// A required value is missing.
    #[error("{part} has no `{attribute}`")]
    Missing {
        /// Kind and number of the component.
        part: String,
        /// Name of the attribute.
        attribute: &'static str,
    },
    /// A value that cannot be used.
    #[error("{part}: `{attribute}` is {value} {unit}, wanted is a number in {wanted}")]
    Value {
        /// Kind and number of the component.
        part: String,
        /// Name of the attribute.
        attribute: &'static str,
        /// The value as written.
        value: String,
        /// The unit as written.
        unit: String,
        /// Unit in the standard's data base.
        wanted: &'static str,
    },
    /// An invalid number of teeth.
    #[error("{part}: `number_of_teeth` is {value}, wanted is a whole number above 0")]
    Teeth {
        /// Kind and number of the component.
        part: String,
        /// The value as read.
        value: f64,
    },
    /// A position or direction that does not have three values.
    #[error("{part}: `{attribute}` is not three finite numbers in {wanted}")]
    Vector {
        /// Kind and number of the component.
        part: String,
        /// Name of the attribute.
        attribute: &'static str,
        /// Unit in the standard's data base.
        wanted: &'static str,
    },
    /// No shaft with this name, or several to choose from.
    #[error("has no shaft {asked}: there are {found}")]
    Shaft {
        /// Number or name requested, with quotes; `to choose` if none was given.
        asked: String,
        /// Numbers and names of the shafts in the file.
        found: String,
    },
    /// A shaft without sections, or whose sections leave gaps.
    #[error("shaft {shaft} {what}")]
    Sections {
        /// Number of its component.
        shaft: String,
        /// What is wrong with them.
        what: String,
    },
    /// Two gears that do not form an external pair.
    #[error("the gears differ in {what}: {pinion} and {wheel}")]
    Pair {
        /// Quantity that does not match.
        what: &'static str,
        /// Value of gear 1.
        pinion: f64,
        /// Value of gear 2.
        wheel: f64,
    },
}

impl RexsError {
    /// Hint for the user: what to do next.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Read(e) if e.kind() == std::io::ErrorKind::InvalidData => {
                "REXS files are XML in UTF-8: export it so, or convert it (`iconv -f UTF-16 -t UTF-8`)".into()
            }
            Self::Read(_) => "is the path right, as seen from here?".into(),
            Self::Packed => "unpack it first (`unzip FILE.rexsz`), and give the `.rexs` file that is in it".into(),
            Self::Json | Self::Xml(_) | Self::Crowded { .. } | Self::Root { .. } => {
                "export the model as REXS in XML (`.rexs`), not packed (`.rexsz`) and not as JSON".into()
            }
            Self::Stage { found: 0, .. } => "only stages of cylindrical gears can be run".into(),
            Self::Stage { found, .. } => format!("give `--stage` 1 to {found}"),
            Self::Case { found: 0, .. } => "leave `--load-case` out: the file has no load spectrum".into(),
            Self::Case { found, .. } => format!("give `--load-case` 1 to {found}"),
            Self::Rings { .. } => "a ring meshes with an external gear: give `--stage` of another stage".into(),
            Self::Unfit { hint, .. } => hint.clone(),
            Self::Gear { .. } | Self::Missing { .. } => "export the whole model, gears and flanks with it".into(),
            Self::Value { .. } | Self::Vector { .. } => "export with the units of the standard's data base".into(),
            Self::Teeth { .. } => "correct the file: half a tooth is no tooth".into(),
            Self::Shaft { .. } => "say which one: its number or its name".into(),
            Self::Sections { .. } => {
                "sections follow on each other from 0 on, hollow or solid, straight or conical".into()
            }
            Self::Pair { .. } => "only external pairs of one module, pressure angle and helix angle can be run".into(),
        })
    }
}
