//! The window's surface: the scene and the panels over it, brought to the screen.

use super::panels::Panels;
use crate::app::{Camera, Frame};
use crate::render::{Gpu, Picture, Renderer, ViewOptions, Viewport, offscreen};
use crate::ui::Ranges;
use anyhow::Context;
use egui_wgpu::ScreenDescriptor;
use std::sync::Arc;
use wgpu::CurrentSurfaceTexture as Current;
use winit::event_loop::OwnedDisplayHandle;
use winit::window::Window;

/// What the scene's picture is made of.
pub struct View<'a> {
    pub frame: &'a Frame,
    pub camera: &'a Camera,
    pub options: &'a ViewOptions,
    /// How far between the last two states, 0 … 1.
    pub share: f64,
    /// Where the canvas lies [points].
    pub canvas: egui::Rect,
    /// The same scene under another method, and where it lies.
    pub rival: Option<(egui::Rect, &'a Frame)>,
}

/// A second picture beside the first, seen by the same camera. It keeps its memory while there is one.
pub struct Beside {
    scene: Renderer,
    picture: Picture,
}

impl Beside {
    /// For targets of `format`.
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Beside {
        Beside { scene: Renderer::new(device, format), picture: Picture::new() }
    }

    /// Builds the picture of `view`'s rival with the ranges of `first`, and uploads it.
    pub fn prepare(&mut self, gpu: &Gpu, view: &View<'_>, first: &Picture, size: [u32; 2], scale: f32) {
        let Some((canvas, frame)) = view.rival else { return };
        // At another step it is shown as it is: between its own last two it would be later still.
        let share = if frame.world.tick() == view.frame.world.tick() { view.share } else { 1.0 };
        self.picture.borrow_ranges(first);
        let options = ViewOptions { extra: Vec::new(), grip: None, ..view.options.clone() };
        self.picture.build(frame, view.camera, &options, share);
        self.scene.prepare(&gpu.device, &gpu.queue, &self.picture, &viewport(canvas, size, scale));
    }

    /// Draws what was prepared last.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.scene.draw(pass);
    }
}

/// The surface, the device and what is drawn with them.
pub struct Screen {
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    scene: Renderer,
    picture: Picture,
    beside: Option<Beside>,
    panels: Panels,
    gpu: Gpu,
    window: Arc<Window>,
}

impl Screen {
    /// Sets up the device for a window.
    ///
    /// # Errors
    /// If there is no graphics adapter, or none that can draw to this window.
    pub fn new(window: Arc<Window>, display: OwnedDisplayHandle) -> anyhow::Result<Screen> {
        let (gpu, found) = Gpu::for_window(window.clone(), display)?;
        let size = window.inner_size();
        let mut config = found
            .surface
            .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
            .context("the graphics adapter cannot draw to this window")?;
        config.format = found.format;
        config.present_mode = wgpu::PresentMode::AutoVsync;
        // The answer to an input is the next frame but one at the latest.
        config.desired_maximum_frame_latency = 1;
        found.surface.configure(&gpu.device, &config);
        let scene = Renderer::new(&gpu.device, config.format);
        let panels = Panels::new(&gpu.device, config.format);
        Ok(Screen { surface: found.surface, config, scene, picture: Picture::new(), beside: None, panels, gpu, window })
    }

    /// Longest side of a texture [px].
    pub fn max_texture_side(&self) -> usize {
        self.gpu.device.limits().max_texture_dimension_2d as usize
    }

    /// The ranges of the picture's legends.
    pub fn ranges(&self) -> Ranges {
        Ranges { tension: self.picture.tension_range(), speed: self.picture.speed_range() }
    }

    /// The window has another size [px].
    pub fn resize(&mut self, size: [u32; 2]) {
        let largest = self.gpu.device.limits().max_texture_dimension_2d;
        [self.config.width, self.config.height] = size.map(|side| side.clamp(1, largest));
        self.surface.configure(&self.gpu.device, &self.config);
    }

    /// Draws the scene and the panels over it. `false` if the screen takes no frame now.
    pub fn draw(
        &mut self,
        egui: &egui::Context,
        mut output: egui::FullOutput,
        view: &View<'_>,
    ) -> anyhow::Result<bool> {
        self.panels.update(&self.gpu, &mut output.textures_delta);
        let texture = self.texture()?;
        let drawn = texture.is_some();
        if let Some(texture) = texture {
            let scale = output.pixels_per_point;
            let primitives = egui.tessellate(std::mem::take(&mut output.shapes), scale);
            self.paint(&texture, &primitives, view, scale);
            self.window.pre_present_notify();
            self.gpu.queue.present(texture);
        }
        self.panels.free(&mut output.textures_delta);
        Ok(drawn)
    }

    fn paint(
        &mut self,
        texture: &wgpu::SurfaceTexture,
        primitives: &[egui::ClippedPrimitive],
        view: &View<'_>,
        scale: f32,
    ) {
        let size = [self.config.width, self.config.height];
        let gpu = &self.gpu;
        self.picture.build(view.frame, view.camera, view.options, view.share);
        self.scene.prepare(&gpu.device, &gpu.queue, &self.picture, &viewport(view.canvas, size, scale));
        match view.rival {
            Some(_) => {
                let beside = self.beside.get_or_insert_with(|| Beside::new(&gpu.device, self.config.format));
                beside.prepare(gpu, view, &self.picture, size, scale);
            }
            None => self.beside = None,
        }
        let target = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("window") });
        {
            let mut pass = offscreen::begin_scene(&mut encoder, &target, self.picture.background());
            self.scene.draw(&mut pass);
            self.beside.iter().for_each(|beside| beside.draw(&mut pass));
        }
        let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point: scale };
        self.panels.paint(gpu, &mut encoder, &target, primitives, &screen);
        gpu.queue.submit([encoder.finish()]);
    }

    /// The next texture of the surface. One that was lost or has become unfit is set up anew, once.
    fn texture(&mut self) -> anyhow::Result<Option<wgpu::SurfaceTexture>> {
        for _ in 0..2 {
            match self.surface.get_current_texture() {
                Current::Success(texture) | Current::Suboptimal(texture) => return Ok(Some(texture)),
                Current::Timeout | Current::Occluded => return Ok(None),
                Current::Lost => {
                    let window = self.window.clone();
                    self.surface = self.gpu.instance.create_surface(window).context("the screen was lost")?;
                }
                Current::Outdated | Current::Validation => {}
            }
            self.surface.configure(&self.gpu.device, &self.config);
        }
        Ok(None)
    }
}

/// The canvas on a target of `size` [px].
pub fn viewport(canvas: egui::Rect, size: [u32; 2], pixels_per_point: f32) -> Viewport {
    let pixels = |points: f32| points * pixels_per_point;
    Viewport {
        corner: [pixels(canvas.min.x), pixels(canvas.min.y)],
        size: [pixels(canvas.width()), pixels(canvas.height())],
        target: size,
        pixels_per_point,
    }
}
