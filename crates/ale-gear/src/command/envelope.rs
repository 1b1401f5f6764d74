//! `ale-gear envelope`: every way in which such solvers fail, and maps of where.

use std::{path::PathBuf, time::Instant};

use envelope::files::{EnvelopeResult, find_envelope_tables, replace_envelope_tables, write_envelope};
use envelope::{FailureMode, MAPS, MODES, chosen};

use crate::{command::Answer, error::CommandError, output::ResultDirectory, phases::Phases, talk};

/// Words of `ale-gear envelope`.
#[derive(Debug, clap::Args)]
pub(super) struct EnvelopeArgs {
    /// Folder for envelope.csv, maps.csv and report.html, created when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// Only these failure modes (F7) and maps (c), comma-separated [default: all failure modes]
    #[arg(long, value_delimiter = ',', value_name = "CASES", conflicts_with = "quick")]
    only: Vec<String>,
    /// Draw all maps as well, which takes some ten minutes
    #[arg(long)]
    maps: bool,
    /// Run only failure modes that take a few seconds
    #[arg(long)]
    quick: bool,
    /// Replace the tables between `<!-- chart failure modes -->`, `<!-- chart maps -->` and `<!-- end -->` in this file
    #[arg(long, value_name = "FILE")]
    into: Option<PathBuf>,
}

impl EnvelopeArgs {
    /// Looks at all; the text is the closing table.
    pub(super) fn execute(self) -> Result<Answer, CommandError> {
        let (modes, maps) = chosen(&self.only, self.quick, self.maps).map_err(|word| {
            let [mode, map] = [MODES.last().map(FailureMode::label), MAPS.last().map(|m| m.key.to_owned())];
            let hint = format!("F1 .. {}, or a map: a .. {}", mode.unwrap_or_default(), map.unwrap_or_default());
            CommandError::input(format_args!("`--only {word}`: there is no such case"), Some(hint))
        })?;
        let shown = [!modes.is_empty(), !maps.is_empty()];
        self.into.iter().try_for_each(|file| find_envelope_tables(shown, file))?;
        let results = ResultDirectory::create(&self.out)?;
        let mut phases = Phases::with_bars();
        let examined = phases.run_steps("failure modes", modes.len() as u64, |progress| {
            let look = |mode: &&FailureMode| {
                progress.say(format!("{} {}", mode.label(), mode.name));
                let found = (**mode, mode.examine());
                progress.tick();
                found
            };
            modes.iter().map(look).collect()
        });
        let mut found = EnvelopeResult { modes: examined, ..EnvelopeResult::default() };
        for map in maps {
            let start = Instant::now();
            let drawn = phases.run_steps(map.name, map.count() as u64, |progress| map.draw(&|| progress.tick()));
            found.maps.push((*map, drawn, start.elapsed().as_secs_f64()));
        }
        let text = write_envelope(&found, "ale-gear envelope --maps --out DIR", phases.cost(), &results)?.table;
        results.finish(talk::note)?;
        self.into.iter().try_for_each(|file| replace_envelope_tables(&found, file))?;
        let failure = found
            .missed()
            .map(|missed| CommandError::failed(format_args!("failed: {missed}"), Some("the table says why".into())));
        Ok(Answer { text: format!("{text}\nresults: {}\n", self.out.display()), failure })
    }
}
