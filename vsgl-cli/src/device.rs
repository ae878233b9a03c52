//! Which backend computes, and on what.

use crate::args::BackendName;
use crate::commands::count;
use crate::exit::Result;
use serde_json::{Value, json};
use std::time::Duration;
use vsgl_core::backend::Backend;
use vsgl_core::parity::Origin;
use vsgl_core::render::Phase;
use vsgl_cpu::CpuBackend;
use vsgl_wgpu::wgpu::AdapterInfo;
use vsgl_wgpu::{Clock, Survey, WgpuBackend, WgpuOptions, adapters, is_software};

/// Variable of the environment that names the adapter, by a part of its name.
pub const ADAPTER: &str = "VSGL_ADAPTER";

/// A backend as this program uses it.
pub trait Host: Backend {
    /// What it runs on, in words.
    fn device(&self) -> String;

    /// The adapter; nothing of the processor itself.
    fn adapter(&self) -> Option<Value>;

    /// Times of the phases by the device's own clock since the last call. None if phases are done when their calls
    /// return, so that the host's clock is right.
    ///
    /// # Errors
    /// If the device failed.
    fn times(&self) -> Result<Option<Vec<(Phase, Duration)>>>;

    /// Name and device, for comparisons.
    fn origin(&self) -> Origin {
        Origin::new(self.name(), self.device())
    }
}

impl Host for CpuBackend {
    fn device(&self) -> String {
        count(self.threads(), "thread")
    }

    fn adapter(&self) -> Option<Value> {
        None
    }

    fn times(&self) -> Result<Option<Vec<(Phase, Duration)>>> {
        Ok(None)
    }
}

impl Host for WgpuBackend {
    fn device(&self) -> String {
        let strict = if self.context().strict() {
            ", strict"
        } else {
            ""
        };
        format!("{}{strict}", adapter_text(self.context().info()))
    }

    fn adapter(&self) -> Option<Value> {
        Some(adapter_json(self.context().info()))
    }

    fn times(&self) -> Result<Option<Vec<(Phase, Duration)>>> {
        let times = self.timings()?;
        Ok(times
            .filter(|times| times.clock == Clock::Device)
            .map(|times| times.phases))
    }
}

/// A backend that was chosen.
#[derive(Debug)]
pub enum Chosen {
    /// The processor; if nobody asked for it by name, why.
    Cpu(CpuBackend, Option<String>),
    /// An adapter.
    Wgpu(Box<WgpuBackend>),
}

/// Takes the backend of this name.
///
/// `auto` takes a real GPU if there is one, else the processor: a software adapter would run on the same processor, only
/// slower.
///
/// # Errors
/// [`crate::exit::Failure::Device`] if there is no adapter where one was asked for.
pub fn choose(name: BackendName, threads: usize) -> Result<Chosen> {
    match name {
        BackendName::Cpu => Ok(Chosen::Cpu(CpuBackend::new(threads)?, None)),
        BackendName::Wgpu => Ok(Chosen::Wgpu(Box::new(open(wanted(), false)?))),
        BackendName::Auto => match real_gpu() {
            Ok(gpu) => Ok(Chosen::Wgpu(gpu)),
            Err(why) => Ok(Chosen::Cpu(CpuBackend::new(threads)?, Some(why))),
        },
    }
}

/// The adapter that the environment names.
pub fn wanted() -> Option<String> {
    std::env::var(ADAPTER).ok().filter(|name| !name.is_empty())
}

/// A device on the first adapter whose name holds `adapter`.
///
/// # Errors
/// [`crate::exit::Failure::Device`] if there is none, or it cannot be opened.
pub fn open(adapter: Option<String>, strict: bool) -> Result<WgpuBackend> {
    let options = WgpuOptions {
        adapter,
        strict,
        timing: true,
        ..WgpuOptions::default()
    };
    Ok(WgpuBackend::headless(&options)?)
}

/// A real GPU, or why there is none.
fn real_gpu() -> std::result::Result<Box<WgpuBackend>, String> {
    let wanted = wanted().map(|name| name.to_lowercase());
    let fits = |info: &AdapterInfo| {
        let name = info.name.to_lowercase();
        wanted.as_ref().is_none_or(|wanted| name.contains(wanted))
    };
    let found: Vec<_> = adapters().into_iter().filter(fits).collect();
    let Some(gpu) = found.iter().find(|info| !is_software(info)) else {
        return Err(match (found.first(), &wanted) {
            (Some(info), _) => format!("no GPU, only the software adapter {}", info.name),
            (None, Some(wanted)) => format!("no GPU whose name holds `{wanted}`, see {ADAPTER}"),
            (None, None) => "no GPU found".into(),
        });
    };
    let opened = open(Some(gpu.name.clone()), false);
    opened.map(Box::new).map_err(|e| e.to_string())
}

/// An adapter in words; a software adapter is called one.
pub fn adapter_text(info: &AdapterInfo) -> String {
    let mut text = format!("{}, {:?}", info.name, info.backend);
    for driver in [&info.driver, &info.driver_info] {
        if !driver.is_empty() {
            text += &format!(", {driver}");
        }
    }
    if is_software(info) {
        text += ": a software adapter";
    }
    text
}

/// An adapter for machines.
pub fn adapter_json(info: &AdapterInfo) -> Value {
    json!({
        "name": info.name,
        "api": format!("{:?}", info.backend),
        "driver": info.driver,
        "driver_info": info.driver_info,
        "type": format!("{:?}", info.device_type),
        "software": is_software(info),
    })
}

/// What an adapter can do, in words.
pub fn abilities_text(survey: &Survey) -> String {
    let limits = &survey.limits;
    let mebibytes = |bytes: u64| bytes >> 20;
    format!(
        "buffers up to {} MiB, {} MiB in one binding, {} storage buffers a stage, workgroups of {} with {} B, {}, {}",
        mebibytes(limits.max_buffer_size),
        mebibytes(limits.max_storage_buffer_binding_size),
        limits.max_storage_buffers_per_shader_stage,
        limits.max_compute_invocations_per_workgroup,
        limits.max_compute_workgroup_storage_size,
        if survey.timestamps {
            "own clock"
        } else {
            "no clock of its own"
        },
        if survey.strict {
            "strict mode"
        } else {
            "no strict mode"
        },
    )
}

/// An adapter with what it can do, for machines.
pub fn survey_json(survey: &Survey) -> Value {
    let limits = &survey.limits;
    let mut adapter = adapter_json(&survey.info);
    adapter["timestamps"] = survey.timestamps.into();
    adapter["strict"] = survey.strict.into();
    adapter["limits"] = json!({
        "max_buffer_size": limits.max_buffer_size,
        "max_storage_buffer_binding_size": limits.max_storage_buffer_binding_size,
        "max_storage_buffers_per_shader_stage": limits.max_storage_buffers_per_shader_stage,
        "max_compute_workgroup_storage_size": limits.max_compute_workgroup_storage_size,
        "max_compute_invocations_per_workgroup": limits.max_compute_invocations_per_workgroup,
        "max_compute_workgroups_per_dimension": limits.max_compute_workgroups_per_dimension,
    });
    adapter
}
