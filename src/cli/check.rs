//! `tautline check`: says what a scene contains, or what is wrong with it.

use super::output::Output;
use crate::engine::World;
use crate::scene;
use crate::text::named;
use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

/// Says what scene files contain, or what is wrong with them: file, line, column, and how to mend it.
///
/// Exits with 1 if any of them is wrong.
#[derive(Debug, clap::Args)]
pub struct CheckArguments {
    /// Paths of scene files (or names of shipped scenes)
    #[arg(required = true, value_name = "FILE")]
    files: Vec<OsString>,
}

pub(super) fn execute(arguments: &CheckArguments) -> anyhow::Result<ExitCode> {
    let mut out = Output::stdout();
    let mut code = ExitCode::SUCCESS;
    for file in &arguments.files {
        match scene::open(file) {
            Ok(setup) => {
                let (file, title) = (named(file), scene::shown(&setup.title));
                out.line(format_args!("{file}: good. \"{title}\": {}", contents(&setup.world)))?
            }
            Err(error) => {
                // Where nobody can be told, the exit code still tells.
                let _ = writeln!(std::io::stderr(), "{error}");
                code = ExitCode::FAILURE;
            }
        }
    }
    Ok(code)
}

/// Counts by kind: "3 bodies (1 turns), 2 Rod, 1 Spring, 4 walls".
fn contents(world: &World) -> String {
    let bodies = world.bodies();
    let mut parts = vec![format!("{} bodies ({} with spin)", bodies.len(), bodies.spinning())];
    let mut kinds: Vec<(&str, usize)> = Vec::new();
    for name in world.constraints().kind.iter().map(|kind| kind.name()) {
        match kinds.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => kinds.push((name, 1)),
        }
    }
    parts.extend(kinds.iter().map(|(name, count)| format!("{count} × {}", name.to_lowercase())));
    parts.push(format!("{} walls", world.walls().len()));
    parts.join(", ")
}
