//! One picture without a window: the canvas as the sandbox shows it, or the whole sandbox.

use super::desktop::show;
use super::panels::Panels;
use super::screen::{Beside as BesideView, View, viewport};
use crate::app::{Beside, Camera, Frame, frame_after};
use crate::engine::DVec2;
use crate::render::offscreen::{self, FORMAT};
use crate::render::{Gpu, Image, Picture, Renderer};
use crate::scene::Setup;
use crate::ui::{Ranges, Shell, ShellOutput, Theme};
use egui_wgpu::ScreenDescriptor;
use std::path::PathBuf;
use std::sync::Arc;

/// What to draw, and where to.
#[derive(Clone, Debug, PartialEq)]
pub struct ShotOptions {
    /// Simulated time of the picture [s].
    pub at: f64,
    /// Width and height [px].
    pub size: [u32; 2],
    /// The PNG file to write.
    pub path: PathBuf,
    /// The light theme in place of the dark one.
    pub light: bool,
    /// The panels as well as the canvas.
    pub whole_window: bool,
    /// What is shown beside the simulation.
    pub beside: Beside,
}

/// Passes that egui needs until every panel has its size and the view fits the canvas.
const PASSES: u32 = 4;

/// Steps `setup` to the time asked for and writes one picture of it.
///
/// # Errors
/// If the run diverges before that time, there is no graphics adapter, the size cannot be drawn, or the file cannot be written.
pub fn shot(setup: Setup, options: &ShotOptions) -> anyhow::Result<()> {
    let frame = frame_after(setup, options.at, &options.beside);
    if let Some(fault) = &frame.fault {
        anyhow::bail!("{fault}");
    }
    draw(&frame, options)?.write_png(&options.path)?;
    Ok(())
}

/// The picture of a frame.
pub fn draw(frame: &Arc<Frame>, options: &ShotOptions) -> anyhow::Result<Image> {
    let gpu = Gpu::headless()?;
    let mut picture = Picture::new();
    let mut panels = Panels::new(&gpu.device, FORMAT);
    let egui = egui::Context::default();
    let mut shell = Shell::new();
    let state = shell.state_mut();
    state.panels = options.whole_window;
    state.view.ghost = options.beside.truth;
    state.rival = options.beside.rival.is_some();
    state.rival_method = options.beside.rival;
    state.theme = if options.light { Theme::Light } else { Theme::Dark };
    shell.prepare(&egui);
    let [width, height] = options.size.map(|side| side as f32);
    let mut camera =
        Camera { centre: DVec2::ZERO, scale: 100.0, size: DVec2::new(f64::from(width), f64::from(height)) };
    let mut pass = |time: u32, picture: &mut Picture| -> (egui::FullOutput, ShellOutput) {
        let screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, height)));
        // Far enough apart that whatever fades in has done so.
        let input = egui::RawInput { screen_rect, time: Some(f64::from(time)), ..egui::RawInput::default() };
        let ranges = Ranges { tension: picture.tension_range(), speed: picture.speed_range() };
        let (mut output, shown) = show(&egui, input, &mut shell, frame, &mut camera, ranges);
        panels.update(&gpu, &mut output.textures_delta);
        panels.free(&mut output.textures_delta);
        picture.build(frame, &camera, &shown.view, 1.0);
        (output, shown)
    };
    for time in 1..PASSES {
        let (output, _) = pass(time, &mut picture);
        output.drop_without_applying_deltas();
    }
    let (mut output, shown) = pass(PASSES, &mut picture);
    let primitives = egui.tessellate(std::mem::take(&mut output.shapes), 1.0);
    let mut scene = Renderer::new(&gpu.device, FORMAT);
    let screen = ScreenDescriptor { size_in_pixels: options.size, pixels_per_point: 1.0 };
    let place = viewport(shown.canvas, options.size, 1.0);
    let rival = frame.companions.rival.as_ref().and_then(|rival| rival.report().frame.clone());
    let pane = shown.rival.zip(rival);
    let beside = pane.as_ref().map(|(canvas, rival)| {
        let view = View {
            frame,
            camera: &camera,
            options: &shown.view,
            share: 1.0,
            canvas: shown.canvas,
            rival: Some((*canvas, &**rival)),
        };
        let mut beside = BesideView::new(&gpu.device, FORMAT);
        beside.prepare(&gpu, &view, &picture, options.size, 1.0);
        beside
    });
    let more = |pass: &mut wgpu::RenderPass<'_>| beside.iter().for_each(|beside| beside.draw(pass));
    let image = offscreen::render(&gpu, &mut scene, &picture, &place, more, |canvas| {
        panels.paint(canvas.gpu, canvas.encoder, canvas.target, &primitives, &screen);
    })?;
    Ok(image)
}
