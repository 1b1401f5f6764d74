//! One axis as a word of a command line.

use cases::{Axis, Distribution};
use geometry::TOLERANCE_CLASSES;

/// Values that a word gives its keys.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisValues {
    /// The given values, or the distribution from which they are drawn.
    By(Axis),
    /// The given texts, such as names of files.
    Words(Vec<String>),
    /// Any value between two limits, in the order written.
    Between([f64; 2]),
    /// Within a tolerance class of ISO 1328-1.
    Class(u32),
}

/// Keys and their values in one word; several keys joined by `+` have the same value.
///
/// ```text
/// key=1,2,5              each of these            key~0:40                   drawn, uniform
/// key=0:40:9             nine, evenly spaced      key~0.1:10:log             its logarithm uniform
/// key=0.1:10:9:log       their logarithms are     key~normal:0:5             mean, standard deviation
/// key=0:40               any between              key~normal:0:5:-10:10      between limits
/// one+other=1,2,5        both of them             key~iso1328:6              within a class of ISO 1328-1
/// key=a.csv,b.csv        each of these files
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct AxisWord {
    /// The keys, at least one; the first one is the name of the axis.
    pub keys: Vec<String>,
    /// Values of the keys.
    pub values: AxisValues,
}

impl AxisWord {
    /// Parses a word.
    ///
    /// # Errors
    /// A text about the error.
    pub fn parse(word: &str) -> Result<Self, String> {
        axis(word).map(|(keys, values)| Self { keys, values })
    }

    /// The values given; `None` if they are drawn, or any between two limits.
    pub fn list(&self) -> Option<&[f64]> {
        match &self.values {
            AxisValues::By(Axis::Each(values)) => Some(values),
            _ => None,
        }
    }
}

fn axis(word: &str) -> Result<(Vec<String>, AxisValues), String> {
    let at = word.find(['=', '~']).ok_or("it has neither `=` (each value) nor `~` (drawn)")?;
    let (key, rest) = word.split_at(at);
    let (drawn, values) = (rest.starts_with('~'), &rest[1..]);
    let number = |part: &str| part.trim().parse::<f64>().map_err(|_| format!("`{}` is not a number", part.trim()));
    let numbers = |parts: &[&str]| parts.iter().map(|part| number(part)).collect::<Result<Vec<f64>, String>>();
    let parts: Vec<&str> = values.split(':').collect();
    let axis = match (drawn, &parts[..]) {
        (false, [list]) => {
            let parts: Vec<&str> = list.split(',').map(str::trim).collect();
            if parts.iter().all(|part| !part.is_empty() && part.parse::<f64>().is_err()) {
                return Ok((keys(key), AxisValues::Words(parts.into_iter().map(str::to_owned).collect())));
            }
            let values = numbers(&parts)?;
            if let Some(bad) = values.iter().find(|x| !x.is_finite()) {
                return Err(format!("`{bad}` is not a value"));
            }
            Axis::Each(values)
        }
        (false, [from, to, count, scale @ ..]) => {
            let logarithmic = is_logarithmic(scale)?;
            let wrong = || format!("`{}` is not a number of values, 1 or more", count.trim());
            let count = count.trim().parse::<u32>().ok().filter(|n| *n > 0).ok_or_else(wrong)?;
            grid([number(from)?, number(to)?], count, logarithmic)?
        }
        (false, [from, to]) => return Ok((keys(key), AxisValues::Between([number(from)?, number(to)?]))),
        (true, ["normal", rest @ ..]) => match numbers(rest)?[..] {
            [mean, deviation] => normal(mean, deviation, [f64::NEG_INFINITY, f64::INFINITY]),
            [mean, deviation, least, largest] => normal(mean, deviation, [least, largest]),
            _ => return Err("a normal distribution is `normal:MEAN:DEVIATION`, or with `:LEAST:LARGEST`".into()),
        },
        (true, ["iso1328", class]) => {
            let class = class.trim().parse().ok().filter(|class| TOLERANCE_CLASSES.contains(class));
            let (first, last) = (TOLERANCE_CLASSES.start(), TOLERANCE_CLASSES.end());
            let class = class.ok_or_else(|| format!("a tolerance class is a number, {first} to {last}"))?;
            return Ok((keys(key), AxisValues::Class(class)));
        }
        (true, [from, to, scale @ ..]) => {
            let (from, to) = (number(from)?, number(to)?);
            let logarithmic = is_logarithmic(scale)?;
            Axis::Drawn(if logarithmic {
                Distribution::LogUniform { from, to }
            } else {
                Distribution::Uniform { from, to }
            })
        }
        _ => return Err("say `=A,B,C`, `=FROM:TO:COUNT`, `~FROM:TO` or `~normal:MEAN:DEVIATION`".into()),
    };
    Ok((keys(key), AxisValues::By(axis)))
}

/// Keys of an axis, as a word says them.
fn keys(word: &str) -> Vec<String> {
    word.split('+').map(|key| key.trim().to_owned()).collect()
}

fn is_logarithmic(rest: &[&str]) -> Result<bool, String> {
    match rest {
        [] => Ok(false),
        ["log"] => Ok(true),
        _ => Err(format!("`{}` is not understood; `log` may stand there", rest.join(":"))),
    }
}

/// Evenly spaced values.
pub(super) fn grid(ends: [f64; 2], count: u32, logarithmic: bool) -> Result<Axis, String> {
    if ends.iter().any(|x| !x.is_finite()) {
        return Err("its ends are numbers".into());
    }
    if logarithmic && (ends[0] <= 0.0 || ends[1] <= 0.0) {
        return Err("on a logarithmic scale both ends lie above 0".into());
    }
    Ok(Axis::grid(ends, count, logarithmic))
}

/// A normal distribution between limits.
pub(super) fn normal(mean: f64, deviation: f64, [least, largest]: [f64; 2]) -> Axis {
    Axis::Drawn(Distribution::Normal { mean, deviation, least, largest })
}
