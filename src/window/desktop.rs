//! The event loop's side of the window: opens it, hands events to the panels, and draws when there is a reason to.

use super::screen::{Screen, View};
use super::timing::Timing;
use super::{interpolation, quietly};
use crate::app::{Camera, Command, Frame, RescueError, Session, rescue};
use crate::engine::DVec2;
use crate::scene::{SceneError, Setup};
use crate::text::{escaped, named};
use crate::ui::{Shell, ShellOutput};
use anyhow::{Context, anyhow};
use egui_winit::accesskit_winit;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::window::{Fullscreen, Window, WindowId};

/// Size of a new window [points].
const SIZE: LogicalSize<f64> = LogicalSize::new(1280.0, 800.0);
/// Refresh rate of a monitor that does not tell [Hz].
const USUAL_REFRESH: f64 = 60.0;

/// How long to wait when the screen takes no frame, because the window is covered, say.
const HIDDEN_DELAY: Duration = Duration::from_millis(100);

/// What wakes the loop from outside.
pub enum Wake {
    /// The simulation published a frame.
    Frame,
    /// The system asks the program to end.
    Leave,
    /// A screen reader asks for something.
    Access(accesskit_winit::Event),
}

impl From<accesskit_winit::Event> for Wake {
    fn from(event: accesskit_winit::Event) -> Wake {
        Wake::Access(event)
    }
}

/// The program from the event loop's side.
pub struct Desktop {
    proxy: EventLoopProxy<Wake>,
    /// The scene that is being read; taken when the window opens.
    setup: Option<JoinHandle<Result<Setup, SceneError>>>,
    sandbox: Option<Sandbox>,
    failure: Option<anyhow::Error>,
    /// Where unsaved work went when something failed.
    rescued: Option<Result<PathBuf, RescueError>>,
    timing: Timing,
}

impl Desktop {
    /// A desktop that will open its window when the loop starts.
    pub fn new(proxy: EventLoopProxy<Wake>, setup: JoinHandle<Result<Setup, SceneError>>, timing: Timing) -> Desktop {
        Desktop { proxy, setup: Some(setup), sandbox: None, failure: None, rescued: None, timing }
    }

    /// Ends the session; what went wrong, if anything did, and what became of unsaved work then.
    pub fn finish(mut self) -> anyhow::Result<()> {
        self.timing.report();
        let Some(failure) = self.failure else { return Ok(()) };
        Err(match self.rescued {
            None => failure,
            Some(Ok(path)) => anyhow!("{failure:#}; the scene with its unsaved changes is in {}", named(path)),
            Some(Err(why)) => anyhow!("{failure:#}; unsaved changes of the scene are lost: {why}"),
        })
    }

    /// Ends the session after a panic in the event loop. What is tied to the display is left to the end of the process:
    /// it may be half changed.
    pub fn abandon(mut self, mut failure: anyhow::Error) -> anyhow::Result<()> {
        if let Some(sandbox) = self.sandbox.take() {
            self.rescued = self.rescued.or_else(|| rescue(&sandbox.session.frame()));
            failure = cause(&sandbox.window, failure);
            let Sandbox { screen, input, egui, window, session, .. } = sandbox;
            std::mem::forget((screen, input, egui, window));
            drop(session);
        }
        // The cause comes first: a window that is gone makes more fail.
        self.failure.get_or_insert(failure);
        self.finish()
    }

    fn open(
        &mut self,
        event_loop: &ActiveEventLoop,
        setup: JoinHandle<Result<Setup, SceneError>>,
    ) -> anyhow::Result<Sandbox> {
        // Invisible until the screen reader is connected, which must not happen to a visible window.
        let size = fitting(event_loop);
        let attributes = Window::default_attributes().with_title("Tautline").with_inner_size(size).with_visible(false);
        let window = Arc::new(event_loop.create_window(attributes).context("no window can be opened")?);
        let egui = egui::Context::default();
        let display = event_loop.owned_display_handle();
        let mut input = egui_winit::State::new(egui.clone(), egui::ViewportId::ROOT, &display, None, None, None);
        input.init_accesskit(event_loop, &window, self.proxy.clone());
        let screen = Screen::new(window.clone(), display)?;
        input.set_max_texture_side(screen.max_texture_side());
        let setup = join(setup)?;
        window.set_visible(true);
        let proxy = self.proxy.clone();
        let wake = move || {
            // The loop ends before the session does: then nobody is left to wake.
            let _ = proxy.send_event(Wake::Frame);
        };
        let session = Session::start(setup, wake).context("the simulation thread cannot be started")?;
        let mut shell = Shell::new();
        shell.prepare(&egui);
        Ok(Sandbox {
            window,
            egui,
            input,
            screen,
            session,
            shell,
            camera: Camera { centre: DVec2::ZERO, scale: 100.0, size: DVec2::new(size.width, size.height) },
            drawn: Instant::now(),
            title: String::new(),
        })
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: anyhow::Error) {
        self.rescued = self.sandbox.as_ref().and_then(|sandbox| rescue(&sandbox.session.frame()));
        self.failure = Some(match &self.sandbox {
            Some(sandbox) => cause(&sandbox.window, error),
            None => error,
        });
        event_loop.exit();
    }

    /// The open window, unless it failed: then nothing may be asked of it any more.
    fn usable(&mut self) -> Option<&mut Sandbox> {
        self.sandbox.as_mut().filter(|_| self.failure.is_none())
    }
}

/// The size of a new window: never larger than the screen [points].
fn fitting(event_loop: &ActiveEventLoop) -> LogicalSize<f64> {
    let monitor = event_loop.primary_monitor().or_else(|| event_loop.available_monitors().next());
    let screen = monitor.map(|monitor| monitor.size().to_logical::<f64>(monitor.scale_factor()));
    // A monitor that tells nothing of itself has no size at all.
    match screen.filter(|screen| screen.width >= 1.0 && screen.height >= 1.0) {
        Some(screen) => LogicalSize::new(SIZE.width.min(screen.width), SIZE.height.min(screen.height)),
        None => SIZE,
    }
}

impl ApplicationHandler<Wake> for Desktop {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let Some(setup) = self.setup.take() else { return };
        match self.open(event_loop, setup) {
            Ok(sandbox) => {
                sandbox.window.request_redraw();
                self.sandbox = Some(sandbox);
            }
            Err(error) => self.fail(event_loop, error),
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if let (StartCause::ResumeTimeReached { .. }, Some(sandbox)) = (cause, self.usable()) {
            sandbox.window.request_redraw();
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, wake: Wake) {
        let Some(sandbox) = self.usable() else { return };
        match wake {
            Wake::Leave if sandbox.session.frame().unsaved.is_none() => event_loop.exit(),
            Wake::Leave => self.fail(event_loop, anyhow!("the program was asked to end from outside")),
            // Steps come at their own pace, pictures at the monitor's.
            Wake::Frame => event_loop.set_control_flow(sandbox.next(Duration::ZERO)),
            Wake::Access(event) => {
                sandbox.access(event.window_event);
                sandbox.window.request_redraw();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(sandbox) = self.sandbox.as_mut().filter(|_| self.failure.is_none()) else { return };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Destroyed => self.fail(event_loop, destroyed()),
            WindowEvent::RedrawRequested => match sandbox.redraw(event_loop, &mut self.timing) {
                Ok(next) => event_loop.set_control_flow(next),
                Err(error) => self.fail(event_loop, error),
            },
            event => sandbox.handle(&event, &mut self.timing),
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        // The device, the surface and the clipboard go before the display they live on.
        self.sandbox = None;
    }
}

/// The open window and all that lives with it.
struct Sandbox {
    // Dropped in this order: the surface before the window it draws to.
    screen: Screen,
    input: egui_winit::State,
    egui: egui::Context,
    shell: Shell,
    camera: Camera,
    session: Session,
    /// When the last picture was begun.
    drawn: Instant,
    title: String,
    window: Arc<Window>,
}

impl Sandbox {
    fn access(&mut self, event: accesskit_winit::WindowEvent) {
        match event {
            accesskit_winit::WindowEvent::InitialTreeRequested => self.egui.enable_accesskit(),
            accesskit_winit::WindowEvent::ActionRequested(request) => self.input.on_accesskit_action_request(request),
            accesskit_winit::WindowEvent::AccessibilityDeactivated => self.egui.disable_accesskit(),
        }
    }

    fn handle(&mut self, event: &WindowEvent, timing: &mut Timing) {
        match event {
            WindowEvent::Resized(size) => self.screen.resize([size.width, size.height]),
            WindowEvent::DroppedFile(path) => self.session.send(Command::OpenFile(path.clone())),
            WindowEvent::KeyboardInput { .. } | WindowEvent::CursorMoved { .. } | WindowEvent::MouseInput { .. } => {
                timing.input();
            }
            _ => {}
        }
        if self.input.on_window_event(&self.window, event).repaint {
            self.window.request_redraw();
        }
    }

    /// Shows the panels and draws the picture. Returns until when the loop may sleep.
    fn redraw(&mut self, event_loop: &ActiveEventLoop, timing: &mut Timing) -> anyhow::Result<ControlFlow> {
        let begun = Instant::now();
        let frame = self.session.frame();
        self.retitle(&frame);
        let input = self.input.take_egui_input(&self.window);
        let (mut output, shown) =
            show(&self.egui, input, &mut self.shell, &frame, &mut self.camera, self.screen.ranges());
        timing.panels(begun.elapsed());
        self.input.handle_platform_output_with_event_loop(
            &self.window,
            event_loop,
            std::mem::take(&mut output.platform_output),
        );
        for command in shown.commands {
            self.session.send(command);
        }
        if shown.quit {
            event_loop.exit();
        }
        if shown.full_screen {
            let full = self.window.fullscreen().is_none();
            self.window.set_fullscreen(full.then_some(Fullscreen::Borderless(None)));
        }
        let share = interpolation(&frame, frame.published.elapsed().as_secs_f64());
        let rival = frame.companions.rival.as_ref().and_then(|rival| rival.report().frame.clone());
        let pane = shown.rival.zip(rival);
        let view = View {
            frame: &frame,
            camera: &self.camera,
            options: &shown.view,
            share,
            canvas: shown.canvas,
            rival: pane.as_ref().map(|(canvas, frame)| (*canvas, &**frame)),
        };
        let delay =
            output.viewport_output.get(&egui::ViewportId::ROOT).map_or(Duration::MAX, |root| root.repaint_delay);
        self.drawn = begun;
        if !self.screen.draw(&self.egui, output, &view)? {
            return Ok(self.next(HIDDEN_DELAY.min(delay)));
        }
        timing.frame();
        let moving = frame.running && share < 1.0;
        Ok(self.next(if moving { Duration::ZERO } else { delay }))
    }

    /// Sleeps until `delay` has passed, but never draws faster than the monitor shows.
    fn next(&self, delay: Duration) -> ControlFlow {
        let monitor = self.window.current_monitor().and_then(|monitor| monitor.refresh_rate_millihertz());
        let refresh = monitor.map_or(USUAL_REFRESH, |millihertz| f64::from(millihertz) / 1e3).max(1.0);
        // A tenth early: where presenting waits for the monitor it sets the pace, and the timer must not miss a beat.
        let soonest = self.drawn + Duration::from_secs_f64(0.9 / refresh);
        match Instant::now().checked_add(delay) {
            Some(wanted) if delay < Duration::MAX => ControlFlow::WaitUntil(wanted.max(soonest)),
            _ => ControlFlow::Wait,
        }
    }

    fn retitle(&mut self, frame: &Frame) {
        let scene = &frame.scene;
        let name = if scene.title.is_empty() { &scene.name } else { &scene.title };
        if self.title != *name {
            self.title.clone_from(name);
            self.window.set_title(&format!("Tautline – {}", escaped(name)));
        }
    }
}

/// What is said of a window that another program, or the display, took away.
fn destroyed() -> anyhow::Error {
    anyhow!("the window was destroyed from outside")
}

/// What lies behind a failure: where the window is gone, that. winit asks the display for its size, and takes it for
/// granted that the display knows the window.
fn cause(window: &Window, failure: anyhow::Error) -> anyhow::Error {
    let (size, _) = quietly(|| window.inner_size());
    if size.is_some() { failure } else { destroyed() }
}

/// The scene that was read meanwhile.
pub(super) fn join(setup: JoinHandle<Result<Setup, SceneError>>) -> anyhow::Result<Setup> {
    let read = setup.join().map_err(|_| anyhow::anyhow!("reading the scene failed, which is a defect of Tautline"))?;
    Ok(read?)
}

/// One pass of the panels. egui may run it twice; the commands of both count, for the second sees no input.
pub(super) fn show(
    egui: &egui::Context,
    input: egui::RawInput,
    shell: &mut Shell,
    frame: &Arc<Frame>,
    camera: &mut Camera,
    ranges: crate::ui::Ranges,
) -> (egui::FullOutput, ShellOutput) {
    let mut shown: Option<ShellOutput> = None;
    let output = egui.run_ui(input, |ui| {
        let mut pass = shell.show(ui, frame, camera, ranges);
        if let Some(earlier) = shown.take() {
            pass.commands.splice(0..0, earlier.commands);
            pass.full_screen |= earlier.full_screen;
            pass.quit |= earlier.quit;
        }
        shown = Some(pass);
    });
    (output, shown.expect("egui runs at least one pass"))
}
