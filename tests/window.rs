//! The real window, under a display of its own: drawn, dragged, saved, closed, and what is said where none can be opened.
//!
//! Needs Xvfb, xdotool and ImageMagick. Without them the tests that open a window are skipped with a printed reason, unless
//! `TAUTLINE_REQUIRE_DISPLAY=1` forbids it.
#![cfg(all(feature = "desktop", target_os = "linux"))]

use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Long enough for a loaded machine that draws in software; a test that waits this long has failed.
const PATIENCE: Duration = Duration::from_secs(60);

/// One particle at rest in the middle, without gravity.
const ONE_PARTICLE: &str = "(
    version: 1,
    title: \"One particle\",
    view: (centre: (0.0, 0.0), height: 10.0),
    settings: (gravity: (0.0, 0.0)),
    bodies: [Particle(position: (0.0, 0.0), radius: 0.5)],
)";

/// A rope with so many sweeps that a step takes far longer than a picture.
const OVERLOAD: &str = "(
    version: 1,
    title: \"Overload\",
    settings: (substeps: 40, iterations: 100000),
    generators: [Rope(name: \"rope\", from: (0.0, 0.0), to: (20.0, 0.0), links: 200)],
)";

/// An X server that ends with the test.
struct Display {
    server: Child,
    name: String,
    /// One window at a time: several at once, drawn in software, would only measure each other.
    _turn: MutexGuard<'static, ()>,
}

impl Display {
    /// A server on a free display; `None`, with the reason printed, where it cannot be had and need not be.
    fn start() -> Option<Display> {
        Display::of_size("1280x800")
    }

    /// The same with a screen of this many pixels.
    fn of_size(size: &str) -> Option<Display> {
        let missing = ["Xvfb", "xdotool", "import"].into_iter().find(|tool| !on_path(tool));
        if let Some(tool) = missing {
            let required = std::env::var("TAUTLINE_REQUIRE_DISPLAY").is_ok_and(|value| value == "1");
            assert!(!required, "{tool} is missing, and TAUTLINE_REQUIRE_DISPLAY=1 forbids to skip the window's tests");
            println!("skipped: {tool} is not installed (Debian: xvfb xdotool imagemagick)");
            return None;
        }
        static TURN: Mutex<()> = Mutex::new(());
        // A test that failed has left nothing behind that would matter to the next.
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        // Numbers of our own: two test runs that both take the first free one can remove each other's sockets.
        let own = std::process::id() % 50_000;
        (0..10)
            .find_map(|attempt| {
                let name = format!(":{}", 100 + (own + 997 * attempt) % 50_000);
                serve(&name, size).map(|server| (server, name))
            })
            .map(|(server, name)| Display { server, name, _turn: turn })
            .or_else(|| panic!("Xvfb does not start"))
    }

    /// What a tool prints.
    fn run(&self, tool: &str, arguments: &[&str]) -> Vec<u8> {
        let done = Command::new(tool).args(arguments).env("DISPLAY", &self.name).output();
        done.unwrap_or_else(|error| panic!("{tool}: {error}")).stdout
    }

    fn xdotool(&self, arguments: &str) -> String {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        String::from_utf8_lossy(&self.run("xdotool", &arguments)).trim().to_owned()
    }

    /// The screen as it is now.
    fn picture(&self) -> Picture {
        Picture::from_ppm(&self.run("import", &["-window", "root", "-depth", "8", "ppm:-"]))
    }

    /// Drags with the left button in small steps, as a hand would.
    fn drag(&self, from: [i32; 2], to: [i32; 2]) {
        self.xdotool(&format!("mousemove {} {}", from[0], from[1]));
        std::thread::sleep(Duration::from_millis(200));
        self.xdotool("mousedown 1");
        for step in 1..=10 {
            let at = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * step / 10);
            self.xdotool(&format!("mousemove {} {}", at[0], at[1]));
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

/// An X server that answers under this name; `None` if it ends, because the name is taken, say.
fn serve(name: &str, size: &str) -> Option<Child> {
    // It must not start anew, and refuse a client meanwhile, each time that a tool was the only client.
    let screen = format!("{size}x24");
    let arguments = [name, "-noreset", "-screen", "0", &screen, "-nolisten", "tcp"];
    let mut server = Command::new("Xvfb").args(arguments).stderr(Stdio::null()).spawn().expect("Xvfb starts");
    let answers = || {
        let mut question = Command::new("xdotool");
        question.arg("getmouselocation").env("DISPLAY", name).stdout(Stdio::null()).stderr(Stdio::null());
        question.status().is_ok_and(|status| status.success())
    };
    while server.try_wait().expect("a child can be asked").is_none() {
        if answers() {
            return Some(server);
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    None
}

impl Drop for Display {
    fn drop(&mut self) {
        // Both only fail if the server has ended by itself.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

fn on_path(tool: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(tool).is_file())
}

/// A screenshot.
struct Picture {
    width: usize,
    rgb: Vec<u8>,
}

impl Picture {
    /// From the binary PPM that `import` writes: "P6", width, height and 255 in words, then the pixels.
    fn from_ppm(bytes: &[u8]) -> Picture {
        let mut words = bytes.splitn(4, u8::is_ascii_whitespace);
        assert_eq!(words.next(), Some(&b"P6"[..]), "import wrote no picture");
        let mut number = || -> usize {
            let word = words.next().and_then(|word| std::str::from_utf8(word).ok());
            word.and_then(|word| word.parse().ok()).expect("a number in the header")
        };
        let (width, height) = (number(), number());
        Picture { width, rgb: bytes[bytes.len() - 3 * width * height..].to_vec() }
    }

    fn pixel(&self, x: usize, y: usize) -> [u8; 3] {
        let first = 3 * (y * self.width + x);
        [self.rgb[first], self.rgb[first + 1], self.rgb[first + 2]]
    }

    /// The right end of the first run of the accent colour below the top bar in the panel on the right: a slider's handle.
    fn first_slider(&self) -> Option<[i32; 2]> {
        let accent = |x: usize, y: usize| {
            let [r, g, b] = self.pixel(x, y);
            b > 200 && r < 120 && g < 190
        };
        (60..780).find_map(|y| {
            let right = (1000..1270).rev().find(|&x| accent(x, y))?;
            ((right - 8)..right).all(|x| accent(x, y)).then_some([right as i32 + 4, y as i32 + 1])
        })
    }
}

/// The sandbox, running.
struct Sandbox<'a> {
    display: &'a Display,
    process: Child,
    window: String,
}

impl Sandbox<'_> {
    /// Opens a scene in a folder of its own and waits for its first picture.
    fn open<'a>(display: &'a Display, folder: &Path, scene: &str) -> Sandbox<'a> {
        std::fs::write(folder.join("scene.ron"), scene).expect("writable");
        let mut process = Command::new(env!("CARGO_BIN_EXE_tautline"));
        process.args(["open", "./scene.ron"]).current_dir(folder).stderr(Stdio::piped());
        process.env("DISPLAY", &display.name).env("TAUTLINE_TIMING", "1").env("XDG_RUNTIME_DIR", folder);
        process.env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        let process = process.spawn().expect("the program starts");
        let mut sandbox = Sandbox { display, process, window: String::new() };
        sandbox.wait("the window", |s| {
            s.window = s.display.xdotool("search --name Tautline");
            !s.window.is_empty()
        });
        sandbox.wait("the first picture", |s| s.display.picture().pixel(400, 20) != [0, 0, 0]);
        // Without a window manager nobody else gives it the keyboard.
        sandbox.display.xdotool(&format!("windowfocus --sync {}", sandbox.window));
        sandbox
    }

    fn wait(&mut self, what: &str, mut there: impl FnMut(&mut Self) -> bool) {
        let begin = Instant::now();
        while !there(self) {
            assert!(begin.elapsed() < PATIENCE, "waited {PATIENCE:?} for {what}");
            let ended = self.process.try_wait().expect("a child can be asked");
            if ended.is_some() {
                panic!("the program ended ({ended:?}) while the test waited for {what}: {}", self.printed());
            }
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    fn key(&self, key: &str) {
        self.display.xdotool(&format!("key {key}"));
        std::thread::sleep(Duration::from_millis(200));
    }

    fn title(&self) -> String {
        self.display.xdotool(&format!("getwindowname {}", self.window))
    }

    /// Saves the scene as it stands and returns it.
    fn saved(&mut self, folder: &Path) -> tautline::scene::Setup {
        let path = folder.join("my scene.ron");
        // It may not have been saved before.
        let _ = std::fs::remove_file(&path);
        self.key("ctrl+s");
        self.key("Return");
        self.wait("the file to be saved", |_| path.exists());
        tautline::scene::open(&path).expect("what was saved can be read")
    }

    /// Closes the window by its shortcut; how it ended, and what it printed.
    fn close(self) -> (ExitStatus, String) {
        self.key("ctrl+q");
        self.ended()
    }

    /// Waits for its end; how it ended, and what it printed.
    fn ended(mut self) -> (ExitStatus, String) {
        let mut status = None;
        let begin = Instant::now();
        while status.is_none() {
            assert!(begin.elapsed() < PATIENCE, "the window does not close");
            std::thread::sleep(Duration::from_millis(50));
            status = self.process.try_wait().expect("a child can be asked");
        }
        (status.expect("the loop has ended"), self.printed())
    }

    /// What it has printed on standard error; to be asked once, after its end.
    fn printed(&mut self) -> String {
        let mut printed = String::new();
        let mut pipe = self.process.stderr.take().expect("it was piped");
        pipe.read_to_string(&mut printed).expect("messages are text");
        printed
    }
}

impl Drop for Sandbox<'_> {
    fn drop(&mut self) {
        // After a failed assertion; otherwise it has ended.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

#[test]
fn a_user_drags_a_particle_changes_a_slider_and_the_scene_and_closes_the_window() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut sandbox = Sandbox::open(&display, folder.path(), ONE_PARTICLE);
    sandbox.wait("the title", |s| s.title().ends_with("One particle"));

    // Without the panels the particle lies in the middle of the screen, 80 pixels a metre.
    sandbox.key("Tab");
    sandbox.key("Home");
    let empty = display.picture().pixel(860, 330);
    sandbox.wait("the particle in the middle", |s| s.display.picture().pixel(650, 410) != empty);
    display.drag([640, 400], [840, 320]);
    sandbox.wait("the particle to follow", |s| s.display.picture().pixel(850, 330) != empty);
    display.xdotool("mouseup 1");
    let picture = display.picture();
    assert_eq!(picture.pixel(650, 415), empty, "the particle has left the middle");

    sandbox.key("p");
    let dragged = sandbox.saved(folder.path()).world;
    let position = dragged.bodies().position[0];
    println!("dragged to {position}");
    // 200 and −80 pixels at 80 a metre; half a metre covers the way it drifted after it was let go.
    assert!((position - tautline::engine::DVec2::new(2.5, 1.0)).length() < 0.5, "{position}");

    let slider = display.picture().first_slider().expect("the panel on the right has sliders");
    display.drag(slider, [slider[0] + 30, slider[1]]);
    display.xdotool("mouseup 1");
    let gravity = sandbox.saved(folder.path()).world.gravity();
    println!("gravity by the first slider: {gravity}");
    assert!(gravity.x > 0.1, "the slider changed nothing: {gravity}");

    sandbox.key("bracketright");
    sandbox.wait("another scene", |s| !s.title().ends_with("One particle"));
    let (status, printed) = sandbox.close();
    assert_eq!(status.code(), Some(0), "{printed}");
    println!("{printed}");
}

#[test]
fn what_is_typed_at_once_after_a_shortcut_goes_into_the_field_that_it_opens() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut sandbox = Sandbox::open(&display, folder.path(), ONE_PARTICLE);
    sandbox.wait("the title", |s| s.title().ends_with("One particle"));
    // Letters of the first text are shortcuts of the scene: a tool, pause, restart, the next tool.
    for (shortcut, text, title) in
        [("ctrl+k", "exact double", "Exact double pendulum"), ("ctrl+o", "newtons cr", "Newton's cradle")]
    {
        let keys = ["key", shortcut, "type", "--delay", "30", "--args", "1", text, "key", "Return"];
        display.run("xdotool", &keys);
        sandbox.wait(title, |s| s.title().ends_with(title));
    }
    display.run("xdotool", &["key", "ctrl+s", "type", "--delay", "30", "--args", "1", "typed.ron", "key", "Return"]);
    let path = folder.path().join("typed.ron");
    sandbox.wait("the file", |_| path.exists());
    let (status, printed) = sandbox.close();
    assert_eq!(status.code(), Some(0), "{printed}");
}

#[test]
fn a_window_never_opens_larger_than_the_screen_and_small_it_is_usable() {
    let Some(display) = Display::of_size("800x600") else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut sandbox = Sandbox::open(&display, folder.path(), ONE_PARTICLE);
    let geometry = display.xdotool(&format!("getwindowgeometry {}", sandbox.window));
    assert!(geometry.contains("Geometry: 800x600"), "{geometry}");
    // The panels make way for the scene: the particle of 1 m is there, and can be dragged.
    sandbox.key("p");
    let before = sandbox.saved(folder.path()).world.bodies().position[0];
    sandbox.key("p");
    display.drag([508, 280], [560, 240]);
    display.xdotool("mouseup 1");
    let after = sandbox.saved(folder.path()).world.bodies().position[0];
    assert!(after.distance(before) > 0.2, "{before} became {after}");
    sandbox.close();
}

#[test]
fn a_paused_window_uses_no_processor_time() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let sandbox = Sandbox::open(&display, folder.path(), ONE_PARTICLE);
    sandbox.key("p");
    // What fades in after a change of focus has done so.
    std::thread::sleep(Duration::from_secs(2));
    let before = cpu_ticks(sandbox.process.id());
    std::thread::sleep(Duration::from_secs(5));
    let used = cpu_ticks(sandbox.process.id()) - before;
    println!("paused for 5 s: {used} ticks of 10 ms");
    // 1 % of five seconds.
    assert!(used <= 5, "{used} ticks of 10 ms in 5 s");
    sandbox.close();
}

/// Processor time of a process, user and system [clock ticks of 10 ms].
fn cpu_ticks(process: u32) -> u64 {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).expect("the process runs");
    let fields = stat.rsplit_once(") ").expect("the name ends").1;
    fields.split(' ').skip(11).take(2).map(|ticks| ticks.parse::<u64>().expect("a number")).sum()
}

#[test]
fn the_window_answers_while_a_step_takes_far_too_long() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let sandbox = Sandbox::open(&display, folder.path(), OVERLOAD);
    for step in 0..40 {
        display.xdotool(&format!("mousemove {} {}", 400 + 10 * step, 300 + 5 * step));
        std::thread::sleep(Duration::from_millis(50));
    }
    let (status, printed) = sandbox.close();
    println!("{printed}");
    assert_eq!(status.code(), Some(0), "{printed}");
    let line = printed.lines().find(|line| line.starts_with("input to frame")).expect("times are printed");
    let median = line.split("median ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a figure");
    let median: f64 = median.parse().expect("a number");
    // A step takes many seconds. A picture takes 0.05 s in software, and several times that on two cores that also run the
    // step and other programs: the window waits for the picture alone.
    assert!(median < 1000.0, "{line}");
}

#[test]
fn a_window_that_is_destroyed_from_outside_leaves_what_was_not_saved() {
    let Some(display) = Display::start() else { return };
    for (edits, running) in [(true, true), (true, false), (false, true)] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut sandbox = Sandbox::open(&display, folder.path(), ONE_PARTICLE);
        sandbox.wait("the title", |s| s.title().ends_with("One particle"));
        if edits {
            // Another particle, where the pointer is.
            display.xdotool("mousemove 500 300");
            sandbox.key("1");
            display.xdotool("click 1");
            std::thread::sleep(Duration::from_millis(500));
        }
        if !running {
            sandbox.key("p");
        }
        display.xdotool(&format!("windowclose {}", sandbox.window));
        let (status, printed) = sandbox.ended();
        println!("{printed}");
        let lines: Vec<&str> = printed.lines().filter(|line| line.starts_with("error: ")).collect();
        assert!(status.code() == Some(1) && !printed.contains("panicked"), "{status:?}: {printed}");
        assert!(lines.len() == 1 && lines[0].contains("the window was destroyed from outside"), "{printed}");
        let rescued = folder.path().join("scene.rescued.ron");
        assert_eq!(rescued.exists(), edits, "{printed}");
        assert_eq!(lines[0].ends_with("is in ./scene.rescued.ron"), edits, "{printed}");
        if edits {
            let kept = tautline::scene::open(&rescued).expect("what was kept can be read");
            assert_eq!((kept.world.bodies().len(), kept.title.as_str()), (2, "One particle"));
        }
        let own = std::fs::read_to_string(folder.path().join("scene.ron")).expect("the scene");
        assert_eq!(own, ONE_PARTICLE, "the user's own file stays as it was");
    }
}

#[test]
fn a_program_that_is_asked_to_end_leaves_what_was_not_saved() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder");
    for edits in [false, true] {
        let mut sandbox = Sandbox::open(&display, folder.path(), ONE_PARTICLE);
        sandbox.wait("the title", |s| s.title().ends_with("One particle"));
        if edits {
            display.xdotool("mousemove 500 300");
            sandbox.key("1");
            display.xdotool("click 1");
            std::thread::sleep(Duration::from_millis(500));
        }
        let asked = Command::new("kill").args(["-TERM", &sandbox.process.id().to_string()]).status().expect("kill");
        assert!(asked.success());
        let (status, printed) = sandbox.ended();
        assert_eq!(status.code(), Some(i32::from(edits)), "{printed}");
        assert_eq!(folder.path().join("scene.rescued.ron").exists(), edits, "{printed}");
    }
}

/// What the program prints on standard error, and its exit code, without a display unless `display` names one.
fn fails(display: Option<&str>, scene: Option<&str>) -> (String, Option<i32>) {
    let mut program = Command::new(env!("CARGO_BIN_EXE_tautline"));
    program.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
    if let Some(display) = display {
        program.env("DISPLAY", display);
    }
    if let Some(scene) = scene {
        program.args(["open", scene]);
    }
    let output = program.output().expect("the program starts");
    (String::from_utf8_lossy(&output.stderr).into_owned(), output.status.code())
}

#[test]
fn without_a_display_there_is_one_clear_line_and_exit_code_1() {
    for display in [None, Some(":12345")] {
        let (printed, code) = fails(display, None);
        println!("{printed}");
        assert_eq!(code, Some(1), "{printed}");
        assert_eq!(printed.lines().count(), 1, "{printed}");
        assert!(printed.contains("no window can be opened"), "{printed}");
        assert!(!printed.contains(".rs:"), "a place in some source is of no use to a user: {printed}");
    }
}

#[test]
fn without_an_adapter_there_is_one_clear_line_and_exit_code_1() {
    let Some(display) = Display::start() else { return };
    let mut program = Command::new(env!("CARGO_BIN_EXE_tautline"));
    // No driver is found where the loader is told to look for none.
    program.env("DISPLAY", &display.name).env("WGPU_BACKEND", "vulkan").env("VK_DRIVER_FILES", "/nowhere.json");
    program.env("VK_ICD_FILENAMES", "/nowhere.json").env_remove("WAYLAND_DISPLAY");
    let output = program.output().expect("the program starts");
    let printed = String::from_utf8_lossy(&output.stderr);
    println!("{printed}");
    assert_eq!(output.status.code(), Some(1), "{printed}");
    assert!(printed.contains("no graphics adapter was found"), "{printed}");
}

#[test]
fn a_scene_that_cannot_be_opened_is_named_before_any_window() {
    let (printed, code) = fails(None, Some("no_such_scene"));
    println!("{printed}");
    assert_eq!(code, Some(1));
    assert!(printed.contains("no_such_scene"), "{printed}");
}
