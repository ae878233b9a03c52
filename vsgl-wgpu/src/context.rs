//! The device, and what all phases share on it.

use crate::drawing::{Drawing, DrawingId, Drawings};
use crate::kernel::{Constant, Kernel, KernelId, Kernels};
use crate::pool::{Pool, Pooled};
use crate::raster::{Targets, TargetsKept};
use crate::recorder::Uniforms;
use crate::res::WgpuRes;
use crate::timing::{Timer, Timings};
use crate::{passes, raster};
use std::sync::{Arc, Mutex, OnceLock};
use vsgl_core::data::SceneData;
use vsgl_core::plan::Plan;
use vsgl_core::settings::Primary;
use vsgl_core::{Error, Result};
use wgpu::{Device, DeviceType, Queue};

/// How a device is taken and used.
#[derive(Clone, Debug, Default)]
pub struct WgpuOptions {
    /// Forbid the driver to rearrange float arithmetic, so that results can be compared bit by bit. Vulkan only, and slower
    /// on real GPUs: for tests.
    pub strict: bool,
    /// Measure the time of each phase.
    pub timing: bool,
    /// Part of the adapter's name, in any case of letters; the first adapter that has it is taken.
    pub adapter: Option<String>,
    /// Ask for the least limits that WebGPU promises, and no more, whatever the adapter has.
    pub least_limits: bool,
}

/// The adapters of this machine, best first: real GPUs, then others, then software.
pub fn adapters() -> Vec<wgpu::AdapterInfo> {
    found().iter().map(wgpu::Adapter::get_info).collect()
}

/// An adapter, and what it can do that matters here.
#[derive(Clone, Debug)]
pub struct Survey {
    /// What it says about itself.
    pub info: wgpu::AdapterInfo,
    /// Its limits.
    pub limits: wgpu::Limits,
    /// Whether it can measure its own time.
    pub timestamps: bool,
    /// Whether [`WgpuOptions::strict`] works on it.
    pub strict: bool,
}

/// All adapters in the order of [`adapters`], with their abilities.
pub fn survey() -> Vec<Survey> {
    let look = |adapter: &wgpu::Adapter| Survey {
        info: adapter.get_info(),
        limits: adapter.limits(),
        timestamps: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY),
        strict: can_be_strict(adapter),
    };
    found().iter().map(look).collect()
}

/// Strict mode hands the driver SPIR-V of our own.
fn can_be_strict(adapter: &wgpu::Adapter) -> bool {
    adapter.get_info().backend == wgpu::Backend::Vulkan
        && adapter
            .features()
            .contains(wgpu::Features::PASSTHROUGH_SHADERS)
}

/// Whether an adapter is a program on the processor, such as lavapipe or SwiftShader.
pub fn is_software(info: &wgpu::AdapterInfo) -> bool {
    info.device_type == DeviceType::Cpu || info.name.contains("SwiftShader")
}

fn found() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    let instance = wgpu::Instance::new(descriptor);
    let mut all = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    all.sort_by_key(|adapter| {
        let info = adapter.get_info();
        match info.device_type {
            _ if is_software(&info) => 4,
            DeviceType::DiscreteGpu => 0,
            DeviceType::IntegratedGpu => 1,
            DeviceType::VirtualGpu => 2,
            _ => 3,
        }
    });
    all
}

const REMEDY: &str = "install a Vulkan driver (on Debian or Ubuntu the software driver is `apt-get install \
                      mesa-vulkan-drivers libvulkan1`), or use `--backend cpu`";

/// The device and what is made on it once.
#[derive(Debug)]
pub struct Context {
    device: Device,
    queue: Queue,
    info: wgpu::AdapterInfo,
    strict: bool,
    kernels: Kernels,
    drawings: Drawings,
    raster: TargetsKept,
    pool: Arc<Pool>,
    uniforms: Uniforms,
    timer: Option<Timer>,
    failure: Arc<Mutex<Option<String>>>,
    /// A scene that blocks nothing, once a host needs it.
    nothing: OnceLock<WgpuRes<SceneData>>,
    /// The submission that [`Self::wait_but_one`] waits for next.
    last: Mutex<Option<wgpu::SubmissionIndex>>,
}

impl Context {
    /// A device of our own.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if there is none, or none of the wanted name; [`Error::Device`] if it cannot be opened.
    pub fn headless(options: &WgpuOptions) -> Result<Self> {
        let wanted = options.adapter.as_ref().map(|name| name.to_lowercase());
        let all = found();
        let names: Vec<String> = all.iter().map(|a| a.get_info().name).collect();
        let adapter = all.into_iter().find(|adapter| {
            let name = adapter.get_info().name.to_lowercase();
            wanted.as_ref().is_none_or(|wanted| name.contains(wanted))
        });
        let Some(adapter) = adapter else {
            return Err(Error::NoAdapter {
                problem: match &options.adapter {
                    Some(wanted) if !names.is_empty() => {
                        format!("none is called `{wanted}`; there are: {}", names.join(", "))
                    }
                    _ => "no graphics driver was found".into(),
                },
                remedy: REMEDY.into(),
            });
        };
        let info = adapter.get_info();
        let mut features = wgpu::Features::empty();
        if options.timing {
            features |= adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
        }
        if options.strict {
            if !can_be_strict(&adapter) {
                return Err(Error::Device {
                    device: info.name,
                    problem: "strict mode needs Vulkan".into(),
                    remedy: "leave it out, or choose a Vulkan adapter".into(),
                });
            }
            features |= wgpu::Features::PASSTHROUGH_SHADERS;
        }
        let mut limits = wgpu::Limits::default();
        if !options.least_limits {
            let most = adapter.limits();
            limits.max_buffer_size = most.max_buffer_size;
            limits.max_storage_buffer_binding_size = most.max_storage_buffer_binding_size;
        }
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("vsgl"),
            required_features: features,
            required_limits: limits,
            memory_hints: wgpu::MemoryHints::Performance,
            ..Default::default()
        };
        let opened = pollster::block_on(adapter.request_device(&descriptor));
        let (device, queue) = opened.map_err(|e| Error::Device {
            device: info.name.clone(),
            problem: e.to_string(),
            remedy: REMEDY.into(),
        })?;
        let context = Self::new(device, queue, options)?;
        context.watch();
        Ok(context)
    }

    /// On the device of a host, which keeps it.
    ///
    /// With `strict` the device must have [`wgpu::Features::PASSTHROUGH_SHADERS`]; with `timing` times come from the
    /// device only if it has [`wgpu::Features::TIMESTAMP_QUERY`].
    ///
    /// # Errors
    /// [`Error::Device`] if it lacks what `options` need.
    pub fn new(device: Device, queue: Queue, options: &WgpuOptions) -> Result<Self> {
        let info = device.adapter_info();
        if options.strict
            && !device
                .features()
                .contains(wgpu::Features::PASSTHROUGH_SHADERS)
        {
            return Err(Error::Device {
                device: info.name,
                problem: "strict mode needs the feature PASSTHROUGH_SHADERS".into(),
                remedy: "ask for it when the device is requested, or leave strict mode out".into(),
            });
        }
        Ok(Self {
            kernels: Kernels::default(),
            drawings: Drawings::default(),
            raster: TargetsKept::default(),
            pool: Arc::new(Pool::default()),
            uniforms: Uniforms::new(&device),
            timer: options.timing.then(|| Timer::new(&device, &queue)),
            failure: Arc::default(),
            nothing: OnceLock::new(),
            last: Mutex::default(),
            strict: options.strict,
            info,
            device,
            queue,
        })
    }

    /// Keeps what goes wrong on our own device, instead of the panic that wgpu would make of it.
    fn watch(&self) {
        let keep = |failure: Arc<Mutex<Option<String>>>| {
            move |problem: String| {
                if let Ok(mut first) = failure.lock() {
                    first.get_or_insert(problem);
                }
            }
        };
        let store = keep(self.failure.clone());
        self.device
            .on_uncaptured_error(Arc::new(move |error: wgpu::Error| store(error.to_string())));
        let store = keep(self.failure.clone());
        self.device
            .set_device_lost_callback(move |reason, message| {
                store(format!("the device was lost ({reason:?}): {message}"));
            });
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Its queue.
    pub fn queue(&self) -> &Queue {
        &self.queue
    }

    /// What is known of the adapter.
    pub fn info(&self) -> &wgpu::AdapterInfo {
        &self.info
    }

    /// Whether drivers are kept from rearranging arithmetic.
    pub fn strict(&self) -> bool {
        self.strict
    }

    /// Buffers made since the start: a steady frame makes none.
    pub fn buffers_made(&self) -> u64 {
        self.pool.made()
    }

    /// Time of each phase since the last call; none unless asked for when it was made. Waits for the device.
    ///
    /// # Errors
    /// [`Error::Device`] if it failed.
    pub fn timings(&self) -> Result<Option<Timings>> {
        let Some(timer) = &self.timer else {
            return Ok(None);
        };
        self.wait()?;
        let taken = timer.take(&self.device, &self.queue);
        self.check()?;
        taken
            .map(Some)
            .map_err(|problem| self.error(problem, "try again, or use `--backend cpu`"))
    }

    /// Pipelines made since the start.
    pub fn pipelines_made(&self) -> usize {
        self.kernels.made()
    }

    /// Makes sure that a few more passes can be timed.
    pub(crate) fn make_room_for_times(&self) -> Result<()> {
        let made = self
            .timer
            .as_ref()
            .map_or(Ok(()), |timer| timer.make_room(&self.device, &self.queue));
        made.map_err(|problem| self.error(problem, "try again, or use `--backend cpu`"))
    }

    pub(crate) fn timer(&self) -> Option<&Timer> {
        self.timer.as_ref()
    }

    pub(crate) fn uniforms(&self) -> &Uniforms {
        &self.uniforms
    }

    /// The pipeline of an entry with its constants.
    pub(crate) fn kernel(
        &self,
        file: &'static str,
        entry: &'static str,
        constants: &[Constant],
    ) -> Result<Arc<Kernel>> {
        self.made(&KernelId::new(file, entry, constants))
    }

    fn made(&self, id: &KernelId) -> Result<Arc<Kernel>> {
        let made = self.kernels.get(&self.device, self.strict, id);
        made.map_err(|problem| self.error(problem, "report it, with the adapter's name and driver"))
    }

    /// A scene that blocks nothing: no box to enter, and one triangle for ids to name.
    pub(crate) fn nothing(&self) -> Result<&WgpuRes<SceneData>> {
        if self.nothing.get().is_none() {
            let scene = SceneData {
                corner: vec![[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]],
                ..SceneData::default()
            };
            // If another thread was faster, its scene is as good.
            let _ = self.nothing.set(WgpuRes::upload(self, &scene)?);
        }
        Ok(self.nothing.get().expect("it was set"))
    }

    /// The render pipeline of a file of shaders for a target.
    pub(crate) fn drawing(&self, id: &DrawingId) -> Result<Arc<Drawing>> {
        let made = self.drawings.get(&self.device, id);
        made.map_err(|problem| self.error(problem, "report it, with the adapter's name and driver"))
    }

    /// The textures that triangle ids are drawn into.
    pub(crate) fn raster_targets(&self, width: u32, height: u32) -> Result<Arc<Targets>> {
        let targets = self.raster.get(&self.device, width, height);
        targets
            .map_err(|problem| self.error(problem, "take a smaller picture, or `--primary rays`"))
    }

    /// Makes every pipeline that a plan needs, so that its first frame need not wait for compilers.
    ///
    /// # Errors
    /// [`Error::Device`] if the driver refuses one.
    pub fn prepare(&self, plan: &Plan) -> Result<()> {
        for id in passes::kernels(plan) {
            self.made(&id)?;
        }
        if plan.gbuffer.primary == Primary::Raster {
            self.drawing(&raster::ID)?;
        }
        Ok(())
    }

    /// A storage buffer of so many bytes, from the pool.
    ///
    /// # Errors
    /// [`Error::Device`] if it is larger than a binding may be, or memory is out.
    pub(crate) fn buffer(&self, what: &str, bytes: u64) -> Result<Pooled> {
        let limits = self.device.limits();
        let most = limits
            .max_buffer_size
            .min(limits.max_storage_buffer_binding_size);
        if bytes > most {
            return Err(self.error(
                format!("{what} needs {bytes} bytes in one binding, and it has {most}"),
                "take fewer pixels, texels or triangles, or use `--backend cpu`",
            ));
        }
        self.pool.take(&self.device, bytes).map_err(|problem| {
            self.error(
                format!("{what}: {problem}"),
                "take fewer pixels, texels or lights, or use `--backend cpu`",
            )
        })
    }

    pub(crate) fn error(&self, problem: impl Into<String>, remedy: &str) -> Error {
        Error::Device {
            device: self.info.name.clone(),
            problem: problem.into(),
            remedy: remedy.into(),
        }
    }

    /// What has gone wrong on our own device since it was opened.
    ///
    /// # Errors
    /// [`Error::Device`] with the first failure.
    pub fn check(&self) -> Result<()> {
        let failure = self.failure.lock().ok().and_then(|f| f.clone());
        failure.map_or(Ok(()), |problem| {
            Err(self.error(
                problem,
                "try again, take a smaller picture, or use `--backend cpu`",
            ))
        })
    }

    /// Waits until at most the last submission is still at work, so that at most two are under way.
    pub(crate) fn wait_but_one(&self) -> Result<()> {
        let mut last = self.last.lock().expect("no panic while it is held");
        let before = last.replace(self.queue.submit([]));
        let Some(before) = before else { return Ok(()) };
        let waited = self.device.poll(wgpu::PollType::Wait {
            submission_index: Some(before),
            timeout: None,
        });
        self.check()?;
        waited
            .map(|_| ())
            .map_err(|e| self.error(e.to_string(), "try again, or use `--backend cpu`"))
    }

    /// Waits until the device has done all that was submitted.
    ///
    /// # Errors
    /// [`Error::Device`] if it failed or was lost.
    pub fn wait(&self) -> Result<()> {
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check()?;
        waited
            .map(|_| ())
            .map_err(|e| self.error(e.to_string(), "try again, or use `--backend cpu`"))
    }
}
