//! The command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    let scene = std::env::args().nth(1);
    match tautline::window::run(scene.as_deref()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("tautline: {error:#}");
            ExitCode::FAILURE
        }
    }
}
