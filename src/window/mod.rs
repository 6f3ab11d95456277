//! The desktop window: winit's loop, which ties the simulation thread, the panels and the picture together, and the same
//! picture off screen.

mod desktop;
mod panels;
mod screen;
mod shot;
mod timing;

pub use shot::{ShotOptions, shot};

use crate::scene;
use anyhow::{Context, anyhow};
use desktop::{Desktop, Wake};
use std::ffi::{OsStr, OsString};
use std::panic::{AssertUnwindSafe, catch_unwind};
use timing::Timing;
use winit::event_loop::EventLoop;

/// Opens the sandbox on a shipped scene (the first one if none is named) or a scene file, and returns when the window is closed.
///
/// # Errors
/// One line each: no display, a missing system library, no graphics adapter, a scene that cannot be opened.
pub fn run(scene: Option<&OsStr>) -> anyhow::Result<()> {
    let timing = Timing::start();
    let name: OsString = scene.map_or_else(|| scene::shipped()[0].name.into(), OsStr::to_owned);
    // Read while the window and the graphics device are being set up.
    let setup = std::thread::spawn(move || scene::open(&name));
    let event_loop = match event_loop() {
        Ok(event_loop) => event_loop,
        Err(error) => {
            // A scene that cannot be opened is the user's own and comes first.
            desktop::join(setup)?;
            return Err(error);
        }
    };
    let mut desktop = Desktop::new(event_loop.create_proxy(), setup, timing);
    event_loop.run_app(&mut desktop).context("the window system ended the program")?;
    desktop.finish()
}

/// Connects to the display.
fn event_loop() -> anyhow::Result<EventLoop<Wake>> {
    // winit panics where libxkbcommon-x11 is missing. Only its message is for a programmer, so it is not shown.
    let shown = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let built = catch_unwind(AssertUnwindSafe(|| EventLoop::with_user_event().build()));
    std::panic::set_hook(shown);
    match built {
        Ok(Ok(event_loop)) => Ok(event_loop),
        Ok(Err(error)) => {
            log::info!("{error}");
            Err(anyhow!(
                "no window can be opened: {}; start it in a desktop session, or use `tautline run` and `tautline shot`, \
                 which need no display",
                display_problem()
            ))
        }
        Err(_) => Err(anyhow!(
            "no window can be opened: a library of the X window system is missing; on Debian or Ubuntu install \
             libxkbcommon-x11-0, libxcursor1 and libxi6"
        )),
    }
}

/// Why there is no display, as a user would say it: winit's own text names a line of its source.
fn display_problem() -> String {
    let set = |name| std::env::var(name).ok().filter(|value| !value.is_empty()).map(|value| format!("{name}={value}"));
    match set("WAYLAND_DISPLAY").or_else(|| set("DISPLAY")) {
        Some(display) => format!("the display {display} does not answer"),
        None => "there is no display (neither WAYLAND_DISPLAY nor DISPLAY is set)".into(),
    }
}

/// Where between the last two states the picture stands, 0 … 1, `since` seconds after the later one was published.
fn interpolation(frame: &crate::app::Frame, since: f64) -> f64 {
    // Paused, the exact state is shown; after an edit there is no state before it.
    if !frame.running || frame.previous_position.is_empty() {
        return 1.0;
    }
    (since * frame.speed.wanted * frame.method.hz).clamp(0.0, 1.0)
}
