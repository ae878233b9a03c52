//! A file of shaders, ready to make pipelines of: linked, validated, and its bindings read from it.

use crate::shaders::link;
use wgpu::naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use wgpu::naga::{self, AddressSpace};

/// Name, number and kind of a binding of group 0.
pub(crate) type Global = (String, u32, wgpu::BindingType);

/// A shader with the layout of what some of its entry points bind.
pub(crate) struct Linked {
    pub(crate) source: String,
    pub(crate) module: naga::Module,
    pub(crate) info: ModuleInfo,
    /// What the entry points bind, in order of the numbers.
    pub(crate) globals: Vec<Global>,
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) pipeline_layout: wgpu::PipelineLayout,
}

impl Linked {
    /// From a file and the entry points that one pipeline uses, in stages that may see the bindings.
    pub(crate) fn new(
        device: &wgpu::Device,
        label: &str,
        file: &str,
        entries: &[&str],
        visibility: wgpu::ShaderStages,
    ) -> Result<Self, String> {
        let source = link(&[file]);
        let module = naga::front::wgsl::parse_str(&source)
            .map_err(|e| format!("{label}: {}", e.emit_to_string(&source)))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .map_err(|e| format!("{label}: {}", e.emit_to_string(&source)))?;
        let globals = globals(&module, &info, entries)?;
        let of = |(_, binding, kind): &Global| wgpu::BindGroupLayoutEntry {
            binding: *binding,
            visibility,
            ty: *kind,
            count: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &globals.iter().map(of).collect::<Vec<_>>(),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        Ok(Self {
            source,
            module,
            info,
            globals,
            layout,
            pipeline_layout,
        })
    }

    /// Name and number of each binding.
    pub(crate) fn bindings(&self) -> Vec<(String, u32)> {
        let pair = |(name, binding, _): &Global| (name.clone(), *binding);
        self.globals.iter().map(pair).collect()
    }
}

/// Name, number and kind of what entry points bind in group 0, in order of the numbers.
fn globals(
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
