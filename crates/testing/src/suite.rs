//! A test program whose tests need programs of others.

use std::process::ExitCode;

use libtest_mimic::{Arguments, Completion, Failed, Trial};

use crate::record::{Record, folder, note};

/// Tests of one program (`harness = false`), each with what it needs.
///
/// It takes the words that cargo gives to any test program, and says what the usual harness says: `ok`, `FAILED` or
/// `ignored` with a reason.
#[derive(Debug)]
pub struct Suite {
    source: &'static str,
    trials: Vec<Trial>,
    records: Vec<Record>,
}

impl Suite {
    /// Without tests yet; `source` is `file!()` of the program's main file.
    pub fn new(source: &'static str) -> Self {
        Self { source, trials: Vec::new(), records: Vec::new() }
    }

    /// Adds a test that is given what it needs, or is left out for a reason.
    #[must_use]
    pub fn needing<T: Clone + Send + 'static>(
        mut self,
        need: &Result<T, String>,
        name: &'static str,
        test: impl FnOnce(T) + Send + 'static,
    ) -> Self {
        self.records.push(Record { test: name.to_owned(), reason: need.as_ref().err().cloned() });
        let need = need.clone();
        self.trials.push(Trial::ignorable_test(name, move || match need {
            Ok(need) => {
                test(need);
                Ok::<_, Failed>(Completion::Completed)
            }
            Err(reason) => Ok(Completion::ignored_with(reason)),
        }));
        self
    }

    /// Adds a test that needs nothing.
    #[must_use]
    pub fn always(mut self, name: &'static str, test: impl FnOnce() + Send + 'static) -> Self {
        self.trials.push(Trial::test(name, move || {
            test();
            Ok(())
        }));
        self
    }

    /// Runs what the command line asks for; the status is that of the program.
    pub fn run(self) -> ExitCode {
        let arguments = Arguments::from_args();
        if !arguments.list
            && let Err(error) = note(&folder(), self.source, "", &self.records)
        {
            use std::io::Write;
            let _ = writeln!(std::io::stderr(), "what is left out cannot be recorded: {error}");
            return ExitCode::FAILURE;
        }
        libtest_mimic::run(&arguments, self.trials).exit_code()
    }
}
