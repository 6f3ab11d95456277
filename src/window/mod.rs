//! The desktop window: winit's loop, which ties the simulation thread, the panels and the picture together, and the same
//! picture off screen.

mod desktop;
mod panels;
mod screen;
mod shot;
mod timing;

pub use shot::{ShotOptions, shot};

use crate::scene;
use crate::stop;
use anyhow::anyhow;
use desktop::{Desktop, Wake};
use std::ffi::{OsStr, OsString};
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};
use timing::Timing;
use winit::event_loop::EventLoop;

/// Opens the sandbox on a shipped scene (the first one if none is named) or a scene file, and returns when the window is closed.
///
/// # Errors
/// One line each: no display, a missing system library, no graphics adapter, a scene that cannot be opened; a window that was
/// destroyed from outside, a panic, or a request of the system to end while something is unsaved, with the file in which the
/// unsaved scene was kept.
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
    let proxy = event_loop.create_proxy();
    stop::listen(move || drop(proxy.send_event(Wake::Leave)));
    let mut desktop = Desktop::new(event_loop.create_proxy(), setup, timing);
    let (ended, panic) = quietly(|| event_loop.run_app(&mut desktop));
    match ended {
        Some(Ok(())) => desktop.finish(),
        Some(Err(error)) => desktop.abandon(anyhow::Error::new(error).context("the window system ended the program")),
        None => desktop.abandon(panic.map_or_else(|| anyhow!("the window failed"), |panic| panic.error())),
    }
}

/// Where and why a thread panicked.
struct Panic {
    place: String,
    message: String,
}

impl Panic {
    fn of(info: &PanicHookInfo<'_>) -> Panic {
        let place = info.location().map_or(String::new(), |at| {
            // Its folder is one of the machine that the program was compiled on.
            let file = at.file().rsplit(['/', '\\']).next().unwrap_or_default();
            format!("{file}:{}", at.line())
        });
        Panic { place, message: info.payload_as_str().unwrap_or("no message").to_owned() }
    }

    fn error(&self) -> anyhow::Error {
        anyhow!("the window failed, which is a defect of Tautline ({}: {})", self.place, self.message)
    }
}

/// Does `act`, and catches a panic of it, of which nothing is printed: a message for a programmer is no use to a user.
/// Panics of other threads are told as ever.
fn quietly<T>(act: impl FnOnce() -> T) -> (Option<T>, Option<Panic>) {
    let caught = Arc::new(Mutex::new(None));
    let (here, found) = (std::thread::current().id(), caught.clone());
    let shown: Arc<dyn Fn(&PanicHookInfo<'_>) + Send + Sync> = std::panic::take_hook().into();
    let others = shown.clone();
    std::panic::set_hook(Box::new(move |info| {
        if std::thread::current().id() != here {
            return others(info);
        }
        let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
        // The first is the cause; what is dropped on the way out may panic as well.
        found.get_or_insert_with(|| Panic::of(info));
    }));
    let done = catch_unwind(AssertUnwindSafe(act)).ok();
    std::panic::set_hook(Box::new(move |info| shown(info)));
    let panic = caught.lock().unwrap_or_else(PoisonError::into_inner).take();
    (done, panic)
}

/// Connects to the display.
fn event_loop() -> anyhow::Result<EventLoop<Wake>> {
    // winit panics where libxkbcommon-x11 is missing.
    let (built, _) = quietly(|| EventLoop::with_user_event().build());
    match built {
        Some(Ok(event_loop)) => Ok(event_loop),
        Some(Err(error)) => {
            log::info!("{error}");
            Err(anyhow!(
                "no window can be opened: {}; start it in a desktop session, or use `tautline run` and `tautline shot`, \
                 which need no display",
                display_problem()
            ))
        }
        None => Err(anyhow!(
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
    (since * frame.speed.rate() * frame.method.hz).clamp(0.0, 1.0)
}
