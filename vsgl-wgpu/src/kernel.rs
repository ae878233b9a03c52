//! Compute pipelines: one for each entry and set of constants, made once.

use crate::shaders::link;
use crate::strict;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex};
use wgpu::naga::back::{pipeline_constants, spv};
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
use wgpu::naga::{self, AddressSpace, ShaderStage};

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
        let source = link(&[id.file]);
        let parsed = naga::front::wgsl::parse_str(&source)
            .map_err(|e| format!("{label}: {}", e.emit_to_string(&source)))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&parsed)
            .map_err(|e| format!("{label}: {}", e.emit_to_string(&source)))?;
        let globals = globals(&parsed, &info, &[id.entry])?;
        let entries: Vec<wgpu::BindGroupLayoutEntry> = globals
            .iter()
            .map(|(_, binding, kind)| wgpu::BindGroupLayoutEntry {
                binding: *binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: *kind,
                count: None,
            })
            .collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(&label),
            entries: &entries,
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&label),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let (module, constants): (_, &[(&str, f64)]) = if is_strict {
            let values = id
                .constants
                .iter()
                .map(|&(n, v)| (n.to_owned(), v))
                .collect();
            let entry = Some((ShaderStage::Compute, id.entry));
            let (resolved, info) =
                pipeline_constants::process_overrides(&parsed, &info, entry, &values)
                    .map_err(|e| format!("{label}: {e}"))?;
            let map = binding_map(&globals);
            (
                strict::module(device, &label, &resolved, &info, id.entry, &map)?,
                &[],
            )
        } else {
            let descriptor = wgpu::ShaderModuleDescriptor {
                label: Some(&label),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            };
            (device.create_shader_module(descriptor), &id.constants)
        };
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&label),
            layout: Some(&pipeline_layout),
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
            layout,
            bindings: globals
                .into_iter()
                .map(|(name, binding, _)| (name, binding))
                .collect(),
        })
    }
}

/// Name, number and kind of what entry points bind in group 0, in order of the numbers.
pub(crate) fn globals(
    module: &naga::Module,
    info: &naga::valid::ModuleInfo,
    entries: &[&str],
) -> Result<Vec<(String, u32, wgpu::BindingType)>, String> {
    let mut used = Vec::new();
    for entry in entries {
        let index = module.entry_points.iter().position(|e| e.name == *entry);
        let index = index.ok_or_else(|| format!("no entry point `{entry}`"))?;
        used.push(info.get_entry_point(index));
    }
    let mut globals = Vec::new();
    for (handle, variable) in module.global_variables.iter() {
        let (Some(binding), Some(name)) = (variable.binding, variable.name.clone()) else {
            continue;
        };
        if used.iter().any(|used| !used[handle].is_empty()) {
            globals.push((name, binding.binding, kind(module, variable)?));
        }
    }
    globals.sort_by_key(|(_, binding, _)| *binding);
    Ok(globals)
}

fn kind(
    module: &naga::Module,
    variable: &naga::GlobalVariable,
) -> Result<wgpu::BindingType, String> {
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    match variable.space {
        AddressSpace::Uniform => Ok(buffer(wgpu::BufferBindingType::Uniform)),
        AddressSpace::Storage { access } => Ok(buffer(wgpu::BufferBindingType::Storage {
            read_only: !access.contains(naga::StorageAccess::STORE),
        })),
        _ => texture(&module.types[variable.ty].inner)
            .ok_or_else(|| format!("binding of an unexpected kind: {:?}", variable.name)),
    }
}

/// Textures of two dimensions, and arrays of them, that are read texel by texel or stored to. Of floats none is filtered, so
/// that formats that cannot be, and depth, are accepted.
fn texture(kind: &naga::TypeInner) -> Option<wgpu::BindingType> {
    let naga::TypeInner::Image {
        dim: naga::ImageDimension::D2,
        arrayed,
        class,
    } = *kind
    else {
        return None;
    };
    let view_dimension = if arrayed {
        wgpu::TextureViewDimension::D2Array
    } else {
        wgpu::TextureViewDimension::D2
    };
    let sample_type = match class {
        naga::ImageClass::Sampled {
            kind: naga::ScalarKind::Uint,
            multi: false,
        } => wgpu::TextureSampleType::Uint,
        naga::ImageClass::Sampled {
            kind: naga::ScalarKind::Float,
            multi: false,
        } => wgpu::TextureSampleType::Float { filterable: false },
        naga::ImageClass::Storage { format, access } if access == naga::StorageAccess::STORE => {
            return Some(wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format: match format {
                    naga::StorageFormat::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
                    naga::StorageFormat::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
                    _ => return None,
                },
                view_dimension,
            });
        }
        _ => return None,
    };
    Some(wgpu::BindingType::Texture {
        sample_type,
        view_dimension,
        multisampled: false,
    })
}

/// wgpu numbers the bindings of a layout from 0 without gaps; words that it does not translate must do the same.
fn binding_map(globals: &[(String, u32, wgpu::BindingType)]) -> spv::BindingMap {
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
