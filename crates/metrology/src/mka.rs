//! Curve files (MKA) of Klingelnberg's P machines.
//!
//! No description is public; this is what files and open readers agree on. Latin-1 or UTF-8 text:
//!
//! ```text
//! HEADER KS.MK.FILE
//! UNDEFINED -2147483.648 ! a value that is none
//!  22  :Zähnezahl z.......:  26
//!  42  :Start Messbereich....da  [mm]..:  46.1
//! Profil:  Zahn-Nr.: 17 links / 480 Werte  z= 12.5
//!   .125 -.5 2.25 -2147483.648 ...
//! Flankenlinie:  Zahn-Nr.: 17 links / 480 Werte / d= 47.82
//!   ...
//!         linke Zahnflanke
//!         Zahn-Nr.  fp  Fp  Fr
//!   1   0.662   0.662   0.778
//! ```
//!
//! Numbered lines are the header: 21 m_n, 22 z, 23 beta (negative: left hand), 24 alpha, 25 x, 26 b, angles in degrees;
//! ranges are known by the words d1 d2 (evaluation of the profile, diameters), da de (its measurement), b1 b2, ba be (the
//! helix, heights). Values follow the heading of their curve until as many are read as it tells. A helix stands at a
//! diameter (d=) or a roll length (x=). Teeth with a letter (`1k`) and the curves of twist belong to their tooth. What is
//! not known is passed over; what is known and wrong is an error with its line.

use std::fmt::Write as _;
use std::path::Path;

use geometry::Side;

use crate::MetrologyError;
use crate::measured_gear::{GearHeader, MeasuredGear, Pitch, Trace, TraceKind};

/// What stands for a value that is none in every file, beside the number of its line `UNDEFINED`, and how near a number has to
/// come to be it, parts.
const UNDEFINED: f64 = -2_147_483.648;
const NEAR_UNDEFINED: f64 = 1e-6;
/// Values of a trace at the most, and teeth of a gear: more is a damaged file.
const MOST_VALUES: usize = 1 << 20;
const MOST_TEETH: u32 = 10_000;
/// Values a line that are written.
const A_LINE: usize = 8;

/// Reads the bytes of a file; `path` is what messages name.
///
/// # Errors
/// [`MetrologyError`] with file and line.
pub fn read_mka(bytes: &[u8], path: &Path) -> Result<MeasuredGear, MetrologyError> {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        // Every byte is a letter of Latin-1.
        Err(_) => bytes.iter().map(|b| char::from(*b)).collect(),
    };
    let (header, undefined) = (Header::default(), UNDEFINED);
    let mut reader = Reader { path, header, undefined, traces: Vec::new(), pitch: Vec::new() };
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line)).peekable();
    let mut block = None;
    while let Some((line, content)) = lines.next() {
        if content.contains("Zahn-Nr.:") {
            let heading = reader.heading(line, content, block)?;
            let wanted = heading.count;
            let mut values = Vec::new();
            while values.len() < wanted {
                let Some((number, content)) = lines.next_if(|(_, content)| is_values(content)) else { break };
                for word in content.split_whitespace() {
                    values.push(reader.value(number, word)?);
                }
            }
            let more =
                lines.peek().filter(|(_, content)| is_values(content)).map_or(0, |(_, c)| c.split_whitespace().count());
            if values.len() + more != wanted {
                return Err(MetrologyError::Count { path: path.to_owned(), line, found: values.len() + more, wanted });
            }
            reader.traces.push(Trace {
                kind: heading.kind,
                tooth: heading.tooth,
                side: heading.side,
                deviations_um: values,
            });
        } else if let Some(side) = pitch_table(content) {
            // Rows follow after the line with the names of the columns and blank ones.
            while lines.next_if(|(_, content)| content.trim().is_empty() || content.contains("Zahn-Nr.")).is_some() {}
            let mut index_um = Vec::new();
            while let Some((number, content)) = lines.next_if(|(_, content)| is_values(content)) {
                index_um.push(reader.pitch_row(number, content, index_um.len())?);
            }
            reader.pitch.push(Pitch { side, index_um });
        } else {
            if let Some(word) = content.strip_prefix("UNDEFINED").and_then(|rest| rest.split_whitespace().next()) {
                reader.undefined = number(path, line, word)?;
            }
            block = title(content).or(block);
            reader.header.take(path, line, content)?;
        }
    }
    reader.finish()
}

/// Whether a line is nothing but numbers.
fn is_values(content: &str) -> bool {
    let mut words = content.split_whitespace().peekable();
    words.peek().is_some()
        && words.all(|word| word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.')))
}

/// Which way curves run that follow.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Block {
    Profile,
    Helix,
}

fn title(content: &str) -> Option<Block> {
    let at = |name: &str| content.rfind(name);
    match (at("Profil:"), at("Flankenlinie:")) {
        (None, None) => None,
        (Some(_), None) => Some(Block::Profile),
        (None, Some(_)) => Some(Block::Helix),
        (Some(profile), Some(helix)) => Some(if profile > helix { Block::Profile } else { Block::Helix }),
    }
}

fn pitch_table(content: &str) -> Option<Side> {
    match content.trim() {
        "linke Zahnflanke" => Some(Side::Left),
        "rechte Zahnflanke" => Some(Side::Right),
        _ => None,
    }
}

fn side(word: &str) -> Option<Side> {
    match word {
        "links" => Some(Side::Left),
        "rechts" => Some(Side::Right),
        _ => None,
    }
}

struct Heading {
    kind: TraceKind,
    tooth: u32,
    side: Side,
    count: usize,
}

/// What was found of the header so far.
#[derive(Default)]
struct Header {
    numbers: [Option<f64>; 6],
    ranges: [Option<f64>; 8],
}

/// Codes of the first lines, and words of the ranges.
const CODES: [&str; 6] = ["21", "22", "23", "24", "25", "26"];
const RANGES: [&str; 8] = ["d1", "d2", "da", "de", "b1", "b2", "ba", "be"];

impl Header {
    /// Takes a numbered line; any other is passed over.
    fn take(&mut self, path: &Path, line: usize, content: &str) -> Result<(), MetrologyError> {
        let mut parts = content.split(':');
        let code = parts.next().unwrap_or_default().trim();
        if code.is_empty() || !code.bytes().all(|b| b.is_ascii_digit()) {
            return Ok(());
        }
        let label = parts.next().unwrap_or_default();
        let value = parts.next().unwrap_or_default();
        let range =
            RANGES.iter().position(|name| label.split(|c: char| !c.is_ascii_alphanumeric()).any(|word| word == *name));
        let known = CODES.iter().position(|own| *own == code);
        let slot = match (known, range) {
            (Some(i), _) => &mut self.numbers[i],
            (None, Some(i)) => &mut self.ranges[i],
            (None, None) => return Ok(()),
        };
        let Some(word) = value.split_whitespace().next() else { return Ok(()) };
        *slot = Some(number(path, line, word)?);
        Ok(())
    }
}

/// A finite number, the zero before its point left out or not.
fn number(path: &Path, line: usize, word: &str) -> Result<f64, MetrologyError> {
    let value = word.parse::<f64>().ok().filter(|v| v.is_finite());
    value.ok_or_else(|| MetrologyError::Syntax {
        path: path.to_owned(),
        line,
        expected: "a number",
        found: word.chars().take(40).collect(),
    })
}

struct Reader<'a> {
    path: &'a Path,
    header: Header,
    /// What stands for a value that is none.
    undefined: f64,
    traces: Vec<Trace>,
    pitch: Vec<Pitch>,
}

impl Reader<'_> {
    fn fault(&self, line: usize, expected: &'static str, found: &str) -> MetrologyError {
        let found = found.trim().chars().take(60).collect();
        MetrologyError::Syntax { path: self.path.to_owned(), line, expected, found }
    }

    fn value(&self, line: usize, word: &str) -> Result<Option<f64>, MetrologyError> {
        let value = number(self.path, line, word)?;
        let nears = [self.undefined, UNDEFINED].map(|none| (value - none).abs() <= NEAR_UNDEFINED * none.abs());
        Ok((!nears.contains(&true)).then_some(value))
    }

    /// `Profil:  Zahn-Nr.: 17 links / 480 Werte  z= 12.5`, `Verschränkung: Zahn-Nr.: 1k /Flankenlinie:3 links / 2 Werte x= 10.2`.
    fn heading(&self, line: usize, content: &str, block: Option<Block>) -> Result<Heading, MetrologyError> {
        const WHAT: &str = "`Zahn-Nr.: <tooth> links|rechts / <count> Werte`, then `z=`, `d=` or `x=` and a number";
        let fault = || self.fault(line, WHAT, content);
        let (before, rest) = content.split_once("Zahn-Nr.:").ok_or_else(fault)?;
        let words: Vec<&str> = rest.split(|c: char| c.is_whitespace() || c == '/').filter(|w| !w.is_empty()).collect();
        let digits = |word: &str| word.chars().take_while(char::is_ascii_digit).collect::<String>();
        let tooth: u32 = words.first().and_then(|w| digits(w).parse().ok()).ok_or_else(fault)?;
        if tooth == 0 || tooth > MOST_TEETH {
            return Err(self.fault(line, "a tooth, counted from 1", words[0]));
        }
        if self.header.numbers[1].is_some_and(|teeth| f64::from(tooth) > teeth) {
            return Err(self.fault(line, "a tooth of the gear, whose number of teeth is in line 22", words[0]));
        }
        let side = words.iter().find_map(|w| side(w)).ok_or_else(fault)?;
        let at = words.iter().position(|w| *w == "Werte").filter(|at| *at > 0).ok_or_else(fault)?;
        let count: usize = words[at - 1].parse().ok().filter(|n| *n <= MOST_VALUES).ok_or_else(fault)?;
        // `z= 12.5`, `z=12.5`.
        let behind = words[at + 1..].concat();
        let (axis, place) = behind.split_once('=').ok_or_else(fault)?;
        let place = number(self.path, line, place)?;
        let kind = match (axis, title(rest).or(title(before)).or(block)) {
            ("z", Some(Block::Profile) | None) => TraceKind::Profile(place),
            ("d", Some(Block::Helix) | None) => TraceKind::Helix(place),
            ("x", Some(Block::Helix) | None) => {
                let base = self.header()?.base_diameter();
                TraceKind::Helix(base.hypot(2.0 * place))
            }
            _ => return Err(fault()),
        };
        Ok(Heading { kind, tooth: tooth - 1, side, count })
    }

    /// Tooth, f_p, F_p, F_r: the third is the index deviation.
    fn pitch_row(&self, line: usize, content: &str, before: usize) -> Result<f64, MetrologyError> {
        let words: Vec<&str> = content.split_whitespace().collect();
        let tooth: usize = words[0].parse().map_err(|_| self.fault(line, "a tooth, counted from 1", words[0]))?;
        if tooth != before + 1 {
            return Err(self.fault(line, "the teeth one after the other, from 1", words[0]));
        }
        let word = words.get(2).ok_or_else(|| self.fault(line, "tooth, fp, Fp and Fr", content))?;
        self.value(line, word)?.ok_or_else(|| self.fault(line, "a value of Fp", word))
    }

    fn header(&self) -> Result<GearHeader, MetrologyError> {
        let missing = |what| MetrologyError::Missing { path: self.path.to_owned(), what };
        let [module, teeth, helix, pressure, shift, width] = self.header.numbers;
        let teeth = teeth.filter(|z| *z >= 1.0 && *z <= f64::from(MOST_TEETH) && z.fract() == 0.0);
        let teeth = teeth.ok_or_else(|| missing("line 22, the number of teeth,"))? as u32;
        let normal_module = module.filter(|m| *m > 0.0).ok_or_else(|| missing("line 21, the normal module,"))?;
        let angle = |value: Option<f64>| value.filter(|a| a.abs() < 89.0).map(f64::to_radians);
        let range = |i: usize| self.header.ranges[i].zip(self.header.ranges[i + 1]).map(|(from, to)| [from, to]);
        Ok(GearHeader {
            teeth,
            normal_module,
            helix_angle: angle(helix).ok_or_else(|| missing("line 23, the helix angle,"))?,
            pressure_angle: angle(pressure).ok_or_else(|| missing("line 24, the pressure angle,"))?,
            profile_shift: shift,
            face_width: width,
            profile_evaluation: range(0),
            profile_measured: range(2),
            helix_evaluation: range(4),
            helix_measured: range(6),
        })
    }

    fn finish(self) -> Result<MeasuredGear, MetrologyError> {
        let header = self.header()?;
        let missing = |what| MetrologyError::Missing { path: self.path.to_owned(), what };
        if self.traces.is_empty() && self.pitch.is_empty() {
            return Err(missing("any curve"));
        }
        if self.traces.iter().any(|t| t.tooth >= header.teeth) {
            return Err(missing("a tooth whose curve there is"));
        }
        if self.pitch.iter().any(|p| p.index_um.len() != header.teeth as usize) {
            return Err(missing("a row of the pitch table for every tooth, or a tooth for every row,"));
        }
        MeasuredGear { header, traces: self.traces, pitch: self.pitch }.checked(self.path)
    }
}

/// The text of a file that [`read_mka`] reads back to the last bit; Latin-1 takes it as it is.
pub fn write_mka(gear: &MeasuredGear) -> String {
    let h = &gear.header;
    let mut out = format!("HEADER KS.MK.FILE\nUNDEFINED {UNDEFINED} ! Undefined\n");
    let mut line = |code: u32, label: &str, value: Option<f64>| {
        if let Some(value) = value {
            let _ = writeln!(out, "{code:>4}  :{label:.<44}:  {value}");
        }
    };
    line(21, "Normalmodul mn [mm]", Some(h.normal_module));
    line(22, "Zähnezahl z", Some(f64::from(h.teeth)));
    line(23, "Schrägungswinkel [Grad]", Some(degrees(h.helix_angle)));
    line(24, "Eingriffswinkel [Grad]", Some(degrees(h.pressure_angle)));
    line(25, "Profilverschiebungsfaktor x", h.profile_shift);
    line(26, "Zahnbreite [mm]", h.face_width);
    let ranges = [
        (["Start der Auswertestrecke d1 [mm]", "Ende der Auswertestrecke d2 [mm]"], 41, h.profile_evaluation),
        (["Start Messbereich da [mm]", "Ende der Messstrecke de [mm]"], 43, h.profile_measured),
        (["Auswerteanfang b1 [mm]", "Auswerteende b2 [mm]"], 61, h.helix_evaluation),
        (["Messanfang ba [mm]", "Messende be [mm]"], 63, h.helix_measured),
    ];
    for (labels, code, range) in ranges {
        for (i, label) in labels.into_iter().enumerate() {
            line(code + i as u32, label, range.map(|r| r[i]));
        }
    }
    for trace in &gear.traces {
        let (block, axis, place) = match trace.kind {
            TraceKind::Profile(z) => ("Profil", 'z', z),
            TraceKind::Helix(d) => ("Flankenlinie", 'd', d),
        };
        let (tooth, count) = (trace.tooth + 1, trace.deviations_um.len());
        let _ =
            writeln!(out, "\n{block}:  Zahn-Nr.: {tooth} {} / {count} Werte / {axis}= {place}", side_name(trace.side));
        for values in trace.deviations_um.chunks(A_LINE) {
            for value in values {
                let _ = write!(out, " {}", word(value.unwrap_or(UNDEFINED)));
            }
            out.push('\n');
        }
    }
    for pitch in &gear.pitch {
        let name = if pitch.side == Side::Left { "linke" } else { "rechte" };
        let _ = writeln!(out, "\n        {name} Zahnflanke\n        Zahn-Nr.  fp  Fp  Fr\n");
        let before = pitch.index_um.last().copied().unwrap_or(0.0);
        let mut last = before;
        for (i, index) in pitch.index_um.iter().enumerate() {
            let _ = writeln!(out, "  {}   {}   {}   0", i + 1, word(index - last), word(*index));
            last = *index;
        }
    }
    out
}

fn side_name(side: Side) -> &'static str {
    if side == Side::Left { "links" } else { "rechts" }
}

/// Degrees that become the very radians again.
fn degrees(radians: f64) -> f64 {
    let near = radians.to_degrees();
    let back = |d: f64| d.to_radians() == radians;
    [near, near.next_up(), near.next_down()].into_iter().find(|d| back(*d)).unwrap_or(near)
}

/// A number as such files have it: without a zero before its point.
fn word(value: f64) -> String {
    let text = value.to_string();
    match text.strip_prefix("0.") {
        Some(rest) => format!(".{rest}"),
        None => text.strip_prefix("-0.").map_or_else(|| text.clone(), |rest| format!("-.{rest}")),
    }
}
