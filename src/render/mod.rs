//! Pictures of the scene. A [`Picture`] is built from a frame and a camera on the processor; a [`Renderer`] draws it with
//! one pipeline per kind of mark, every mark as an anti-aliased signed distance in an instanced quad.
//!
//! Colours are blended in sRGB with premultiplied alpha, as egui's are: the target must not have an sRGB format.

mod bodies;
pub mod colour;
pub mod ghost;
pub mod gpu;
pub mod grid;
pub mod legend;
mod links;
pub mod marks;
pub mod offscreen;
pub mod options;
mod overlays;
pub mod picture;
mod pipeline;
mod pose;
mod surroundings;
mod trails;
mod view;

pub use colour::{Colour, Palette, Theme, viridis};
pub use gpu::{Gpu, GpuError};
pub use grid::{GridLabel, GridStep, ScaleBar};
pub use legend::SteadyRange;
pub use offscreen::{Image, OffscreenError};
pub use options::{Extra, ViewOptions};
pub use picture::{FORCE_TICK, Picture, VELOCITY_ARROW};

use bytemuck::{Pod, Zeroable};
use marks::MarkKind;
use pipeline::MarkPipeline;

/// Where on a target the canvas lies, in physical pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Upper left corner of the canvas [px].
    pub corner: [f32; 2],
    /// Size of the canvas [px].
    pub size: [f32; 2],
    /// Size of the whole target [px].
    pub target: [u32; 2],
    /// Physical pixels a point (the scale factor).
    pub pixels_per_point: f32,
}

impl Viewport {
    /// A canvas that fills its target.
    pub fn whole(target: [u32; 2], pixels_per_point: f32) -> Viewport {
        Viewport { corner: [0.0; 2], size: target.map(|side| side as f32), target, pixels_per_point }
    }

    /// The canvas's pixels that lie on the target: x, y, width, height; `None` if there are none.
    fn scissor(&self) -> Option<[u32; 4]> {
        let side = |axis: usize| {
            let limit = self.target[axis] as f32;
            let low = self.corner[axis].round().clamp(0.0, limit);
            let high = (self.corner[axis] + self.size[axis]).round().clamp(0.0, limit);
            (low as u32, (high - low) as u32)
        };
        let ((x, width), (y, height)) = (side(0), side(1));
        (width > 0 && height > 0).then_some([x, y, width, height])
    }
}

/// What `view.wgsl` calls `View`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct ViewUniform {
    origin: [f32; 2],
    target_size: [f32; 2],
    half_size: [f32; 2],
    pixels_per_point: f32,
    padding: f32,
}

/// The pipelines, their buffers, and what was uploaded last.
pub struct Renderer {
    uniform: wgpu::Buffer,
    bindings: wgpu::BindGroup,
    /// In the order of [`MarkKind`].
    pipelines: [MarkPipeline; 4],
    draws: Vec<picture::Draw>,
    scissor: Option<[u32; 4]>,
}

impl Renderer {
    /// Creates every pipeline for targets of `format`, which should not be an sRGB format.
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Renderer {
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("view"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("view"),
            size: size_of::<ViewUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("view"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        let pipelines = [MarkKind::Disc, MarkKind::Line, MarkKind::Spring, MarkKind::Box]
            .map(|kind| MarkPipeline::new(device, &layout, format, kind));
        Renderer { uniform, bindings, pipelines, draws: Vec::new(), scissor: None }
    }

    /// Uploads a picture. What was prepared last is what [`Renderer::draw`] draws.
    pub fn prepare(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, picture: &Picture, viewport: &Viewport) {
        let middle = |axis: usize| viewport.corner[axis] + viewport.size[axis] / 2.0;
        let view = ViewUniform {
            origin: [middle(0), middle(1)],
            target_size: viewport.target.map(|side| side as f32),
            half_size: viewport.size.map(|side| side / 2.0),
            pixels_per_point: viewport.pixels_per_point,
            padding: 0.0,
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&view));
        for (pipeline, bytes) in self.pipelines.iter_mut().zip(picture.instances()) {
            pipeline.upload(device, queue, bytes);
        }
        self.draws.clear();
        self.draws.extend_from_slice(picture.draws());
        self.scissor = viewport.scissor();
    }

    /// Draws the prepared picture over what the pass holds, inside the canvas only.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some([x, y, width, height]) = self.scissor else {
            return;
        };
        pass.set_scissor_rect(x, y, width, height);
        pass.set_bind_group(0, &self.bindings, &[]);
        for draw in &self.draws {
            self.pipelines[draw.kind as usize].draw(pass, draw.marks.clone());
        }
    }
}
