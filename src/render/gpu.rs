//! The graphics device: found quickly, with errors that say in one line what is missing and how to mend it.

use std::sync::Arc;
use wgpu::Backends;

/// A graphics device with the queue that feeds it.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The way to the system's graphics interfaces; the window's surface belongs to it.
    pub instance: wgpu::Instance,
    /// The graphics card, or what draws in its place.
    pub adapter: wgpu::Adapter,
    /// Makes buffers, textures and pipelines.
    pub device: wgpu::Device,
    /// Takes uploads and command buffers, in order.
    pub queue: wgpu::Queue,
}

/// Why there is no graphics device.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// `WGPU_BACKEND` as it is set.
    #[error(
        "WGPU_BACKEND={0:?} names no graphics interface of this system: set it to vulkan or gl (on Windows dx12, on macOS metal), or unset it"
    )]
    UnknownBackend(String),
    /// No interface offers an adapter that can draw to the target.
    #[error(
        "no graphics adapter was found (tried {tried}): install a graphics driver; on Debian or Ubuntu the package mesa-vulkan-drivers (or libegl1, for OpenGL) also draws without a graphics card"
    )]
    NoAdapter {
        /// The interfaces that were asked, separated by commas.
        tried: String,
    },
    /// There is an adapter, but no device on it.
    #[error("the graphics adapter {adapter:?} refused to start: {reason}; update its driver, or try WGPU_BACKEND=gl")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// What the driver says.
        reason: String,
    },
    /// The adapter can draw, but not to the window.
    #[error("the graphics adapter {adapter:?} offers no picture format for this window; try WGPU_BACKEND=gl")]
    NoFormat {
        /// The adapter's name.
        adapter: String,
    },
}

/// What the window needs beside the device.
pub struct WindowSurface {
    /// What is drawn to; to be configured at every change of the window's size.
    pub surface: wgpu::Surface<'static>,
    /// A format that is not sRGB, as [`super::Renderer`] and egui want it, wherever the adapter has one.
    pub format: wgpu::TextureFormat,
}

impl Gpu {
    /// A device that draws off screen.
    pub fn headless() -> Result<Gpu, GpuError> {
        first_that_works(|backends| {
            let instance =
                wgpu::Instance::new(describe(backends, wgpu::InstanceDescriptor::new_without_display_handle()));
            let adapter = request_adapter(&instance, None)?;
            Some(open(instance, adapter))
        })
    }

    /// A device that draws to a window: `window` and `display` are handles of both, such as winit's `Arc<Window>` and
    /// `OwnedDisplayHandle`.
    pub fn for_window<W, D>(window: W, display: D) -> Result<(Gpu, WindowSurface), GpuError>
    where
        W: wgpu::rwh::HasWindowHandle + Clone + Send + Sync + 'static,
        D: wgpu::rwh::HasDisplayHandle + Clone + std::fmt::Debug + Send + Sync + 'static,
    {
        first_that_works(|backends| {
            let display = Box::new(display.clone());
            let descriptor = wgpu::InstanceDescriptor::new_with_display_handle(display);
            let instance = wgpu::Instance::new(describe(backends, descriptor));
            let surface = instance.create_surface(wgpu::SurfaceTarget::Window(Box::new(window.clone()))).ok()?;
            let adapter = request_adapter(&instance, Some(&surface))?;
            let formats = surface.get_capabilities(&adapter).formats;
            let format = formats.iter().find(|format| !format.is_srgb()).or(formats.first()).copied();
            Some(open(instance, adapter).and_then(|gpu| {
                let format = format.ok_or_else(|| GpuError::NoFormat { adapter: gpu.adapter.get_info().name })?;
                Ok((gpu, WindowSurface { surface, format }))
            }))
        })
    }
}

/// Tries the system's own interfaces first and OpenGL after them, each with an instance of its own: starting only one costs
/// half the time of starting both. `WGPU_BACKEND` narrows the choice. `None` from `start` means: nothing here, try the next.
fn first_that_works<T>(start: impl Fn(Backends) -> Option<Result<T, GpuError>>) -> Result<T, GpuError> {
    let available = wgpu::Instance::enabled_backend_features();
    let wanted = std::env::var("WGPU_BACKEND").unwrap_or_default();
    let allowed = if wanted.is_empty() { available } else { Backends::from_comma_list(&wanted) & available };
    if allowed.is_empty() {
        return Err(GpuError::UnknownBackend(wanted));
    }
    let choices = [allowed - Backends::GL, allowed & Backends::GL].into_iter().filter(|choice| !choice.is_empty());
    let mut last = Err(GpuError::NoAdapter { tried: tried(allowed) });
    for backends in choices {
        match start(backends) {
            Some(Ok(found)) => return Ok(found),
            Some(Err(error)) => last = Err(error),
            None => {}
        }
    }
    last
}

fn tried(backends: Backends) -> String {
    let names = [
        (Backends::VULKAN, "Vulkan"),
        (Backends::METAL, "Metal"),
        (Backends::DX12, "Direct3D 12"),
        (Backends::GL, "OpenGL"),
    ];
    let names: Vec<&str> = names.iter().filter(|(flag, _)| backends.contains(*flag)).map(|(_, name)| *name).collect();
    names.join(", ")
}

fn describe(backends: Backends, descriptor: wgpu::InstanceDescriptor) -> wgpu::InstanceDescriptor {
    wgpu::InstanceDescriptor {
        backends,
        // The driver's own validation is slow to start and complains of its absence; wgpu's is always on.
        flags: wgpu::InstanceFlags::empty().with_env(),
        ..descriptor
    }
}

fn request_adapter(instance: &wgpu::Instance, surface: Option<&wgpu::Surface<'_>>) -> Option<wgpu::Adapter> {
    let options = wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::from_env().unwrap_or_default(),
        compatible_surface: surface,
        ..wgpu::RequestAdapterOptions::default()
    };
    pollster::block_on(instance.request_adapter(&options)).ok()
}

fn open(instance: wgpu::Instance, adapter: wgpu::Adapter) -> Result<Gpu, GpuError> {
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("tautline"),
        required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
        memory_hints: wgpu::MemoryHints::MemoryUsage,
        ..wgpu::DeviceDescriptor::default()
    };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
        .map_err(|error| GpuError::NoDevice { adapter: adapter.get_info().name, reason: error.to_string() })?;
    // Without a handler wgpu panics; a picture that fails to draw is no reason to lose a running scene.
    device.on_uncaptured_error(Arc::new(|error| log::error!("drawing failed: {error}")));
    Ok(Gpu { instance, adapter, device, queue })
}
