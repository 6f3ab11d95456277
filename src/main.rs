//! Reads the command line, hands over, and turns errors into one line and an exit code.

use clap::Parser;
use std::io::Write;
use std::process::ExitCode;
use tautline::cli::{self, Arguments};
use tautline::text::escaped;

fn main() -> ExitCode {
    match Arguments::try_parse().map_or_else(|answer| cli::say(&answer), cli::execute) {
        Ok(code) => code,
        // Whoever read our output has seen enough.
        Err(error) if cli::is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            // Where nobody can be told, the exit code still tells.
            let _ = writeln!(std::io::stderr(), "error: {}", escaped(&format!("{error:#}")));
            ExitCode::FAILURE
        }
    }
}
