//! The pipeline of one kind of mark, with the buffer that holds the marks.

use super::marks::{BoxMark, DiscMark, LineMark, MarkKind, SpringMark};
use std::ops::Range;

/// Vertices of the quad that each mark is drawn in, a strip of two triangles.
const QUAD: Range<u32> = 0..4;
/// Smallest buffer [bytes]: enough for a few hundred marks.
const SMALLEST_BUFFER: u64 = 16 * 1024;

/// One kind's pipeline and instances.
pub(super) struct MarkPipeline {
    pipeline: wgpu::RenderPipeline,
    instances: wgpu::Buffer,
}

impl MarkPipeline {
    pub(super) fn new(
        device: &wgpu::Device,
        view: &wgpu::BindGroupLayout,
        format: wgpu::TextureFormat,
        kind: MarkKind,
    ) -> MarkPipeline {
        let (label, source, stride, attributes) = description(kind);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &[Some(view)],
            immediate_size: 0,
        });
        let buffer =
            wgpu::VertexBufferLayout { array_stride: stride, step_mode: wgpu::VertexStepMode::Instance, attributes };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(buffer)],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format,
                    blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        MarkPipeline { pipeline, instances: instance_buffer(device, SMALLEST_BUFFER) }
    }

    /// Replaces the instances. The buffer at least doubles when it is too small, so that it is seldom replaced.
    pub(super) fn upload(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, bytes: &[u8]) {
        let needed = bytes.len() as u64;
        if needed > self.instances.size() {
            self.instances = instance_buffer(device, needed.max(2 * self.instances.size()));
        }
        if needed > 0 {
            queue.write_buffer(&self.instances, 0, bytes);
        }
    }

    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, marks: Range<u32>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_vertex_buffer(0, self.instances.slice(..));
        pass.draw(QUAD, marks);
    }
}

fn instance_buffer(device: &wgpu::Device, size: u64) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("marks"),
        size,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Label, shader, bytes an instance, and the fields of an instance in the order in which its structure declares them.
fn description(kind: MarkKind) -> (&'static str, String, u64, &'static [wgpu::VertexAttribute]) {
    const DISC: [wgpu::VertexAttribute; 7] = wgpu::vertex_attr_array![
        0 => Float32x2, 1 => Float32, 2 => Float32, 3 => Float32x2, 4 => Float32, 5 => Unorm8x4, 6 => Unorm8x4];
    const LINE: [wgpu::VertexAttribute; 5] =
        wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Float32, 3 => Uint32, 4 => Unorm8x4];
    const SPRING: [wgpu::VertexAttribute; 5] =
        wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Float32x3, 3 => Float32, 4 => Unorm8x4];
    const BOX: [wgpu::VertexAttribute; 7] = wgpu::vertex_attr_array![
        0 => Float32x2, 1 => Float32x2, 2 => Float32, 3 => Float32, 4 => Unorm8x4, 5 => Unorm8x4, 6 => Unorm8x4];
    let (label, body, stride, attributes): (_, _, _, &'static [wgpu::VertexAttribute]) = match kind {
        MarkKind::Disc => ("disc", include_str!("../../shaders/disc.wgsl"), size_of::<DiscMark>(), &DISC),
        MarkKind::Line => ("line", include_str!("../../shaders/line.wgsl"), size_of::<LineMark>(), &LINE),
        MarkKind::Spring => ("spring", include_str!("../../shaders/spring.wgsl"), size_of::<SpringMark>(), &SPRING),
        MarkKind::Box => ("block", include_str!("../../shaders/block.wgsl"), size_of::<BoxMark>(), &BOX),
    };
    let source = [include_str!("../../shaders/view.wgsl"), body].join("\n");
    (label, source, stride as u64, attributes)
}
