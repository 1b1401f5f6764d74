//! `ale-gear init`: a commented scene to begin with.

use std::{
    io::IsTerminal,
    path::{Path, PathBuf},
};

use clap::ValueEnum;
use dialoguer::{Confirm, Input, Select};
use files::{write_file, write_new_file};

use scene::{
    RexsGearbox, RexsPair, SceneError, Starter,
    gearbox::{Gearbox, GearboxOfPair, StageHeld, StageStarter, gearbox_of_pair},
    read_gearbox, read_pair, read_rexs,
};

use crate::{
    error::CommandError,
    scene::{Kind, Scene},
    talk::{complain, note},
};

/// Words of `ale-gear init`.
///
/// Without any of them, and with somebody at a terminal, it asks.
#[derive(Debug, Default, clap::Args)]
pub(super) struct InitArgs {
    /// File to write [default: scene.toml, for a gearbox gearbox.toml]; `-` is stdout
    file: Option<PathBuf>,
    #[command(flatten)]
    pair: PairArgs,
    /// Import a REXS file (XML): as a gearbox with the scenes of its pairs if stages are on shafts, else its first
    /// pair; options of the pair override it
    #[arg(long, value_name = "FILE")]
    rexs: Option<PathBuf>,
    /// Convert the pair of this scene to a gearbox file with its friction, bodies, bearings and motion as far as a
    /// gearbox file can state them; shafts without bearings are held
    #[arg(long, value_name = "SCENE", conflicts_with_all = ["rexs", "PairArgs"])]
    of_pair: Option<PathBuf>,
    /// Import only this cylindrical stage of the REXS file, as a pair
    #[arg(long, value_name = "N", requires = "rexs")]
    stage: Option<usize>,
    /// Load case of the REXS file's load spectrum [default: 1]
    #[arg(long, value_name = "N", requires = "rexs")]
    load_case: Option<usize>,
    /// Overwrite existing files
    #[arg(long)]
    force: bool,
}

/// What the scene says; what is not given stands as in the default pair.
#[derive(Debug, Default, Clone, PartialEq, clap::Args)]
#[command(next_help_heading = "The pair")]
struct PairArgs {
    /// Title of the case [default: from the teeth]
    #[arg(long)]
    name: Option<String>,
    /// Numbers of teeth of pinion and wheel, negative for an internal wheel; three numbers (sun, planet, ring) for a
    /// planetary stage, whose other options describe sun and planet [default: 30,30]
    #[arg(long, value_name = "Z1,Z2", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    teeth: Vec<i32>,
    /// Normal module [default: 3]
    #[arg(long, value_name = "MM")]
    module_mm: Option<f64>,
    /// The pinion's helix angle, right hand positive [default: 20]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    helix_deg: Option<f64>,
    /// Face width of both gears [default: 20; for a stage 20/3 modules]
    #[arg(long, value_name = "MM")]
    face_width_mm: Option<f64>,
    /// Torque on the driven gear [default: 150; for a stage 1000 on its driven member at module 3, scaled with the cube
    /// of the module]
    #[arg(long, value_name = "NM")]
    torque_nm: Option<f64>,
    /// Speed of the driver [default: 1000]
    #[arg(long, value_name = "RPM")]
    speed_rpm: Option<f64>,
    /// Profile shift coefficients of pinion and wheel [default: 0,0]
    #[arg(long, value_name = "X1,X2", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    profile_shift: Vec<f64>,
    /// Working centre distance [default: from the profile shifts]
    #[arg(long, value_name = "MM")]
    centre_distance_mm: Option<f64>,
    /// Equilibrium at every position, or motion in time [default: static]
    #[arg(long)]
    kind: Option<KindWord>,
    /// Number of planets of a planetary stage [default: 3]
    #[arg(long, value_name = "N")]
    planets: Option<usize>,
    /// Fixed member of a planetary stage; the torque acts on the remaining one [default: ring]
    #[arg(long)]
    held: Option<HeldWord>,
}

/// What of a stage stands, as a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum HeldWord {
    Ring,
    Carrier,
}

/// What is computed, as a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum KindWord {
    Static,
    Dynamic,
}

impl InitArgs {
    /// Writes the scene, or the gearbox; the text says what to do next.
    pub(super) fn execute(self, quiet: bool) -> Result<String, CommandError> {
        if let Some(scene) = &self.of_pair {
            return self.write_gearbox_of(scene, quiet);
        }
        if let [_, _, ring_teeth] = self.pair.teeth[..] {
            return self.write_stage(ring_teeth, quiet);
        }
        if self.pair.planets.is_some() || self.pair.held.is_some() {
            let hint = "give the teeth of sun, planet and ring, such as `--teeth 21,30,-81`".to_owned();
            return Err(CommandError::input("`--planets` and `--held` are words on a planetary stage", Some(hint)));
        }
        let nothing_said = self.pair == PairArgs::default() && self.rexs.is_none();
        let read = match &self.rexs {
            Some(file) => Some(self.of_rexs(file)?),
            None => None,
        };
        let pair = match read {
            Some(OfRexs::Gearbox(gearbox)) => return self.write_gearbox(*gearbox, quiet),
            Some(OfRexs::Pair(pair)) => Some(*pair),
            None => None,
        };
        let file = self.file.clone().unwrap_or_else(|| "scene.toml".into());
        let to_stdout = file.as_os_str() == "-";
        let asked = nothing_said && !to_stdout && std::io::stdin().is_terminal() && std::io::stderr().is_terminal();
        if !to_stdout && !asked && !self.force {
            absent(&file)?;
        }
        let shown = if to_stdout { "scene.toml".into() } else { file.display().to_string() };
        let text = if asked { asked_until_it_can_be(&shown)? } else { self.checked_pair(pair.as_ref(), &shown)? };
        if let Some(pair) = &pair {
            self.say_remarks(&pair.remarks);
        }
        if to_stdout {
            return Ok(text);
        }
        if asked && !self.force && file.exists() && !replace(&file)? {
            return Ok(format!("{shown}: left as it was\n"));
        }
        write_new(&file, &text, self.force || asked)?;
        Ok(if quiet { String::new() } else { format!("{shown}: written; next\n  ale-gear run {shown} --out out\n") })
    }
}

/// What a REXS file becomes.
enum OfRexs {
    Pair(Box<RexsPair>),
    Gearbox(Box<RexsGearbox>),
}

impl InitArgs {
    /// The gearbox of the REXS file, or the pair of a stage.
    fn of_rexs(&self, file: &Path) -> Result<OfRexs, CommandError> {
        let wrong = |e: scene::RexsError| CommandError::input(format_args!("{}: {e}", file.display()), e.hint());
        let text = read_rexs(file).map_err(wrong)?;
        let case = self.load_case.unwrap_or(1);
        if self.stage.is_none() {
            let stem = self.gearbox_file().file_stem().map(|s| s.to_string_lossy().into_owned());
            let whole = read_gearbox(&text, &stem.unwrap_or_default(), case).map_err(wrong)?;
            if let Some(gearbox) = whole {
                return Ok(OfRexs::Gearbox(Box::new(gearbox)));
            }
        }
        let pair = read_pair(&text, self.stage.unwrap_or(1), case, &Starter::default()).map_err(wrong)?;
        Ok(OfRexs::Pair(Box::new(pair)))
    }

    /// Writes the gearbox file of a pair.
    fn write_gearbox_of(&self, scene: &Path, quiet: bool) -> Result<String, CommandError> {
        let GearboxOfPair { text, left } = gearbox_of_pair(&Scene::read(scene)?)?;
        for own in left {
            note(format!("{}: left out: {own}", scene.display()));
        }
        let file = self.gearbox_file();
        if file.as_os_str() == "-" {
            return Ok(text);
        }
        Gearbox::parse(&text, &file)?;
        if !self.force {
            absent(&file)?;
        }
        write_new(&file, &text, self.force)?;
        let shown = file.display();
        Ok(if quiet { String::new() } else { format!("{shown}: written; next\n  ale-gear run {shown} --out out\n") })
    }

    /// Writes the gearbox file of a planetary stage.
    fn write_stage(&self, ring_teeth: i32, quiet: bool) -> Result<String, CommandError> {
        let refused = |what: &str, hint: &str| Err(CommandError::input(what, Some(hint.to_owned())));
        if self.rexs.is_some() || self.pair.kind.is_some() {
            return refused(
                "a planetary stage is neither of a REXS file nor of a kind",
                "leave `--rexs` and `--kind` out: `[motion]` of the file that is written asks for a motion",
            );
        }
        if ring_teeth >= 0 {
            return refused("the ring's number of teeth is not negative", "a ring has its teeth inside: write -81");
        }
        let mut words = self.pair.clone();
        words.teeth.truncate(2);
        let pair = Starter::default();
        let size = words.module_mm.map_or(1.0, |module| module / pair.module_mm);
        let (face_width_mm, torque_nm) = (pair.face_width_mm * size, 1000.0 * size.powi(3));
        let starter = words.over(Starter { face_width_mm, torque_nm, helix_deg: 0.0, ..pair })?;
        let held = match self.pair.held {
            Some(HeldWord::Carrier) => StageHeld::Carrier,
            Some(HeldWord::Ring) | None => StageHeld::Ring,
        };
        let stage = StageStarter { pair: starter, ring_teeth, planets: self.pair.planets.unwrap_or(3), held };
        let without_file = |e: SceneError| {
            let own = CommandError::from(e);
            CommandError { message: without_place(&own.message), excerpt: None, ..own }
        };
        let most = stage.most_planets().map_err(without_file)?;
        if !(2..=most).contains(&stage.planets) {
            let what = format_args!("{} planets do not fit around this sun", stage.planets);
            let hint = if most < 2 { "take smaller planets".to_owned() } else { format!("2 to {most} have room") };
            return Err(CommandError::input(what, Some(hint)));
        }
        let file = self.gearbox_file();
        let to_stdout = file.as_os_str() == "-";
        let shown = if to_stdout { "gearbox.toml".into() } else { file.display().to_string() };
        if !to_stdout && !self.force {
            absent(&file)?;
        }
        let even = -(stage.pair.teeth[0] + 2 * stage.pair.teeth[1]);
        let text = stage.text(&shown).map_err(|e| match without_file(e) {
            own if ring_teeth == even => own,
            own => CommandError {
                message: format!("no ring of {} teeth: {}", -ring_teeth, own.message),
                hint: Some(format!("a ring of {even} teeth, as the sun and two planets, needs no profile shift")),
                ..own
            },
        })?;
        if to_stdout {
            return Ok(text);
        }
        write_new(&file, &text, self.force)?;
        Ok(if quiet { String::new() } else { format!("{shown}: written; next\n  ale-gear run {shown} --out out\n") })
    }

    fn gearbox_file(&self) -> PathBuf {
        self.file.clone().unwrap_or_else(|| "gearbox.toml".into())
    }

    /// The pair of the file with the words over it, or the default one; what is wrong with a value of the file is told of
    /// that.
    fn checked_pair(&self, of_file: Option<&RexsPair>, shown: &str) -> Result<String, CommandError> {
        let starter = self.pair.over(of_file.map_or_else(Starter::default, |pair| pair.starter.clone()))?;
        let (Some(pair), Some(file)) = (of_file, &self.rexs) else { return checked(&starter, shown) };
        let text = starter.with_tips_that_pass().text(shown);
        match Scene::parse(&text, Path::new(shown)).and_then(|scene| scene.gear_pair()) {
            Ok(_) => Ok(text),
            Err(error) => Err(match pair.blamed(&text, &error).filter(|_| self.pair == PairArgs::default()) {
                Some(own) => CommandError::input(format_args!("{}: {own}", file.display()), own.hint()),
                None => error.into(),
            }),
        }
    }

    fn say_remarks(&self, remarks: &[String]) {
        let Some(file) = &self.rexs else { return };
        for remark in remarks {
            note(format!("{}: {remark}", file.display()));
        }
    }

    /// Writes the gearbox file and the scenes beside it: all of them, or none.
    fn write_gearbox(&self, gearbox: RexsGearbox, quiet: bool) -> Result<String, CommandError> {
        let Some(rexs) = &self.rexs else { return Ok(String::new()) };
        if self.pair != PairArgs::default() {
            let hint = "leave them out, or take one of its pairs with `--stage N`".to_owned();
            return Err(CommandError::input(
                format_args!("{}: is a whole gearbox, and the flags are words on a pair", rexs.display()),
                Some(hint),
            ));
        }
        let file = self.gearbox_file();
        if file.as_os_str() == "-" {
            let hint = "give the name of the gearbox file, or take one pair with `--stage N`".to_owned();
            let what = format_args!("{}: is a whole gearbox, which is several files", rexs.display());
            return Err(CommandError::input(what, Some(hint)));
        }
        let folder = file.parent().unwrap_or(Path::new(""));
        let scenes = gearbox.scenes.iter().map(|(name, text, _)| (folder.join(name), text.as_str()));
        let all: Vec<(PathBuf, &str)> = scenes.chain([(file.clone(), gearbox.text.as_str())]).collect();
        if !self.force {
            all.iter().try_for_each(|(path, _)| absent(path))?;
        }
        gearbox.check(&file).map_err(|e| match gearbox.blamed(&e) {
            Some(own) => CommandError::input(format_args!("{}: {own}", rexs.display()), own.hint()),
            None => e.into(),
        })?;
        self.say_remarks(&gearbox.remarks);
        write_together(&all, self.force)?;
        let shown = file.display();
        let scenes: String = all.iter().rev().skip(1).rev().map(|(p, _)| format!("{}, ", p.display())).collect();
        Ok(if quiet {
            String::new()
        } else {
            format!("{scenes}{shown}: written; next\n  ale-gear run {shown} --out out\n")
        })
    }
}

/// Writes several files; where one of them cannot be, all are as they were.
fn write_together(all: &[(PathBuf, &str)], replace: bool) -> Result<(), CommandError> {
    let mut done: Vec<(&Path, Option<String>)> = Vec::new();
    for (path, text) in all {
        let before = std::fs::read_to_string(path).ok();
        if let Err(e) = write_new(path, text, replace) {
            for (path, before) in done {
                // What cannot be put back is told by the first failure.
                let _ = match before {
                    Some(text) => write_new(path, &text, true),
                    None => std::fs::remove_file(path).map_err(|e| CommandError::write(path, &e)),
                };
            }
            return Err(e);
        }
        done.push((path, before));
    }
    Ok(())
}

fn there(file: &Path) -> CommandError {
    CommandError::input(
        format_args!("{}: is there already", file.display()),
        Some("give another name, or `--force` to replace it".into()),
    )
}

fn is_folder(file: &Path) -> CommandError {
    let hint = "give the name of a file in it, such as `scene.toml`".into();
    CommandError::input(format_args!("{}: is a folder", file.display()), Some(hint))
}

fn absent(file: &Path) -> Result<(), CommandError> {
    match file.exists() {
        true if file.is_dir() => Err(is_folder(file)),
        true => Err(there(file)),
        false => Ok(()),
    }
}

fn write_new(file: &Path, text: &str, replace: bool) -> Result<(), CommandError> {
    let written = if replace { write_file(file, text.as_bytes()) } else { write_new_file(file, text.as_bytes()) };
    written.map_err(|e| match e.kind() {
        std::io::ErrorKind::AlreadyExists => there(file),
        _ if file.is_dir() => is_folder(file),
        std::io::ErrorKind::NotFound => CommandError::input(
            format_args!("{}: cannot be written: {e}", file.display()),
            Some("is the folder there?".into()),
        ),
        _ => CommandError::write(file, &e),
    })
}

impl PairArgs {
    /// What is said here, and the rest as it was.
    fn over(&self, d: Starter) -> Result<Starter, CommandError> {
        Ok(Starter {
            name: self.name.clone().unwrap_or(d.name),
            teeth: two("--teeth", &self.teeth, d.teeth)?,
            module_mm: self.module_mm.unwrap_or(d.module_mm),
            helix_deg: self.helix_deg.unwrap_or(d.helix_deg),
            face_width_mm: self.face_width_mm.unwrap_or(d.face_width_mm),
            own_face_width_mm: if self.face_width_mm.is_some() { [None, None] } else { d.own_face_width_mm },
            mid_face_offset_mm: d.mid_face_offset_mm,
            torque_nm: self.torque_nm.unwrap_or(d.torque_nm),
            speed_rpm: self.speed_rpm.unwrap_or(d.speed_rpm),
            profile_shift: two("--profile-shift", &self.profile_shift, d.profile_shift)?,
            centre_distance_mm: self.centre_distance_mm.or(d.centre_distance_mm),
            pressure_angle_deg: d.pressure_angle_deg,
            tip_diameter_mm: d.tip_diameter_mm,
            bore_diameter_mm: d.bore_diameter_mm,
            thickness_allowance_mm: d.thickness_allowance_mm,
            steel: d.steel,
            dedendum_coefficient: d.dedendum_coefficient,
            root_radius_coefficient: d.root_radius_coefficient,
            driver: d.driver,
            rotation: d.rotation,
            kind: match self.kind {
                None => d.kind,
                Some(KindWord::Static) => Kind::Static,
                Some(KindWord::Dynamic) => Kind::Dynamic,
            },
        })
    }
}

/// One value a gear, one for both, or none.
fn two<T: Copy>(flag: &str, given: &[T], default: [T; 2]) -> Result<[T; 2], CommandError> {
    match *given {
        [] => Ok(default),
        [both] => Ok([both, both]),
        [pinion, wheel] => Ok([pinion, wheel]),
        _ => Err(CommandError::input(
            format_args!("`{flag}` has {} values", given.len()),
            Some("give one for the pinion and one for the wheel, with a comma between them".into()),
        )),
    }
}

/// The scene as text; what would not run is not written.
fn checked(starter: &Starter, shown: &str) -> Result<String, CommandError> {
    let text = starter.with_tips_that_pass().text(shown);
    Scene::parse(&text, Path::new(shown))?.gear_pair()?;
    Ok(text)
}

/// Asks again, with the last answers in brackets, while no pair comes of the answers.
fn asked_until_it_can_be(shown: &str) -> Result<String, CommandError> {
    let mut starter = Starter::default();
    loop {
        starter = ask(&starter, shown).map_err(|e| no_answer(&e))?;
        match checked(&starter, shown) {
            Ok(text) => return Ok(text),
            Err(complaint) => {
                let message = without_place(&complaint.message);
                let complaint = CommandError { message, excerpt: None, ..complaint };
                complain(&complaint, "The questions again; an empty answer keeps what is in brackets.");
            }
        }
    }
}

/// The questions; an empty answer takes what is shown in brackets. Every answer is held against the range of its key at
/// once.
fn ask(d: &Starter, shown: &str) -> dialoguer::Result<Starter> {
    let kinds = [("equilibrium at every position (static)", Kind::Static), ("motion in time (dynamic)", Kind::Dynamic)];
    // What is complained of is the answer: all before it have been through this.
    let fits = |starter: &Starter| -> Result<(), String> {
        Scene::parse(&starter.text(shown), Path::new(shown)).map(|_| ()).map_err(|e| {
            let said = without_place(&e.to_string());
            e.hint().map_or(said.clone(), |hint| format!("{said} ({hint})"))
        })
    };
    let mut s = d.clone();
    answer("Teeth of the pinion", &mut s, |s| &mut s.teeth[0], fits)?;
    answer("Teeth of the wheel, negative if internal", &mut s, |s| &mut s.teeth[1], fits)?;
    answer("Normal module, mm", &mut s, |s| &mut s.module_mm, fits)?;
    answer("Helix angle of the pinion, degrees, right hand positive", &mut s, |s| &mut s.helix_deg, fits)?;
    answer("Face width, mm", &mut s, |s| &mut s.face_width_mm, fits)?;
    answer("Profile shift coefficient of the pinion", &mut s, |s| &mut s.profile_shift[0], fits)?;
    answer("Profile shift coefficient of the wheel", &mut s, |s| &mut s.profile_shift[1], fits)?;
    centre_distance(&mut s, shown, fits)?;
    answer("Torque on the driven gear, N m", &mut s, |s| &mut s.torque_nm, fits)?;
    answer("Speed of the driver, 1/min", &mut s, |s| &mut s.speed_rpm, fits)?;
    let before = kinds.iter().position(|k| k.1 == s.kind).unwrap_or(0);
    s.kind = kinds[Select::new().with_prompt("What").items(kinds.map(|k| k.0)).default(before).interact()?].1;
    Ok(s)
}

/// Asks for the centre distance; what follows from the profile shifts stands in brackets, and is not written down.
fn centre_distance(
    s: &mut Starter,
    shown: &str,
    fits: impl Fn(&Starter) -> Result<(), String>,
) -> dialoguer::Result<()> {
    let free = Starter { centre_distance_mm: None, ..s.clone() };
    let pair = Scene::parse(&free.text(shown), Path::new(shown)).ok().and_then(|scene| scene.gear_pair().ok());
    // Without a pair there is none to follow; the answers as a whole are complained of at the end.
    let Some(follows) = pair.map(|pair| (1e4 * pair.centre_distance()).round() / 1e4) else { return Ok(()) };
    let mut asked = Starter { centre_distance_mm: Some(s.centre_distance_mm.unwrap_or(follows)), ..s.clone() };
    answer("Centre distance, mm", &mut asked, |s| s.centre_distance_mm.get_or_insert(follows), fits)?;
    s.centre_distance_mm = asked.centre_distance_mm.filter(|own| *own != follows);
    Ok(())
}

/// What is complained of, without a line of a file that is not there yet.
fn without_place(message: &str) -> String {
    message.split_once(": ").map_or(message, |(_, what)| what).to_owned()
}

/// Asks until the answer is a number with which `fits` has no complaint, and puts it into its place.
fn answer<T>(
    question: &str,
    starter: &mut Starter,
    place: impl Fn(&mut Starter) -> &mut T,
    fits: impl Fn(&Starter) -> Result<(), String>,
) -> dialoguer::Result<()>
where
    T: Copy + std::fmt::Display + std::str::FromStr,
{
    let before = *place(starter);
    let tried = |word: &str| -> Result<Starter, String> {
        let whole = std::any::type_name::<T>() == std::any::type_name::<i32>();
        let number = word.trim().parse::<T>().map_err(|_| match word.contains(',') {
            true => format!("`{word}` is not a number: write it with a decimal point"),
            false => format!("`{word}` is no {}number", if whole { "whole " } else { "" }),
        })?;
        let mut with = starter.clone();
        *place(&mut with) = number;
        fits(&with).map(|()| with)
    };
    let word: String = Input::new()
        .with_prompt(question)
        .default(before.to_string())
        .validate_with(|word: &String| tried(word).map(|_| ()))
        .interact_text()?;
    // What was validated fits.
    if let Ok(with) = tried(&word) {
        *starter = with;
    }
    Ok(())
}

fn replace(file: &Path) -> Result<bool, CommandError> {
    let question = format!("{} is there already. Replace it?", file.display());
    Confirm::new().with_prompt(question).default(false).interact().map_err(|e| no_answer(&e))
}

fn no_answer(error: &dialoguer::Error) -> CommandError {
    CommandError::input(
        format_args!("the questions were not answered: {error}"),
        Some("say it with flags: `ale-gear init --help` lists them".into()),
    )
}
