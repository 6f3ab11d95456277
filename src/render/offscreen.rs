//! Pictures without a window: a canvas of any size, read back and written as PNG.

use super::{Colour, Gpu, Picture, Renderer, Viewport};
use crate::file::{Sink, WriteError};
use crate::text::named;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Format of the off-screen target.
pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// A finished picture, row by row from the top, four bytes a pixel: red, green, blue, opacity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels of a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// 4 × width × height bytes.
    pub rgba: Vec<u8>,
}

/// Why there is no picture, or no file of it.
#[derive(Debug, thiserror::Error)]
pub enum OffscreenError {
    /// A side is 0, or more than the adapter can draw.
    #[error("a picture of {width} × {height} pixels cannot be drawn here: each side must be between 1 and {largest}")]
    Size {
        /// As asked for [pixels].
        width: u32,
        /// As asked for [pixels].
        height: u32,
        /// Largest side of a texture of this adapter [pixels].
        largest: u32,
    },
    /// Drawn, but not brought into memory; the reason in words.
    #[error("the picture could not be read back from the graphics adapter: {0}")]
    ReadBack(String),
    /// There is a picture, but no file of it.
    #[error("the picture could not be written to {}: {why}", named(path))]
    Write {
        /// Where it was to be.
        path: PathBuf,
        /// What is in the way, and how to mend it.
        why: WriteError,
    },
}

/// What a hook draws with: the device, the open encoder, and the target that holds the scene.
pub struct Canvas<'a> {
    /// The device that the picture is drawn with.
    pub gpu: &'a Gpu,
    /// Takes passes that come after the scene's own.
    pub encoder: &'a mut wgpu::CommandEncoder,
    /// The picture so far, of [`FORMAT`].
    pub target: &'a wgpu::TextureView,
}

/// Draws `picture` on its background, `more` in the same pass, lets `hook` draw over it, and reads the result back.
///
/// `renderer` must have been made for [`FORMAT`]. The viewport's target is the size of the picture.
pub fn render(
    gpu: &Gpu,
    renderer: &mut Renderer,
    picture: &Picture,
    viewport: &Viewport,
    more: impl FnOnce(&mut wgpu::RenderPass<'_>),
    hook: impl FnOnce(&mut Canvas<'_>),
) -> Result<Image, OffscreenError> {
    let [width, height] = viewport.target;
    let largest = gpu.device.limits().max_texture_dimension_2d;
    if !(1..=largest).contains(&width) || !(1..=largest).contains(&height) {
        return Err(OffscreenError::Size { width, height, largest });
    }
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let target = texture.create_view(&wgpu::TextureViewDescriptor::default());
    renderer.prepare(&gpu.device, &gpu.queue, picture, viewport);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("picture") });
    {
        let mut pass = begin_scene(&mut encoder, &target, picture.background());
        renderer.draw(&mut pass);
        more(&mut pass);
    }
    hook(&mut Canvas { gpu, encoder: &mut encoder, target: &target });
    read_back(gpu, encoder, &texture, size)
}

/// Begins a pass that clears `target` to the scene's background.
pub fn begin_scene<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    background: Colour,
) -> wgpu::RenderPass<'a> {
    let [r, g, b, a] = background.0.map(|channel| f64::from(channel) / 255.0);
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("scene"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..wgpu::RenderPassDescriptor::default()
    })
}

fn read_back(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    texture: &wgpu::Texture,
    size: wgpu::Extent3d,
) -> Result<Image, OffscreenError> {
    // Rows of a copy are padded to a multiple of 256 bytes.
    let row = 4 * size.width;
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: u64::from(padded) * u64::from(size.height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None };
    let destination = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), destination, size);
    gpu.queue.submit([encoder.finish()]);
    let (sender, receiver) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver lives until the mapping has been awaited below; if it is gone nobody wants the picture.
        let _ = sender.send(result);
    });
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(read_back_error)?;
    receiver.recv().map_err(read_back_error)?.map_err(read_back_error)?;
    let mapped = buffer.get_mapped_range(..).map_err(read_back_error)?;
    let mut rgba = Vec::with_capacity(row as usize * size.height as usize);
    for padded_row in mapped.chunks_exact(padded as usize) {
        rgba.extend_from_slice(&padded_row[..row as usize]);
    }
    Ok(Image { width: size.width, height: size.height, rgba })
}

fn read_back_error(error: impl std::fmt::Display) -> OffscreenError {
    OffscreenError::ReadBack(error.to_string())
}

impl Image {
    /// Red, green, blue and opacity at a pixel counted from the upper left corner; `None` outside.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        let inside = x < self.width && y < self.height;
        let first = 4 * (y as usize * self.width as usize + x as usize);
        inside.then(|| std::array::from_fn(|channel| self.rgba[first + channel]))
    }

    /// Writes a PNG, or says why it cannot.
    pub fn write_png(&self, path: &Path) -> Result<(), OffscreenError> {
        let failed = |why: WriteError| OffscreenError::Write { path: path.to_owned(), why };
        let mut bytes = Vec::new();
        self.encode(&mut bytes).map_err(|error| failed(std::io::Error::from(error).into()))?;
        let mut file = Sink::create(path).map_err(failed)?;
        file.write_all(&bytes).map_err(|error| failed(error.into()))?;
        file.commit().map_err(failed)
    }

    fn encode(&self, to: impl std::io::Write) -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(to, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.rgba)?;
        writer.finish()
    }
}
