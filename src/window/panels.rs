//! The panels on the graphics device: what egui drew, painted over the scene.

use crate::render::Gpu;
use egui::epaint::textures::TexturesDelta;
use egui_wgpu::{RendererOptions, ScreenDescriptor};

/// egui's textures and buffers on the device.
pub struct Panels {
    renderer: egui_wgpu::Renderer,
}

impl Panels {
    /// For targets of `format`, which should not be an sRGB format.
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Panels {
        // Nothing of ours is an image that dithering or a filter would improve; pictures stay the same on every machine.
        Panels { renderer: egui_wgpu::Renderer::new(device, format, RendererOptions::PREDICTABLE) }
    }

    /// Takes over new and changed textures. Due on every pass of egui, painted or not.
    pub fn update(&mut self, gpu: &Gpu, delta: &mut TexturesDelta) {
        for (id, images) in delta.set.drain() {
            for image in images {
                self.renderer.update_texture(&gpu.device, &gpu.queue, id, &image);
            }
        }
    }

    /// Paints over what `target` holds.
    pub fn paint(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        primitives: &[egui::ClippedPrimitive],
        screen: &ScreenDescriptor,
    ) {
        let uploads = self.renderer.update_buffers(&gpu.device, &gpu.queue, encoder, primitives, screen);
        gpu.queue.submit(uploads);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("panels"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        self.renderer.render(&mut pass.forget_lifetime(), primitives, screen);
    }

    /// Gives back textures that are no longer used. Due after painting.
    pub fn free(&mut self, delta: &mut TexturesDelta) {
        for id in delta.free.drain() {
            self.renderer.free_texture(&id);
        }
    }
}
