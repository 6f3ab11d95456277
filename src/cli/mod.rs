//! The command line: what can be asked for, and who answers. Exit codes: 0 done, 1 failed (also a window that was
//! destroyed from outside), 2 not understood, 130 stopped with Ctrl-C.

mod check;
mod desktop;
mod lab;
mod numbers;
mod output;
pub mod run;
mod scenes;
mod stop;
mod truth;

use crate::text::escaped_lines;
use clap::{Parser, Subcommand};
use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// A desktop sandbox for 2D physics with constraints.
///
/// Without a command the sandbox opens on a running rope bridge.
#[derive(Debug, Parser)]
#[command(name = "tautline", version)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

/// What can be asked for.
//
// Variants with arguments have no documentation here: as the program's help it would take the place of the arguments'
// own.
#[derive(Debug, Subcommand)]
enum Command {
    /// Opens the sandbox on a scene.
    Open {
        /// Name of a shipped scene, or path of a scene file
        scene: OsString,
    },
    Run(run::RunArguments),
    Lab(lab::LabArguments),
    /// Lists the shipped scenes: those of the sandbox, the hard cases, and those whose exact motion is stored.
    Scenes,
    Check(check::CheckArguments),
    Truth(truth::TruthArguments),
    Shot(ShotArguments),
}

/// Draws a scene into a PNG file, without a window.
#[derive(Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub struct ShotArguments {
    /// Name of a shipped scene, or path of a scene file
    scene: OsString,
    /// The picture to write, a PNG file
    #[arg(value_parser = numbers::png())]
    file: PathBuf,
    /// Simulated time of the picture [s]
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = numbers::seconds)]
    at: f64,
    /// Width and height [pixels]
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x800", value_parser = numbers::size)]
    size: [u32; 2],
    #[arg(long, default_value = "dark", value_parser = ["dark", "light"])]
    theme: String,
    /// Draw the whole sandbox, panels included
    #[arg(long)]
    window: bool,
    /// Draw the truth as well, translucently
    #[arg(long)]
    ghost: bool,
    /// Draw beside it the same scene by this accuracy, 1e-14 to 0.1
    #[arg(long, value_name = "TOL", value_parser = numbers::accuracy)]
    beside: Option<f64>,
}

/// Does what was asked for.
pub fn execute(arguments: Arguments) -> anyhow::Result<ExitCode> {
    match arguments.command {
        None => desktop::open(None)?,
        Some(Command::Open { scene }) => desktop::open(Some(&scene))?,
        Some(Command::Run(arguments)) => return run::execute(&arguments),
        Some(Command::Lab(arguments)) => return lab::execute(&arguments),
        Some(Command::Scenes) => scenes::execute()?,
        Some(Command::Check(arguments)) => return check::execute(&arguments),
        Some(Command::Truth(arguments)) => truth::execute(&arguments)?,
        Some(Command::Shot(arguments)) => desktop::shot(&arguments)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// Prints what the reader of the command line has to say: help and the version, or what is wrong.
pub fn say(answer: &clap::Error) -> anyhow::Result<ExitCode> {
    // What was typed stands in it.
    let text = escaped_lines(&answer.render().to_string());
    if !answer.use_stderr() {
        let mut out = output::Output::stdout();
        out.write_all(text.as_bytes())?;
        out.flush()?;
        return Ok(ExitCode::SUCCESS);
    }
    // Where nobody can be told, the exit code still tells.
    let _ = std::io::stderr().write_all(text.as_bytes());
    Ok(ExitCode::from(2))
}

/// Whether an error only says that the reader of our output has gone.
pub fn is_broken_pipe(error: &anyhow::Error) -> bool {
    let kinds = error.chain().filter_map(|cause| cause.downcast_ref::<std::io::Error>());
    kinds.into_iter().any(|error| error.kind() == ErrorKind::BrokenPipe)
}
