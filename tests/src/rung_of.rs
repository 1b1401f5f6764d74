//! Rungs in words of a command line.

use std::error::Error;

use analysis::accuracy::Rung;

/// The rung of so many elements along the profile; without a word of `usual` ones.
///
/// # Errors
/// A word that is no number, and a number that no rung has.
pub fn rung_of(word: Option<&str>, usual: u32) -> Result<Rung, Box<dyn Error + Send + Sync>> {
    let elements: u32 = word.map_or(Ok(usual), str::parse)?;
    Ok(Rung::ALL.into_iter().find(|r| r.elements_profile == elements).ok_or("no such rung")?)
}
