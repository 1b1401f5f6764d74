//! `ale-gear serve`: a page on this machine where a pair or a gearbox is tried by hand.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use ::serve::Server;
use files::hold_still;

use super::cache_args::CacheArgs;
use crate::{
    error::CommandError,
    memory,
    scene::{Document, DocumentKind, SceneError, Starter, read_text},
    stop,
    talk::{self, Verbosity},
};

/// Words of `ale-gear serve`.
#[derive(Debug, clap::Args)]
pub(super) struct ServeArgs {
    /// Scene or gearbox file to start with [default: the default pair on built-in meshes]
    scene: Option<PathBuf>,
    /// Port of 127.0.0.1 [default: a free one]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// Print the address without opening a browser
    #[arg(long)]
    no_browser: bool,
    #[command(flatten)]
    cache: CacheArgs,
}

/// What the scene is called where none is given.
const NAME: &str = "scene.toml";

impl ServeArgs {
    /// Serves until the user stops it; the address goes to stdout at once.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let (text, file) = self.text()?;
        let server = Server::bind(self.port).map_err(|e| CommandError::input(&e, Some(e.hint())))?;
        let handle = server.stop_handle();
        stop::gently(move || handle.stop());
        let address = server.address();
        announce(&address)?;
        talk::say(Verbosity::Bars, || "ale-gear: serves this machine alone, until Ctrl-C");
        if !self.no_browser
            && let Err(error) = open::that_detached(&address)
        {
            talk::note(format!("no browser was opened ({error}): open the address above in one"));
        }
        let served = server.run(&text, &file, memory::available_bytes, &self.cache.open());
        // For good: a reduction that goes on would begin a file of the cache that nobody ends.
        std::mem::forget(hold_still());
        served.map_err(|e| CommandError::input(&e, Some(e.hint())))?;
        Ok(String::new())
    }

    /// The text to begin with, and what it is called. A scene that cannot be read ends here; what is wrong in it the page
    /// shows beside its key.
    fn text(&self) -> Result<(String, PathBuf), CommandError> {
        match &self.scene {
            None => {
                let starter = Starter { name: "helical-30x30-beta20".into(), ..Starter::default() };
                Ok((starter.text(NAME), PathBuf::from(NAME)))
            }
            Some(file) => {
                let text = read_text(file).map_err(|source| SceneError::Read { file: file.clone(), source })?;
                let document = Document::new(text.clone(), file);
                let kind = document.base_kind().or(document.kind());
                if let Some(other) = kind.filter(|kind| !matches!(kind, DocumentKind::Scene | DocumentKind::Gearbox)) {
                    let message =
                        format_args!("{}: this is {other}, and a pair or a gearbox is tried by hand", file.display());
                    let hint = format!("`ale-gear {} {} --out DIR` takes it", other.command(), file.display());
                    return Err(CommandError::input(message, Some(hint)));
                }
                Ok((text, file.clone()))
            }
        }
    }
}

/// The address on a line of its own, for who starts this from a program.
fn announce(address: &str) -> Result<(), CommandError> {
    let mut out = std::io::stdout().lock();
    let written = writeln!(out, "{address}").and_then(|()| out.flush());
    written.map_err(|e| CommandError::write(Path::new("stdout"), &e))
}
