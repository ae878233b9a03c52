//! Strict mode: shaders whose float arithmetic a driver must not rearrange.
//!
//! Drivers may regroup sums and products as if they were real numbers. SPIR-V forbids it by the decoration
//! `NoContraction`, which naga does not write, so it is added here to the words that naga writes. Only for drivers of
//! Vulkan, and only for comparing bits: the ordinary path needs none of this.

use wgpu::naga::back::spv;
use wgpu::naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use wgpu::naga::valid::ModuleInfo;
use wgpu::naga::{Module, ShaderStage};

/// A decorated module for one entry point whose overrides are resolved.
pub(crate) fn module(
    device: &wgpu::Device,
    label: &str,
    module: &Module,
    info: &ModuleInfo,
    entry: &str,
    bindings: &spv::BindingMap,
) -> Result<wgpu::ShaderModule, String> {
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::empty(),
        binding_map: bindings.clone(),
        // What wgpu asks for in the ordinary path.
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            buffer: BoundsCheckPolicy::Restrict,
            image_load: BoundsCheckPolicy::Restrict,
            binding_array: BoundsCheckPolicy::Unchecked,
        },
        zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::Polyfill,
        force_loop_bounding: true,
        ..spv::Options::default()
    };
    let pipeline = spv::PipelineOptions {
        shader_stage: ShaderStage::Compute,
        entry_point: entry.to_owned(),
    };
    let words =
        spv::write_vec(module, info, &options, Some(&pipeline)).map_err(|e| e.to_string())?;
    let words = decorated(&words);
    let size = module
        .entry_points
        .iter()
        .find(|e| e.name == entry)
        .map_or([1; 3], |e| e.workgroup_size);
    let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
        label: Some(label),
        entry_points: std::borrow::Cow::Owned(vec![wgpu::PassthroughShaderEntryPoint {
            name: entry.to_owned().into(),
            workgroup_size: (size[0], size[1], size[2]),
        }]),
        spirv: Some(words.into()),
        ..Default::default()
    };
    #[expect(
        unsafe_code,
        reason = "the only way to hand wgpu SPIR-V; the words come from naga, validated, with bounds checks, and are \
                  changed by decorations alone"
    )]
    // SAFETY: as the reason says: no word that accesses memory is touched.
    Ok(unsafe { device.create_shader_module_passthrough(descriptor) })
}

const HEADER: usize = 5;
const OP_EXT_INST: u32 = 12;
const OP_TYPES: std::ops::RangeInclusive<u32> = 19..=39;
const OP_TYPE_FLOAT: u32 = 22;
const OP_TYPE_VECTOR: u32 = 23;
const OP_DECORATE: u32 = 71;
const NO_CONTRACTION: u32 = 42;
/// Negation, sum, difference, product, quotient, vector times scalar, dot.
const ARITHMETIC: [u32; 7] = [127, 129, 131, 133, 136, 142, 148];

/// The words with `NoContraction` on every result of float arithmetic.
pub(crate) fn decorated(words: &[u32]) -> Vec<u32> {
    let mut floats = Vec::new();
    let mut results = Vec::new();
    let mut types_start = words.len();
    for (at, code, operands) in instructions(words) {
        if OP_TYPES.contains(&code) && types_start == words.len() {
            types_start = at;
        }
        match (code, operands) {
            (OP_TYPE_FLOAT, [id, ..]) => floats.push(*id),
            (OP_TYPE_VECTOR, [id, component, ..]) if floats.contains(component) => floats.push(*id),
            (code, [kind, id, ..])
                if (ARITHMETIC.contains(&code) || code == OP_EXT_INST) && floats.contains(kind) =>
            {
                results.push(*id);
            }
            _ => {}
        }
    }
    let mut out = words[..types_start].to_vec();
    for id in results {
        out.extend([OP_DECORATE | 3 << 16, id, NO_CONTRACTION]);
    }
    out.extend_from_slice(&words[types_start..]);
    out
}

/// Place, code and operands of each instruction.
fn instructions(words: &[u32]) -> impl Iterator<Item = (usize, u32, &[u32])> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let word = *words.get(at)?;
        let length = ((word >> 16) as usize).max(1);
        let operands = words.get(at + 1..at + length)?;
        let start = at;
        at += length;
        Some((start, word & 0xffff, operands))
    })
}
