//! Runs are killed at random moments and taken up again; their final files must be those of undisturbed ones.
//!
//! `cargo run --profile test -p verification --bin kill_runs -- KILLS SEED`
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

use std::{error::Error, process::ExitCode};

use testing::Random;
use verification::{killed::tasks, program::as_command};

fn main() -> ExitCode {
    if let Some(code) = as_command() {
        return code;
    }
    match run() {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            println!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Gives how many runs were not as they must be.
fn run() -> Result<usize, Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [wanted, seed] = &words[..] else { return Err("KILLS SEED are wanted".into()) };
    let (wanted, mut random) = (wanted.parse::<u32>()?, Random::new(seed.parse()?));
    let program = std::env::current_exe()?;
    let (tasks, mut wholes) = (tasks(), Vec::new());
    for task in &tasks {
        let whole = task.undisturbed(&program)?;
        println!("{}: {} files in {:.2} s", task.document.name, whole.0.len(), whole.1.as_secs_f64());
        wholes.push(whole);
    }
    let (mut kills, mut wrong) = (vec![0; tasks.len()], 0);
    while kills.iter().sum::<u32>() < wanted {
        for (i, task) in tasks.iter().enumerate() {
            match task.disturbed(&program, &wholes[i], &mut random) {
                Ok(n) => kills[i] += n,
                Err(said) => {
                    wrong += 1;
                    println!("{said}");
                }
            }
        }
        if wrong > 20 {
            break;
        }
    }
    for (task, kills) in tasks.iter().zip(&kills) {
        println!("{}: {kills} kills", task.document.name);
    }
    println!("{} kills in all, {wrong} runs are not as they must be", kills.iter().sum::<u32>());
    Ok(wrong)
}
