//! Which reasons of refusals are known, why each is legitimate, and whether one that can be recomputed is true.

use serde::Deserialize;

use super::Draft;

/// The list, committed.
const LIST: &str = include_str!("../../data/refusals.toml");

/// Reasons by which a scene may be refused or may have no answer.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Refusals {
    reason: Vec<Reason>,
}

/// One kind of message.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Reason {
    /// The message; a star stands for anything.
    pattern: String,
    /// Exit status that goes with it.
    status: i32,
    /// Why it is legitimate.
    why: String,
}

impl Refusals {
    /// The committed list.
    ///
    /// # Errors
    /// Where it is not readable, or a reason has no word of why.
    pub fn committed() -> Result<Self, String> {
        let list: Self = toml::from_str(LIST).map_err(|e| e.to_string())?;
        match list.reason.iter().find(|r| r.why.split_whitespace().count() < 4) {
            Some(bare) => Err(format!("refusals.toml does not say why `{}` is legitimate", bare.pattern)),
            None => Ok(list),
        }
    }

    /// The pattern of a message.
    pub(super) fn explain(&self, message: &str, status: i32, scene: &Draft) -> Result<String, String> {
        // Values of a plan are drawn by the program.
        if scene.get("vary").is_none() {
            range_is_left(message, scene)?;
        }
        something_is_free(message, scene)?;
        friction_is_high(message, scene)?;
        something_is_stiff(message, scene)?;
        // A plan none of whose documents is accepted has no result, for the reason of the first.
        let of_plan = status == 1 && scene.get("vary").is_some();
        let fits = |r: &&Reason| (r.status == status || of_plan) && matches(&r.pattern, message);
        match self.reason.iter().find(fits) {
            Some(reason) => Ok(reason.pattern.clone()),
            None => Err(format!("unexplained, status {status}: {message}")),
        }
    }
}

/// Whether a text is a pattern with something for every star.
pub fn matches(pattern: &str, text: &str) -> bool {
    let Some((begin, rest)) = pattern.split_once('*') else { return pattern == text };
    let Some(mut text) = text.strip_prefix(begin) else { return false };
    let mut parts: Vec<&str> = rest.split('*').collect();
    let Some(last) = parts.pop() else { return false };
    for part in parts {
        let Some(at) = text.find(part) else { return false };
        text = &text[at + part.len()..];
    }
    text.ends_with(last)
}

/// What a number of a message may be off by: one with many digits is printed with four of them.
const SHOWN: f64 = 5e-4;

/// "`key` is 3, allowed is 4 .. 9": the scene has that number behind such a key, and it is not within that range.
fn range_is_left(message: &str, scene: &Draft) -> Result<(), String> {
    let Some((key, rest)) = message.strip_prefix('`').and_then(|m| m.split_once("` is ")) else { return Ok(()) };
    let Some((value, range)) = rest.split_once(", allowed is ") else { return Ok(()) };
    let (Ok(value), Some((low, high))) = (value.parse::<f64>(), range.split_once(" .. ")) else { return Ok(()) };
    let (Ok(low), Ok(high)) = (low.parse::<f64>(), high.parse::<f64>()) else {
        return Err(format!("a range that is none: {message}"));
    };
    let is_shown = |n: &f64| (n - value).abs() <= SHOWN * value.abs();
    match scene.numbers(key).into_iter().find(is_shown) {
        None => Err(format!("the scene has no such value: {message}")),
        Some(own) if (low..=high).contains(&own) => Err(format!("refused, though it is within the range: {message}")),
        Some(_) => Ok(()),
    }
}

/// "contact did not converge": without friction there is one solution, and with little; with much there may be none.
fn friction_is_high(message: &str, scene: &Draft) -> Result<(), String> {
    let high = scene.number("contact.friction").is_some_and(|friction| friction > 0.5);
    if high || !message.contains("contact did not converge") {
        Ok(())
    } else {
        Err(format!("little friction: {message}"))
    }
}

/// "body_balance": forces are lost in round-off where shafts or bearings are far stiffer than teeth, and nowhere else.
fn something_is_stiff(message: &str, scene: &Draft) -> Result<(), String> {
    let above = |key: &str, most: f64| scene.numbers(key).iter().any(|value| *value > most);
    let stiff = above("young_mpa", 1e9) || above("stiffness_n_per_mm", 1e10) || above("matrix_n_mm_rad", 1e13);
    if stiff || !message.contains("body_balance") {
        Ok(())
    } else {
        Err(format!("nothing is stiffer than teeth: {message}"))
    }
}

/// "no equilibrium": teeth alone hold the driven gear under any load; only bearings can be too soft.
fn something_is_free(message: &str, scene: &Draft) -> Result<(), String> {
    if !message.ends_with("of the displacements") {
        return Ok(());
    }
    let free =
        |gear: &str| scene.get(&format!("{gear}.body.free")).and_then(|f| f.as_array()).is_some_and(|f| !f.is_empty());
    if free("pinion") || free("wheel") { Ok(()) } else { Err(format!("teeth alone hold the gears: {message}")) }
}
