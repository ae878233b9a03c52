//! Compute pipelines: one for each entry and set of constants, made once.

use crate::linked::{Global, Linked};
use crate::strict;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex};
use wgpu::naga::back::{pipeline_constants, spv};
use wgpu::naga::{self, ShaderStage};

/// Invocations of a workgroup that takes one item each.
pub(crate) const INVOCATIONS: u32 = 64;

/// Value of an `override` constant; `bool` as 0 or 1.
pub type Constant = (&'static str, f64);

/// What makes a pipeline: a file of shaders, an entry point in it, and constants.
#[derive(Clone, Debug, PartialEq)]
pub struct KernelId {
    /// The file, such as `entry/shade`; [`crate::link`] gives its text.
    pub file: &'static str,
    /// The function marked `@compute`.
    pub entry: &'static str,
    /// Values of its `override` constants.
    pub constants: Vec<Constant>,
}

impl KernelId {
    pub(crate) fn new(file: &'static str, entry: &'static str, constants: &[Constant]) -> Self {
        Self {
            file,
            entry,
            constants: constants.to_vec(),
        }
    }
}

/// A pipeline and the names of what it binds.
#[derive(Debug)]
pub(crate) struct Kernel {
    pub(crate) label: String,
    pub(crate) pipeline: wgpu::ComputePipeline,
    pub(crate) layout: wgpu::BindGroupLayout,
    /// Name and number of each binding.
    pub(crate) bindings: Vec<(String, u32)>,
}

/// All pipelines made so far.
#[derive(Debug, Default)]
pub(crate) struct Kernels {
    made: Mutex<HashMap<String, Arc<Kernel>>>,
}

impl Kernels {
    /// How many were made.
    pub(crate) fn made(&self) -> usize {
        self.made.lock().map_or(0, |made| made.len())
    }

    /// The pipeline, made now if it was not yet.
    pub(crate) fn get(
        &self,
        device: &wgpu::Device,
        is_strict: bool,
        id: &KernelId,
    ) -> Result<Arc<Kernel>, String> {
        let key = label(id);
        let mut made = self.made.lock().expect("no panic while it is held");
        if let Some(kernel) = made.get(&key) {
            return Ok(kernel.clone());
        }
        let kernel = Arc::new(Kernel::new(device, is_strict, id)?);
        made.insert(key, kernel.clone());
        Ok(kernel)
    }
}

fn label(id: &KernelId) -> String {
    let mut label = format!("{}:{}", id.file, id.entry);
    for (name, value) in &id.constants {
        label.push_str(&format!(" {name}={value}"));
    }
    label
}

impl Kernel {
    fn new(device: &wgpu::Device, is_strict: bool, id: &KernelId) -> Result<Self, String> {
        let label = label(id);
        let shader = Linked::new(
            device,
            &label,
            id.file,
            &[id.entry],
            wgpu::ShaderStages::COMPUTE,
        )?;
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let (module, constants): (_, &[(&str, f64)]) = if is_strict {
            let values = id
                .constants
                .iter()
                .map(|&(n, v)| (n.to_owned(), v))
                .collect();
            let entry = Some((ShaderStage::Compute, id.entry));
            let (resolved, info) =
                pipeline_constants::process_overrides(&shader.module, &shader.info, entry, &values)
                    .map_err(|e| format!("{label}: {e}"))?;
            let map = binding_map(&shader.globals);
            (
                strict::module(device, &label, &resolved, &info, id.entry, &map)?,
                &[],
            )
        } else {
            let descriptor = wgpu::ShaderModuleDescriptor {
                label: Some(&label),
                source: wgpu::ShaderSource::Wgsl(shader.source.as_str().into()),
            };
            (device.create_shader_module(descriptor), &id.constants)
        };
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&label),
            layout: Some(&shader.pipeline_layout),
            module: &module,
            entry_point: Some(id.entry),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants,
                ..Default::default()
            },
            cache: None,
        });
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(format!("{label}: {error}"));
        }
        Ok(Self {
            label,
            pipeline,
            bindings: shader.bindings(),
            layout: shader.layout,
        })
    }
}

/// wgpu numbers the bindings of a layout from 0 without gaps; words that it does not translate must do the same.
fn binding_map(globals: &[Global]) -> spv::BindingMap {
    let mut map = BTreeMap::new();
    for (place, (_, binding, _)) in globals.iter().enumerate() {
        map.insert(
            naga::ResourceBinding {
                group: 0,
                binding: *binding,
            },
            spv::BindingInfo {
                descriptor_set: 0,
                binding: place as u32,
                binding_array_size: None,
            },
        );
    }
    map
}
