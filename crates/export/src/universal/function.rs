//! Dataset 58: a complex function over even steps of frequency.

use super::number::{real, text};

/// What a function tells of: node, and direction 1 .. 6 for x, y, z and the turns about them.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// Name, ten characters at most.
    pub name: String,
    /// Number of the node.
    pub node: usize,
    /// 1 .. 6; 4 .. 6 are moments.
    pub direction: u8,
}

/// Amplitudes (peaks of Re(x exp(i w t))) of a force in N or of a moment in N mm over the frequency in Hz, steps even.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// Description: up to five lines of 80 characters.
    pub words: Vec<String>,
    /// Number of the function.
    pub number: usize,
    /// Where.
    pub response: Response,
    /// First frequency and step, Hz.
    pub frequencies_hz: [f64; 2],
    /// Real and imaginary part.
    pub values: Vec<[f64; 2]>,
}

/// Begins and ends a dataset.
const MARK: &str = "    -1\n";
/// Units of dataset 164: mm and N, and what divides a length to give m. The temperature is not used.
const UNITS: (u32, &str, f64) = (10, "mm (newton)", 1e3);
const ABSOLUTE_ZERO: f64 = 273.15;

/// Codes of dataset 58.
const SPECTRUM: u32 = 12;
const COMPLEX_DOUBLE: u32 = 6;
const EVEN: u32 = 1;
const FREQUENCY: u32 = 18;
const EXCITATION_FORCE: u32 = 13;
const UNKNOWN: u32 = 0;

/// A file of functions, mm and N.
pub fn universal_file(functions: &[Function]) -> String {
    let mut file = String::from(MARK);
    let (code, name, length) = UNITS;
    file += &format!("{:>6}\n{code:>10}{}{:>10}\n", 164, text(name, 20), 2);
    file += &[length, 1.0, 1.0].map(|factor| real(factor, 25, 17, 'D')).concat();
    file += &format!("\n{}\n{MARK}", real(ABSOLUTE_ZERO, 25, 17, 'D'));
    for own in functions {
        file += &function(own);
    }
    file
}

fn function(of: &Function) -> String {
    let mut set = format!("{MARK}{:>6}\n", 58);
    for i in 0..5 {
        let line = of.words.get(i).map_or("NONE", String::as_str);
        set += &format!("{}\n", text(line, 80).trim_end());
    }
    let Response { name, node, direction } = &of.response;
    // Record 6: type, number, version, load case; where it is; no reference.
    set += &format!("{SPECTRUM:>5}{:>10}{:>5}{:>10}", of.number, 1, 0);
    set += &format!(" {}{node:>10}{direction:>4} {}{:>10}{:>4}\n", text(name, 10), text("NONE", 10), 0, 0);
    let [start, step] = of.frequencies_hz;
    set += &format!("{COMPLEX_DOUBLE:>10}{:>10}{EVEN:>10}", of.values.len());
    set += &[start, step, 0.0].map(|x| real(x, 13, 5, 'E')).concat();
    set.push('\n');
    let moment = u32::from(*direction > 3);
    let unit = if moment == 1 { "N mm" } else { "N" };
    // Records 8 to 11: abscissa, ordinate, its denominator, z axis. Exponents are those of length, force, temperature.
    set += &axis(FREQUENCY, [0; 3], "Frequency", "Hz");
    set += &axis(EXCITATION_FORCE, [moment, 1, 0], if moment == 1 { "Moment" } else { "Force" }, unit);
    set += &axis(UNKNOWN, [0; 3], "NONE", "NONE");
    set += &axis(UNKNOWN, [0; 3], "NONE", "NONE");
    for pairs in of.values.chunks(2) {
        set += &pairs.iter().flatten().map(|x| real(*x, 20, 12, 'E')).collect::<String>();
        set.push('\n');
    }
    set + MARK
}

fn axis(kind: u32, exponents: [u32; 3], label: &str, unit: &str) -> String {
    let [length, force, temperature] = exponents;
    let words = format!(" {} {}", text(label, 20), text(unit, 20));
    format!("{kind:>10}{length:>5}{force:>5}{temperature:>5}{}\n", words.trim_end())
}
