//! A command line that cannot be read: one line, and a hint that cures it.

use std::{error::Error, ffi::OsString, num};

use clap::{
    CommandFactory,
    error::{ContextKind, ContextValue, ErrorKind},
};

use super::Cli;
use crate::error::CommandError;

/// Subcommands that are gone, and what does their work now; `{}` stands for the file.
const OLD_WORDS: [(&str, &str); 12] = [
    ("gearbox", "`ale-gear run {} --out DIR` takes it"),
    ("study", "`ale-gear run {} --out DIR` takes it"),
    ("sweep", "`ale-gear vary {} --out DIR --vary 'KEY=FROM:TO:COUNT' --start carry` takes it"),
    ("curve", "`ale-gear vary {} --out DIR --vary 'KEY=FROM:TO' --start branch` takes it"),
    (
        "case",
        "`ale-gear vary {} --cases FROM..TO --out PART` takes it; of one case `ale-gear run {} --case N --out DIR`",
    ),
    ("reduce", "`ale-gear mesh reduce {}` takes it"),
    ("schema", "`ale-gear print schema` takes it"),
    ("completions", "`ale-gear print completions SHELL` takes it"),
    ("man", "`ale-gear print man` takes it"),
    ("licences", "`ale-gear print licences` takes it"),
    ("licenses", "`ale-gear print licences` takes it"),
    ("optimize", "`ale-gear optimise {} --out DIR` takes it"),
];

/// What is said of a command line that cannot be read; `None` where the error is a text that was asked for, as of `--help`.
/// `typed`: the whole command line.
pub(super) fn complaint(error: &clap::Error, typed: &[OsString]) -> Option<CommandError> {
    if !error.use_stderr() || error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return None;
    }
    let argument = || text(error, ContextKind::InvalidArg).unwrap_or_else(|| "argument".into());
    let value = || text(error, ContextKind::InvalidValue).unwrap_or_default();
    let message = match error.kind() {
        ErrorKind::InvalidSubcommand => return Some(of_a_subcommand(error, typed)),
        ErrorKind::MissingSubcommand => "a subcommand is missing".into(),
        ErrorKind::MissingRequiredArgument => format!("missing on the command line: {}", argument()),
        ErrorKind::UnknownArgument if argument().parse::<f64>().is_ok() => {
            let hint = "the option before it takes no negative number";
            return Some(CommandError::input(format_args!("`{}` is not allowed here", argument()), Some(hint.into())));
        }
        ErrorKind::UnknownArgument if argument().starts_with('-') => format!("unknown option `{}`", argument()),
        ErrorKind::UnknownArgument => format!("`{}` is one argument too many", argument()),
        ErrorKind::InvalidValue if value().is_empty() => format!("`{}` has no value", argument()),
        ErrorKind::InvalidValue => format!("`{}` is `{}`", argument(), value()),
        ErrorKind::ValueValidation => format!("`{}` is `{}`, {}", argument(), value(), wanted(error)),
        ErrorKind::ArgumentConflict => match text(error, ContextKind::PriorArg) {
            Some(prior) if prior == argument() => format!("`{prior}` is given twice"),
            Some(prior) => format!("`{}` and `{prior}` do not go together", argument()),
            None => format!("`{}` does not go with the other options", argument()),
        },
        ErrorKind::TooFewValues | ErrorKind::WrongNumberOfValues => format!("`{}` has too few values", argument()),
        ErrorKind::TooManyValues => format!("`{}` has too many values", argument()),
        _ => first_line(error),
    };
    // `-out` is read as `-o ut`.
    let one_dash = |word: &OsString| {
        let name = word.to_str()?.strip_prefix('-')?.split('=').next()?;
        let is_name =
            name.len() > 1 && name.chars().all(|c| c.is_ascii_lowercase() || c == '-') && !name.starts_with('-');
        is_name.then(|| format!("is `--{name}` meant, with two dashes?"))
    };
    let hint = match error.kind() {
        ErrorKind::UnknownArgument if typed.iter().any(|word| one_dash(word).is_some()) => {
            typed.iter().find_map(one_dash).unwrap_or_default()
        }
        ErrorKind::ArgumentConflict => "leave one of them out".into(),
        _ => cure(error, typed),
    };
    Some(CommandError::input(message, Some(hint)))
}

/// What is to be done: the word that is nearest, the values that are known, or the whole line as it is written.
fn cure(error: &clap::Error, typed: &[OsString]) -> String {
    let near = [ContextKind::SuggestedArg, ContextKind::SuggestedValue].into_iter().find_map(|kind| text(error, kind));
    let known = text(error, ContextKind::ValidValue).filter(|known| !known.is_empty());
    if let Some(near) = near {
        return format!("is `{near}` meant?");
    }
    if let Some(known) = known {
        return format!("known here: {known}");
    }
    let usage = text(error, ContextKind::Usage).map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "));
    let usage = usage.as_deref().map_or("", |usage| usage.trim_start_matches("Usage: "));
    let mut command = Cli::command();
    let mut path = "ale-gear".to_owned();
    for word in typed.iter().skip(1) {
        let Some(own) = command.find_subcommand(word) else { continue };
        path = format!("{path} {}", own.get_name());
        command = own.clone();
    }
    match (usage, command.has_subcommands()) {
        (_, true) => format!("`{path} --help` lists its subcommands"),
        ("", _) => format!("`{path} --help` lists its options"),
        (usage, _) => format!("write `{usage}`; `{path} --help` lists its options"),
    }
}

/// A scene where a subcommand is wanted, a subcommand that is gone, or one that never was.
fn of_a_subcommand(error: &clap::Error, typed: &[OsString]) -> CommandError {
    let word = text(error, ContextKind::InvalidSubcommand).unwrap_or_default();
    if word.ends_with(".toml") {
        let message = format!("a subcommand is missing before `{word}`");
        return CommandError::input(message, Some(format!("to run it: `ale-gear run {word} --out DIR`")));
    }
    if let Some((_, now)) = OLD_WORDS.iter().find(|(old, _)| *old == word) {
        let file = typed.iter().find_map(|word| word.to_str().filter(|word| word.ends_with(".toml")));
        let hint = now.replace("{}", file.unwrap_or("FILE.toml"));
        return CommandError::input(format_args!("the subcommand `{word}` is gone"), Some(hint));
    }
    let near = text(error, ContextKind::SuggestedSubcommand).map(|near| format!("is `{near}` meant?"));
    CommandError::input(format_args!("unknown subcommand `{word}`"), Some(near.unwrap_or_else(|| cure(error, typed))))
}

/// What a value must be that cannot be read.
fn wanted(error: &clap::Error) -> String {
    let Some(source) = error.source() else { return "which cannot be read".into() };
    if source.is::<num::ParseIntError>() {
        "allowed is a whole number".into()
    } else if source.is::<num::ParseFloatError>() {
        "allowed is a number".into()
    } else {
        source.to_string()
    }
}

/// What clap knows of an error, in words.
fn text(error: &clap::Error, kind: ContextKind) -> Option<String> {
    match error.get(kind)? {
        ContextValue::String(word) => Some(word.clone()),
        ContextValue::Strings(words) => Some(words.join(", ")),
        ContextValue::StyledStr(word) => Some(word.to_string()),
        ContextValue::StyledStrs(words) => Some(words.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
        ContextValue::Number(number) => Some(number.to_string()),
        _ => None,
    }
}

/// The first line of what clap says itself.
fn first_line(error: &clap::Error) -> String {
    let said = error.render().to_string();
    said.lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned()
}
